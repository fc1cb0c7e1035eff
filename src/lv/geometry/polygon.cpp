#include "lv/geometry/polygon.hpp"

namespace lv::geometry {

bool encloses(const Polygon& polygon, const Eigen::Vector2d& point) {
  bool in = false;
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    const auto& a = polygon[i];
    const auto& b = polygon[j];
    if ((a.y() > point.y()) != (b.y() > point.y()) &&
        point.x() < a.x() + (point.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x()))
      in = !in;
  }
  return in;
}

double farthest_crossing(const Polygon& polygon, const Eigen::Vector2d& ray) {
  // of a side: a ray through a corner must not miss both sides there
  constexpr double slack = 1e-9;
  double farthest = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector2d& a = polygon[i];
    const Eigen::Vector2d e = polygon[(i + 1) % polygon.size()] - a;
    const double det = ray.y() * e.x() - ray.x() * e.y();
    if (det == 0.0)
      continue;
    const double s = (ray.x() * a.y() - ray.y() * a.x()) / det;
    if (s >= -slack && s <= 1.0 + slack)
      farthest = std::max(farthest, (a.y() * e.x() - a.x() * e.y()) / det);
  }
  return farthest;
}

}  // namespace lv::geometry
