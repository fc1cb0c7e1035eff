#pragma once

#include "lv/phantom/imaging.hpp"
#include "lv/phantom/truth.hpp"

#include <filesystem>
#include <string>

namespace lv::phantom {

/// Which image files a study has.
struct StudyFiles {
  bool dicom = true, nifti = true;
};

/// Makes a complete study of a phantom:
///
///   dicom/               cine of short and long axes, late enhancement, as mixed files
///   nifti/               the same as volumes, with label maps
///   contours/            CSV at end-diastole (ed), end-systole (es) and early diastole
///   case.toml            a case that takes the study
///   truth.json, truth_segments.csv, truth_rotation.csv
///
/// Throws InputError for a phantom that cannot be and RunError when files cannot be written.
/// Returns what to tell the user.
std::string write_study(const Ventricle& ventricle, const Scan& scan, const StudyFiles& files,
                        const std::filesystem::path& folder);

/// The short-axis cine alone, in memory.
[[nodiscard]] image::Cine short_axis_cine(const Ventricle& ventricle, const Scan& scan,
                                          const ScanPlanes& planes);

/// The long-axis cines alone.
[[nodiscard]] image::Cine long_axis_cine(const Ventricle& ventricle, const Scan& scan,
                                         const ScanPlanes& planes);

}  // namespace lv::phantom
