#include "lv/solid/base_motion.hpp"

#include "lv/base/units.hpp"
#include "lv/mesh/refine.hpp"
#include "lv/solid/support.hpp"

#include "support/block_mesh.hpp"
#include <catch2/catch.hpp>

#include <numbers>

namespace {

using namespace lv;
using solid::AffineField;
using solid::BaseFrame;
using solid::BasePlace;
using solid::BasePose;
using units::degree;

constexpr double radius = 20.0;

/// A base of which a part x towards the septum and y towards the anterior wall is asked for.
struct Base {
  BaseFrame frame{{3.0, -2.0, 0.0}, std::numbers::pi / 3.0};

  [[nodiscard]] Vec3 at(double septal, double anterior) const {
    const Vec3 s(std::cos(frame.septum_angle), std::sin(frame.septum_angle), 0.0);
    return frame.middle + radius * (septal * s + anterior * Vec3::UnitZ().cross(s));
  }
};

/// A block with quadratic elements whose sides are a base.
mesh::Mesh block() {
  return mesh::refine(test::block_mesh(mesh::CellKind::hexahedron, 2));
}

solid::Surroundings soft_base() {
  return {.base = {3.0, 2.0, 0.05, 0.03, {}}};
}

/// The largest force on a node of a wall that has gone by u and goes at v.
double largest_force(const mesh::Mesh& mesh, const solid::BasalSupport& base, const BasePlace& wall,
                     const BasePlace& held) {
  std::vector<Vec3> x, v;
  for (const Vec3& X : mesh.nodes) {
    x.push_back(X + wall.displacement.at(X));
    v.push_back(wall.velocity.at(X));
  }
  std::vector<Vec3> forces(mesh.nodes.size(), Vec3::Zero());
  solid::Supports(mesh, base, soft_base()).add_forces(x, v, forces, held);
  double most = 0.0;
  for (const Vec3& f : forces)
    most = std::max(most, f.norm());
  return most;
}

}  // namespace

TEST_CASE("a base goes towards the apex, and its edges as its tilts say", "[unit][solid]") {
  const Base base;
  const auto z = [&](const BasePose& pose, double septal, double anterior) {
    return displacement(pose, base.frame).at(base.at(septal, anterior)).z();
  };
  const BasePose down{.axial = 12.0};
  CHECK(z(down, 0.0, 0.0) == Approx(-12.0));
  CHECK(z(down, 1.0, 0.0) == Approx(-12.0));
  const BasePose septal{.septal_tilt = 5.0 * degree};
  CHECK(z(septal, 1.0, 0.0) == Approx(-radius * std::sin(5.0 * degree)));
  CHECK(z(septal, -1.0, 0.0) == Approx(radius * std::sin(5.0 * degree)));
  CHECK(z(septal, 0.0, 1.0) == Approx(0.0).margin(1e-12));
  const BasePose anterior{.anterior_tilt = 5.0 * degree};
  CHECK(z(anterior, 0.0, 1.0) == Approx(-radius * std::sin(5.0 * degree)));
  CHECK(z(anterior, 1.0, 0.0) == Approx(0.0).margin(1e-12));
}

TEST_CASE("a base turns anticlockwise as the apex sees it", "[unit][solid]") {
  const Base base;
  const BasePose pose{.rotation = 90.0 * degree};
  const Vec3 X = base.at(1.0, 0.0);
  const Vec3 x = X + displacement(pose, base.frame).at(X);
  // from the base that is clockwise, away from the anterior wall
  CHECK((x - base.at(0.0, -1.0)).norm() < 1e-12);
}

TEST_CASE("a displaced base is a rigid body", "[unit][solid]") {
  const Base base;
  const AffineField u = solid::displacement({10.0, 0.1, -0.2, 0.3}, base.frame);
  const Mat3 F = Mat3::Identity() + u.H;
  CHECK((F.transpose() * F - Mat3::Identity()).norm() < 1e-14);
  CHECK((base.frame.middle + u.at(base.frame.middle) - (base.frame.middle - 10.0 * Vec3::UnitZ()))
            .norm() < 1e-12);
  CHECK(displacement({}, base.frame).at({1.0, 2.0, 3.0}).norm() == 0.0);
}

TEST_CASE("springs and dashpots pull a wall to where the base is, and not where it went along",
          "[unit][solid]") {
  const mesh::Mesh mesh = block();
  const AffineField u = solid::displacement({4.0, 0.05, 0.1, -0.1}, {});
  const BasePlace moved{u, {0.3 * u.H, 2.0 * u.d}};
  for (const auto kind : {solid::BasalSupport::Kind::sliding, solid::BasalSupport::Kind::fixed,
                          solid::BasalSupport::Kind::elastic}) {
    CHECK(largest_force(mesh, {kind, 100.0}, moved, moved) < 1e-10);
    CHECK(largest_force(mesh, {kind, 100.0}, {}, moved) > 1.0);
    CHECK(largest_force(mesh, {kind, 100.0}, moved, {}) ==
          Approx(largest_force(mesh, {kind, 100.0}, {}, moved)));
  }
}
