#include "lv/immersed/model.hpp"
#include "lv/verify/problems.hpp"
#include "lv/verify/sphere_mesh.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace lv::verify {
namespace {

/// An inflated shell: radii A, B without stress, a, b now; incompressible, b^3 - a^3 = B^3 - A^3.
/// Blood fills the inside and the box around it and is at rest, with the pressure difference that
/// balances the wall exactly (neo-Hookean):
///
///   p_in - p_out = mu/2 [4 B/b + (B/b)^4 - 4 A/a - (A/a)^4]
struct Shell {
  double A = 15.0, B = 22.0, a = 18.0;  ///< [mm]
  double mu = 10.0;                     ///< [kPa]

  [[nodiscard]] double radius_now(double R) const {
    return std::cbrt(R * R * R + a * a * a - A * A * A);
  }
  [[nodiscard]] double trapped_pressure() const {
    const auto g = [](double x) { return 4.0 * x + x * x * x * x; };
    return 0.5 * mu * (g(B / radius_now(B)) - g(A / a));
  }
};

constexpr double box = 64.0;           ///< edge of the box [mm]
constexpr double end_time = 1e-3;      ///< [s]
const Vec3 centre(0.31, -0.17, 0.23);  ///< of the shell: on no symmetry plane of the grid [mm]

/// Thick as honey. In blood the small imbalance near the wall's two surfaces, where the pressure
/// jumps within one cell, would set off elastic waves that take a second to die out; here it meets
/// a viscous balance within a millisecond, and what flows is what the imbalance sustains.
constexpr double viscosity = 0.02;  // [kPa s]

struct Outcome {
  double pressure_error = 0.0;    ///< of the trapped pressure, relative
  double largest_velocity = 0.0;  ///< in the box [mm/s]
  double rms_velocity = 0.0;
};

/// Mean pressure of the blood inside minus that outside, three cells away from the wall.
double trapped_pressure(const immersed::Model& model, const Shell& shell) {
  const fluid::Component p = model.pressure();
  const double h = model.grid().spacing.minCoeff();
  std::array<double, 2> sum{};
  std::array<int, 2> count{};
  for (int k = 0; k < p.nz(); ++k) {
    for (int j = 0; j < p.ny(); ++j) {
      for (int i = 0; i < p.nx(); ++i) {
        const Vec3 x = model.grid().face(0, i, j, k) + 0.5 * h * Vec3::UnitX();
        const double r = (x - centre).norm();
        const bool inside = r < shell.a - 3.0 * h;
        if (inside || r > shell.radius_now(shell.B) + 3.0 * h) {
          sum[inside ? 0 : 1] += p.at(i, j, k);
          ++count[inside ? 0 : 1];
        }
      }
    }
  }
  return sum[0] / count[0] - sum[1] / count[1];
}

/// The shell on a grid of n^3 cells, with elements as fine as the grid, left alone for a while.
Outcome settle(int n, immersed::CouplingKind kind) {
  const Shell shell;
  const double h = box / n;
  const double b = shell.radius_now(shell.B);
  const double edge = 0.9 * h;  // as for a ventricle
  const int around = static_cast<int>(std::ceil(0.5 * std::numbers::pi * b / edge));
  const int layers = static_cast<int>(std::ceil((b - shell.a) / edge));
  const mesh::Mesh mesh = spherical_shell(shell.A, shell.B, around, layers);

  immersed::ModelParameters parameters;
  parameters.grid = {{n, n, n}, Vec3::Constant(-0.5 * box), Vec3::Constant(h)};
  parameters.coupling.kind = kind;
  material::Myocardium material;
  material.passive = lv::material::NeoHookean{shell.mu};
  parameters.blood.viscosity = viscosity;
  immersed::Model model(mesh, {material, {}, {}}, parameters);
  immersed::ModelState state = model.state();
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i) {
    const Vec3& X = mesh.nodes[i];
    state.positions[i] = centre + shell.radius_now(X.norm()) / X.norm() * X;
  }
  model.restore(state);

  const double dt = 5e-5 * h;
  for (double t = 0.0; t < end_time - 0.5 * dt; t += dt)
    static_cast<void>(model.step({}, dt));
  const fluid::Motion motion = fluid::motion(model.velocity(), parameters.grid, 1.0);
  return {std::abs(trapped_pressure(model, shell) / shell.trapped_pressure() - 1.0),
          motion.largest_velocity, std::sqrt(2.0 * motion.kinetic_energy / std::pow(box, 3))};
}

}  // namespace

void thick_sphere_at_rest(Findings& found) {
  constexpr double wave_speed = 3162.0;  // sqrt(mu/rho), what an unbalanced wall moves at [mm/s]
  for (const auto kind : {immersed::CouplingKind::nodal, immersed::CouplingKind::quadrature}) {
    const bool nodal = kind == immersed::CouplingKind::nodal;
    const std::string name = nodal ? "nodal" : "quadrature";
    const std::vector<int> cells = nodal ? std::vector{32, 48, 64} : std::vector{32, 48};
    std::vector<Outcome> outcomes;
    for (const int n : cells) {
      const Outcome o = settle(n, kind);
      const std::string where = fmt::format(", {}, mesh width {:.2f} mm", name, box / n);
      found.add_error("trapped pressure, relative error" + where, o.pressure_error, 0.005);
      found.add_error("largest velocity" + where, o.largest_velocity, 1e-3 * wave_speed, "mm/s");
      found.add_error("rms velocity" + where, o.rms_velocity, 2e-4 * wave_speed, "mm/s");
      outcomes.push_back(o);
    }
    const auto order = [&](double Outcome::*quantity) {
      return std::log(outcomes.front().*quantity / outcomes.back().*quantity) /
             std::log(static_cast<double>(cells.back()) / cells.front());
    };
    // first order where the pressure jumps, half an order more in the mean over the box; the
    // trapped pressure, far from the wall, between first and second order
    found.add("order of the trapped pressure, " + name, order(&Outcome::pressure_error), 1.5, 0.7);
    found.add("order of the largest velocity, " + name, order(&Outcome::largest_velocity), 1.0,
              0.5);
    found.add("order of the rms velocity, " + name, order(&Outcome::rms_velocity), 1.5, 0.5);
  }
}

}  // namespace lv::verify
