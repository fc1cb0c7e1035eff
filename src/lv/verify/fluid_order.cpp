#include "lv/fluid/advect.hpp"
#include "lv/verify/manufactured.hpp"
#include "lv/verify/problems.hpp"

#include <fmt/format.h>

#include <cmath>

namespace lv::verify {
namespace {

using fluid::FaceField;

/// Sets a field on the faces to a function of position.
template <class Function>
void set(const fluid::Grid& grid, const fluid::Slab& slab, const Function& function,
         FaceField& field) {
  for (int c = 0; c < 3; ++c) {
    fluid::Component& u = field.component[c];
    for (int k = 0; k < u.nz(); ++k)
      for (int j = 0; j < u.ny(); ++j)
        for (int i = 0; i < u.nx(); ++i)
          u.at(i, j, k) = function(grid.face(c, i, j, k + slab.planes.begin))[c];
  }
}

/// Adds the force of a flow at time t.
void add_force(const fluid::Grid& grid, const ManufacturedFlow& flow, double t, bool convection,
               FaceField& force) {
  for (int c = 0; c < 3; ++c) {
    fluid::Component& f = force.component[c];
    for (int k = 0; k < f.nz(); ++k)
      for (int j = 0; j < f.ny(); ++j)
        for (int i = 0; i < f.nx(); ++i)
          f.at(i, j, k) += flow.force(grid.face(c, i, j, k), t, convection)[c];
  }
}

/// The velocity after `steps` steps to the time `end`, with the engine's own solver and convection
/// and its staggered times: velocities at half steps, forces at whole ones.
class Integration {
 public:
  Integration(int n, int steps, double end, bool convection)
      : grid_{{n, n, n}, Vec3::Zero(), flow_.box / n},
        slab_(fluid::slab_of(grid_, 0, 1)),
        transform_(grid_, slab_),
        stokes_(grid_, transform_, flow_.blood),
        velocity_(grid_, slab_) {
    const double dt = end / steps;
    FaceField force(grid_, slab_);
    FaceField previous(grid_, slab_);
    set_exact(-dt);
    fluid::convection_force(velocity_, grid_, flow_.blood.density, {1.0, 0.0}, previous, force);
    set_exact(0.0);
    fluid::ModeField modes = transform_.zero_modes();
    fluid::ModeField force_modes = transform_.zero_modes();
    to_modes(modes);
    for (int step = 0; step < steps; ++step) {
      force.set_zero();
      if (convection)
        fluid::convection_force(velocity_, grid_, flow_.blood.density, {1.5, -0.5}, previous,
                                force);
      add_force(grid_, flow_, (step + 0.5) * dt, convection, force);
      transform_.to_modes(force, force_modes);
      stokes_.advance(modes, force_modes, dt, flow_.drag);
      transform_.to_points(modes, velocity_);
      fluid::fill_ghosts(velocity_, slab_);
    }
  }

  /// rms over the faces of u - u_exact, over the rms of u_exact.
  [[nodiscard]] double error(double time) const {
    FaceField exact(grid_, slab_);
    set(
        grid_, slab_, [&](const Vec3& x) { return flow_.velocity(x, time); }, exact);
    return distance(velocity_, exact) / size(exact);
  }

  [[nodiscard]] const FaceField& velocity() const { return velocity_; }

  static double distance(const FaceField& a, const FaceField& b) {
    double sum = 0.0;
    for (int c = 0; c < 3; ++c)
      for (int k = 0; k < a.component[c].nz(); ++k)
        for (int j = 0; j < a.component[c].ny(); ++j)
          for (int i = 0; i < a.component[c].nx(); ++i)
            sum += std::pow(a.component[c].at(i, j, k) - b.component[c].at(i, j, k), 2);
    return std::sqrt(sum);
  }

 private:
  static double size(const FaceField& a) {
    FaceField zero = a;
    zero.set_zero();
    return distance(a, zero);
  }

  void set_exact(double time) {
    set(
        grid_, slab_, [&](const Vec3& x) { return flow_.velocity(x, time); }, velocity_);
    fluid::fill_ghosts(velocity_, slab_);
  }

  /// Modes of the present velocity, divided by 8 Nx Ny Nz so that they transform back to it.
  void to_modes(fluid::ModeField& modes) {
    transform_.to_modes(velocity_, modes);
    const double scale = 1.0 / (8.0 * grid_.cells[0] * grid_.cells[1] * grid_.cells[2]);
    for (auto& component : modes)
      for (double& mode : component)
        mode *= scale;
  }

  ManufacturedFlow flow_;
  fluid::Grid grid_;
  fluid::Slab slab_;
  fluid::BoxTransform transform_;
  fluid::Stokes stokes_;
  FaceField velocity_;
};

void check_orders(bool convection, Findings& found) {
  constexpr double end = 0.02;  // [s]
  constexpr double band = 0.2;  // around the theoretical order 2
  // steps as fine as the cells, so that both errors shrink alike
  const auto error = [&](int n) { return Integration(n, 4 * n, end, convection).error(end); };
  const double coarse = error(16);
  const double middle = error(24);
  const double fine = error(36);
  found.add("order in space with dt ~ h, 16 to 24 cells", std::log(coarse / middle) / std::log(1.5),
            2.0, band);
  found.add("order in space with dt ~ h, 24 to 36 cells", std::log(middle / fine) / std::log(1.5),
            2.0, band);
  found.add_error("error with 36 cells, relative", fine, 0.02);

  // differences of successive steps on one grid: the error in space is the same in all
  const auto with_steps = [&](int steps) { return Integration(16, steps, end, convection); };
  const Integration first = with_steps(10);
  const Integration second = with_steps(20);
  const Integration third = with_steps(40);
  const double ratio = Integration::distance(first.velocity(), second.velocity()) /
                       Integration::distance(second.velocity(), third.velocity());
  found.add("order in time, steps of 2, 1 and 0.5 ms", std::log2(ratio), 2.0, band);
}

}  // namespace

void stokes_order(Findings& found) {
  check_orders(false, found);
}

void convection_order(Findings& found) {
  check_orders(true, found);
}

}  // namespace lv::verify
