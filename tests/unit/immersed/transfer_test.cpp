#include "lv/immersed/transfer.hpp"

#include "lv/fluid/stokes.hpp"

#include "support/fluid_fields.hpp"
#include <catch2/catch.hpp>

#include <cmath>
#include <limits>

namespace {

using namespace lv;
using fluid::Component;
using fluid::FaceField;
using fluid::Grid;
using immersed::Kernel;
using immersed::Transfer;

const Grid grid{{12, 10, 14}, {-6.0, 3.0, -20.0}, {1.5, 2.0, 1.0}};
constexpr std::array kernels{Kernel::peskin4, Kernel::composite_bspline};

/// Points all over the part of the box where the kernel fits in.
std::vector<Vec3> points(int count) {
  test::RandomValues random(1);
  const Vec3 centre = 0.5 * (grid.lower + grid.upper());
  const Vec3 reach = 0.5 * (grid.upper() - grid.lower) - 3.0 * grid.spacing;
  std::vector<Vec3> result;
  for (int i = 0; i < count; ++i)
    result.push_back(centre + reach.cwiseProduct(random.vector()));
  return result;
}

Transfer transfer_with(Kernel kernel) {
  return {grid, test::whole_box(grid), kernel};
}

FaceField spread(Kernel kernel, const Vec3& X, const Vec3& F) {
  FaceField force(grid, test::whole_box(grid));
  transfer_with(kernel).spread(X, F, force);
  return force;
}

/// Resultant and torque about the origin of a force density.
struct Load {
  Vec3 force = Vec3::Zero();
  Vec3 torque = Vec3::Zero();
};
Load load_of(FaceField& density) {
  Load load;
  for (int c = 0; c < 3; ++c)
    test::for_points(density.component[c], 0, [&](int i, int j, int k, double& f) {
      const Vec3 F = grid.cell_volume() * f * Vec3::Unit(c);
      load.force += F;
      load.torque += grid.face(c, i, j, k).cross(F);
    });
  return load;
}

/// A velocity without divergence, of size one.
FaceField solenoidal_velocity() {
  fluid::BoxTransform transform(grid, test::whole_box(grid));
  fluid::ModeField force = transform.zero_modes();
  fluid::ModeField modes = transform.zero_modes();
  transform.to_modes(test::random_field(grid, 5), force);
  fluid::Stokes(grid, transform, {1.0, 0.0}).advance(modes, force, 1.0, 0.0);
  FaceField u(grid, test::whole_box(grid));
  transform.to_points(modes, u);
  fluid::fill_ghosts(u, test::whole_box(grid));
  return u;
}

/// Root mean square of div U at the points, by differences over 1e-4 mm.
double rms_divergence(const Transfer& transfer, const FaceField& u) {
  constexpr double h = 1e-4;
  double squares = 0.0;
  const auto at = points(100);
  for (const Vec3& X : at) {
    double divergence = 0.0;
    for (int d = 0; d < 3; ++d)
      divergence += (transfer.interpolate(u, X + h * Vec3::Unit(d))[d] -
                     transfer.interpolate(u, X - h * Vec3::Unit(d))[d]) /
                    (2.0 * h);
    squares += divergence * divergence;
  }
  return std::sqrt(squares / static_cast<double>(at.size()));
}

}  // namespace

TEST_CASE("spreading and interpolation are adjoint", "[unit][immersed]") {
  test::RandomValues random(2);
  const FaceField u = test::random_field(grid, 3);
  for (const Kernel kernel : kernels) {
    for (const Vec3& X : points(50)) {
      const Vec3 F = random.vector();
      const double on_the_grid = test::product(spread(kernel, X, F), u) * grid.cell_volume();
      CHECK(on_the_grid == Approx(F.dot(transfer_with(kernel).interpolate(u, X))).margin(1e-14));
    }
  }
}

TEST_CASE("spreading conserves force and torque", "[unit][immersed]") {
  test::RandomValues random(4);
  for (const Kernel kernel : kernels) {
    for (const Vec3& X : points(50)) {
      const Vec3 F = random.vector();
      FaceField density = spread(kernel, X, F);
      const Load load = load_of(density);
      CHECK((load.force - F).norm() < 1e-14);
      CHECK((load.torque - X.cross(F)).norm() < 1e-12);  // arms of 30 mm, 64 terms
    }
  }
}

TEST_CASE("spreading adds to what is there", "[unit][immersed]") {
  FaceField density = test::random_field(grid, 6);
  const Load before = load_of(density);
  transfer_with(Kernel::peskin4).spread(points(1)[0], {1, 2, 3}, density);
  CHECK((load_of(density).force - before.force - Vec3(1, 2, 3)).norm() < 1e-11);
}

TEST_CASE("rigid motion and uniform strain are interpolated exactly", "[unit][immersed]") {
  const Mat3 gradient = test::RandomValues(7).tensor();
  const FaceField u =
      test::field_of(grid, [&](int c, const Vec3& x) { return 2.0 - c + gradient.row(c).dot(x); });
  for (const Kernel kernel : kernels)
    for (const Vec3& X : points(50))
      CHECK((transfer_with(kernel).interpolate(u, X) - (Vec3(2, 1, 0) + gradient * X)).norm() <
            1e-13 * 30.0);  // positions of 30 mm
}

TEST_CASE("the composite kernel keeps a velocity free of divergence between grid points",
          "[unit][immersed]") {
  const FaceField u = solenoidal_velocity();
  REQUIRE(test::largest_divergence(u, grid) < 1e-13);
  // differences over 1e-4 mm: that squared, and jumps of the second derivative where pieces meet
  CHECK(rms_divergence(transfer_with(Kernel::composite_bspline), u) < 1e-6);
  CHECK(rms_divergence(transfer_with(Kernel::peskin4), u) > 1e-3);
}

TEST_CASE("a point is inside when three cells separate it from every side of the box",
          "[unit][immersed]") {
  const Transfer transfer = transfer_with(Kernel::peskin4);
  const Vec3 centre = 0.5 * (grid.lower + grid.upper());
  CHECK(transfer.inside(centre));
  for (int d = 0; d < 3; ++d) {
    for (const double sign : {-1.0, 1.0}) {
      const double margin = 0.5 * (grid.upper() - grid.lower)[d] - 3.0 * grid.spacing[d];
      CHECK(transfer.inside(centre + sign * (margin - 1e-9) * Vec3::Unit(d)));
      CHECK_FALSE(transfer.inside(centre + sign * (margin + 1e-9) * Vec3::Unit(d)));
    }
    Vec3 nowhere = centre;
    nowhere[d] = std::numeric_limits<double>::quiet_NaN();
    CHECK_FALSE(transfer.inside(nowhere));
  }
}

TEST_CASE("every point is owned by exactly one slab, and spreads to all that it reaches",
          "[unit][immersed]") {
  constexpr int ranks = 3;
  for (const Vec3& X : points(50)) {
    int owners = 0;
    Vec3 total = Vec3::Zero();
    for (int rank = 0; rank < ranks; ++rank) {
      const fluid::Slab slab = fluid::slab_of(grid, rank, ranks);
      const Transfer transfer(grid, slab, Kernel::peskin4);
      owners += transfer.owns(X) ? 1 : 0;
      if (!transfer.reaches(X.z(), X.z()))
        continue;
      FaceField force(grid, slab);
      transfer.spread(X, {1, 2, 3}, force);
      for (int c = 0; c < 3; ++c)
        test::for_points(force.component[c], 0,
                         [&](int, int, int, double& f) { total[c] += f * grid.cell_volume(); });
    }
    CHECK(owners == 1);
    CHECK((total - Vec3(1, 2, 3)).norm() < 1e-13);
  }
}
