#include "lv/geometry/ellipsoid.hpp"

#include <cmath>
#include <numbers>

namespace lv::geometry {
namespace {

double between(double a, double b, double t) {
  return (1.0 - t) * a + t * b;
}

}  // namespace

Vec3 Ellipsoid::point(double u, double theta, double t) const {
  const double radius = between(endo_radius, epi_radius, t);
  const double length = between(endo_length, epi_length, t);
  const double base_angle = std::numbers::pi - std::acos(base_height / length);
  const double angle = u * base_angle;  // from the apex
  const double r = radius * std::sin(angle);
  return {r * std::cos(theta), r * std::sin(theta), -base_height - length * std::cos(angle)};
}

double Ellipsoid::enclosed_volume(double t) const {
  const double radius = between(endo_radius, epi_radius, t);
  const double length = between(endo_length, epi_length, t);
  // integral of pi radius^2 (1 - (z/length)^2) from the apex to the base plane
  const auto primitive = [&](double z) { return z - z * z * z / (3.0 * length * length); };
  return std::numbers::pi * radius * radius * (primitive(base_height) - primitive(-length));
}

}  // namespace lv::geometry
