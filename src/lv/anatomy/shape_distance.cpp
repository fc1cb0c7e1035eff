#include "lv/anatomy/shape_distance.hpp"

#include "lv/geometry/contour_measures.hpp"
#include "lv/mesh/distance.hpp"
#include "lv/mesh/regions.hpp"

#include <boost/math/tools/minima.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

namespace lv::anatomy {
namespace {

using geometry::Side;

constexpr double farthest_shift = 25.0;  // of the base, as far as it comes down in anybody [mm]
constexpr std::array sides{Side::endo, Side::epi};

/// A drawn point in the model frame.
struct Point {
  int slice;
  Side side;
  Vec3 x;
};

/// What a point at a height counts: less and less from here up to the base plane, so that no fit
/// leaps when one passes it.
double weight_at(double z) {
  constexpr double fading = 5.0;  // [mm]
  return std::clamp(-z / fading, 0.0, 1.0);
}

/// The surfaces of a model.
class Surfaces {
 public:
  Surfaces(const mesh::Mesh& mesh, std::span<const Vec3> nodes)
      : endo_(nodes, mesh.endo), epi_(nodes, mesh.epi) {}

  /// By how much a surface lies outside of a point [mm]; normals point out of the wall.
  [[nodiscard]] double outside(Side side, const Vec3& x) const {
    return side == Side::endo ? endo_.signed_distance(x) : -epi_.signed_distance(x);
  }

  /// Of all points, along the long axis: where the sum of their squared distances is smallest.
  /// Points that pass the base plane are held against the base's edge: a sum from which they
  /// dropped out would have a minimum wherever a loop has just passed.
  [[nodiscard]] double best_shift(const std::vector<Point>& points) const {
    const auto sum_of_squares = [&](double shift) {
      double sum = 0.0;
      for (const Point& p : points)
        sum += std::pow(outside(p.side, {p.x.x(), p.x.y(), std::min(0.0, p.x.z() + shift)}), 2);
      return sum;
    };
    constexpr int bits = 20;
    return boost::math::tools::brent_find_minima(sum_of_squares, -farthest_shift, farthest_shift,
                                                 bits)
        .first;
  }

 private:
  mesh::SurfaceDistance endo_, epi_;
};

/// Of a slice (0: all) with the loops shifted.
DrawnDistance distance(const Surfaces& surfaces, const std::vector<Point>& points, int slice,
                       Side side, double shift) {
  std::vector<double> found;
  for (const Point& p : points)
    if (p.side == side && (slice == 0 || p.slice == slice) && p.x.z() + shift <= 0.0)
      found.push_back(std::abs(surfaces.outside(side, p.x + shift * Vec3::UnitZ())));
  DrawnDistance d{slice, side, static_cast<int>(found.size())};
  if (found.empty())
    return d;
  std::sort(found.begin(), found.end());
  for (const double x : found) {
    d.mean += x / static_cast<double>(found.size());
    d.rms += x * x / static_cast<double>(found.size());
  }
  d.rms = std::sqrt(d.rms);
  d.p95 = found[static_cast<std::size_t>(0.95 * static_cast<double>(found.size() - 1))];
  d.max = found.back();
  return d;
}

}  // namespace

ShapeDistance shape_distance(const mesh::Mesh& mesh, std::span<const Vec3> nodes,
                             const geometry::Frame& frame,
                             const std::vector<geometry::Contour>& loops) {
  const Surfaces surfaces(mesh, nodes);
  std::vector<Point> points;
  std::set<int> slices;
  for (const geometry::Contour& loop : loops) {
    slices.insert(loop.slice);
    for (const Vec3& x : loop.points)
      points.push_back({loop.slice, loop.side, frame.to_model(x)});
  }
  ShapeDistance result;
  result.axial_shift = surfaces.best_shift(points);
  for (const Side side : sides) {
    result.as_drawn.push_back(distance(surfaces, points, 0, side, 0.0));
    result.shifted.push_back(distance(surfaces, points, 0, side, result.axial_shift));
  }
  for (const int slice : slices)
    for (const Side side : sides)
      if (DrawnDistance d = distance(surfaces, points, slice, side, result.axial_shift);
          d.points > 0)
        result.shifted.push_back(d);
  return result;
}

std::vector<DrawnPart> drawn_parts(const geometry::Frame& frame,
                                   const std::vector<geometry::Contour>& loops,
                                   double septum_angle) {
  constexpr int sectors = 6;
  std::vector<DrawnPart> all;
  for (const geometry::Contour& loop : loops) {
    const Vec3 centre = frame.to_model(geometry::mean_of(loop.points));
    std::vector<DrawnPart> parts(sectors);
    for (const Vec3& point : loop.points) {
      const Vec3 x = frame.to_model(point);
      const double angle = std::atan2(x.y() - centre.y(), x.x() - centre.x());
      parts[mesh::sector_at(angle, septum_angle, sectors) - 1].points.push_back(x);
    }
    for (int k = 1; k <= sectors; ++k)
      if (DrawnPart& part = parts[k - 1]; !part.points.empty()) {
        part.name =
            fmt::format("{} {} {}", loop.slice, geometry::name(loop.side), mesh::sector_name(1, k));
        part.side = loop.side;
        all.push_back(std::move(part));
      }
  }
  return all;
}

std::vector<double> mean_distances(const mesh::Mesh& mesh, std::span<const Vec3> nodes,
                                   const std::vector<DrawnPart>& parts) {
  const Surfaces surfaces(mesh, nodes);
  std::vector<Point> points;
  for (const DrawnPart& part : parts)
    for (const Vec3& x : part.points)
      points.push_back({0, part.side, x});
  const Vec3 shift = surfaces.best_shift(points) * Vec3::UnitZ();
  std::vector<double> means;
  for (const DrawnPart& part : parts) {
    double sum = 0.0;
    for (const Vec3& x : part.points)
      if (const double w = weight_at(x.z() + shift.z()); w > 0.0)
        sum += w * surfaces.outside(part.side, x + shift);
    means.push_back(sum / static_cast<double>(part.points.size()));
  }
  return means;
}

Table shape_distance_table(const ShapeDistance& distance) {
  Table table(
      {"slice", "contour", "axial_shift_mm", "points", "mean_mm", "rms_mm", "p95_mm", "max_mm"});
  const auto number = [](double value) { return Table::number(value, 6); };
  const auto add = [&](const DrawnDistance& d, double shift) {
    table.add_row({d.slice == 0 ? "all" : std::to_string(d.slice), geometry::name(d.side),
                   number(shift), std::to_string(d.points), number(d.mean), number(d.rms),
                   number(d.p95), number(d.max)});
  };
  for (const DrawnDistance& d : distance.as_drawn)
    add(d, 0.0);
  for (const DrawnDistance& d : distance.shifted)
    add(d, distance.axial_shift);
  return table;
}

std::string shape_distance_text(const ShapeDistance& distance) {
  std::string text = "\n  the drawn end-systolic contours are from the model's surfaces (mm):\n";
  const auto rows = [&](const std::vector<DrawnDistance>& list, const std::string& how) {
    for (const DrawnDistance& d : list)
      if (d.slice == 0)
        text += fmt::format("    {:<5}{:<36} mean {:.2f}, rms {:.2f}, 95% {:.2f}, largest {:.2f}\n",
                            geometry::name(d.side), how, d.mean, d.rms, d.p95, d.max);
  };
  rows(distance.as_drawn, "as they lie");
  rows(distance.shifted, fmt::format("moved {:.1f} mm along the axis", distance.axial_shift));
  return text;
}

}  // namespace lv::anatomy
