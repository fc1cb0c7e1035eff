#include "lv/solid/support.hpp"

#include "lv/mesh/refine.hpp"

#include "support/block_mesh.hpp"
#include "support/random_values.hpp"
#include <catch2/catch.hpp>

#include <array>
#include <cmath>

namespace {

using namespace lv;
using mesh::CellKind;
using solid::Support;
using solid::SupportedSurface;

std::vector<mesh::Mesh> meshes() {
  return {test::block_mesh(CellKind::hexahedron, 2),
          mesh::refine(test::block_mesh(CellKind::hexahedron, 2)),
          mesh::refine(test::block_mesh(CellKind::tetrahedron, 1))};
}

/// A cube of 6 mm whose top at z = 6 is its base.
mesh::Mesh cube() {
  mesh::Mesh m = test::cubes(CellKind::hexahedron, 1);
  for (const int node : {4, 5, 6, 7})
    m.base.nodes.push_back(m.cells[node]);
  for (Vec3& X : m.nodes)
    X *= 3.0;
  return m;
}

std::vector<Vec3> forces(const mesh::Mesh& mesh, const Support& support, const Vec3& u,
                         const Vec3& v) {
  const SupportedSurface surface(mesh, mesh.base, support);
  std::vector<Vec3> f(mesh.nodes.size(), Vec3::Zero());
  surface.add_forces(test::moved(mesh.nodes, Mat3::Identity(), u),
                     std::vector<Vec3>(mesh.nodes.size(), v), f);
  return f;
}

}  // namespace

TEST_CASE("a support pulls back along its normal and across it", "[unit][solid]") {
  const mesh::Mesh m = cube();
  const Support support{2.0, 0.5, 0.03, 0.01};
  const Vec3 f = test::resultant(forces(m, support, {0.1, -0.2, 0.3}, {1.0, 2.0, -3.0}));
  constexpr double area = 36.0;
  CHECK(f.x() == Approx(-area * (0.5 * 0.1 + 0.01 * 1.0)));
  CHECK(f.y() == Approx(-area * (0.5 * -0.2 + 0.01 * 2.0)));
  CHECK(f.z() == Approx(-area * (2.0 * 0.3 + 0.03 * -3.0)));
}

TEST_CASE("normals that scatter hold a surface across its own normal too", "[unit][solid]") {
  const mesh::Mesh m = cube();
  Support support{2.0, 0.0, 0.03, 0.0};
  support.scatter = [](const Vec3& X) {
    CHECK(X.z() == Approx(6.0));
    return Mat3(Vec3(0.01, 0.04, 0.0).asDiagonal());
  };
  const Vec3 f = test::resultant(forces(m, support, {0.1, -0.2, 0.3}, {1.0, 2.0, -3.0}));
  constexpr double area = 36.0;
  CHECK(f.x() == Approx(-area * 0.01 * (2.0 * 0.1 + 0.03 * 1.0)));
  CHECK(f.y() == Approx(-area * 0.04 * (2.0 * -0.2 + 0.03 * 2.0)));
  CHECK(f.z() == Approx(-area * (2.0 * 0.3 + 0.03 * -3.0)));
}

TEST_CASE("a support of all directions is one spring", "[unit][solid]") {
  for (const mesh::Mesh& m : meshes()) {
    const Vec3 u(0.2, 0.1, -0.3);
    const Vec3 f = test::resultant(forces(m, Support::in_all_directions(3.0, 0.0), u, u));
    CHECK(f.cross(u).norm() < 1e-10 * f.norm());
    CHECK(f.dot(u) < 0.0);
  }
}

TEST_CASE("a support's weight changes along the long axis", "[unit][solid]") {
  mesh::Mesh m = cube();
  for (Vec3& X : m.nodes)
    X = Vec3(X.z(), X.x(), X.y());  // the surface stands upright, z from 0 to 6
  Support support = Support::in_all_directions(3.0, 0.0);
  const Vec3 even = test::resultant(forces(m, support, Vec3::UnitX(), Vec3::Zero()));
  support.weight.shape = solid::AxialWeight::WeightShape::linear;
  const auto f = forces(m, support, Vec3::UnitX(), Vec3::Zero());
  CHECK(test::resultant(f).x() == Approx(0.5 * even.x()));
  double below = 0.0;
  for (std::size_t a = 0; a < m.nodes.size(); ++a)
    below += m.nodes[a].z() < 3.0 ? f[a].x() : 0.0;
  CHECK(below == Approx(2.0 / 3.0 * test::resultant(f).x()));  // int of (1-s) (1-s) over 1/2
}

TEST_CASE("a sigmoid of the long axis holds the apex and lets the base go", "[unit][solid]") {
  solid::AxialWeight weight{.shape = solid::AxialWeight::WeightShape::sigmoid};
  CHECK(weight.at(0.0) == Approx(1.0 / (1.0 + std::exp(-25.0 * 0.15))));
  CHECK(weight.at(0.15) == Approx(0.5));
  CHECK(weight.at(1.0) < 1e-8);
  weight.at_base = 0.2;
  CHECK(weight.at(1.0) == Approx(0.2));
  CHECK(weight.at(0.15) == Approx(0.6));
}

TEST_CASE("a leapfrog stays within the supports' longest step and grows beyond it",
          "[unit][solid]") {
  constexpr double mass = 2e-6;  // per area [kg/mm^2]
  for (const auto& [k, c] :
       {std::array{300.0, 0.0}, std::array{0.0, 0.02}, std::array{50.0, 0.01}}) {
    solid::Surroundings held;
    held.epicardium = {0.5 * k, 0.1 * k, 0.5 * c, c, {}};
    held.base = {0.5 * k, 0.0, 0.0, 0.0, {}};
    const auto grows = [&, k = k, c = c](double dt) {
      double x = 1.0;
      double v = 1.0;
      for (int n = 0; n < 4000; ++n) {
        v += dt * (-k * x - c * v) / mass;
        x += dt * v;
        if (std::abs(x) + dt * std::abs(v) > 1e3)
          return true;
      }
      return false;
    };
    CHECK(!grows(0.99 * held.longest_step(mass)));
    CHECK(grows(1.01 * held.longest_step(mass)));
  }
  CHECK(std::isinf(solid::Surroundings{}.longest_step(mass)));
}

TEST_CASE("a support's stiffness is the derivative of its forces", "[unit][solid]") {
  const Support support{2.0, 0.5, 0.03, 0.01, {solid::AxialWeight::WeightShape::linear, 0.4}};
  constexpr double slope = 25.0;
  for (const mesh::Mesh& m : meshes()) {
    const SupportedSurface surface(m, m.epi, support);
    test::RandomValues random(9);
    std::vector<Vec3> d, velocities;
    for (std::size_t a = 0; a < m.nodes.size(); ++a) {
      d.push_back(random.vector());
      velocities.emplace_back(slope * d.back());
    }
    std::vector<Vec3> expected(m.nodes.size(), Vec3::Zero());  // linear: from rest along d
    surface.add_forces(test::displaced(m.nodes, d, 1.0), velocities, expected);
    std::vector<Vec3> found(m.nodes.size(), Vec3::Zero());
    surface.add_stiffness(slope, [&](std::span<const int> nodes, const Eigen::MatrixXd& K) {
      CHECK((K - K.transpose()).norm() < 1e-14 * K.norm());
      for (std::size_t a = 0; a < nodes.size(); ++a)
        for (std::size_t b = 0; b < nodes.size(); ++b)
          found[nodes[a]] -=
              K.block<3, 3>(3 * static_cast<Eigen::Index>(a), 3 * static_cast<Eigen::Index>(b)) *
              d[nodes[b]];
    });
    for (std::size_t a = 0; a < m.nodes.size(); ++a)
      CHECK((found[a] - expected[a]).norm() < 1e-11);
  }
}
