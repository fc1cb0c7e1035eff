#include "lv/geometry/landmarks.hpp"

#include "lv/base/check.hpp"
#include "lv/base/files.hpp"
#include "lv/base/lines.hpp"
#include "lv/base/table.hpp"
#include "lv/geometry/long_axis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lv::geometry {
namespace {

constexpr std::array<std::string_view, 7> landmark_columns{"landmark", "slice", "x_mm", "y_mm",
                                                           "z_mm",     "by",    "when"};
constexpr const char* landmark_rule =
    "The first line is landmark,slice,x_mm,y_mm,z_mm,by,when and every other line has as many "
    "values";

/// The number in a column of a line.
template <class Number>
Number landmark_number(const LineReader& lines, const std::string& text, std::size_t column) {
  const auto value = number_of<Number>(text);
  if (!value || !std::isfinite(static_cast<double>(*value)))
    throw InputError(lines.where(),
                     fmt::format("{} \"{}\" is not a number", landmark_columns.at(column), text),
                     "Give the slice's number and scanner millimetres, or remove the line");
  return *value;
}

Landmark landmark_of(const LineReader& lines) {
  const auto fields = csv_fields(lines.text());
  if (fields.size() != landmark_columns.size())
    throw InputError(lines.where(),
                     fmt::format("{} values instead of {}", fields.size(), landmark_columns.size()),
                     landmark_rule);
  const std::string& name = fields[0];
  if (std::find(landmark_names.begin(), landmark_names.end(), name) == landmark_names.end())
    throw InputError(lines.where(), fmt::format("unknown landmark \"{}\"", name),
                     fmt::format("Landmarks are {}", fmt::join(landmark_names, ", ")));
  const auto at = [&](std::size_t column) {
    return landmark_number<double>(lines, fields[column], column);
  };
  return {
      name, landmark_number<int>(lines, fields[1], 1), {at(2), at(3), at(4)}, fields[5], fields[6]};
}

/// The direction of a vector across the axis.
Vec3 across(const LongAxis& axis, const Vec3& x) {
  return (x - x.dot(axis.up) * axis.up).normalized();
}

}  // namespace

std::vector<Landmark> read_landmarks(const std::filesystem::path& file) {
  LineReader lines(file);
  if (!lines.is_open())
    throw InputError(file.string(), "the file of landmarks cannot be opened: " + unreadable(file),
                     "Check the name and that it can be read");
  if (!lines.next() || !std::ranges::equal(csv_fields(lines.text()), landmark_columns))
    throw InputError(file.string(), "is no table of landmarks", landmark_rule);
  std::vector<Landmark> all;
  while (lines.next()) {
    all.push_back(landmark_of(lines));
    const std::string& name = all.back().name;
    if (find(all, name) != &all.back())
      throw InputError(lines.where(), fmt::format("the landmark {} is there twice", name),
                       "Keep one");
  }
  return all;
}

const Landmark* find(const std::vector<Landmark>& landmarks, std::string_view name) {
  const auto found = std::find_if(landmarks.begin(), landmarks.end(),
                                  [&](const Landmark& mark) { return mark.name == name; });
  return found == landmarks.end() ? nullptr : &*found;
}

void write_landmarks(const std::vector<Landmark>& landmarks, const std::filesystem::path& file) {
  Table table({landmark_columns.begin(), landmark_columns.end()});
  const auto written = [](double x) { return fmt::format("{:.3f}", x); };
  for (const Landmark& mark : landmarks)
    table.add_row({mark.name, std::to_string(mark.slice), written(mark.at.x()),
                   written(mark.at.y()), written(mark.at.z()), mark.by, mark.when});
  table.write_csv(file);
}

std::optional<Septum> septum_of(const std::vector<Landmark>& landmarks, const Contours& contours,
                                const std::string& where) {
  constexpr double widest = 170.0 * std::numbers::pi / 180.0;  // beyond, a click decides the side
  constexpr const char* remedy =
      "Set septum_anterior and septum_inferior where the right ventricle's wall meets the left one";
  const Landmark* anterior = find(landmarks, "septum_anterior");
  const Landmark* inferior = find(landmarks, "septum_inferior");
  if (anterior == nullptr && inferior == nullptr)
    return std::nullopt;
  if (anterior == nullptr || inferior == nullptr)
    throw InputError(where, "one insertion of the septum is named without the other", remedy);
  const LongAxis axis = long_axis(contours);
  const Vec3 from_a = anterior->at - axis.point;
  const Vec3 from_b = inferior->at - axis.point;
  const Vec3 a = across(axis, from_a);
  const Vec3 b = across(axis, from_b);
  if (!(a.dot(b) > std::cos(widest)))
    throw InputError(where, "the insertions of the septum lie on opposite sides of the long axis",
                     remedy);
  const double h = 0.5 * (from_a + from_b).dot(axis.up);
  const double r = 0.5 * (from_a.dot(a) + from_b.dot(b));
  return Septum{axis.point + h * axis.up + r * (a + b).normalized(), axis.up.dot(a.cross(b)) > 0.0};
}

}  // namespace lv::geometry
