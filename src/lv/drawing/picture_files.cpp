#include "lv/drawing/picture_files.hpp"

#include "lv/drawing/canvas.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace lv::drawing {
namespace {

namespace fs = std::filesystem;

constexpr const char* list_name = "pictures.csv";
constexpr std::array axes{"x", "y", "z"};

/// Pixels from `first` up to, not including, `last`.
struct Extent {
  int first, last;
};

/// Of positions [pixels] with a margin [pixels], inside 0 to `count`.
Extent extent(const std::vector<double>& positions, double margin, int count) {
  const auto [low, high] = std::minmax_element(positions.begin(), positions.end());
  const int first = std::clamp(static_cast<int>(*low - margin), 0, count - 1);
  return {first, std::clamp(static_cast<int>(*high + margin + 1.0), first + 1, count)};
}

std::vector<std::string> columns() {
  std::vector<std::string> names{"state",   "slice", "phase",        "file",
                                 "columns", "rows",  "spacing_i_mm", "spacing_j_mm"};
  for (const char* axis : axes)
    names.push_back(fmt::format("origin_{}_mm", axis));
  for (const char* direction : {"row", "column"})
    for (const char* axis : axes)
      names.push_back(fmt::format("along_{}_{}", direction, axis));
  return names;
}

std::vector<std::string> fields(const PictureFile& p, const std::string& file) {
  const image::Plane& plane = p.picture.plane;
  std::vector<std::string> row{p.state,
                               p.slice,
                               std::to_string(p.phase),
                               file,
                               std::to_string(plane.columns),
                               std::to_string(plane.rows),
                               Table::number(plane.spacing_i),
                               Table::number(plane.spacing_j)};
  for (const Vec3& v : {plane.origin, plane.along_row, plane.along_column})
    for (int d = 0; d < 3; ++d)
      row.push_back(Table::number(v[d]));
  return row;
}

/// end_diastole_04.png, end_diastole_long_axis_1.png
std::string file_name(const PictureFile& p) {
  std::string name = fmt::format("{}_{:0>2}.png", p.state, p.slice);
  std::replace(name.begin(), name.end(), ' ', '_');
  return name;
}

Vec3 vector_at(const Table& table, const std::string& name, const std::string& end,
               std::size_t row) {
  Vec3 v;
  for (int d = 0; d < 3; ++d)
    v[d] = table.numbers(fmt::format("{}{}{}", name, axes.at(d), end))[row];
  return v;
}

}  // namespace

image::Picture cut_around(const image::Picture& picture, const std::vector<Vec3>& points) {
  constexpr double margin = 18.0;  // [mm]
  if (points.empty())
    return picture;
  std::vector<double> across;
  std::vector<double> down;
  for (const Vec3& x : points) {
    const Vec3 p = picture.plane.pixel(x);
    across.push_back(p.x());
    down.push_back(p.y());
  }
  const auto [left, right] =
      extent(across, margin / picture.plane.spacing_i, picture.plane.columns);
  const auto [top, bottom] = extent(down, margin / picture.plane.spacing_j, picture.plane.rows);
  image::Picture part{picture.plane, {}};
  part.plane.origin = picture.plane.point(left, top);
  part.plane.columns = right - left;
  part.plane.rows = bottom - top;
  for (int j = top; j < bottom; ++j)
    for (int i = left; i < right; ++i)
      part.values.push_back(picture.at(i, j));
  return part;
}

std::vector<unsigned char> grey_levels(const image::Picture& picture) {
  std::vector<float> sorted = picture.values;
  const auto bright =
      sorted.begin() + static_cast<std::ptrdiff_t>(0.99 * static_cast<double>(sorted.size() - 1));
  std::nth_element(sorted.begin(), bright, sorted.end());
  const float high = *bright;
  const float low = *std::min_element(sorted.begin(), sorted.end());
  std::vector<unsigned char> levels;
  for (const float value : picture.values) {
    const float t = std::clamp((value - low) / std::max(high - low, 1e-6F), 0.0F, 1.0F);
    levels.push_back(static_cast<unsigned char>(std::lround(255.0F * t)));
  }
  return levels;
}

void write_pictures(const std::vector<PictureFile>& pictures, const fs::path& folder) {
  fs::create_directories(folder);
  Table list(columns());
  for (const PictureFile& p : pictures) {
    const std::string file = file_name(p);
    write_file(folder / file,
               grey_png(p.picture.plane.columns, p.picture.plane.rows, grey_levels(p.picture)));
    list.add_row(fields(p, file));
  }
  list.write_csv(folder / list_name);
}

std::vector<ShownPicture> read_pictures(const fs::path& folder) {
  if (!fs::exists(folder / list_name))
    return {};
  const Table list = Table::read_csv(folder / list_name);
  std::vector<ShownPicture> pictures;
  for (std::size_t i = 0; i < list.rows().size(); ++i) {
    const auto whole = [&](const char* column) { return list.whole_numbers(column)[i]; };
    const ShownPicture p{
        list.words("state")[i],
        list.words("slice")[i],
        whole("phase"),
        folder / list.words("file")[i],
        {vector_at(list, "origin_", "_mm", i), vector_at(list, "along_row_", "", i),
         vector_at(list, "along_column_", "", i), list.numbers("spacing_i_mm")[i],
         list.numbers("spacing_j_mm")[i], whole("columns"), whole("rows")}};
    if (fs::exists(p.file))
      pictures.push_back(p);
  }
  return pictures;
}

}  // namespace lv::drawing
