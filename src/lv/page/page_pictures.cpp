#include "lv/page/page_pictures.hpp"

#include "lv/drawing/picture_files.hpp"
#include "lv/page/packing.hpp"
#include "lv/report/work_folder.hpp"

#include <nlohmann/json.hpp>

#include <cmath>
#include <map>
#include <tuple>

namespace lv::page {
namespace {

using Json = nlohmann::ordered_json;

/// An image's state and slice.
using Place = std::pair<std::string, std::string>;

/// One line over an image.
struct Outline {
  std::string source, contour;
  std::vector<Vec3> points;  ///< image space [mm]
};

/// The lines of outlines.csv over each image.
std::map<Place, std::vector<Outline>> read_outlines(const Table& table) {
  const auto state = table.words("state");
  const auto slice = table.words("slice");
  const auto source = table.words("source");
  const auto contour = table.words("contour");
  const auto line = table.words("line");
  const auto x = table.numbers("x_mm");
  const auto y = table.numbers("y_mm");
  const auto z = table.numbers("z_mm");
  std::map<Place, std::vector<Outline>> outlines;
  for (std::size_t i = 0; i < state.size(); ++i) {
    const auto key = [&](std::size_t row) {
      return std::tie(state[row], slice[row], source[row], contour[row], line[row]);
    };
    auto& lines = outlines[{state[i], slice[i]}];
    if (i == 0 || key(i) != key(i - 1))
      lines.push_back({source[i], contour[i], {}});
    lines.back().points.emplace_back(x[i], y[i], z[i]);
  }
  return outlines;
}

Json vector_json(const Vec3& v) {
  return {v.x(), v.y(), v.z()};
}

/// To a hundredth of a pixel.
double rounded_pixels(double pixels) {
  return std::round(100.0 * pixels) / 100.0;
}

Json line_json(const Outline& outline, const image::Plane& plane) {
  Json points = Json::array();
  for (const Vec3& x : outline.points) {
    const Vec3 p = plane.pixel(x);
    points.push_back(rounded_pixels(p.x() + 0.5));  // pixel 0 reaches from 0 to 1
    points.push_back(rounded_pixels(p.y() + 0.5));
  }
  return {{"source", outline.source}, {"contour", outline.contour}, {"points", points}};
}

}  // namespace

std::string pictures_json(const std::filesystem::path& work) {
  const auto table = report::table_of(work, "results", "outlines.csv");
  if (!table)
    return "";
  const auto pictures = drawing::read_pictures(report::folder_of(work, "results") / "pictures");
  if (pictures.empty())
    return "";
  const auto outlines = read_outlines(*table);
  Json list = Json::array();
  for (const drawing::ShownPicture& p : pictures) {
    Json lines = Json::array();
    if (const auto found = outlines.find({p.state, p.slice}); found != outlines.end())
      for (const Outline& outline : found->second)
        lines.push_back(line_json(outline, p.plane));
    list.push_back({{"state", p.state},
                    {"slice", p.slice},
                    {"phase", p.phase},
                    {"columns", p.plane.columns},
                    {"rows", p.plane.rows},
                    {"spacing_i_mm", p.plane.spacing_i},
                    {"spacing_j_mm", p.plane.spacing_j},
                    {"along_row", vector_json(p.plane.along_row)},
                    {"along_column", vector_json(p.plane.along_column)},
                    {"png", base64(read_file(p.file))},
                    {"lines", lines}});
  }
  return list.dump();
}

}  // namespace lv::page
