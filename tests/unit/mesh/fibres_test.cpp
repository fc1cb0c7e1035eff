#include "lv/mesh/fibres.hpp"

#include "lv/base/units.hpp"
#include "lv/geometry/ellipsoid.hpp"
#include "lv/mesh/cell.hpp"
#include "lv/mesh/split.hpp"
#include "lv/mesh/transmural.hpp"
#include "lv/mesh_io/import.hpp"

#include "mesh_io/mesh_files.hpp"
#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include <cmath>

namespace {

using namespace lv;
using mesh::Mesh;
using units::degree;

/// Exact depth and axes at a place in the wall of an ellipsoid.
struct ExactWall {
  double t;
  mesh::WallAxes axes;
};

ExactWall exact_wall(const geometry::Ellipsoid& e, const Vec3& X) {
  const double z = X.z() + e.base_height;
  const double r2 = X.x() * X.x() + X.y() * X.y();
  double below = -0.5;
  double above = 1.5;
  double R2 = 0.0;
  double L2 = 0.0;
  for (int i = 0; i < 60; ++i) {  // bisection for the ellipsoid of depth t through X
    const double t = 0.5 * (below + above);
    R2 = std::pow((1 - t) * e.endo_radius + t * e.epi_radius, 2);
    L2 = std::pow((1 - t) * e.endo_length + t * e.epi_length, 2);
    (r2 / R2 + z * z / L2 > 1.0 ? below : above) = t;
  }
  return {below, mesh::wall_axes({X.x() / R2, X.y() / R2, z / L2})};
}

/// The largest error of the helix angle [degrees] that edges of h explain.
///
/// The angle turns by 120 degrees through 11.5 mm: the sagitta h^2/8R of an edge is worth 0.08 h^2
/// degrees where the wall's radius is that of its section, and a few times that in the worst cell.
/// Besides, the mean gradient in a cell may point where the normal points half an edge away, which
/// is off by e = h/2R. A normal that is off by e turns the circumferential direction about it by
/// up to e cot(phi), phi its angle with the long axis: nothing at the equator, everything at the
/// apex, where R is the smallest too, a^2/c of the ellipsoid through the place.
double error_bound(const geometry::Ellipsoid& ellipsoid, const ExactWall& wall, double h) {
  const double a = (1.0 - wall.t) * ellipsoid.endo_radius + wall.t * ellipsoid.epi_radius;
  const double c = (1.0 - wall.t) * ellipsoid.endo_length + wall.t * ellipsoid.epi_length;
  const double phi = std::acos(std::abs(wall.axes.radial.z()));
  return 0.3 * h * h + h / (2.0 * a * a / c) / std::tan(phi) / degree;
}

/// The helix angle's errors at the cells' centres, except within 5 mm of the long axis, where no
/// angle is defined: their mean [degrees], and the largest in parts of its bound.
struct HelixErrors {
  double mean = 0.0, largest_part = 0.0;
};

template <class Radial>
HelixErrors helix_errors(const Mesh& mesh, double edge, const Radial& radial_of_cell) {
  const geometry::Ellipsoid ellipsoid;
  const mesh::FibreRule rule;
  HelixErrors errors;
  int count = 0;
  for (int c = 0; c < mesh.cell_count(); ++c) {
    const Vec3 X = mesh::cell_centre(mesh, c);
    if (std::hypot(X.x(), X.y()) < 5.0)
      continue;
    double t = 0.0;
    for (const int node : mesh.cell(c))
      t += mesh.transmural[node] / mesh::nodes_per_cell(mesh.kind);
    const Mat3 frame = mesh::fibre_frame(rule, mesh::wall_axes(radial_of_cell(c)), t);
    const ExactWall exact = exact_wall(ellipsoid, X);
    const double expected = (1.0 - exact.t) * rule.helix_endo + exact.t * rule.helix_epi;
    const double error = std::abs(mesh::helix_angle(frame.col(0), exact.axes) - expected) / degree;
    errors.mean += error;
    errors.largest_part =
        std::max(errors.largest_part, error / error_bound(ellipsoid, exact, edge));
    ++count;
  }
  errors.mean /= count;
  return errors;
}

/// A tetrahedral mesh that went through a file and so has t by distance.
Mesh imported_tetrahedra(double edge_length) {
  const Mesh mesh = mesh::split_into_tetrahedra(test::ellipsoid_mesh({}, edge_length));
  const test::TemporaryFile file(".msh", test::gmsh41(mesh));
  mesh::ImportParameters parameters;
  parameters.file = file.path();
  return mesh_io::import_mesh(parameters).mesh;
}

}  // namespace

TEST_CASE("fibres on an imported tetrahedral mesh have the rule's helix angles", "[unit][mesh]") {
  HelixErrors before;
  for (const double edge : {6.0, 4.0, 3.0}) {
    const Mesh mesh = imported_tetrahedra(edge);
    const HelixErrors errors = helix_errors(
        mesh, edge, [&](int c) { return mesh::mean_gradient(mesh, c, mesh.transmural); });
    INFO("edges of " << edge << " mm: mean " << errors.mean << ", largest " << errors.largest_part
                     << " of its bound");
    CHECK(errors.mean < 0.08 * edge * edge);
    CHECK(errors.largest_part < 1.0);
    if (before.mean > 0.0)
      CHECK(errors.mean < 0.75 * before.mean);
    before = errors;
  }
}

TEST_CASE("radial directions at nodes give the same fibres as the gradient in cells",
          "[unit][mesh]") {
  const double edge = 4.0;
  const Mesh tetrahedra = imported_tetrahedra(edge);
  Mesh hexahedra = test::ellipsoid_mesh({}, edge);
  hexahedra.transmural = mesh::transmural_by_distance(hexahedra);
  for (const Mesh& mesh : {tetrahedra, hexahedra}) {
    const auto radial = mesh::radial_directions(mesh);
    const HelixErrors errors = helix_errors(mesh, edge, [&](int c) {
      Vec3 mean = Vec3::Zero();
      for (const int node : mesh.cell(c))
        mean += radial[node];
      return mean;
    });
    CHECK(errors.mean < 0.08 * edge * edge);
    CHECK(errors.largest_part < 1.0);
  }
}

TEST_CASE("wall axes are orthonormal and right-handed in the stated order", "[unit][mesh]") {
  for (const Vec3& gradient : {Vec3(1, 0, 0), Vec3(0.3, -0.2, -0.5), Vec3(0, 0, -2)}) {
    const mesh::WallAxes axes = mesh::wall_axes(gradient);
    Mat3 all;
    all << axes.radial, axes.circumferential, axes.longitudinal;
    CHECK((all.transpose() * all - Mat3::Identity()).norm() < 1e-12);
    CHECK(all.determinant() == Approx(1.0));
  }
  // at x > 0 anticlockwise seen from the base is +y
  CHECK(mesh::wall_axes({1, 0, 0}).circumferential.isApprox(Vec3::UnitY()));
  CHECK(mesh::wall_axes({1, 0, 0}).longitudinal.isApprox(Vec3::UnitZ()));
}

TEST_CASE("endocardial fibres form a right-handed helix and epicardial ones a left-handed one",
          "[unit][mesh]") {
  const mesh::WallAxes axes = mesh::wall_axes({1, 0, 0});
  const mesh::FibreRule rule;
  for (const double t : {0.0, 0.25, 0.5, 1.0}) {
    const Mat3 frame = mesh::fibre_frame(rule, axes, t);
    CHECK((frame.transpose() * frame - Mat3::Identity()).norm() < 1e-12);
    CHECK(mesh::helix_angle(frame.col(0), axes) / degree == Approx(-60.0 + 120.0 * t).margin(1e-9));
    // a right-handed helix rises towards +z while it turns anticlockwise about +z
    const Vec3 f0 = frame.col(0);
    if (t < 0.5)
      CHECK(f0.y() * f0.z() > 0.0);
    if (t > 0.5)
      CHECK(f0.y() * f0.z() < 0.0);
  }
}

TEST_CASE("the mean gradient of a linear field is exact", "[unit][mesh]") {
  const Vec3 slope(0.3, -0.7, 1.1);
  for (const auto kind : {mesh::CellKind::hexahedron, mesh::CellKind::tetrahedron}) {
    const Mesh mesh = test::coarse_mesh(kind);
    std::vector<double> field;
    for (const Vec3& X : mesh.nodes)
      field.push_back(slope.dot(X) + 5.0);
    for (int c = 0; c < mesh.cell_count(); c += 7)
      CHECK((mesh::mean_gradient(mesh, c, field) - slope).norm() < 1e-10);
  }
}
