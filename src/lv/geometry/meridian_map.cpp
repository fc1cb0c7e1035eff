#include "lv/geometry/meridian_map.hpp"

#include "lv/base/dense.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace lv::geometry {
namespace {

using std::numbers::pi;
constexpr int angles = 48;  // of the mean over theta
constexpr int steps = 400;  // along the mean meridians
constexpr int waves = 6;    // of the matching
using Vec2 = Eigen::Vector2d;
using Vec = Eigen::VectorXd;

double mean_base_angle(const StarSurface& surface) {
  double sum = 0.0;
  for (int j = 0; j < angles; ++j)
    sum += surface.base_angle(2.0 * pi * j / angles);
  return sum / angles;
}

/// Where `x` lies between the ascending values of a table with equal steps from 0 to 1.
double inverse(const std::vector<double>& table, double x) {
  const auto upper = std::upper_bound(table.begin() + 1, table.end() - 1, x) - table.begin();
  const double part = (x - table[upper - 1]) / (table[upper] - table[upper - 1]);
  return (static_cast<double>(upper) - 1.0 + part) / static_cast<double>(table.size() - 1);
}

template <class T>
T interpolate(const std::vector<T>& table, double x) {
  const double at = x * static_cast<double>(table.size() - 1);
  const auto i = std::min(static_cast<std::size_t>(std::max(at, 0.0)), table.size() - 2);
  const double w = at - static_cast<double>(i);
  return (1.0 - w) * table[i] + w * table[i + 1];
}

/// Lengths along a polygon, from 0 to 1.
std::vector<double> relative_lengths(const std::vector<Vec2>& line) {
  std::vector<double> lengths(line.size(), 0.0);
  for (std::size_t i = 1; i < line.size(); ++i)
    lengths[i] = lengths[i - 1] + (line[i] - line[i - 1]).norm();
  for (double& length : lengths)
    length /= lengths.back();
  return lengths;
}

/// The mean over theta of a surface's meridians (r, z).
struct MeanMeridian {
  std::vector<Vec2> line;       ///< at equal steps of the fraction m of the base angle
  std::vector<double> lengths;  ///< relative, from the apex

  explicit MeanMeridian(const StarSurface& surface) : line(steps + 1, Vec2::Zero()) {
    for (int j = 0; j < angles; ++j) {
      const double theta = 2.0 * pi * j / angles;
      const double base = surface.base_angle(theta);
      for (int i = 0; i <= steps; ++i) {
        const Vec3 x = surface.point(base * i / steps, theta);
        line[i] += Vec2(x.head<2>().norm(), x.z()) / angles;
      }
    }
    lengths = relative_lengths(line);
  }

  [[nodiscard]] double fraction(double length) const { return inverse(lengths, length); }
  [[nodiscard]] Vec2 at(double length) const { return interpolate(line, fraction(length)); }
};

/// An increasing map of [0, 1] onto itself with the slope exp(sum a_k cos(k pi x)), scaled; given
/// at equal steps.
std::vector<double> increasing_map(const Vec& a) {
  std::vector<double> map(steps + 1, 0.0);
  for (int i = 1; i <= steps; ++i) {
    double exponent = 0.0;
    for (int k = 0; k < a.size(); ++k)
      exponent += a[k] * std::cos((k + 1) * pi * (i - 0.5) / steps);
    map[i] = map[i - 1] + std::exp(exponent);
  }
  for (double& x : map)
    x /= map[steps];
  return map;
}

/// The lines across the wall when the epicardium's lengths are a map of the endocardium's.
struct Crossings {
  std::vector<double> epi_lengths;
  std::vector<Vec2> middle;
  Vec cosines;  ///< of each line with the curve of the middles
};

Crossings crossings(const MeanMeridian& endo, const MeanMeridian& epi, const Vec& a) {
  Crossings c{increasing_map(a), {}, Vec(steps)};
  std::vector<Vec2> across;
  for (int i = 0; i <= steps; ++i) {
    const Vec2 inner = endo.at(static_cast<double>(i) / steps);
    const Vec2 outer = epi.at(c.epi_lengths[i]);
    across.emplace_back(outer - inner);
    c.middle.emplace_back(0.5 * (outer + inner));
  }
  for (int i = 0; i < steps; ++i) {
    const Vec2 along = c.middle[i + 1] - c.middle[i];
    const Vec2 line = 0.5 * (across[i] + across[i + 1]);
    c.cosines[i] = along.dot(line) / (along.norm() * line.norm());
  }
  return c;
}

/// The map that makes the sum of squared cosines least, by Levenberg-Marquardt steps. A small
/// penalty on `a` settles what the lines leave open.
Vec best_matching(const MeanMeridian& endo, const MeanMeridian& epi) {
  constexpr double penalty = 1e-3 * steps;
  constexpr int iterations = 30;
  constexpr double probe = 1e-4;
  const auto cost = [&](const Vec& a) {
    return crossings(endo, epi, a).cosines.squaredNorm() + penalty * a.squaredNorm();
  };
  Vec a = Vec::Zero(waves);
  double damping = 1.0;
  for (int n = 0; n < iterations; ++n) {
    const Vec r = crossings(endo, epi, a).cosines;
    Eigen::MatrixXd J(steps, waves);
    for (int k = 0; k < waves; ++k)
      J.col(k) = (crossings(endo, epi, a + probe * Vec::Unit(waves, k)).cosines - r) / probe;
    Eigen::MatrixXd K = J.transpose() * J;
    K.diagonal().array() += penalty + damping;
    const Vec next = a - dense::solve_symmetric(K, J.transpose() * r + penalty * a);
    const bool better = cost(next) < cost(a);
    damping *= better ? 0.3 : 4.0;
    if (better)
      a = next;
  }
  return a;
}

}  // namespace

MeridianMap::MeridianMap(StarSurface surface, std::vector<double> fractions)
    : surface_(std::move(surface)),
      mean_base_angle_(mean_base_angle(surface_)),
      fractions_(std::move(fractions)) {}

Vec3 MeridianMap::point(double u, double theta) const {
  const double b = mean_base_angle_ + (surface_.base_angle(theta) - mean_base_angle_) * u * u;
  return surface_.point(interpolate(fractions_, u) * b, theta);
}

MeridianMaps matched_meridians(const StarSurface& endo, const StarSurface& epi) {
  const MeanMeridian inner(endo);
  const MeanMeridian outer(epi);
  const Crossings lines = crossings(inner, outer, best_matching(inner, outer));
  const std::vector<double> middle_lengths = relative_lengths(lines.middle);
  std::vector<double> inner_fractions, outer_fractions;
  for (int i = 0; i <= steps; ++i) {
    const double length = inverse(middle_lengths, static_cast<double>(i) / steps);
    inner_fractions.push_back(inner.fraction(length));
    outer_fractions.push_back(outer.fraction(interpolate(lines.epi_lengths, length)));
  }
  return {{endo, std::move(inner_fractions)}, {epi, std::move(outer_fractions)}};
}

}  // namespace lv::geometry
