#include "lv/scar/scar_map.hpp"

#include "lv/base/check.hpp"
#include "lv/base/lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

namespace lv::scar {
namespace {

constexpr std::array<const char*, 4> tissue_names{"outside", "muscle", "remote", "scar"};

enum MapColumn {
  slice_number,
  tissue_name,
  row_number,
  first_pixel,
  last_pixel,
  x_of_first,
  y_of_first,
  z_of_first,
  phase_number,
  grey_threshold,
  how_drawn,
  drawn_by,
  drawn_when,
  map_columns
};
constexpr std::array<std::string_view, map_columns> map_column_names{
    "slice", "tissue", "row",       "first", "last", "x_mm", "y_mm",
    "z_mm",  "phase",  "threshold", "how",   "by",   "when"};

/// Reads the rows of a map's table.
class MapReader {
 public:
  MapReader(const std::filesystem::path& file, const image::Cine& image)
      : lines_(file), image_(image) {
    if (!lines_.is_open() || !lines_.next())
      throw InputError(file.string(), "the map of scar cannot be read or is empty",
                       "Name a file that ventricle draw has saved");
    read_columns();
    for (const image::CineSlice& slice : image.slices)
      map_.slices.push_back(
          {std::vector<Tissue>(slice.frames.front().values.size(), Tissue::outside), {}});
  }

  ScarMap map() {
    while (lines_.next())
      read_run();
    return std::move(map_);
  }

 private:
  void read_columns() {
    const auto fields = csv_fields(lines_.text());
    width_ = fields.size();
    for (std::size_t c = 0; c < map_columns; ++c) {
      const auto found = std::find(fields.begin(), fields.end(), map_column_names.at(c));
      if (found == fields.end())
        throw InputError(lines_.where(),
                         fmt::format("column \"{}\" is missing", map_column_names.at(c)),
                         "Name a map of scar that ventricle draw has saved");
      at_.at(c) = static_cast<std::size_t>(found - fields.begin());
    }
  }

  void read_run() {
    fields_ = csv_fields(lines_.text());
    if (fields_.size() != width_)
      refuse(fmt::format("{} values in a table of {} columns", fields_.size(), width_));
    const auto s = static_cast<std::size_t>(number(slice_number, image_.slices.size()) - 1);
    const image::Plane& plane = image_.slices[s].frames.front().plane;
    Run run{number(row_number, static_cast<std::size_t>(plane.rows)) - 1,
            number(first_pixel, static_cast<std::size_t>(plane.columns)) - 1,
            number(last_pixel, static_cast<std::size_t>(plane.columns)) - 1, Tissue::outside};
    check_place(plane, run);
    run.tissue = tissue();
    paint(map_.slices[s], plane, run);
    map_.slices[s].drawn = {field(how_drawn), field(drawn_by), field(drawn_when)};
    map_.threshold = real(grey_threshold);
    map_.phase = static_cast<int>(real(phase_number));
  }

  void check_place(const image::Plane& plane, const Run& run) const {
    constexpr double farthest = 0.1;  // of a pixel
    const Vec3 x(real(x_of_first), real(y_of_first), real(z_of_first));
    const double away = (x - plane.point(run.first, run.row)).norm();
    if (!(away < farthest * std::min(plane.spacing_i, plane.spacing_j)))
      refuse(fmt::format("the pixel lies {:.1f} mm from where the image has it", away),
             "It belongs to another image: name the one on which the scar was drawn");
  }

  [[nodiscard]] Tissue tissue() const {
    const auto name = std::find(tissue_names.begin() + 1, tissue_names.end(), field(tissue_name));
    if (name == tissue_names.end())
      refuse(fmt::format("unknown tissue \"{}\"", field(tissue_name)));
    return static_cast<Tissue>(name - tissue_names.begin());
  }

  void paint(SliceMap& slice, const image::Plane& plane, const Run& run) const {
    for (int i = run.first; i <= run.last; ++i) {
      Tissue& pixel = slice.pixels[plane.index(i, run.row)];
      if (pixel != Tissue::outside)
        refuse(fmt::format("pixel {} of row {} stands there twice", i + 1, run.row + 1));
      pixel = run.tissue;
    }
  }

  [[nodiscard]] const std::string& field(MapColumn c) const { return fields_[at_.at(c)]; }

  /// A whole number from 1.
  [[nodiscard]] int number(MapColumn c, std::size_t most) const {
    const auto value = number_of<int>(field(c));
    if (!value || *value < 1 || static_cast<std::size_t>(*value) > most)
      refuse(fmt::format("{} \"{}\" is no number from 1 to {}", map_column_names.at(c), field(c),
                         most));
    return *value;
  }

  [[nodiscard]] double real(MapColumn c) const {
    const auto value = number_of<double>(field(c));
    if (!value || !std::isfinite(*value))
      refuse(fmt::format("{} \"{}\" is no number", map_column_names.at(c), field(c)));
    return *value;
  }

  [[noreturn]] void refuse(
      const std::string& what,
      const std::string& remedy = "Take the file as ventricle draw has saved it") const {
    throw InputError(lines_.where(), what, remedy);
  }

  LineReader lines_;
  const image::Cine& image_;
  std::size_t width_ = 0;
  std::array<std::size_t, map_columns> at_{};
  std::vector<std::string> fields_;
  ScarMap map_;
};

/// Numbers of the pixels across the sides of one, where they are.
std::vector<std::size_t> beside(const image::Plane& plane, std::size_t pixel) {
  const auto columns = static_cast<std::size_t>(plane.columns);
  const auto rows = static_cast<std::size_t>(plane.rows);
  std::vector<std::size_t> all;
  if (pixel % columns > 0)
    all.push_back(pixel - 1);
  if (pixel % columns + 1 < columns)
    all.push_back(pixel + 1);
  if (pixel >= columns)
    all.push_back(pixel - columns);
  if (pixel + columns < rows * columns)
    all.push_back(pixel + columns);
  return all;
}

/// Pixels of the wall that hang together and are no scar.
struct Rest {
  std::vector<std::size_t> pixels;
  bool reaches_epicardium = false;
};

Rest rest_from(const image::Plane& plane, const std::vector<char>& parts,
               const std::vector<char>& scar, std::size_t first, std::vector<char>& seen) {
  Rest rest{{first}, false};
  seen[first] = 1;
  for (std::size_t n = 0; n < rest.pixels.size(); ++n)
    for (const std::size_t next : beside(plane, rest.pixels[n])) {
      rest.reaches_epicardium = rest.reaches_epicardium || parts[next] == 2;
      if (parts[next] != 1 || scar[next] != 0 || seen[next] != 0)
        continue;
      seen[next] = 1;
      rest.pixels.push_back(next);
    }
  return rest;
}

void fill_dark_core(const image::Plane& plane, const std::vector<char>& parts,
                    std::vector<char>& scar) {
  std::vector<char> seen(parts.size(), 0);
  std::vector<Rest> all;
  for (std::size_t n = 0; n < parts.size(); ++n)
    if (parts[n] == 1 && scar[n] == 0 && seen[n] == 0)
      all.push_back(rest_from(plane, parts, scar, n, seen));
  std::size_t largest = 0;
  for (const Rest& rest : all)
    largest = std::max(largest, rest.pixels.size());
  for (const Rest& rest : all)
    if (!rest.reaches_epicardium && rest.pixels.size() < largest)
      for (const std::size_t n : rest.pixels)
        scar[n] = 1;
}

/// The tissue of the nearest pixel of the wall within reach, else outside.
Tissue nearest_tissue(const std::vector<Tissue>& pixels, const image::Plane& plane, int i, int j) {
  constexpr double reach = 5.0;  // [mm]
  const int across = static_cast<int>(reach / plane.spacing_i);
  const int down = static_cast<int>(reach / plane.spacing_j);
  double least = reach;
  Tissue found = Tissue::outside;
  for (int b = std::max(0, j - down); b <= std::min(plane.rows - 1, j + down); ++b)
    for (int a = std::max(0, i - across); a <= std::min(plane.columns - 1, i + across); ++a) {
      const Tissue tissue = pixels[plane.index(a, b)];
      const double away = std::hypot((a - i) * plane.spacing_i, (b - j) * plane.spacing_j);
      if (tissue == Tissue::outside || away >= least)
        continue;
      least = away;
      found = tissue;
    }
  return found;
}

image::Picture scar_picture(const SliceMap& slice, const image::Plane& plane) {
  image::Picture picture{plane, {}};
  for (int j = 0; j < plane.rows; ++j)
    for (int i = 0; i < plane.columns; ++i)
      picture.values.push_back(nearest_tissue(slice.pixels, plane, i, j) == Tissue::scar ? 1.0F
                                                                                         : 0.0F);
  return picture;
}

}  // namespace

std::vector<char> parts_of(const image::Plane& plane, const std::optional<WallOutlines>& lines) {
  constexpr char surroundings = 2;
  std::vector<char> parts(static_cast<std::size_t>(plane.rows) * plane.columns, surroundings);
  if (!lines)
    return parts;
  Eigen::AlignedBox2d box;
  for (const Eigen::Vector2d& x : lines->epi)
    box.extend(x);
  for (int j = 0; j < plane.rows; ++j)
    for (int i = 0; i < plane.columns; ++i)
      if (const Eigen::Vector2d x(i * plane.spacing_i, j * plane.spacing_j); box.contains(x))
        parts[plane.index(i, j)] = static_cast<char>(part_at(*lines, x));
  return parts;
}

std::vector<char> brighter(const image::Picture& picture, const std::vector<char>& parts,
                           double threshold, bool fill) {
  std::vector<char> scar(parts.size(), 0);
  for (std::size_t n = 0; n < parts.size(); ++n)
    scar[n] = parts[n] == 1 && picture.values[n] > threshold ? 1 : 0;
  if (fill)
    fill_dark_core(picture.plane, parts, scar);
  return scar;
}

std::vector<Run> runs_of(const std::vector<Tissue>& pixels, const image::Plane& plane) {
  std::vector<Run> runs;
  for (int row = 0; row < plane.rows; ++row) {
    const auto at = [&](int i) {
      return pixels[static_cast<std::size_t>(row) * static_cast<std::size_t>(plane.columns) +
                    static_cast<std::size_t>(i)];
    };
    for (int i = 0; i < plane.columns;) {
      int end = i + 1;
      while (end < plane.columns && at(end) == at(i))
        ++end;
      if (at(i) != Tissue::outside)
        runs.push_back({row, i, end - 1, at(i)});
      i = end;
    }
  }
  return runs;
}

Table table_of(const ScarMap& map, const image::Cine& image) {
  Table table(std::vector<std::string>(map_column_names.begin(), map_column_names.end()));
  for (std::size_t s = 0; s < map.slices.size(); ++s) {
    const SliceMap& slice = map.slices[s];
    const image::Plane& plane = image.slices[s].frames.front().plane;
    for (const Run& run : runs_of(slice.pixels, plane)) {
      const Vec3 x = plane.point(run.first, run.row);
      table.add_row({std::to_string(s + 1), tissue_names.at(static_cast<std::size_t>(run.tissue)),
                     std::to_string(run.row + 1), std::to_string(run.first + 1),
                     std::to_string(run.last + 1), fmt::format("{:.3f}", x.x()),
                     fmt::format("{:.3f}", x.y()), fmt::format("{:.3f}", x.z()),
                     std::to_string(map.phase), Table::number(map.threshold), slice.drawn.how,
                     slice.drawn.by, slice.drawn.when});
    }
  }
  return table;
}

ScarMap read_scar_map(const std::filesystem::path& file, const image::Cine& image) {
  return MapReader(file, image).map();
}

image::Cine scar_stack(const ScarMap& map, const image::Cine& image) {
  image::Cine stack;
  for (std::size_t s = 0; s < map.slices.size(); ++s)
    stack.slices.push_back({image.slices[s].name,
                            {scar_picture(map.slices[s], image.slices[s].frames.front().plane)},
                            {},
                            0.0});
  return stack;
}

}  // namespace lv::scar
