#pragma once

#include "lv/geometry/frame.hpp"
#include "lv/geometry/spline_wall.hpp"
#include "lv/job/case.hpp"
#include "lv/mesh/wall_mesh.hpp"
#include "lv/report/quality_sheet.hpp"

#include <filesystem>
#include <optional>

namespace lv::job {

/// The wall's shape at early diastole and how image space relates to the model.
struct Shape {
  mesh::WallMap wall;               ///< empty for a mesh from elsewhere
  std::optional<mesh::Mesh> given;  ///< that mesh
  std::vector<bool> infarcted;      ///< its elements in infarct.elements.set, if that is the source
  geometry::Frame frame;
  std::optional<report::QualitySheet> quality;  ///< for a drawn wall
  std::vector<std::string> notes;               ///< what was assumed or changed
};

/// The shape that a case asks for. Throws InputError naming the file and what is wrong in it.
[[nodiscard]] Shape make_anatomy(const Case& c);

/// What the names of regions rest on when the case says nowhere where the septum is; empty when it
/// does.
[[nodiscard]] std::string septum_note(const Case& c);

/// Writes surfaces.vtu (in the model frame), frame.json and, for a drawn wall, fit.csv with the
/// residual distances per image and the quality sheet as quality.csv, .json and .txt.
void write_anatomy(const Shape& shape, const std::filesystem::path& folder);

}  // namespace lv::job
