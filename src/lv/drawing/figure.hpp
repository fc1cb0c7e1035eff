#pragma once

#include "lv/drawing/bulls_eye.hpp"
#include "lv/drawing/chart.hpp"
#include "lv/drawing/orientation.hpp"
#include "lv/drawing/scene.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace lv::drawing {

/// A scene seen by a camera, with a bar that shows its scale in mm, and letters over it.
struct Picture {
  Scene scene{};
  Camera camera{};
  std::vector<Letter> letters{};
  bool scale_bar = true;
};

struct ColourBar {
  std::string label{};  ///< with its unit, e.g. "fibre stress [kPa]"
  ColourScale scale{};
};

/// One part of a figure: title, legend, content and colour bar.
struct Panel {
  std::string title{};
  std::variant<Picture, LineChart, BullsEye> content{};
  std::optional<ColourBar> colour_bar{};
  std::vector<LegendEntry> legend{};  ///< a line chart adds its series
};

/// Panels in a grid, row after row, all of one size. Lengths in points (1/72 inch).
struct Figure {
  std::vector<Panel> panels{};
  int columns = 2;
  double panel_width = 340.0;
  double panel_height = 300.0;  ///< without title and legend
  std::string title{};
  std::string footnote{};
  std::optional<ColourBar> colour_bar{};  ///< for all panels, on the right
};

/// The bytes of a file. In SVG all but scenes is made of lines and text. Scenes are drawn with
/// `pixels_per_point` pixels in both.
[[nodiscard]] std::string png(const Figure& figure, double pixels_per_point = 2.0);
[[nodiscard]] std::string svg(const Figure& figure, double pixels_per_point = 3.0);

/// Writes PNG or SVG as the file's extension says. Throws RunError naming a file that cannot be
/// written.
void write(const Figure& figure, const std::filesystem::path& file);

}  // namespace lv::drawing
