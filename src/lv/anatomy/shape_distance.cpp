#include "lv/anatomy/shape_distance.hpp"

#include "lv/mesh/distance.hpp"

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

class Comparison {
 public:
  Comparison(const mesh::Mesh& mesh, std::span<const Vec3> nodes, const geometry::Frame& frame,
             const std::vector<geometry::Contour>& loops)
      : endo_(nodes, mesh.endo), epi_(nodes, mesh.epi) {
    for (const geometry::Contour& loop : loops)
      for (const Vec3& x : loop.points)
        points_.push_back({loop.slice, loop.side, frame.to_model(x)});
  }

  /// Of a slice (0: all) with the loops shifted.
  [[nodiscard]] DrawnDistance distance(int slice, Side side, double shift) const {
    std::vector<double> found;
    for (const Point& p : points_)
      if (p.side == side && (slice == 0 || p.slice == slice) && p.x.z() + shift <= 0.0)
        found.push_back(far(p, shift));
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

  /// Where the mean square of all distances is smallest.
  [[nodiscard]] double best_shift() const {
    const auto mean_square = [&](double shift) {
      double sum = 0.0;
      int counted = 0;
      for (std::size_t n = 0; n < points_.size(); n += 3) {
        if (points_[n].x.z() + shift > 0.0)
          continue;
        const double d = far(points_[n], shift);
        sum += d * d;
        ++counted;
      }
      return counted == 0 ? 1e9 : sum / counted;
    };
    constexpr int bits = 12;
    return boost::math::tools::brent_find_minima(mean_square, -farthest_shift, farthest_shift, bits)
        .first;
  }

  [[nodiscard]] std::set<int> slices() const {
    std::set<int> all;
    for (const Point& p : points_)
      all.insert(p.slice);
    return all;
  }

 private:
  [[nodiscard]] double far(const Point& p, double shift) const {
    const Vec3 x = p.x + shift * Vec3::UnitZ();
    return p.side == Side::endo ? endo_(x) : epi_(x);
  }

  mesh::SurfaceDistance endo_, epi_;
  std::vector<Point> points_;
};

}  // namespace

ShapeDistance shape_distance(const mesh::Mesh& mesh, std::span<const Vec3> nodes,
                             const geometry::Frame& frame,
                             const std::vector<geometry::Contour>& loops) {
  const Comparison comparison(mesh, nodes, frame, loops);
  ShapeDistance result;
  result.axial_shift = comparison.best_shift();
  for (const Side side : sides) {
    result.as_drawn.push_back(comparison.distance(0, side, 0.0));
    result.shifted.push_back(comparison.distance(0, side, result.axial_shift));
  }
  for (const int slice : comparison.slices())
    for (const Side side : sides)
      if (DrawnDistance d = comparison.distance(slice, side, result.axial_shift); d.points > 0)
        result.shifted.push_back(d);
  return result;
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
