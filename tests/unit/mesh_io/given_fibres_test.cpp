// Directions of fibres and sheets that a mesh brings, from the file to the engines.
#include "lv/base/check.hpp"
#include "lv/implicit/reference_points.hpp"
#include "lv/mesh/fibres.hpp"
#include "lv/mesh/quadratic.hpp"
#include "lv/mesh/refine.hpp"
#include "lv/mesh_io/import.hpp"
#include "lv/solid/shape_table.hpp"
#include "lv/solid/wall.hpp"

#include "mesh_io/mesh_files.hpp"
#include "support/temporary_folder.hpp"
#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <cmath>

namespace {

using namespace lv;
using Catch::Matchers::Contains;
using mesh::CellKind;
using mesh::GivenFibres;
using mesh::ImportParameters;
using mesh::Mesh;
using mesh_io::ImportedMesh;
using test::kinds;
using test::replaced;
using test::VtkTags;
using At = GivenFibres::At;

/// A direction that turns with the place, of no particular length or sign.
Vec3 along(const Vec3& X) {
  const double sign = std::sin(3.0 * X.x() + 5.0 * X.y()) > 0.0 ? 2.5 : -0.3;
  return sign * Vec3(std::cos(0.02 * X.z()), std::sin(0.02 * X.z()), 0.3).normalized();
}
/// One that is nearly normal to it.
Vec3 across(const Vec3& X) {
  return Vec3::UnitZ().cross(along(X)) + 0.05 * along(X);
}

/// Of all nodes, or of all cells in the order of the file, surface cells with none.
std::vector<Vec3> at_nodes(const Mesh& mesh, Vec3 (*direction)(const Vec3&)) {
  std::vector<Vec3> directions;
  for (const Vec3& X : mesh.nodes)
    directions.push_back(direction(X));
  return directions;
}
std::vector<Vec3> in_cells(const Mesh& mesh, Vec3 (*direction)(const Vec3&), int surface_cells) {
  std::vector<Vec3> directions;
  for (int c = 0; c < mesh.cell_count(); ++c)
    directions.push_back(direction(mesh.nodes[mesh.cell(c)[0]]));
  directions.resize(directions.size() + surface_cells, Vec3::Zero());
  return directions;
}

ImportParameters with_fibres(ImportParameters parameters) {
  parameters.fibres = "f0";
  parameters.sheets = "s0";
  return parameters;
}

/// A .vtu file with fibres f0 and sheets s0.
std::string vtu_with_fibres(const Mesh& mesh, At at) {
  const std::string text = test::vtu_text(mesh, VtkTags::surface_cells);
  const int faces = mesh.endo.size() + mesh.epi.size() + mesh.base.size();
  return at == At::nodes
             ? replaced(text, "<PointData>\n",
                        "<PointData>\n" + test::vtu_array("f0", at_nodes(mesh, along)) +
                            test::vtu_array("s0", at_nodes(mesh, across)))
             : replaced(text, "<CellData>\n",
                        "<CellData>\n" + test::vtu_array("f0", in_cells(mesh, along, faces)) +
                            test::vtu_array("s0", in_cells(mesh, across, faces)));
}

std::string message(const std::string& text, const ImportParameters& parameters) {
  try {
    static_cast<void>(test::import_text(".vtu", text, parameters));
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

/// How far two lines are from each other, 0 if they are one [rad].
double angle(const Vec3& a, const Vec3& b) {
  return std::atan2(a.cross(b).norm(), std::abs(a.dot(b)));
}

/// A coarse ventricle whose fibres run as the paper's do, sign by sign at random.
Mesh with_rule_at_nodes(CellKind kind) {
  Mesh mesh = test::coarse_mesh(kind);
  mesh.fibres.given.at = At::nodes;
  const std::vector<Vec3> radial = mesh::radial_directions(mesh);
  for (std::size_t a = 0; a < mesh.nodes.size(); ++a) {
    const Mat3 frame = mesh::fibre_frame({}, mesh::wall_axes(radial[a]), mesh.transmural[a]);
    mesh.fibres.given.f0.emplace_back((a % 3 == 0 ? -1.0 : 1.0) * frame.col(0));
    mesh.fibres.given.s0.emplace_back((a % 5 == 0 ? -1.0 : 1.0) * frame.col(1));
  }
  return mesh;
}

std::vector<solid::PointSample> samples(const Mesh& mesh) {
  const solid::Wall wall(mesh, {});
  return wall.sample(mesh.nodes, std::vector<double>(mesh.nodes.size(), 0.0));
}

}  // namespace

TEST_CASE(
    "fibres and sheets of a file come in the model's frame, of unit length and at right angles",
    "[unit][mesh_io]") {
  const Mat3 turn = Eigen::AngleAxisd(2.2, Vec3(0.3, -0.8, 0.5).normalized()).toRotationMatrix();
  for (const CellKind kind : kinds)
    for (const At at : {At::cells, At::nodes}) {
      Mesh mesh = test::coarse_mesh(kind);
      for (Vec3& X : mesh.nodes)
        X = turn * X + Vec3(120.0, -35.0, 410.0);
      const ImportedMesh imported =
          test::import_text(".vtu", vtu_with_fibres(mesh, at), with_fibres(test::by_cells()));
      const GivenFibres& fibres = imported.mesh.fibres.given;
      REQUIRE(fibres.at == at);
      REQUIRE(fibres.f0.size() ==
              (at == At::nodes ? mesh.nodes.size() : static_cast<std::size_t>(mesh.cell_count())));
      REQUIRE(fibres.s0.size() == fibres.f0.size());
      for (std::size_t i = 0; i < fibres.f0.size(); ++i) {
        const Vec3& X = mesh.nodes[at == At::nodes ? i : mesh.cell(static_cast<int>(i))[0]];
        CHECK(fibres.f0[i].norm() == Approx(1.0));
        CHECK(fibres.s0[i].norm() == Approx(1.0));
        CHECK(std::abs(fibres.f0[i].dot(fibres.s0[i])) < 1e-12);
        CHECK(angle(imported.frame.axes * fibres.f0[i], along(X)) < 1e-9);
        CHECK(angle(imported.frame.axes * fibres.s0[i], Vec3::UnitZ().cross(along(X))) < 0.2);
      }
      REQUIRE(imported.notes.size() == 1);
      CHECK_THAT(imported.notes[0],
                 Contains("sheets were up to") && Contains("degrees off the normals"));
    }
}

TEST_CASE("fibres and sheets come from SimVascular's files of the same cells", "[unit][mesh_io]") {
  const Mesh mesh = test::coarse_mesh(CellKind::tetrahedron);
  const std::string plain = test::vtu_text(mesh, VtkTags::none);
  const auto file_of = [&](Vec3 (*direction)(const Vec3&)) {
    return replaced(plain, "<CellData>\n",
                    "<CellData>\n" + test::vtu_array("FIB_DIR", in_cells(mesh, direction, 0)));
  };
  const test::TemporaryFile fibres(".vtu", file_of(along));
  const test::TemporaryFile sheets(".vtu", file_of(across));
  ImportParameters parameters = test::by_geometry();
  parameters.fibres = fibres.path();
  parameters.sheets = sheets.path();
  const ImportedMesh imported = test::import_text(".vtu", plain, parameters);
  REQUIRE(imported.mesh.fibres.given.f0.size() == static_cast<std::size_t>(mesh.cell_count()));
  CHECK(angle(imported.frame.axes * imported.mesh.fibres.given.f0[7],
              along(mesh.nodes[mesh.cell(7)[0]])) < 1e-9);

  Mesh other = mesh;
  other.nodes[3].x() += 1.0;
  CHECK_THAT(message(test::vtu_text(other, VtkTags::none), parameters),
             Contains("is not of the mesh") && Contains("point 3 lies elsewhere"));
  other = mesh;
  other.cells.resize(other.cells.size() - 4);
  CHECK_THAT(message(test::vtu_text(other, VtkTags::none), parameters),
             Contains(fmt::format("it has {} cells and", mesh.cell_count())));
  other = mesh;
  std::swap_ranges(other.cells.begin(), other.cells.begin() + 4, other.cells.begin() + 8);
  CHECK_THAT(message(test::vtu_text(other, VtkTags::none), parameters),
             Contains("cell 0 has other points"));
}

TEST_CASE("directions that are none are refused with their place", "[unit][mesh_io]") {
  const Mesh mesh = test::coarse_mesh(CellKind::hexahedron);
  const auto with = [&](const std::vector<Vec3>& f0, const std::vector<Vec3>& s0) {
    return replaced(test::vtu_text(mesh, VtkTags::none), "<CellData>\n",
                    "<CellData>\n" + test::vtu_array("f0", f0) + test::vtu_array("s0", s0));
  };
  const std::vector<Vec3> f0 = in_cells(mesh, along, 0);
  const std::vector<Vec3> s0 = in_cells(mesh, across, 0);
  ImportParameters parameters = with_fibres(test::by_geometry());
  std::vector<Vec3> bad = f0;
  bad[5].setZero();
  bad[9].setZero();
  CHECK_THAT(
      message(with(bad, s0), parameters),
      Contains(fmt::format("2 of the {} directions of fibres are zero or no numbers, the first "
                           "at element 5 at (",
                           mesh.cell_count())));
  bad = s0;
  bad[7] = f0[7] * 3.0;
  CHECK_THAT(message(with(f0, bad), parameters),
             Contains("directions of sheets lie along the fibres, the first at element 7 at ("));
  bad = f0;
  bad.pop_back();
  CHECK_THAT(message(with(bad, s0), parameters), !Contains("no error"));
  parameters.fibres = "f1";
  CHECK_THAT(message(with(f0, s0), parameters),
             Contains("has no array of vectors \"f1\"; it has f0, s0. Did you mean \"f0\"?"));
  parameters.fibres = "infarct";
  CHECK_THAT(message(with(f0, s0), parameters),
             Contains("point array \"infarct\" has 1 component instead of 3"));
  parameters.fibres = "f0";
  CHECK_THAT(message(replaced(with(f0, s0), "<PointData>\n",
                              "<PointData>\n" + test::vtu_array("f0", at_nodes(mesh, along))),
                     parameters),
             Contains("has a cell array and a point array \"f0\""));
}

TEST_CASE("what may be fibres and is not named is noted", "[unit][mesh_io]") {
  const Mesh mesh = test::coarse_mesh(CellKind::hexahedron);
  ImportParameters parameters = test::by_geometry();
  const auto notes = [&](const std::string& name, double length) {
    std::vector<Vec3> directions = at_nodes(mesh, along);
    for (Vec3& direction : directions)
      direction = length * direction.normalized();
    return test::import_text(".vtu",
                             replaced(test::vtu_text(mesh, VtkTags::none), "<PointData>\n",
                                      "<PointData>\n" + test::vtu_array(name, directions)),
                             parameters)
        .notes;
  };
  REQUIRE(notes("muscle", 1.0).size() == 1);  // unit vectors
  CHECK_THAT(notes("muscle", 1.0)[0],
             Contains("may be fibres (muscle)") && Contains("anatomy.mesh.fibres"));
  CHECK(notes("Fibres", 2.0).size() == 1);
  CHECK(notes("displacement", 2.0).empty());
  CHECK(notes("Normals", 1.0).empty());
}

TEST_CASE("the given fibres hold at every point of an element, whatever their signs",
          "[unit][mesh_io]") {
  for (const CellKind kind : kinds) {
    const Mesh given = with_rule_at_nodes(kind);
    double mean = 0.0;
    const auto all = samples(given);
    for (const solid::PointSample& s : all) {
      CHECK((s.fibre_frame.transpose() * s.fibre_frame - Mat3::Identity()).norm() < 1e-12);
      const Mat3 rule = mesh::fibre_frame({}, s.axes, s.transmural);
      mean += angle(s.fibre_frame.col(0), rule.col(0)) / static_cast<double>(all.size());
    }
    // one element of 8 mm or two take the wall's 120 degrees; at the apex the rule turns within one
    CHECK(mean < 0.15);
    Mesh in_cells = given;
    in_cells.fibres.given = {
        At::cells, std::vector<Vec3>(given.cell_count(), Vec3(0.6, 0.0, 0.8)), {}};
    for (const solid::PointSample& s : samples(in_cells)) {
      CHECK(angle(s.fibre_frame.col(0), Vec3(0.6, 0.0, 0.8)) < 1e-9);
      CHECK((s.fibre_frame.transpose() * s.fibre_frame - Mat3::Identity()).norm() < 1e-12);
    }
  }
}

TEST_CASE("sheets that are not given follow the rule's angle across the given fibres",
          "[unit][mesh_io]") {
  Mesh mesh = test::coarse_mesh(CellKind::hexahedron);
  mesh.fibres.given = {At::cells, {}, {}};
  for (const solid::PointSample& s : samples(mesh))
    if (static_cast<int>(mesh.fibres.given.f0.size()) == s.cell)
      mesh.fibres.given.f0.emplace_back(s.fibre_frame.col(0));
  const Mesh ruled = test::coarse_mesh(CellKind::hexahedron);
  const auto given = samples(mesh);
  const auto by_rule = samples(ruled);
  for (std::size_t i = 0; i < given.size(); i += 8)  // the points from which f0 was taken
    CHECK((given[i].fibre_frame - by_rule[i].fibre_frame).norm() < 1e-9);
}

TEST_CASE("both engines take the fibres that a mesh brings", "[unit][mesh_io]") {
  for (const CellKind kind : kinds)
    for (const At at : {At::cells, At::nodes}) {
      Mesh mesh = test::coarse_mesh(kind);
      const std::size_t count = at == At::nodes ? mesh.nodes.size() : mesh.cell_count();
      mesh.fibres.given = {at, std::vector<Vec3>(count, Vec3(0.6, 0.0, 0.8)),
                           std::vector<Vec3>(count, Vec3(0.0, 1.0, 0.0))};
      const Mesh fine = mesh::refine(mesh);
      CHECK(angle(samples(fine).back().fibre_frame.col(0), Vec3(0.6, 0.0, 0.8)) < 1e-9);
      const auto elements = mesh::elements(fine);
      const implicit::PointMaker maker(fine);
      const int e = elements.size() / 2;
      const auto point =
          maker.points(solid::element_shapes(fine.kind, fine.order), 8 * e, elements.element(e))[0];
      Eigen::Matrix3Xd X(3, elements.nodes_per_element);
      for (int a = 0; a < elements.nodes_per_element; ++a)
        X.col(a) = fine.nodes[elements.element(e)[a]];
      const Mat3 frame = X * point.gradient.transpose();  // F at rest, in the fibre frame
      CHECK(angle(frame.col(0), Vec3(0.6, 0.0, 0.8)) < 1e-9);
      CHECK(angle(frame.col(1), Vec3(0.0, 1.0, 0.0)) < 1e-9);
    }
}

TEST_CASE("refining keeps directions: cells hand theirs on, those at nodes are interpolated",
          "[unit][mesh_io]") {
  for (const CellKind kind : kinds) {
    const Mesh at_nodes = with_rule_at_nodes(kind);
    const Mesh fine = mesh::refine(at_nodes);
    REQUIRE(fine.fibres.given.f0.size() == fine.nodes.size());
    REQUIRE(fine.fibres.given.s0.size() == fine.nodes.size());
    CHECK((fine.fibres.given.f0[5] == at_nodes.fibres.given.f0[5]));
    Mesh in_cells = test::coarse_mesh(kind);
    for (int c = 0; c < in_cells.cell_count(); ++c)
      in_cells.fibres.given.f0.push_back(along(in_cells.nodes[in_cells.cell(c)[0]]).normalized());
    const Mesh finer = mesh::refine(in_cells);
    REQUIRE(finer.fibres.given.f0.size() == static_cast<std::size_t>(finer.cell_count()));
    CHECK((finer.fibres.given.f0[8 * 6 + 3] == in_cells.fibres.given.f0[6]));
    CHECK(finer.fibres.given.s0.empty());
  }
}

TEST_CASE("directions turn with a wall that moves", "[unit][mesh_io]") {
  const Mat3 turn = Eigen::AngleAxisd(0.4, Vec3::UnitZ()).toRotationMatrix();
  Mat3 F = turn;
  F.col(2) *= 1.5;  // longer along z before it is turned about z
  for (const CellKind kind : kinds) {
    Mesh mesh = with_rule_at_nodes(kind);
    std::vector<Vec3> nodes;
    for (const Vec3& X : mesh.nodes)
      nodes.emplace_back(F * X);
    const Mesh moved = mesh::with_nodes(mesh, nodes);
    CHECK((moved.nodes == nodes));
    for (std::size_t a = 0; a < mesh.nodes.size(); ++a)
      CHECK(angle(moved.fibres.given.f0[a], F * mesh.fibres.given.f0[a]) < 1e-9);
    mesh.fibres.given = {At::cells, std::vector<Vec3>(mesh.cell_count(), Vec3(0.6, 0.0, 0.8)), {}};
    CHECK(angle(mesh::with_nodes(mesh, nodes).fibres.given.f0[3], F * Vec3(0.6, 0.0, 0.8)) < 1e-9);
  }
}
