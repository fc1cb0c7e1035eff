#pragma once

#include "lv/mesh/wall_mesh.hpp"

#include <cmath>
#include <numbers>

namespace lv::verify {

/// Half a shell of neo-Hookean rubber between the radii A and B, inflated until its inner radius is
/// a.
struct HalfSphere {
  double A = 10.0, B = 15.0;  ///< [mm]
  double a = 14.0;            ///< [mm]
  double mu = 4.0;            ///< [kPa]

  /// From b^3 - B^3 = a^3 - A^3.
  [[nodiscard]] double outer_radius() const { return std::cbrt(B * B * B + a * a * a - A * A * A); }

  /// p = mu/2 [4 B/b + (B/b)^4 - 4 A/a - (A/a)^4], by integration of the radial balance [kPa].
  [[nodiscard]] double pressure() const {
    const auto g = [](double ratio) { return 4.0 * ratio + std::pow(ratio, 4); };
    return 0.5 * mu * (g(B / outer_radius()) - g(A / a));
  }

  [[nodiscard]] mesh::Mesh mesh(double edge_length, int order) const {
    const auto map = [this](double u, double theta, double t) {
      const double R = A + t * (B - A);
      const double psi = 0.5 * std::numbers::pi * u;
      return Vec3(R * std::sin(psi) * std::cos(theta), R * std::sin(psi) * std::sin(theta),
                  -R * std::cos(psi));
    };
    return mesh::wall_mesh(map, {.edge_length = edge_length, .order = order});
  }
};

}  // namespace lv::verify
