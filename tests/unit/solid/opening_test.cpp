#include "lv/solid/opening.hpp"

#include "lv/solid/endocardial_surface.hpp"

#include "mesh_io/mesh_files.hpp"
#include "support/block_mesh.hpp"
#include "support/cell_kinds.hpp"
#include "support/random_values.hpp"
#include <catch2/catch.hpp>

#include <algorithm>
#include <functional>
#include <numeric>

namespace {

using namespace lv;
using mesh::Mesh;
using solid::Opening;

/// A ventricle whose base is thicker on one side, so that its centre is not the opening's.
Mesh lopsided(mesh::CellKind kind) {
  Mesh mesh = test::coarse_mesh(kind);
  for (Vec3& X : mesh.nodes) {
    X.x() += 4e-3 * X.x() * X.x();
    X.y() += 2e-3 * X.x() * X.y();
  }
  return mesh;
}

/// What the cavity under the lid gains as its nodes move on a straight way from x to x + d [mm^3].
double swept(const Mesh& mesh, std::span<const Vec3> positions, std::span<const Vec3> d) {
  std::vector<Vec3> gradient(positions.size(), Vec3::Zero());
  solid::EndocardialSurface(mesh).add_gradient(1.0, positions, gradient);
  const Vec3 lid = Opening(mesh).carried(d);
  return std::transform_reduce(gradient.begin(), gradient.end(), d.begin(), 0.0, std::plus<>(),
                               [&](const Vec3& g, const Vec3& v) { return g.dot(v - lid); });
}

/// Velocities v(x) = H x + c.
std::vector<Vec3> affine(std::span<const Vec3> positions, const Mat3& H, const Vec3& c) {
  return test::moved(positions, H, c);
}

Mat3 turn(const Vec3& omega) {
  Mat3 W;
  W << 0.0, -omega.z(), omega.y(), omega.z(), 0.0, -omega.x(), -omega.y(), omega.x(), 0.0;
  return W;
}

}  // namespace

TEST_CASE("a wall that moves as a whole changes no cavity's volume", "[unit][solid]") {
  for (const mesh::CellKind kind : test::kinds) {
    const Mesh mesh = lopsided(kind);
    constexpr double opening = 1000.0;  // [mm^2]
    const std::vector<Vec3> along_axis(mesh.nodes.size(), Vec3(0.0, 0.0, -14.0));
    CHECK(std::abs(swept(mesh, mesh.nodes, along_axis)) < 1e-9 * opening);
    const auto turned = affine(mesh.nodes, turn({0.3, -0.2, 0.5}), {5.0, -3.0, 2.0});
    CHECK(std::abs(swept(mesh, mesh.nodes, turned)) < 1e-9 * opening);
    // the endocardium alone sweeps what the opening passes over
    std::vector<Vec3> gradient(mesh.nodes.size(), Vec3::Zero());
    solid::EndocardialSurface(mesh).add_gradient(1.0, mesh.nodes, gradient);
    CHECK(test::work(gradient, along_axis) > 10.0 * opening);
  }
}

TEST_CASE(
    "what the endocardium sweeps against the lid is the whole change of the cavity, where "
    "the base moves evenly",
    "[unit][solid]") {
  test::RandomValues random(11);
  for (const mesh::CellKind kind : test::kinds) {
    const Mesh mesh = lopsided(kind);
    Mat3 H = turn({0.2, 0.1, -0.3});
    H(0, 0) += 0.2;
    H(1, 1) -= 0.1;
    H(0, 1) += 0.15;
    std::vector<Vec3> d = random.vectors(mesh.nodes.size(), 1.0);
    const auto of_base = affine(mesh.nodes, H, {1.0, 2.0, -8.0});
    for (const int node : mesh.base.nodes)
      d[node] = of_base[node];
    std::vector<Vec3> gradient(mesh.nodes.size(), Vec3::Zero());
    solid::EndocardialSurface(mesh).add_volume_gradient(mesh.nodes, gradient);
    CHECK(swept(mesh, mesh.nodes, d) == Approx(test::work(gradient, d)).epsilon(1e-9));
  }
}

TEST_CASE("the lid's centre goes with the base and not with its edge alone", "[unit][solid]") {
  const Mesh mesh = lopsided(mesh::CellKind::hexahedron);
  const Opening opening(mesh);
  const Mat3 H = turn({0.1, -0.2, 0.3});
  const auto moved = affine(mesh.nodes, H, {1.0, 2.0, 3.0});
  CHECK((opening.carried(moved) - (H * opening.centre() + Vec3(1.0, 2.0, 3.0))).norm() < 1e-12);
  std::vector<Vec3> edge(mesh.nodes.size(), Vec3::Zero());
  for (const auto& side : mesh::boundary_edges(mesh.endo))
    edge[side[0]] = Vec3::UnitZ();
  CHECK(opening.carried(edge).z() > 0.0);
  CHECK(opening.carried(edge).z() < 0.5);
}

TEST_CASE("the lid of a cavity without a base stays", "[unit][solid]") {
  Mesh mesh = test::coarse_mesh(mesh::CellKind::hexahedron);
  mesh.base.nodes.clear();
  const std::vector<Vec3> moved(mesh.nodes.size(), Vec3(1.0, 2.0, 3.0));
  CHECK(Opening(mesh).carried(moved) == Vec3::Zero());
}
