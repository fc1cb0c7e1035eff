#pragma once

#include "lv/anatomy/segmentation.hpp"
#include "lv/case_file/case.hpp"
#include "lv/geometry/frame.hpp"
#include "lv/geometry/spline_wall.hpp"
#include "lv/mesh/wall_mesh.hpp"
#include "lv/report/quality_sheet.hpp"

#include <filesystem>
#include <memory>
#include <optional>

namespace lv::anatomy {

/// The wall's shape at early diastole and how image space relates to the model.
struct Shape {
  mesh::WallMap wall;               ///< empty for a mesh from elsewhere
  std::optional<mesh::Mesh> given;  ///< that mesh
  std::vector<bool> infarcted;      ///< its elements in infarct.elements.set, if that is the source
  geometry::Frame frame;
  bool is_in_images = true;  ///< false: the shape was thought of in the model frame itself
  std::optional<report::QualitySheet> quality;           ///< for a drawn wall
  std::shared_ptr<const CineSegmentation> segmentation;  ///< of borders that the program drew
  /// Loops at end-systole where the source shows them besides, moved as the slices were, image
  /// space.
  std::vector<geometry::Contour> end_systole;
  std::vector<std::string> notes;             ///< what was assumed or changed
  std::vector<geometry::Assumption> assumed;  ///< septum, early diastole, apex, base
  std::vector<geometry::Assumption>
      warnings;  ///< of these, what results may be wrong for: a septum that
                 ///< nothing shows, a filled wall taken as free of stress
};

/// The shape that a case asks for. Throws InputError naming the file and what is wrong in it.
[[nodiscard]] Shape make_anatomy(const case_file::Case& c);

/// Writes surfaces.vtu (in the model frame), frame.json and, for a drawn wall, fit.csv with the
/// residual distances per image and the quality sheet as quality.csv, .json and .txt; for borders
/// that the program drew, segmentation/ with what write_segmentation makes. es_contours.csv holds
/// the loops at end-systole where there are some.
void write_anatomy(const Shape& shape, const std::filesystem::path& folder);

/// What write_anatomy left in a folder of a shape's frame, assumptions and warnings.
struct AnatomyRecord {
  std::optional<geometry::Frame> frame;  ///< none for a shape that is in no images
  std::vector<geometry::Assumption> assumed;
  std::vector<std::string> warnings;
  std::vector<geometry::Contour> end_systole;  ///< empty where none are drawn
};
[[nodiscard]] AnatomyRecord anatomy_record(const std::filesystem::path& folder);

}  // namespace lv::anatomy
