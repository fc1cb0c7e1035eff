#include "lv/strain/measures.hpp"

#include "lv/geometry/polygon.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <list>
#include <optional>

namespace lv::strain {
namespace {

using Line = std::vector<Vec3>;

/// Two directions in the plane of a loop.
struct Axes {
  Vec3 origin, x, y;

  explicit Axes(const Line& loop) : origin(loop.front()) {
    Vec3 normal = Vec3::Zero();
    for (std::size_t i = 0, j = loop.size() - 1; i < loop.size(); j = i++)
      normal += (loop[j] - origin).cross(loop[i] - origin);
    normal.normalize();
    x = normal.unitOrthogonal();
    y = normal.cross(x);
  }
  [[nodiscard]] geometry::Polygon flat(const Line& loop) const {
    geometry::Polygon points;
    for (const Vec3& p : loop)
      points.emplace_back((p - origin).dot(x), (p - origin).dot(y));
    return points;
  }
};

/// Where a plane crosses a triangle.
std::optional<std::array<Vec3, 2>> crossing(const std::array<Vec3, 3>& triangle, const Vec3& point,
                                            const Vec3& normal) {
  std::array<double, 3> h{};
  for (int i = 0; i < 3; ++i) {
    h[i] = (triangle[i] - point).dot(normal);
    h[i] = h[i] == 0.0 ? 1e-12 : h[i];  // a corner in the plane counts as above it
  }
  std::vector<Vec3> ends;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    if ((h[i] > 0.0) == (h[j] > 0.0))
      continue;
    // from the same end on both sides of an edge, so that neighbours meet exactly
    const bool forward = h[i] > 0.0;
    const int a = forward ? i : j;
    const int b = forward ? j : i;
    ends.push_back(triangle[a] + h[a] / (h[a] - h[b]) * (triangle[b] - triangle[a]));
  }
  if (ends.size() != 2 || (ends[0] - ends[1]).norm() < 1e-12)
    return {};
  return std::array<Vec3, 2>{ends[0], ends[1]};
}

}  // namespace

double dice(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  constexpr double step = 0.25;
  const Axes axes(a);
  const auto p = axes.flat(a);
  const auto q = axes.flat(b);
  Eigen::Vector2d low = p.front();
  Eigen::Vector2d high = p.front();
  for (const auto& loop : {p, q})
    for (const auto& x : loop) {
      low = low.cwiseMin(x);
      high = high.cwiseMax(x);
    }
  double both = 0.0;
  double sum = 0.0;
  for (double y = low.y() + 0.5 * step; y < high.y(); y += step)
    for (double x = low.x() + 0.5 * step; x < high.x(); x += step) {
      const bool in_a = geometry::encloses(p, {x, y});
      const bool in_b = geometry::encloses(q, {x, y});
      both += in_a && in_b ? 1.0 : 0.0;
      sum += (in_a ? 1.0 : 0.0) + (in_b ? 1.0 : 0.0);
    }
  return 2.0 * both / sum;
}

Distance distance(const std::vector<Vec3>& points, const std::vector<std::vector<Vec3>>& lines,
                  bool closed) {
  constexpr double missing = std::numeric_limits<double>::quiet_NaN();
  if (lines.empty() || points.empty())
    return {missing, missing, missing};
  Distance d;
  for (const Vec3& x : points) {
    double least = std::numeric_limits<double>::infinity();
    for (const Line& line : lines)
      for (std::size_t i = closed ? 0 : 1; i < line.size(); ++i)
        least = std::min(
            least, geometry::distance_to_segment(x, i == 0 ? line.back() : line[i - 1], line[i]));
    d.mean += least;
    d.rms += least * least;
    d.largest = std::max(d.largest, least);
  }
  const double n = static_cast<double>(points.size());
  d.mean /= n;
  d.rms = std::sqrt(d.rms / n);
  return d;
}

std::vector<std::vector<Vec3>> cut(const std::vector<std::array<Vec3, 3>>& triangles,
                                   const Vec3& point, const Vec3& normal) {
  constexpr double same = 1e-7;  // [mm]
  std::list<std::array<Vec3, 2>> pieces;
  for (const auto& triangle : triangles)
    if (const auto piece = crossing(triangle, point, normal))
      pieces.push_back(*piece);
  std::vector<Line> lines;
  while (!pieces.empty()) {
    Line line{pieces.front()[0], pieces.front()[1]};
    pieces.pop_front();
    for (int side = 0; side < 2; ++side) {
      bool grew = true;
      while (grew) {
        grew = false;
        for (auto piece = pieces.begin(); piece != pieces.end(); ++piece) {
          const bool first = ((*piece)[0] - line.back()).norm() < same;
          if (!first && ((*piece)[1] - line.back()).norm() >= same)
            continue;
          line.push_back((*piece)[first ? 1 : 0]);
          pieces.erase(piece);
          grew = true;
          break;
        }
      }
      std::reverse(line.begin(), line.end());
    }
    lines.push_back(std::move(line));
  }
  return lines;
}

}  // namespace lv::strain
