#include "lv/fluid/stokes.hpp"

#include "support/fluid_fields.hpp"
#include <catch2/catch.hpp>

#include <cmath>

namespace {

using namespace lv;
using fluid::Component;
using fluid::FaceField;
using fluid::ModeField;
using test::uneven_grid;

const fluid::Blood blood{1.3, 0.7};  // of order one, so that all terms count
constexpr double dt = 0.1;
constexpr double drag = 2.0;

/// The solver with its transform, seen from the points.
struct Box {
  fluid::BoxTransform transform{uneven_grid, test::whole_box(uneven_grid)};
  fluid::Stokes stokes{uneven_grid, transform, blood};
  ModeField velocity = transform.zero_modes();
  ModeField force_modes = transform.zero_modes();

  FaceField step(const FaceField& force, double c) {
    transform.to_modes(force, force_modes);
    stokes.advance(velocity, force_modes, dt, c);
    return points();
  }
  FaceField points() {
    FaceField u(uneven_grid, test::whole_box(uneven_grid));
    transform.to_points(velocity, u);
    fluid::fill_ghosts(u, test::whole_box(uneven_grid));
    return u;
  }
  void set(const FaceField& u) {
    transform.to_modes(u, velocity);
    for (auto& component : velocity)
      for (double& mode : component)
        mode /= 8.0 * 240.0;
  }
  Component pressure() {
    fluid::ComponentTransform centred(uneven_grid, test::whole_box(uneven_grid),
                                      fluid::cell_centred);
    Component p(uneven_grid.cells[0], uneven_grid.cells[1], uneven_grid.cells[2]);
    centred.to_points(stokes.pressure(force_modes, centred.layout()), p);
    fluid::fill_ghosts(p, test::whole_box(uneven_grid));
    return p;
  }
};

/// Differences along axis d by the definition of the staggered grid.
double laplacian(const Component& u, int i, int j, int k) {
  const auto second = [&](int d) {
    const int x = d == 0;
    const int y = d == 1;
    const int z = d == 2;
    return (u.at(i + x, j + y, k + z) - 2.0 * u.at(i, j, k) + u.at(i - x, j - y, k - z)) /
           (uneven_grid.spacing[d] * uneven_grid.spacing[d]);
  };
  return second(0) + second(1) + second(2);
}
double gradient(const Component& p, int d, int i, int j, int k) {
  return (p.at(i, j, k) - p.at(i - (d == 0), j - (d == 1), k - (d == 2))) / uneven_grid.spacing[d];
}

double wave_number(int d, int m) {
  return 2.0 / uneven_grid.spacing[d] * std::sin(M_PI * m / (2.0 * uneven_grid.cells[d]));
}

/// The solenoidal mode with numbers 2, 3, 5.
FaceField single_mode() {
  const Vec3 k(wave_number(0, 2), wave_number(1, 3), wave_number(2, 5));
  const Vec3 amplitude = k.cross(Vec3(1.0, 0.3, -0.5));
  return test::field_of(uneven_grid, [&](int c, const Vec3& x) {
    constexpr std::array<int, 3> m{2, 3, 5};
    double u = amplitude[c];
    for (int d = 0; d < 3; ++d) {
      const double phase = M_PI * m[d] * x[d] / (uneven_grid.cells[d] * uneven_grid.spacing[d]);
      u *= d == c ? std::cos(phase) : std::sin(phase);
    }
    return u;
  });
}

}  // namespace

TEST_CASE("the velocity after a step has no divergence", "[unit][fluid]") {
  Box box;
  for (unsigned seed = 1; seed < 4; ++seed) {
    const FaceField u = box.step(test::random_field(uneven_grid, seed), drag);
    CHECK(std::sqrt(test::product(u, u)) > 0.1);
    CHECK(test::largest_divergence(u, uneven_grid) < 1e-14);  // rounding of velocities of 0.1
  }
}

TEST_CASE("a step solves the discrete equations at every point, on the sides of the box too",
          "[unit][fluid]") {
  Box box;
  const FaceField before = box.step(test::random_field(uneven_grid, 1), 0.0);
  const FaceField force = test::random_field(uneven_grid, 2);
  const FaceField after = box.step(force, drag);
  Component p = box.pressure();
  for (int c = 0; c < 3; ++c) {
    FaceField f = force;
    test::for_points(f.component[c], 0, [&](int i, int j, int k, double& f_here) {
      const double u = before.component[c].at(i, j, k);
      const double v = after.component[c].at(i, j, k);
      const double viscous =
          0.5 * blood.viscosity *
          (laplacian(before.component[c], i, j, k) + laplacian(after.component[c], i, j, k));
      const double residual = blood.density * (v - u) / dt + gradient(p, c, i, j, k) - viscous +
                              0.5 * blood.density * drag * (u + v) - f_here;
      CHECK(std::abs(residual) < 1e-13);  // rounding of terms of size one
    });
  }
}

TEST_CASE("a mode decays by its own factor", "[unit][fluid]") {
  double k2 = 0.0;
  for (const auto& [d, m] : {std::pair{0, 2}, {1, 3}, {2, 5}})
    k2 += wave_number(d, m) * wave_number(d, m);
  const double loss = 0.5 * (blood.viscosity * k2 + blood.density * drag);
  const double factor = (blood.density / dt - loss) / (blood.density / dt + loss);
  const FaceField mode = single_mode();
  REQUIRE(test::largest_divergence(mode, uneven_grid) < 1e-14);
  Box box;
  box.set(mode);
  FaceField after = box.step(FaceField(uneven_grid, test::whole_box(uneven_grid)), drag);
  for (int c = 0; c < 3; ++c)
    test::for_points(after.component[c], 0, [&](int i, int j, int k, double& u) {
      CHECK(u == Approx(factor * mode.component[c].at(i, j, k)).margin(1e-14));
    });
}

TEST_CASE("a force that is a gradient moves nothing and makes its pressure", "[unit][fluid]") {
  test::RandomValues random(3);
  Component potential(uneven_grid.cells[0], uneven_grid.cells[1], uneven_grid.cells[2]);
  test::for_points(potential, 0, [&](int, int, int, double& value) { value = random(); });
  fluid::fill_ghosts(potential, test::whole_box(uneven_grid));
  FaceField force(uneven_grid, test::whole_box(uneven_grid));
  for (int c = 0; c < 3; ++c)
    test::for_points(force.component[c], 0,
                     [&](int i, int j, int k, double& f) { f = gradient(potential, c, i, j, k); });
  Box box;
  const FaceField u = box.step(force, 0.0);
  CHECK(std::sqrt(test::product(u, u)) < 1e-14);  // rounding of forces of size one times dt
  Component p = box.pressure();
  test::for_points(p, 0, [&](int i, int j, int k, double& value) {
    CHECK(value == Approx(potential.at(i, j, k)).margin(1e-13));
  });
}

TEST_CASE("drag takes a uniform share of every velocity and leaves an equilibrium in place",
          "[unit][fluid]") {
  // a flow that a steady force keeps up, without drag; at rest drag does nothing
  Box rest;
  const FaceField still = rest.step(FaceField(uneven_grid, test::whole_box(uneven_grid)), drag);
  CHECK(test::product(still, still) == 0.0);
  Box with;
  Box without;
  with.set(single_mode());
  without.set(single_mode());
  const FaceField none(uneven_grid, test::whole_box(uneven_grid));
  for (int i = 0; i < 5; ++i) {
    const FaceField slow = with.step(none, drag);
    const FaceField fast = without.step(none, 0.0);
    CHECK(test::product(slow, slow) < test::product(fast, fast));
  }
}
