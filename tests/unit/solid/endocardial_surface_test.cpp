#include "lv/solid/endocardial_surface.hpp"

#include "lv/mesh/refine.hpp"
#include "lv/mesh/surface.hpp"

#include "mesh_io/mesh_files.hpp"
#include "support/block_mesh.hpp"
#include "support/cell_kinds.hpp"
#include "support/random_values.hpp"
#include <catch2/catch.hpp>

#include <cmath>

namespace {

using namespace lv;
using mesh::CellKind;
using mesh::Mesh;
using solid::EndocardialSurface;
using test::kinds;

/// A ventricle of every kind of element, the quadratic ones bent.
std::vector<Mesh> ventricles() {
  std::vector<Mesh> result;
  test::RandomValues random(7);
  for (const CellKind kind : kinds) {
    result.push_back(test::coarse_mesh(kind));
    result.push_back(mesh::refine(test::coarse_mesh(kind)));
    for (Vec3& x : result.back().nodes)
      if (x.z() < -1.0)
        x += 0.1 * random.vector();
  }
  return result;
}

/// All of a block's surface as endocardium, so closed.
Mesh closed(CellKind kind) {
  Mesh mesh = test::block_mesh(kind);
  mesh.endo = mesh::boundary(mesh);
  return mesh;
}

/// p dV/dx.
std::vector<Vec3> pressure_forces(const Mesh& mesh, double pressure,
                                  std::span<const Vec3> positions) {
  std::vector<Vec3> forces(positions.size(), Vec3::Zero());
  EndocardialSurface(mesh).add_gradient(pressure, positions, forces);
  return forces;
}

/// d/dh of a cubic polynomial of h, exactly.
template <class Function>
double slope_of_cubic(const Function& f) {
  const auto difference = [&](double h) { return (f(h) - f(-h)) / (2.0 * h); };
  return (4.0 * difference(0.5) - difference(1.0)) / 3.0;
}

/// Displacements that leave the base in its plane.
std::vector<Vec3> displacements_of_a_plane_base(const Mesh& mesh, test::RandomValues& random) {
  auto displacements = random.vectors(mesh.nodes.size(), 1.0);
  for (const auto& side : mesh::boundary_edges(mesh.endo))
    displacements[side[0]].z() = displacements[side[1]].z() = 0.0;
  return displacements;
}

}  // namespace

TEST_CASE("the cavity of an ellipsoid has its exact volume, to second order in the edge length",
          "[unit][solid]") {
  const geometry::Ellipsoid ellipsoid;
  const double exact = ellipsoid.enclosed_volume(0.0);
  CHECK(exact == Approx(70790.0).epsilon(1e-3));  // 70.79 ml
  const auto error = [&](double edge) {
    const Mesh mesh = test::ellipsoid_mesh(ellipsoid, edge, 3);
    return 1.0 - EndocardialSurface(mesh).volume(mesh.nodes) / exact;
  };
  const double coarse = error(5.0);
  const double fine = error(2.5);
  CHECK(coarse > 0.0);  // faces cut the corners
  CHECK(coarse < 0.05);
  CHECK(coarse / fine > 3.0);  // 4, but the number of elements is whole
  CHECK(coarse / fine < 5.0);
}

TEST_CASE("the cavity's volume changes with det F and not with rigid motions", "[unit][solid]") {
  Mat3 F;
  F << 1.1, 0.05, 0.0, -0.1, 0.95, 0.03, 0.02, 0.0, 1.02;
  for (const CellKind kind : {CellKind::hexahedron, CellKind::tetrahedron}) {
    const Mesh mesh = test::coarse_mesh(kind);
    const EndocardialSurface endocardium(mesh);
    const double V = endocardium.volume(mesh.nodes);
    CHECK(endocardium.volume(test::moved(mesh.nodes, test::RandomValues(1).rotation(),
                                         {70, -20, 90})) == Approx(V).epsilon(1e-12));
    CHECK(endocardium.volume(test::moved(mesh.nodes, F)) ==
          Approx(determinant(F) * V).epsilon(1e-12));
  }
}

TEST_CASE("splitting hexahedra in tetrahedra changes the cavity little", "[unit][solid]") {
  const Mesh hexahedra = test::coarse_mesh(CellKind::hexahedron);
  const Mesh tetrahedra = test::coarse_mesh(CellKind::tetrahedron);
  CHECK(EndocardialSurface(tetrahedra).volume(tetrahedra.nodes) ==
        Approx(EndocardialSurface(hexahedra).volume(hexahedra.nodes)).epsilon(0.01));
}

TEST_CASE("pressure on a closed surface has no resultant and no torque", "[unit][solid]") {
  for (const CellKind kind : kinds) {
    const Mesh mesh = closed(kind);
    const auto forces = pressure_forces(mesh, 8.0, mesh.nodes);
    const double size = test::magnitude(forces);
    CHECK(size > 100.0);
    CHECK(test::resultant(forces).norm() < 1e-14 * size);
    CHECK(test::torque(mesh.nodes, forces).norm() < 1e-14 * 20.0 * size);  // arms of 20 mm
  }
}

TEST_CASE("the volume inside a closed surface is that of its faces", "[unit][solid]") {
  for (const CellKind kind : kinds) {
    const Mesh mesh = closed(kind);
    CHECK(EndocardialSurface(mesh).volume(mesh.nodes) ==
          Approx(-mesh::signed_volume(mesh.nodes, mesh.endo, Vec3::Zero())).epsilon(1e-12));
  }
}

TEST_CASE("dV/dx is the derivative of the volume while the base stays in its plane",
          "[unit][solid]") {
  test::RandomValues random(2);
  std::vector<Mesh> meshes = ventricles();
  meshes.push_back(closed(CellKind::hexahedron));
  for (const Mesh& mesh : meshes) {
    const EndocardialSurface endocardium(mesh);
    const auto forces = pressure_forces(mesh, 1.07, mesh.nodes);
    for (int i = 0; i < 5; ++i) {
      const auto direction = displacements_of_a_plane_base(mesh, random);
      const double dV = slope_of_cubic(
          [&](double h) { return endocardium.volume(test::displaced(mesh.nodes, direction, h)); });
      CHECK(test::work(forces, direction) ==
            Approx(1.07 * dV).epsilon(1e-10).margin(1e-12 * test::magnitude(forces)));
    }
  }
}

TEST_CASE("d2V/dx2 is the derivative of dV/dx", "[unit][solid]") {
  test::RandomValues random(3);
  for (const Mesh& mesh : ventricles()) {
    const EndocardialSurface endocardium(mesh);
    const auto direction = random.vectors(mesh.nodes.size(), 1.0);
    std::vector<Vec3> change(mesh.nodes.size(), Vec3::Zero());
    // dV/dx is quadratic: its central difference is exact
    endocardium.add_gradient(1.0, test::displaced(mesh.nodes, direction, 0.5), change);
    endocardium.add_gradient(-1.0, test::displaced(mesh.nodes, direction, -0.5), change);
    const double size = test::magnitude(change);
    endocardium.add_hessian(
        -1.0, mesh.nodes, [&](std::span<const int> nodes, const Eigen::MatrixXd& block) {
          for (std::size_t a = 0; a < nodes.size(); ++a)
            for (std::size_t b = 0; b < nodes.size(); ++b)
              change[nodes[a]] += block.block<3, 3>(3 * static_cast<Eigen::Index>(a),
                                                    3 * static_cast<Eigen::Index>(b)) *
                                  direction[nodes[b]];
        });
    CHECK(size > 100.0);
    CHECK(test::magnitude(change) < 1e-12 * size);
  }
}

TEST_CASE("the pressure follows the surface as it turns", "[unit][solid]") {
  const Mesh mesh = test::coarse_mesh(CellKind::hexahedron);
  const Mat3 Q = test::RandomValues(3).rotation();
  const auto forces = pressure_forces(mesh, 1.0, mesh.nodes);
  const auto turned = pressure_forces(mesh, 1.0, test::moved(mesh.nodes, Q, {5, 6, 7}));
  for (std::size_t a = 0; a < forces.size(); ++a)
    CHECK((turned[a] - Q * forces[a]).norm() < 1e-12);  // forces of 10 mN, positions of 80 mm
}

TEST_CASE("pressure in the cavity pushes the wall out and the apex down", "[unit][solid]") {
  const Mesh mesh = test::coarse_mesh(CellKind::tetrahedron);
  const auto forces = pressure_forces(mesh, 1.0, mesh.nodes);
  double outwards = 0.0;
  for (std::size_t a = 0; a < forces.size(); ++a)
    outwards += forces[a].dot(Vec3(mesh.nodes[a].x(), mesh.nodes[a].y(), 0.0));
  CHECK(outwards > 0.0);
  // p times the basal opening; a polygon in the circle of radius 19.5 sqrt(1 - (20/60)^2)
  const double opening = M_PI * 19.5 * 19.5 * (1.0 - 1.0 / 9.0);
  CHECK(test::resultant(forces).z() < 0.0);
  CHECK(-test::resultant(forces).z() == Approx(opening).epsilon(0.03));
}

TEST_CASE("the whole derivative of the volume holds for a base that leaves its plane too",
          "[unit][solid]") {
  for (const Mesh& mesh : ventricles()) {
    const EndocardialSurface endocardium(mesh);
    test::RandomValues random(5);
    const auto displacements = random.vectors(mesh.nodes.size(), 1.0);
    std::vector<Vec3> gradient(mesh.nodes.size(), Vec3::Zero());
    endocardium.add_volume_gradient(mesh.nodes, gradient);
    const double slope = slope_of_cubic([&](double h) {
      return endocardium.volume(test::displaced(mesh.nodes, displacements, h));
    });
    CHECK(test::work(gradient, displacements) == Approx(slope).epsilon(1e-9));
    CHECK(test::resultant(gradient).norm() < 1e-10 * test::magnitude(gradient));
  }
}
