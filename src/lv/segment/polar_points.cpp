#include "lv/segment/polar_points.hpp"

#include "lv/geometry/polygon.hpp"

namespace lv::segment {

PolarPoint polar_of(const image::Plane& plane, const Pixel& centre, const Vec3& x) {
  const Vec3 pixel = plane.pixel(x);
  const double u = (pixel.x() - centre.x()) * plane.spacing_i;
  const double v = (pixel.y() - centre.y()) * plane.spacing_j;
  return {std::atan2(v, u), std::hypot(u, v)};
}

Radii radii_of(const image::Plane& plane, const Pixel& centre, const std::vector<Vec3>& line,
               int rays) {
  geometry::Polygon polygon;
  for (const Vec3& x : line) {
    const PolarPoint p = polar_of(plane, centre, x);
    polygon.emplace_back(p.radius * std::cos(p.angle), p.radius * std::sin(p.angle));
  }
  Radii radii(rays);
  for (int i = 0; i < rays; ++i) {
    const double angle = ray_angle(i, rays);
    radii(i) = geometry::farthest_crossing(polygon, {std::cos(angle), std::sin(angle)});
  }
  return radii;
}

}  // namespace lv::segment
