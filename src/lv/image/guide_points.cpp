#include "lv/image/guide_points.hpp"

#include "lv/base/check.hpp"
#include "lv/base/lines.hpp"
#include "lv/geometry/contour_measures.hpp"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <string_view>
#include <utility>

namespace lv::image {
namespace {

namespace fs = std::filesystem;
using geometry::Contour;
using geometry::Side;

constexpr double pi = std::numbers::pi;
constexpr double widest_gap = pi / 3.0;  // of an epicardial loop
constexpr double farthest = 1e7;         // more than a ventricle in micrometres
constexpr const char* column_rule =
    "The first line names the columns x, y, z, contour type, slice and time frame, separated by "
    "tabs";

struct Row {
  Vec3 x;
  std::string type;
  int slice = 0, frame = 0, line = 0;
};

std::string lower(std::string_view text) {
  std::string result;
  for (const char c : text)
    result += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return result;
}

/// The fields of a line, without quotation marks.
std::vector<std::string_view> columns_of(std::string_view line) {
  std::vector<std::string_view> fields = fields_of(line, '\t');
  for (std::string_view& field : fields)
    if (field.size() > 1 && field.front() == '"' && field.back() == '"')
      field = trimmed(field.substr(1, field.size() - 2));
  return fields;
}

/// The file, line by line.
class List {
 public:
  explicit List(const fs::path& file) : file_(file.string()), lines_(file) {
    if (!lines_.is_open())
      throw InputError(file_, "the list of points cannot be opened",
                       "Check the name and that it can be read");
    read_header();
  }

  std::vector<Row> rows() {
    std::vector<Row> rows;
    while (lines_.next())
      rows.push_back(row());
    if (rows.empty())
      throw InputError(file_, "the list holds no points", "Write one point a line");
    return rows;
  }

 private:
  void read_header() {
    if (!lines_.next())
      throw InputError(file_, "the list of points is empty", column_rule);
    const auto fields = columns_of(lines_.text());
    width_ = fields.size();
    const auto column = [&](const std::vector<std::string>& names) {
      for (std::size_t i = 0; i < fields.size(); ++i)
        if (std::find(names.begin(), names.end(), lower(fields[i])) != names.end())
          return static_cast<int>(i);
      return -1;
    };
    at_ = {column({"x"}),     column({"y"}),
           column({"z"}),     column({"contour type", "type"}),
           column({"slice"}), column({"time frame", "frame"})};
    const std::array<const char*, 5> needed{"x", "y", "z", "contour type", "slice"};
    for (std::size_t c = 0; c < needed.size(); ++c)
      if (at_[c] < 0)
        throw InputError(lines_.where(), fmt::format("column \"{}\" is missing", needed[c]),
                         column_rule);
  }

  [[nodiscard]] Row row() const {
    const auto fields = columns_of(lines_.text());
    if (fields.size() < width_)
      throw InputError(lines_.where(),
                       fmt::format("{} values in a table of {} columns", fields.size(), width_),
                       "Give every line one value per column, separated by tabs");
    Row row;
    row.line = lines_.number();
    for (int d = 0; d < 3; ++d)
      row.x[d] = coordinate(fields[at_[d]]);
    row.type = fields[at_[3]];
    row.slice = whole(fields[at_[4]]);
    row.frame = at_[5] < 0 ? 0 : whole(fields[at_[5]]);
    return row;
  }

  [[nodiscard]] double number(std::string_view text) const {
    double value = 0.0;
    const char* end = text.data() + text.size();
    const auto result = std::from_chars(text.data(), end, value);
    if (result.ec != std::errc() || result.ptr != end || !std::isfinite(value))
      throw InputError(lines_.where(), fmt::format("\"{}\" is not a finite number", text),
                       "Give positions in scanner millimetres");
    return value;
  }

  [[nodiscard]] double coordinate(std::string_view text) const {
    const double value = number(text);
    if (std::abs(value) > farthest)
      throw InputError(lines_.where(), fmt::format("\"{}\" is no place in a scanner", text),
                       "Give positions in scanner millimetres");
    return value;
  }

  /// Whole numbers are also written as 3.0 or 3.0000.
  [[nodiscard]] int whole(std::string_view text) const {
    const double value = number(text);
    if (value != std::round(value) || std::abs(value) > 1e9)
      throw InputError(lines_.where(), fmt::format("\"{}\" is not a whole number", text),
                       "Number slices and times 0, 1, 2 and so on");
    return static_cast<int>(value);
  }

  std::string file_;
  LineReader lines_;
  std::size_t width_ = 0;
  std::array<int, 6> at_{};
};

/// The points of one time.
std::vector<Row> of_frame(std::vector<Row> rows, std::optional<int> frame,
                          const std::string& file) {
  std::set<int> frames;
  for (const Row& row : rows)
    frames.insert(row.frame);
  if (!frame && frames.size() > 1)
    throw InputError(file, fmt::format("has points of {} times", frames.size()),
                     fmt::format("Choose one of the time frames {}", fmt::join(frames, ", ")));
  if (frame && !frames.contains(*frame))
    throw InputError(file, fmt::format("has no points of the time frame {}", *frame),
                     fmt::format("Choose one of the time frames {}", fmt::join(frames, ", ")));
  if (frame)
    std::erase_if(rows, [&](const Row& row) { return row.frame != *frame; });
  return rows;
}

using Groups = std::map<std::pair<std::string, int>, std::vector<Row>>;

/// The points of a type on each slice.
std::map<int, std::vector<Row>> slices_of(const Groups& groups, const std::string& type) {
  std::map<int, std::vector<Row>> slices;
  for (const auto& [key, rows] : groups)
    if (key.first == type)
      slices[key.second] = rows;
  return slices;
}

Contour contour_of(const std::vector<Row>& rows, int slice, Side side, const std::string& file) {
  Contour contour{slice, side, {}, file, {}};
  for (const Row& row : rows) {
    contour.points.push_back(row.x);
    contour.lines.push_back(row.line);
  }
  return contour;
}

std::vector<Vec3> points_of(const std::vector<Row>& rows) {
  std::vector<Vec3> points;
  for (const Row& row : rows)
    points.push_back(row.x);
  return points;
}

/// Sorts rows by an angle.
template <class Angle>
void sort_by(std::vector<Row>& rows, const Angle& angle) {
  std::stable_sort(rows.begin(), rows.end(),
                   [&](const Row& a, const Row& b) { return angle(a.x) < angle(b.x); });
}

/// In order round the point `centre`; the widest angle between neighbours.
double sort_round(std::vector<Row>& rows, const Vec3& centre) {
  if (rows.size() < 3)
    return 2.0 * pi;
  const geometry::Frame plane = geometry::plane_of(points_of(rows));
  const auto angle = [&](const Vec3& x) {
    const Vec3 p = plane.axes.transpose() * (x - centre);
    return std::atan2(p.y(), p.x());
  };
  sort_by(rows, angle);
  double widest = 2.0 * pi + angle(rows.front().x) - angle(rows.back().x);
  for (std::size_t i = 1; i < rows.size(); ++i)
    widest = std::max(widest, angle(rows[i].x) - angle(rows[i - 1].x));
  return widest;
}

void add_loops(const Groups& groups, const std::string& file, GuidePoints& found) {
  const auto endo = slices_of(groups, "SAX_LV_ENDOCARDIAL");
  const auto epi = slices_of(groups, "SAX_LV_EPICARDIAL");
  const auto septum = slices_of(groups, "SAX_RV_SEPTUM");
  std::map<int, Vec3> centres;
  for (auto [slice, rows] : endo) {
    centres[slice] = geometry::mean_of(points_of(rows));
    sort_round(rows, centres[slice]);
    found.contours.short_axis.push_back(contour_of(rows, slice, Side::endo, file));
  }
  for (auto [slice, rows] : epi) {
    const Vec3 centre =
        centres.contains(slice) ? centres[slice] : geometry::mean_of(points_of(rows));
    double gap = sort_round(rows, centre);
    if (gap > widest_gap && septum.contains(slice)) {
      const auto& right = septum.at(slice);
      rows.insert(rows.end(), right.begin(), right.end());
      gap = sort_round(rows, centre);
    }
    if (gap > widest_gap)
      found.notes.push_back(
          fmt::format("slice {}: the epicardium is open over {:.0f} degrees: left "
                      "out",
                      slice, gap * 180.0 / pi));
    else
      found.contours.short_axis.push_back(contour_of(rows, slice, Side::epi, file));
  }
  std::stable_sort(found.contours.short_axis.begin(), found.contours.short_axis.end(),
                   [](const Contour& a, const Contour& b) { return a.slice < b.slice; });
}

/// Numbers the slices in the order in which they lie: lists of points name them as they like.
void renumber(GuidePoints& found) {
  std::vector<Contour>& loops = found.contours.short_axis;
  if (loops.empty())
    return;
  const Vec3 normal = geometry::plane_of(loops.front().points).axes.col(2);
  std::map<int, double> heights;
  for (const Contour& loop : loops)
    heights.try_emplace(loop.slice, geometry::mean_of(loop.points).dot(normal));
  std::vector<int> order;
  for (const auto& [slice, height] : heights)
    order.push_back(slice);
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return heights[a] < heights[b]; });
  if (std::is_sorted(order.begin(), order.end()) || std::is_sorted(order.rbegin(), order.rend()))
    return;
  found.notes.push_back("the slices are not numbered in order: counted anew along their normal");
  for (Contour& loop : loops)
    loop.slice =
        static_cast<int>(std::find(order.begin(), order.end(), loop.slice) - order.begin()) + 1;
  std::stable_sort(loops.begin(), loops.end(),
                   [](const Contour& a, const Contour& b) { return a.slice < b.slice; });
}

/// From the most basal to the most apical: the end with the larger cavity is the base unless points
/// of the annulus say otherwise.
Vec3 towards_base(const GuidePoints& found, const Vec3& middle) {
  if (!found.contours.annulus.empty())
    return (geometry::mean_of(found.contours.annulus) - middle).normalized();
  std::vector<const Contour*> endo;
  for (const Contour& c : found.contours.short_axis)
    if (c.side == Side::endo)
      endo.push_back(&c);
  const Vec3 along =
      geometry::mean_of(endo.back()->points) - geometry::mean_of(endo.front()->points);
  const bool base_last = geometry::mean_radius(*endo.back()) > geometry::mean_radius(*endo.front());
  return (base_last ? along : Vec3(-along)).normalized();
}

void add_curves(const Groups& groups, const std::string& file, GuidePoints& found) {
  Vec3 middle = Vec3::Zero();
  int loops = 0;
  for (const Contour& c : found.contours.short_axis)
    if (c.side == Side::endo) {
      middle += geometry::mean_of(c.points);
      ++loops;
    }
  if (loops < 2)
    return;  // the check of the contours says so
  middle /= loops;
  const Vec3 up = towards_base(found, middle);
  for (const auto& [type, side] :
       {std::pair("LAX_LV_ENDOCARDIAL", Side::endo), std::pair("LAX_LV_EPICARDIAL", Side::epi)})
    for (auto [slice, rows] : slices_of(groups, type)) {
      if (rows.size() < 3)
        continue;
      const Vec3 normal = geometry::plane_of(points_of(rows)).axes.col(2);
      const Vec3 across = normal.cross(up);
      sort_by(rows, [&](const Vec3& x) {
        return std::atan2((x - middle).dot(across), -(x - middle).dot(up));
      });
      found.contours.long_axis.push_back(contour_of(rows, slice, side, file));
    }
}

void add_points(const Groups& groups, const std::string& file, Side apex_of, GuidePoints& found) {
  std::vector<Vec3> septum;
  int unused = 0;
  std::set<std::string> unused_types;
  for (const auto& [key, rows] : groups) {
    const std::string& type = key.first;
    const bool curve = type.starts_with("SAX_LV_E") || type.starts_with("LAX_LV_E");
    for (const Row& row : rows)
      if (type == "MITRAL_VALVE")
        found.contours.annulus.push_back(row.x);
      else if (type == "SAX_RV_SEPTUM")
        septum.push_back(row.x);
      else if (type == "APEX_ENDO_POINT" || type == "APEX_EPI_POINT" || type == "APEX_POINT")
        found.contours.apex.push_back({row.slice,
                                       type == "APEX_POINT"        ? apex_of
                                       : type == "APEX_ENDO_POINT" ? Side::endo
                                                                   : Side::epi,
                                       {row.x},
                                       file,
                                       {row.line}});
      else if (!curve) {
        ++unused;
        unused_types.insert(type);
      }
  }
  if (!septum.empty()) {
    const Vec3 x = geometry::mean_of(septum);
    found.septum = std::array{x.x(), x.y(), x.z()};
  }
  if (unused > 0)
    found.notes.push_back(fmt::format("{} points of other kinds are not used: {}", unused,
                                      fmt::join(unused_types, ", ")));
}

}  // namespace

GuidePoints read_guide_points(const fs::path& file, std::optional<int> frame, Side apex_of) {
  Groups groups;
  for (const Row& row : of_frame(List(file).rows(), frame, file.string()))
    groups[{row.type, row.slice}].push_back(row);
  GuidePoints found;
  add_points(groups, file.string(), apex_of, found);
  add_loops(groups, file.string(), found);
  renumber(found);
  add_curves(groups, file.string(), found);
  if (found.contours.short_axis.empty()) {
    std::set<std::string> types;
    for (const auto& [key, rows] : groups)
      types.insert(rows.front().type);
    throw InputError(file.string(),
                     fmt::format("has no points of short-axis loops; its contour types are {}",
                                 fmt::join(types, ", ")),
                     "Loops are of the types SAX_LV_ENDOCARDIAL and SAX_LV_EPICARDIAL");
  }
  return found;
}

std::vector<int> guide_point_frames(const fs::path& file) {
  std::set<int> frames;
  for (const Row& row : List(file).rows())
    frames.insert(row.frame);
  return {frames.begin(), frames.end()};
}

}  // namespace lv::image
