#pragma once

#include "lv/case_file/case_lines.hpp"
#include "lv/image/dicom_study.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace lv::proposal {

/// What a file or a folder is to a case.
enum class SourceKind {
  volume,  ///< voxels in a single file
  dicom,
  sunnybrook,
  contours,
  guide_points,
  contour_file,  ///< contours of another program
  mesh,
  surface,
  case_file
};

/// Told by name, by the first line of a text, or by content. Throws InputError that names all that
/// are read.
[[nodiscard]] SourceKind kind_of(const std::filesystem::path& source);

/// What a source is, in words, and the lines by which a case uses it.
struct Proposal {
  std::string what;
  std::vector<case_file::CaseLine> lines;
};

/// Reads a source of the anatomy: a label map, contours, guide points, a mesh; images without a
/// drawn wall too, to which lines are left to fill in. `name` is what the case calls it. Throws
/// InputError where it cannot be read.
[[nodiscard]] Proposal propose(const std::filesystem::path& source, const std::string& name);

/// The same of a folder of DICOM files that has been read, with the folder of Sunnybrook contours
/// drawn on them if there is one, and what the case calls that.
[[nodiscard]] Proposal propose(const image::DicomStudy& study, const std::string& name,
                               const std::filesystem::path& contours = {},
                               const std::string& contours_name = "");

/// A case file with what a source shows filled in, with the engine and what each costs on its first
/// lines. Names are relative to `file`, which need not exist.
[[nodiscard]] std::string proposed_case(const std::filesystem::path& source,
                                        const std::filesystem::path& file);

}  // namespace lv::proposal
