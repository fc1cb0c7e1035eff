#include "lv/implicit/inverse.hpp"

#include "lv/base/units.hpp"
#include "lv/geometry/ellipsoid.hpp"
#include "lv/implicit/engine.hpp"
#include "lv/mesh/fibres.hpp"
#include "lv/mesh/regions.hpp"
#include "lv/mesh/wall_mesh.hpp"

#include "support/random_values.hpp"
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

namespace {

using namespace lv;
using implicit::InverseEquations;
using implicit::Reference;
using units::mmHg;

mesh::Mesh coarse_wall(double edge, int layers) {
  return mesh::wall_mesh([e = geometry::Ellipsoid{}](double u, double theta,
                                                     double t) { return e.point(u, theta, t); },
                         {.edge_length = edge, .layers = layers, .order = 2});
}

implicit::StaticModel model(solid::BasalSupport::Kind base) {
  solid::CardiacModel heart{.base = {base, 50.0}};
  return heart;
}

Reference displaced(const Reference& from, std::span<const double> by, double scale) {
  Reference to = from;
  for (std::size_t k = 0; k < 3 * to.nodes.size(); ++k)
    to.nodes[k / 3][static_cast<int>(k % 3)] += scale * by[k];
  for (std::size_t m = 0; m < to.pressures.size(); ++m)
    to.pressures[m] += scale * by[3 * to.nodes.size() + m];
  return to;
}

/// A wall without load and pressures near no symmetry.
Reference some_reference(const InverseEquations& equations, test::RandomValues& random) {
  Reference z = equations.seen();
  for (Vec3& X : z.nodes) {
    X = Vec3(0.97 * X.x() + 0.03 * X.y(), 0.96 * X.y() - 0.02 * X.z(), 0.98 * X.z());
    X += 0.02 * random.vector();
  }
  for (double& p : z.pressures)
    p = random();
  return z;
}

double largest(const std::vector<double>& a, const std::vector<double>& b) {
  double most = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k)
    most = std::max(most, std::abs(a[k] - b[k]));
  return most;
}

}  // namespace

TEST_CASE("the inverse problem has the residual of the equations", "[unit][implicit]") {
  mesh::Mesh seen = coarse_wall(9.0, 1);
  seen.segment = mesh::divide(seen, {}).aha;
  auto muscle = model(solid::BasalSupport::Kind::sliding);
  muscle.heart.septal_pressure = 0.3;
  InverseEquations inverse(seen, muscle);
  test::RandomValues random(5);
  const Reference z = some_reference(inverse, random);
  inverse.hold_frames(z);
  const mesh::Mesh wall = mesh::with_nodes(seen, z.nodes);
  const implicit::Equations equations(wall, muscle);
  const auto expected = equations.residual({seen.nodes, z.pressures}, solid::Loads{1.3, 0.0});
  const auto found = inverse.residual(z, 1.3);
  REQUIRE_FALSE(expected.empty());
  REQUIRE(found.size() == expected.size());
  const std::vector<double> nothing(expected.size(), 0.0);
  CHECK(largest(found, expected) < 1e-11 * largest(expected, nothing));
}

TEST_CASE("the inverse tangent is the derivative of the inverse residual", "[unit][implicit]") {
  const mesh::Mesh seen = coarse_wall(9.0, 1);
  InverseEquations inverse(seen, model(solid::BasalSupport::Kind::sliding));
  test::RandomValues random(3);
  const Reference z = some_reference(inverse, random);
  inverse.hold_frames(z);
  std::vector<double> direction(static_cast<std::size_t>(inverse.size()));
  for (double& d : direction)
    d = random();
  // the areas on which the base is held have no derivative: it moves as a rigid body
  for (const int node : seen.base.nodes) {
    const Vec3& X = z.nodes[static_cast<std::size_t>(node)];
    const Vec3 by(-0.02 * X.y(), 0.02 * X.x(), 0.4);
    for (int i = 0; i < 3; ++i)
      direction[3 * static_cast<std::size_t>(node) + i] = by[i];
  }
  constexpr double h = 1e-6;
  const auto ahead = inverse.residual(displaced(z, direction, h), 1.3);
  const auto behind = inverse.residual(displaced(z, direction, -h), 1.3);
  REQUIRE_FALSE(ahead.empty());
  REQUIRE_FALSE(behind.empty());
  std::vector<double> slope(ahead.size());
  for (std::size_t k = 0; k < slope.size(); ++k)
    slope[k] = (ahead[k] - behind[k]) / (2.0 * h);
  implicit::SparseMatrix K(inverse.pattern(), {}, seen.nodes);
  inverse.tangent(z, K);
  CHECK(largest(K.solve(slope).value(), direction) < 1e-3);
}

TEST_CASE("a wall is found again from its filled shape", "[implicit]") {
  const mesh::Mesh known = coarse_wall(5.0, 2);
  const implicit::StaticModel muscle(
      solid::CardiacModel{.base = {.stiffness = implicit::rigid_base}});
  implicit::Engine engine(known, muscle, {});
  const double pressure = 3.0 * mmHg;
  engine.go_to({pressure, 0.0}).value();
  mesh::Mesh seen = known;
  seen.nodes = engine.state().positions;
  const auto distance = [&](const Reference& z) {
    double most = 0.0;
    for (std::size_t a = 0; a < z.nodes.size(); ++a)
      most = std::max(most, (z.nodes[a] - known.nodes[a]).norm());
    return most;
  };
  const auto found = implicit::find_reference(seen, muscle, pressure, {});
  REQUIRE(found);
  CHECK(distance(*found) < 1e-3);
  const Reference guess{found->nodes, {}};
  const auto again = implicit::find_reference(seen, muscle, pressure, {}, &guess);
  REQUIRE(again);
  CHECK(distance(*again) < 1e-3);
}

TEST_CASE("muscle that is stiffer by the inverse share leaves as much under the whole pressure",
          "[implicit]") {
  const mesh::Mesh seen = coarse_wall(9.0, 1);
  solid::CardiacModel heart{.base = {.stiffness = implicit::rigid_base}};
  const solid::EndocardialSurface endocardium(seen);
  const double volume = 0.85 * endocardium.volume(seen.nodes);
  const double pressure = 8.0 * mmHg;
  const auto share = implicit::share_that_leaves(volume, seen, heart, pressure, {});
  REQUIRE(share);
  CHECK(*share > 1.0 / 32);
  CHECK(*share < 1.0);
  heart.myocardium.passive = material::HolzapfelOgden{}.scaled(1.0 / *share);
  const auto found = implicit::find_reference(seen, heart, pressure, {});
  REQUIRE(found);
  CHECK(endocardium.volume(found->nodes) == Approx(volume).epsilon(0.02));
  CHECK_FALSE(implicit::share_that_leaves(1e-3 * volume, seen, heart, pressure, {}));
}

TEST_CASE("a pressure that no wall bears has no inverse", "[implicit]") {
  solid::CardiacModel heart{.base = {.stiffness = implicit::rigid_base}};
  heart.myocardium.passive = material::HolzapfelOgden{}.scaled(1e-4);
  CHECK_FALSE(implicit::find_reference(coarse_wall(9.0, 1), heart, 90.0 * mmHg, {}));
}
