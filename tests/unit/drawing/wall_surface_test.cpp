#include "lv/drawing/wall_surface.hpp"

#include "lv/geometry/ellipsoid.hpp"
#include "lv/mesh/wall_mesh.hpp"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

namespace {

using namespace lv::drawing;
using lv::Vec3;
namespace mesh = lv::mesh;
constexpr double pi = std::numbers::pi;

double area(const Patch& patch) {
  double sum = 0.0;
  for (const auto& t : patch.triangles) {
    const Vec3& a = patch.points[t[0]];
    sum += 0.5 * (patch.points[t[1]] - a).cross(patch.points[t[2]] - a).norm();
  }
  return sum;
}

mesh::Mesh ellipsoid_mesh(const lv::geometry::Ellipsoid& e, double edge) {
  const auto wall = [&](double u, double theta, double t) { return e.point(u, theta, t); };
  return mesh::wall_mesh(wall, {.edge_length = edge});
}

/// The part below the base of the section through the long axis, inside a truncated ellipse.
double long_axis_area(double radius, double length, double base_height) {
  const double c = base_height / length;
  return radius * length * (0.5 * pi + std::asin(c) + c * std::sqrt(1.0 - c * c));
}

/// Two unit cubes on top of each other.
mesh::Mesh two_cubes() {
  mesh::Mesh m;
  for (int z = 0; z < 3; ++z)
    for (const auto& [x, y] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}})
      m.nodes.emplace_back(x, y, z);
  for (int c = 0; c < 2; ++c)
    for (int i = 0; i < 8; ++i)
      m.cells.push_back(4 * c + i);
  return m;
}

/// The lower cube as six tetrahedra around its diagonal.
mesh::Mesh cube_of_tetrahedra() {
  mesh::Mesh m = two_cubes();
  m.kind = mesh::CellKind::tetrahedron;
  m.cells = {0, 1, 2, 6, 0, 2, 3, 6, 0, 3, 7, 6, 0, 7, 4, 6, 0, 4, 5, 6, 0, 5, 1, 6};
  return m;
}

}  // namespace

TEST_CASE("a long-axis section has the analytic area, to second order in the edge",
          "[unit][drawing]") {
  const lv::geometry::Ellipsoid e;
  const double exact = long_axis_area(e.epi_radius, e.epi_length, e.base_height) -
                       long_axis_area(e.endo_radius, e.endo_length, e.base_height);
  const auto error = [&](double edge) {
    const auto m = ellipsoid_mesh(e, edge);
    return std::abs(area(wall_section(m, m.nodes, {.normal = Vec3::UnitY()}).patch) - exact) /
           exact;
  };
  CHECK(error(6.0) < 0.01);
  CHECK(error(3.0) < 0.4 * error(6.0));  // a quarter, but for the rounding of element counts
}

TEST_CASE("a short-axis section is a ring", "[unit][drawing]") {
  const lv::geometry::Ellipsoid e;
  const auto m = ellipsoid_mesh(e, 3.0);
  const Plane widest{{0.0, 0.0, -e.base_height}, Vec3::UnitZ()};
  const double exact = pi * (e.epi_radius * e.epi_radius - e.endo_radius * e.endo_radius);
  CHECK(area(wall_section(m, m.nodes, widest).patch) == Approx(exact).epsilon(0.005));
}

TEST_CASE("a cube cut across its diagonal shows a regular hexagon, in any kind of cell",
          "[unit][drawing]") {
  const Plane plane{Vec3::Constant(0.5), Vec3::Ones()};
  const double exact = 0.75 * std::sqrt(3.0);
  auto m = two_cubes();
  m.cells.resize(8);
  const auto hexagon = wall_section(m, m.nodes, plane);
  CHECK(hexagon.patch.points.size() == 6);
  CHECK(area(hexagon.patch) == Approx(exact));
  const auto tetrahedra = cube_of_tetrahedra();
  CHECK(area(wall_section(tetrahedra, tetrahedra.nodes, plane).patch) == Approx(exact));
}

TEST_CASE("a section through the nodes between two cells shows them once", "[unit][drawing]") {
  const auto m = two_cubes();
  const auto section = wall_section(m, m.nodes, {Vec3::UnitZ(), Vec3::UnitZ()});
  CHECK(area(section.patch) == Approx(1.0));
}

TEST_CASE("linear nodal fields are exact on a section, and cells keep their values",
          "[unit][drawing]") {
  const auto m = two_cubes();
  const auto section = wall_section(m, m.nodes, {Vec3::Constant(0.7), Vec3(1.0, 0.2, 1.0)});
  std::vector<double> nodal;
  for (const Vec3& x : m.nodes)
    nodal.push_back(3.0 + x.x() - 2.0 * x.z());
  const auto values = section.at_points(nodal);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const Vec3& x = section.patch.points[i];
    CHECK(values[i] == Approx(3.0 + x.x() - 2.0 * x.z()));
  }
  for (std::size_t t = 0; t < section.cells.size(); ++t) {
    const auto& corners = section.patch.triangles[t];
    const double z = section.patch.points[corners[0]].z() + section.patch.points[corners[1]].z() +
                     section.patch.points[corners[2]].z();
    CHECK(section.cells[t] == (z < 3.0 ? 0 : 1));
  }
}

TEST_CASE("the sides of the wall have their areas, normals and cells", "[unit][drawing]") {
  const lv::geometry::Ellipsoid e;
  const auto m = ellipsoid_mesh(e, 3.0);
  const auto base = wall_surface(m, m.nodes, m.base);
  const double c = e.base_height;
  const auto disc = [&](double radius, double length) {
    return pi * radius * radius * (1.0 - c * c / (length * length));
  };
  CHECK(
      area(base.patch) ==
      Approx(disc(e.epi_radius, e.epi_length) - disc(e.endo_radius, e.endo_length)).epsilon(0.01));
  const auto epi = wall_surface(m, m.nodes, m.epi);
  for (std::size_t t = 0; t < epi.cells.size(); ++t) {
    const auto cell = m.cell(epi.cells[t]);
    for (const int p : epi.patch.triangles[t])
      CHECK(std::count(cell.begin(), cell.end(), epi.origins[p].a) == 1);
  }
}
