#include "lv/analysis/wall_fields.hpp"

#include "lv/mesh/cell.hpp"
#include "lv/mesh/quadratic.hpp"

#include "support/block_mesh.hpp"
#include "support/cell_kinds.hpp"
#include "support/random_values.hpp"
#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include <cmath>

namespace {

using namespace lv;
using analysis::CellFields;
using analysis::CellStrain;
using mesh::CellKind;
using mesh::Mesh;
using test::kinds;

const mesh::FibreRule parallel_fibres{0.4, 0.4, 0.3, 0.3};

/// In the block t grows along x: x is radial, z longitudinal, y circumferential.
const Vec3 radial = Vec3::UnitX();
const Vec3 circumferential = Vec3::UnitY();
const Vec3 longitudinal = Vec3::UnitZ();
const Vec3 fibre = std::cos(0.4) * circumferential - std::sin(0.4) * longitudinal;

heartbeat::Snapshot snapshot(const Mesh& mesh, std::vector<Vec3> positions) {
  heartbeat::Snapshot s;
  s.positions = std::move(positions);
  s.tension.assign(mesh.nodes.size(), 40.0);
  return s;
}

std::vector<double> pressures(const Mesh& mesh) {
  std::vector<double> p(mesh.cell_count());
  for (int c = 0; c < mesh.cell_count(); ++c)
    p[c] = 0.1 * c;
  return p;
}

/// Fields of a block deformed by X -> F X + (1, 2, 3).
std::vector<CellFields> uniform(CellKind kind, const Mat3& F) {
  Mesh mesh = test::block_mesh(kind, 2);
  mesh.fibres.rule = parallel_fibres;
  const solid::Wall wall(mesh, {});
  return analysis::cell_fields(wall, snapshot(mesh, test::moved(mesh.nodes, F, {1, 2, 3})),
                               mesh::cell_volumes(mesh), pressures(mesh));
}

Mat3 sheared() {
  Mat3 F;
  F << 1.10, 0.05, -0.02, 0.13, 0.98, 0.04, -0.01, 0.16, 1.01;
  return F;
}

void check_strain(const CellStrain& s, const Mat3& E, const Vec3& f) {
  CHECK(s.fibre == Approx(f.dot(E * f)).margin(1e-13));
  CHECK(s.radial == Approx(E(0, 0)).margin(1e-13));
  CHECK(s.circumferential == Approx(E(1, 1)).margin(1e-13));
  CHECK(s.longitudinal == Approx(E(2, 2)).margin(1e-13));
  CHECK(s.circumferential_radial == Approx(E(0, 1)).margin(1e-13));
  CHECK(s.radial_longitudinal == Approx(E(0, 2)).margin(1e-13));
  CHECK(s.circumferential_longitudinal == Approx(E(1, 2)).margin(1e-13));
}

Mat3 green_lagrange(const Mat3& F) {
  return 0.5 * (F.transpose() * F - Mat3::Identity());
}

}  // namespace

TEST_CASE("cells of a uniform deformation have its gradient, stretch and place",
          "[unit][analysis]") {
  const Mat3 F = sheared();
  for (const CellKind kind : kinds) {
    const auto cells = uniform(kind, F);
    const Mesh mesh = test::block_mesh(kind, 2);
    REQUIRE(static_cast<int>(cells.size()) == mesh.cell_count());
    for (int c = 0; c < mesh.cell_count(); ++c) {
      const CellFields& cell = cells[c];
      CHECK((cell.F - F).norm() < 1e-13);
      CHECK(cell.J == Approx(determinant(F)).epsilon(1e-13));
      CHECK(cell.fibre_stretch == Approx((F * fibre).norm()).epsilon(1e-13));
      CHECK(cell.volume == Approx(mesh::cell_volume(mesh, c)).epsilon(1e-13));
      CHECK((cell.position - (F * cell.reference + Vec3(1, 2, 3))).norm() < 1e-12);
      CHECK(cell.transmural == Approx((cell.reference.x() - 15.0) / 4.0).margin(1e-13));
      CHECK((cell.fibre_frame.col(0) - fibre).norm() < 1e-13);
      CHECK((cell.axes.circumferential - circumferential).norm() < 1e-13);
      CHECK(cell.tension == Approx(40.0).epsilon(1e-13));
      CHECK(cell.pressure == 0.1 * c);
    }
  }
}

TEST_CASE("a cell's J is its deformed over its undeformed volume, whatever the deformation",
          "[unit][analysis]") {
  for (const CellKind kind : kinds) {
    Mesh mesh = test::block_mesh(kind, 2);
    const solid::Wall wall(mesh, {});
    const auto positions =
        test::displaced(mesh.nodes, test::RandomValues(1).vectors(mesh.nodes.size(), 0.3), 1.0);
    const std::vector<double> undeformed = mesh::cell_volumes(mesh);
    const auto cells =
        analysis::cell_fields(wall, snapshot(mesh, positions), undeformed, pressures(mesh));
    mesh.nodes = positions;
    for (int c = 0; c < mesh.cell_count(); ++c)
      CHECK(cells[c].J == Approx(mesh::cell_volume(mesh, c) / undeformed[c]).epsilon(1e-12));
  }
}

TEST_CASE("strains from the undeformed wall are Green-Lagrange in the wall's directions",
          "[unit][analysis]") {
  for (const CellKind kind : kinds)
    for (const CellFields& cell : uniform(kind, sheared()))
      check_strain(analysis::strain(cell), green_lagrange(sheared()), fibre);
}

TEST_CASE("strains from an earlier state are those of what happened since", "[unit][analysis]") {
  const Mat3 filled = Vec3(0.8, 1.2, 1.1).asDiagonal();  // leaves the wall's directions in place
  const auto then = uniform(CellKind::hexahedron, filled);
  const auto now = uniform(CellKind::hexahedron, sheared() * filled);
  for (std::size_t c = 0; c < now.size(); ++c)
    check_strain(analysis::strain(now[c], then[c]), green_lagrange(sheared()),
                 (filled * fibre).normalized());
}

TEST_CASE("the directions of an earlier state turn with the wall", "[unit][analysis]") {
  const Mat3 turn = Eigen::AngleAxisd(0.7, Vec3::UnitZ()).toRotationMatrix();
  const Mat3 since = Vec3(1.3, 0.9, 0.85).asDiagonal();
  const auto then = uniform(CellKind::tetrahedron, turn);
  const auto now = uniform(CellKind::tetrahedron, turn * since);
  for (std::size_t c = 0; c < now.size(); ++c) {
    const CellStrain s = analysis::strain(now[c], then[c]);
    CHECK(s.radial == Approx(0.5 * (1.3 * 1.3 - 1.0)));
    CHECK(s.circumferential == Approx(0.5 * (0.9 * 0.9 - 1.0)));
    CHECK(s.longitudinal == Approx(0.5 * (0.85 * 0.85 - 1.0)));
    CHECK(s.thickening == Approx(0.3));
    CHECK(std::abs(s.circumferential_radial) < 1e-13);
  }
}

TEST_CASE("turning a wall does not strain it", "[unit][analysis]") {
  const auto then = uniform(CellKind::hexahedron, sheared());
  const auto now = uniform(CellKind::hexahedron, test::RandomValues(2).rotation() * sheared());
  for (std::size_t c = 0; c < now.size(); ++c)
    check_strain(analysis::strain(now[c], then[c]), Mat3::Zero(), fibre);
}

TEST_CASE("layers that slide over one another do not thicken", "[unit][analysis]") {
  Mat3 slide = Mat3::Identity();
  slide(2, 0) = 0.4;
  for (const CellFields& cell : uniform(CellKind::hexahedron, slide)) {
    const CellStrain s = analysis::strain(cell);
    CHECK(std::abs(s.thickening) < 1e-13);
    CHECK(s.radial == Approx(0.08));  // the line across the wall is longer all the same
    CHECK(s.radial_longitudinal == Approx(0.2));
  }
}

TEST_CASE("stresses are those of the laws, and along the fibre T lambda^2", "[unit][analysis]") {
  const Mat3 F = sheared();
  const double J = determinant(F);
  for (const CellFields& cell : uniform(CellKind::hexahedron, F)) {
    const Mat3 frame = cell.fibre_frame;
    const Mat3 P = material::HolzapfelOgden{}.stress(Mat3(F * frame)) * frame.transpose();
    CHECK((cell.cauchy_passive - P * F.transpose() / J).norm() < 1e-11);
    CHECK(cell.fibre_stress_active ==
          Approx(40.0 * std::pow(cell.fibre_stretch, 2)).epsilon(1e-12));
    const Mat3 pressure = cell.cauchy_passive + cell.cauchy_active - cell.cauchy_total();
    CHECK((pressure - cell.pressure * Mat3::Identity()).norm() < 1e-12);
  }
}

TEST_CASE("every part of an element has its work density", "[unit][analysis]") {
  std::vector<CellFields> cells(16);
  analysis::set_work_density({}, cells);
  CHECK(std::isnan(cells.front().work_density));
  const std::vector<double> of_elements{3.0, 5.0};
  analysis::set_work_density(of_elements, cells);
  CHECK(cells[7].work_density == 3.0);
  CHECK(cells[8].work_density == 5.0);
}
