// Elements that are missing from a wall: in a side, through the wall, inside of it.
#include "lv/mesh_io/notches.hpp"

#include "lv/base/check.hpp"
#include "lv/mesh/cell.hpp"
#include "lv/mesh/refine.hpp"
#include "lv/mesh/split.hpp"
#include "lv/mesh/surface.hpp"
#include "lv/mesh_io/import.hpp"

#include "mesh_io/mesh_files.hpp"
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <set>

namespace {

using namespace lv;
using Catch::Matchers::Contains;
using mesh::Mesh;
using mesh::Surface;
using mesh_io::Bulge;
using mesh_io::notches;
using test::AbaqusTags;

Vec3 centre(const Mesh& mesh, int cell) {
  Vec3 sum = Vec3::Zero();
  for (const int node : mesh.cell(cell))
    sum += mesh.nodes[node] / static_cast<double>(mesh.cell(cell).size());
  return sum;
}

Mesh without(Mesh mesh, int cell) {
  const auto size = static_cast<std::ptrdiff_t>(mesh.cell(cell).size());
  const auto first = mesh.cells.begin() + cell * size;
  mesh.cells.erase(first, first + size);
  return mesh;
}

/// A side with the faces that a missing cell leaves.
Surface side_without(const Mesh& mesh, const Surface& side, int cell) {
  std::set<mesh::FaceKey> elsewhere;
  for (const Surface* other : {&mesh.endo, &mesh.epi, &mesh.base})
    if (other != &side)
      for (const mesh::FaceKey& key : test::sorted_keys(*other))
        elsewhere.insert(key);
  const Surface all = mesh::boundary(without(mesh, cell));
  std::vector<int> is_here;
  for (int f = 0; f < all.size(); ++f)
    is_here.push_back(elsewhere.count(mesh::face_key(all.face(f))) == 0 ? 1 : 0);
  return mesh::take_part(all, is_here, 1);
}

/// The cells that have a face of the side and no node of the base.
std::vector<int> cells_at(const Mesh& mesh, const Surface& side) {
  std::set<mesh::FaceKey> keys;
  for (const mesh::FaceKey& key : test::sorted_keys(side))
    keys.insert(key);
  const std::set<int> in_base(mesh.base.nodes.begin(), mesh.base.nodes.end());
  std::vector<int> cells;
  for (int c = 0; c < mesh.cell_count(); ++c) {
    const auto nodes = mesh.cell(c);
    const bool is_at_base =
        std::any_of(nodes.begin(), nodes.end(), [&](int n) { return in_base.count(n) != 0; });
    bool is_at_side = false;
    for (const auto& face : mesh::cell_faces(mesh.kind)) {
      std::vector<int> of_face;
      for (const int a : face)
        if (a >= 0)
          of_face.push_back(nodes[a]);
      is_at_side = is_at_side || keys.count(mesh::face_key(of_face)) != 0;
    }
    if (is_at_side && !is_at_base)
      cells.push_back(c);
  }
  return cells;
}

std::string refusal(const Mesh& mesh) {
  try {
    static_cast<void>(
        test::import_text(".inp", test::abaqus_text(mesh, AbaqusTags::none), test::by_geometry()));
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

/// The place that a text names after "near".
Vec3 place_in(const std::string& text) {
  const auto at = text.find("near (");
  REQUIRE(at != std::string::npos);
  Vec3 place;
  REQUIRE(std::sscanf(text.c_str() + at, "near (%lf, %lf, %lf)", &place[0], &place[1], &place[2]) ==
          3);
  return place;
}

}  // namespace

TEST_CASE("no wall that this program makes has a notch", "[unit][mesh_io]") {
  for (const double edge : {3.0, 6.0, 10.0, 16.0})
    for (const int layers : {0, 1}) {
      const Mesh hexahedra = test::ellipsoid_mesh({}, edge, layers);
      std::vector<Mesh> walls{hexahedra, mesh::split_into_tetrahedra(hexahedra)};
      if (edge > 9.0)
        walls.push_back(mesh::refine(hexahedra));
      for (const Mesh& wall : walls) {
        INFO(edge << " mm, " << wall.cell_count() << " cells");
        CHECK(notches(wall.nodes, wall.endo, Bulge::inwards).empty());
        CHECK(notches(wall.nodes, wall.epi, Bulge::outwards).empty());
      }
    }
}

TEST_CASE("a missing element is found wherever it is, with its place", "[unit][mesh_io]") {
  for (const mesh::CellKind kind : {mesh::CellKind::hexahedron, mesh::CellKind::tetrahedron}) {
    const Mesh wall = test::coarse_mesh(kind);
    for (const Surface* side : {&wall.endo, &wall.epi}) {
      const std::vector<int> cells = cells_at(wall, *side);
      for (std::size_t i = 0; i < cells.size(); i += 5) {
        const auto found = notches(wall.nodes, side_without(wall, *side, cells[i]),
                                   side == &wall.endo ? Bulge::inwards : Bulge::outwards);
        REQUIRE(found.size() == 1);
        CHECK((found.front() - centre(wall, cells[i])).norm() < 6.0);
      }
    }
  }
}

TEST_CASE("an imported wall without one of its outer elements is warned of", "[unit][mesh_io]") {
  const Mesh wall = test::coarse_mesh(mesh::CellKind::hexahedron);
  const auto import = [](const Mesh& mesh) {
    return test::import_text(".inp", test::abaqus_text(mesh, AbaqusTags::none),
                             test::by_geometry());
  };
  CHECK(import(wall).warnings.empty());
  for (const auto& [side, name] :
       {std::pair{&wall.endo, "endocardium"}, std::pair{&wall.epi, "epicardium"}}) {
    const int cell = cells_at(wall, *side)[20];
    const std::vector<std::string> warnings = import(without(wall, cell)).warnings;
    REQUIRE(warnings.size() == 1);
    CHECK_THAT(warnings.front(), Contains(name) && Contains("a notch near ("));
    CHECK((place_in(warnings.front()) - centre(wall, cell)).norm() < 6.0);
  }
}

TEST_CASE("a hole through the wall is told with its place", "[unit][mesh_io]") {
  const Mesh wall = test::ellipsoid_mesh({}, 8.0, 1);
  const std::vector<int> cells = cells_at(wall, wall.epi);
  for (const std::size_t i : {std::size_t{3}, cells.size() / 2, cells.size() - 5}) {
    const std::string text = refusal(without(wall, cells[i]));
    CHECK_THAT(text, Contains("the wall has a hole near (") &&
                         Contains("anatomy.mesh.sides = \"tags\"") && !Contains("tolerance"));
    CHECK((place_in(text) - centre(wall, cells[i])).norm() < 16.0);  // two elements
  }
  Mesh twice = without(wall, cells.back());
  twice = without(twice, cells.front());
  CHECK_THAT(refusal(twice), Contains("the wall has 2 holes, one near ("));
}

TEST_CASE("a void in the wall is told with its place", "[unit][mesh_io]") {
  const Mesh wall = test::ellipsoid_mesh({}, 8.0, 3);
  std::set<int> outside;
  for (const Surface* side : {&wall.endo, &wall.epi, &wall.base})
    outside.insert(side->nodes.begin(), side->nodes.end());
  int inner = 0;
  while (std::any_of(wall.cell(inner).begin(), wall.cell(inner).end(),
                     [&](int node) { return outside.count(node) != 0; }))
    ++inner;
  const std::string text = refusal(without(wall, inner));
  CHECK_THAT(text, Contains("the wall has a void near ("));
  CHECK((place_in(text) - centre(wall, inner)).norm() < 8.0);
}
