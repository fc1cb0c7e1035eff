#include "lv/image/guide_points.hpp"

#include "lv/base/check.hpp"
#include "lv/base/median.hpp"
#include "lv/geometry/contour_measures.hpp"
#include "lv/image/guide_point_list.hpp"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <utility>

namespace lv::image {
namespace {

namespace fs = std::filesystem;
using geometry::Contour;
using geometry::Side;

using std::numbers::pi;
constexpr double widest_gap = pi / 3.0;       // of an epicardial loop
constexpr std::size_t least_loop_points = 8;  // of a loop
using Groups = std::map<std::pair<std::string, int>, std::vector<GuidePoint>>;

/// The points of a type on each slice.
std::map<int, std::vector<GuidePoint>> slices_of(const Groups& groups, const std::string& type) {
  std::map<int, std::vector<GuidePoint>> slices;
  for (const auto& [key, rows] : groups)
    if (key.first == type)
      slices[key.second] = rows;
  return slices;
}

Contour contour_of(const std::vector<GuidePoint>& rows, int slice, Side side,
                   const std::string& file) {
  Contour contour{slice, side, {}, file, {}};
  for (const GuidePoint& row : rows) {
    contour.points.push_back(row.x);
    contour.lines.push_back(row.line);
  }
  return contour;
}

std::vector<Vec3> points_of(const std::vector<GuidePoint>& rows) {
  std::vector<Vec3> points;
  for (const GuidePoint& row : rows)
    points.push_back(row.x);
  return points;
}

/// Sorts rows by an angle.
template <class Angle>
void sort_by(std::vector<GuidePoint>& rows, const Angle& angle) {
  std::stable_sort(rows.begin(), rows.end(), [&](const GuidePoint& a, const GuidePoint& b) {
    return angle(a.x) < angle(b.x);
  });
}

/// In order round the point `centre`, ending where neighbours are nearest, for there the loop is
/// closed; the widest angle between neighbours.
double sort_round(std::vector<GuidePoint>& rows, const Vec3& centre) {
  if (rows.size() < 3)
    return 2.0 * pi;
  const geometry::Frame plane = geometry::plane_of(points_of(rows));
  const auto angle = [&](const Vec3& x) {
    const Vec3 p = plane.axes.transpose() * (x - centre);
    return std::atan2(p.y(), p.x());
  };
  sort_by(rows, angle);
  std::vector<double> gaps{2.0 * pi + angle(rows.front().x) - angle(rows.back().x)};
  for (std::size_t i = 1; i < rows.size(); ++i)
    gaps.push_back(angle(rows[i].x) - angle(rows[i - 1].x));
  const auto [narrowest, widest] = std::minmax_element(gaps.begin(), gaps.end());
  std::rotate(rows.begin(), rows.begin() + (narrowest - gaps.begin()), rows.end());
  return *widest;
}

/// Whether points, open over some angle, make a loop; says so if not.
bool is_loop(const std::vector<GuidePoint>& rows, double gap, const Contour& as,
             std::vector<std::string>& notes) {
  if (rows.size() >= least_loop_points && gap <= widest_gap)
    return true;
  notes.push_back(fmt::format("{}: {} points, open over {:.0f} degrees, make no loop: left out",
                              geometry::label(as), rows.size(), gap * 180.0 / pi));
  return false;
}

/// The epicardium of a slice in order round a centre, with the septum's right side where it is
/// drawn on the free wall alone; the widest angle without a point.
double close_epicardium(std::vector<GuidePoint>& rows, const std::vector<GuidePoint>* septum,
                        const Vec3& centre) {
  const double gap = sort_round(rows, centre);
  if (gap <= widest_gap || septum == nullptr)
    return gap;
  rows.insert(rows.end(), septum->begin(), septum->end());
  return sort_round(rows, centre);
}

void add_loops(const Groups& groups, const std::string& file, GuidePoints& found) {
  const auto endo = slices_of(groups, "SAX_LV_ENDOCARDIAL");
  const auto epi = slices_of(groups, "SAX_LV_EPICARDIAL");
  const auto septum = slices_of(groups, "SAX_RV_SEPTUM");
  std::vector<Contour>& loops = found.contours.short_axis;
  const auto add = [&](const std::vector<GuidePoint>& rows, double gap, int slice, Side side) {
    Contour loop = contour_of(rows, slice, side, file);
    if (is_loop(rows, gap, loop, found.notes))
      loops.push_back(std::move(loop));
  };
  for (auto [slice, rows] : endo) {
    const double gap = sort_round(rows, geometry::mean_of(points_of(rows)));
    add(rows, gap, slice, Side::endo);
  }
  for (auto [slice, rows] : epi) {
    const Contour* inner = geometry::find(loops, slice, Side::endo);
    const Vec3 centre = geometry::mean_of(inner != nullptr ? inner->points : points_of(rows));
    const double gap =
        close_epicardium(rows, septum.contains(slice) ? &septum.at(slice) : nullptr, centre);
    add(rows, gap, slice, Side::epi);
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
  found.notes.emplace_back("the slices are not numbered in order: counted anew along their normal");
  for (Contour& loop : loops)
    loop.slice =
        static_cast<int>(std::find(order.begin(), order.end(), loop.slice) - order.begin()) + 1;
  std::stable_sort(loops.begin(), loops.end(),
                   [](const Contour& a, const Contour& b) { return a.slice < b.slice; });
}

/// The middle of all endocardial loops.
Vec3 middle_of_cavity(const std::vector<Contour>& short_axis) {
  std::vector<Vec3> centres;
  for (const Contour& c : short_axis)
    if (c.side == Side::endo)
      centres.push_back(geometry::mean_of(c.points));
  return geometry::mean_of(centres);
}

std::ptrdiff_t endo_loops(const geometry::Contours& contours) {
  return std::count_if(contours.short_axis.begin(), contours.short_axis.end(),
                       [](const Contour& c) { return c.side == Side::endo; });
}

/// From the most basal to the most apical: the end with the larger cavity is the base unless points
/// of the annulus say otherwise.
Vec3 towards_base(const GuidePoints& found) {
  if (!found.contours.annulus.empty())
    return (geometry::mean_of(found.contours.annulus) - middle_of_cavity(found.contours.short_axis))
        .normalized();
  std::vector<const Contour*> endo;
  for (const Contour& c : found.contours.short_axis)
    if (c.side == Side::endo)
      endo.push_back(&c);
  const Vec3 along =
      geometry::mean_of(endo.back()->points) - geometry::mean_of(endo.front()->points);
  const bool base_last = geometry::mean_radius(*endo.back()) > geometry::mean_radius(*endo.front());
  return (base_last ? along : Vec3(-along)).normalized();
}

/// The angle about the middle of the cavity in the plane of a long-axis image: 0 towards the apex,
/// +-pi at the base.
struct AngleFromApex {
  Vec3 middle, up, across;

  [[nodiscard]] double operator()(const Vec3& x) const {
    return std::atan2((x - middle).dot(across), -(x - middle).dot(up));
  }
};

/// The outermost points of the valves in an image, as seen from the middle of the cavity.
std::optional<std::array<Vec3, 2>> opening_of(const std::vector<Vec3>& valve,
                                              const AngleFromApex& angle) {
  const Vec3* left = nullptr;
  const Vec3* right = nullptr;
  for (const Vec3& x : valve)
    if (const double at = angle(x); at > 0.5 * pi)
      left = left == nullptr || at < angle(*left) ? &x : left;
    else if (at < -0.5 * pi)
      right = right == nullptr || at > angle(*right) ? &x : right;
  if (left == nullptr || right == nullptr)
    return std::nullopt;
  return std::array{*left, *right};
}

/// Drops what of a curve lies between the outermost points of the valves in its image, as seen from
/// the middle of the cavity, and no deeper than a drawn line sags: it runs through the opening and
/// is no wall.
std::size_t drop_in_valve(std::vector<GuidePoint>& rows, const std::vector<Vec3>& valve,
                          const AngleFromApex& angle) {
  constexpr double sag = 5.0;  // [mm]
  const auto opening = opening_of(valve, angle);
  if (!opening)
    return 0;
  const auto& [left, right] = *opening;
  const Vec3 along = (left - right).normalized();
  const Vec3 out = (angle.up - angle.up.dot(along) * along).normalized();
  const double first = angle(left);
  const double last = angle(right);
  return std::erase_if(rows, [&, left = left](const GuidePoint& p) {
    const double at = angle(p.x);
    return (at > first || at < last) && (p.x - left).dot(out) > -sag;
  });
}

/// The points of the mitral and the aortic valve in each image.
std::map<int, std::vector<Vec3>> valves_of(const Groups& groups) {
  std::map<int, std::vector<Vec3>> valves;
  for (const char* type : {"MITRAL_VALVE", "AORTA_VALVE"})
    for (const auto& [slice, rows] : slices_of(groups, type))
      for (const GuidePoint& p : rows)
        valves[slice].push_back(p.x);
  return valves;
}

/// Drops what of an epicardial curve closes the wall at the base: nearer to the endocardial curve
/// than half of the usual thickness.
std::size_t drop_closing_line(std::vector<GuidePoint>& epi, const std::vector<GuidePoint>& endo,
                              const AngleFromApex& angle) {
  if (epi.empty() || endo.empty())
    return 0;
  const auto thickness = [&](const Vec3& x) {
    double least = std::numeric_limits<double>::infinity();
    for (const GuidePoint& p : endo)
      least = std::min(least, (p.x - x).norm());
    return least;
  };
  std::vector<double> all;
  for (const GuidePoint& p : epi)
    all.push_back(thickness(p.x));
  const double half = 0.5 * median(std::move(all));
  return std::erase_if(epi, [&](const GuidePoint& p) {
    return std::abs(angle(p.x)) > 0.5 * pi && thickness(p.x) < half;
  });
}

/// Throws InputError for a curve, sorted along the wall, whose points lie across it: it is drawn
/// twice, as where a list holds two times of an image.
void require_single(const std::vector<GuidePoint>& rows, const Contour& as) {
  constexpr double drawn_noise = 2.0;  // [mm]; what a hand is off a smooth curve
  std::vector<double> across;          // of points, to the middle between their neighbours [mm]
  std::vector<double> steep;           // the same over half of the neighbours' distance
  for (std::size_t i = 1; i + 1 < rows.size(); ++i) {
    const Vec3 half = 0.5 * (rows[i + 1].x - rows[i - 1].x);
    const Vec3 off = rows[i].x - rows[i - 1].x;
    const double length = half.norm();
    across.push_back(length > 0.0 ? off.cross(half).norm() / length : off.norm());
    steep.push_back(across.back() / std::max(length, 1e-6));
  }
  const double distance = median(across);
  if (distance > drawn_noise && median(steep) > 1.0)
    throw InputError(
        fmt::format("{}:{}", as.file, as.lines.front()),
        fmt::format("{} is drawn twice: along the wall its points change by {:.1f} mm from one "
                    "curve to another",
                    geometry::label(as), distance),
        "Leave one of the two in the list, or give the image's points the frame of their loops");
}

void add_curves(const Groups& groups, const std::string& file, const Vec3& up, GuidePoints& found) {
  const Vec3 middle = middle_of_cavity(found.contours.short_axis);
  auto valves = valves_of(groups);
  auto endo = slices_of(groups, "LAX_LV_ENDOCARDIAL");
  std::size_t in_valve = 0;
  std::size_t closing = 0;
  for (const auto& [type, side] :
       {std::pair("LAX_LV_ENDOCARDIAL", Side::endo), std::pair("LAX_LV_EPICARDIAL", Side::epi)})
    for (auto [slice, rows] : slices_of(groups, type)) {
      if (rows.size() < 3)
        continue;
      const Vec3 normal = geometry::plane_of(points_of(rows)).axes.col(2);
      const AngleFromApex angle{middle, up, normal.cross(up)};
      in_valve += drop_in_valve(rows, valves[slice], angle);
      if (side == Side::epi)
        closing += drop_closing_line(rows, endo[slice], angle);
      sort_by(rows, angle);
      found.contours.long_axis.push_back(contour_of(rows, slice, side, file));
      require_single(rows, found.contours.long_axis.back());
    }
  if (closing > 0)
    found.notes.push_back(
        fmt::format("{} point{} of long-axis epicardia close the wall at the base: not used",
                    closing, closing == 1 ? "" : "s"));
  if (in_valve > 0)
    found.notes.push_back(
        fmt::format("{} point{} of long-axis curves lie in the opening of the valves: not used",
                    in_valve, in_valve == 1 ? "" : "s"));
}

/// A slice without endocardium can only lie beyond the cavity's apex.
void drop_lone_epicardium(const Vec3& up, GuidePoints& found) {
  std::vector<Contour>& loops = found.contours.short_axis;
  const auto height = [&](const Contour& c) { return geometry::mean_of(c.points).dot(up); };
  double lowest = std::numeric_limits<double>::infinity();
  for (const Contour& c : loops)
    if (c.side == Side::endo)
      lowest = std::min(lowest, height(c));
  std::erase_if(loops, [&](const Contour& c) {
    const bool lone = geometry::find(loops, c.slice, Side::endo) == nullptr && height(c) > lowest;
    if (lone)
      found.notes.push_back(
          fmt::format("slice {}: an epicardium without endocardium: left out", c.slice));
    return lone;
  });
}

void add_points(const Groups& groups, const std::string& file, Side apex_of, GuidePoints& found) {
  std::vector<Vec3> septum;
  int unused = 0;
  std::set<std::string> unused_types;
  for (const auto& [key, rows] : groups) {
    const std::string& type = key.first;
    const bool curve = type.starts_with("SAX_LV_E") || type.starts_with("LAX_LV_E");
    for (const GuidePoint& row : rows)
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

/// What a list shows at one time.
GuidePoints at_time(const std::vector<GuidePoint>& list, std::vector<std::string> notes,
                    std::optional<int> frame, const fs::path& file, Side apex_of) {
  GuidePoints found;
  found.notes = std::move(notes);
  Groups groups;
  for (const GuidePoint& row : points_of_time(list, frame, file.string(), found.notes))
    groups[{row.type, row.slice}].push_back(row);
  add_points(groups, file.string(), apex_of, found);
  add_loops(groups, file.string(), found);
  renumber(found);
  if (endo_loops(found.contours) >= 2) {  // else the check of the contours says so
    const Vec3 up = towards_base(found);
    drop_lone_epicardium(up, found);
    add_curves(groups, file.string(), up, found);
  }
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

}  // namespace

GuidePoints read_guide_points(const fs::path& file, std::optional<int> frame, Side apex_of) {
  std::vector<std::string> notes;
  const std::vector<GuidePoint> list = read_guide_point_list(file, notes);
  return at_time(list, notes, frame, file, apex_of);
}

std::vector<int> guide_point_frames(const fs::path& file) {
  std::vector<std::string> notes;
  return times_to_choose(read_guide_point_list(file, notes));
}

std::map<int, geometry::Contours> guide_point_contours(const fs::path& file, Side apex_of) {
  std::vector<std::string> notes;
  const std::vector<GuidePoint> list = read_guide_point_list(file, notes);
  std::map<int, geometry::Contours> frames;
  for (const int frame : times_to_choose(list)) {
    try {
      frames[frame] = at_time(list, {}, frame, file, apex_of).contours;
    } catch (const InputError&) {  // a frame that cannot be chosen
    }
  }
  return frames;
}

}  // namespace lv::image
