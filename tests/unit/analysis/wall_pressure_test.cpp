#include "lv/analysis/wall_pressure.hpp"

#include "lv/verify/sphere_mesh.hpp"

#include <catch2/catch.hpp>

#include <cmath>

namespace {

using namespace lv;

/// A neo-Hookean shell blown up from radii A, B to a, b without change of volume.
struct InflatedShell {
  double A = 15.0, B = 22.0, a = 18.0;  ///< [mm]
  double mu = 10.0;                     ///< [kPa]

  [[nodiscard]] double radius_now(double R) const {
    return std::cbrt(R * R * R + a * a * a - A * A * A);
  }
  /// -sigma_rr = mu/2 [g(B/b) - g(R/r)], g(x) = 4x + x^4, with no pressure outside.
  [[nodiscard]] double radial_compression(double R) const {
    const auto g = [](double x) { return 4.0 * x + x * x * x * x; };
    return 0.5 * mu * (g(B / radius_now(B)) - g(R / radius_now(R)));
  }
  /// p = mu ((R/r)^4 - 1) - sigma_rr, since the law's own radial stress is mu (lambda_r^2 - 1).
  [[nodiscard]] double pressure(double R) const {
    return mu * (std::pow(R / radius_now(R), 4) - 1.0) + radial_compression(R);
  }
};

/// rms over the elements of p - p_exact, over the rms of p_exact.
double error(int around, int layers) {
  const InflatedShell shell;
  const mesh::Mesh mesh = verify::spherical_shell(shell.A, shell.B, around, layers);
  material::Myocardium material;
  material.passive = material::NeoHookean{shell.mu};
  material.volumetric.beta_s = 0.0;
  const solid::Wall wall(mesh, material);
  heartbeat::Snapshot s;
  s.pressure = shell.radial_compression(shell.A);
  for (const Vec3& X : mesh.nodes)
    s.positions.push_back(shell.radius_now(X.norm()) / X.norm() * X);
  s.tension.assign(mesh.nodes.size(), 0.0);

  const auto p =
      analysis::wall_pressure(mesh, wall, solid::Supports(mesh, {.stiffness = 1.0}, {}), s);
  double squares = 0.0;
  double scale = 0.0;
  for (int c = 0; c < mesh.cell_count(); ++c) {
    double R = 0.0;
    for (const int node : mesh.cell(c))
      R += mesh.nodes[node].norm() / 8.0;
    squares += std::pow(p[c] - shell.pressure(R), 2);
    scale += std::pow(shell.pressure(R), 2);
  }
  return std::sqrt(squares / scale);
}

}  // namespace

TEST_CASE(
    "the pressure of an inflated shell is the exact one, with an error that falls with the "
    "mesh width",
    "[unit][analysis]") {
  const double coarse = error(10, 5);
  const double fine = error(20, 10);
  CHECK(coarse < 0.08);
  CHECK(fine < 0.5 * coarse);  // at least first order
}
