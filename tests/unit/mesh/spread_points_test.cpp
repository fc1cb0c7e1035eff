#include "lv/mesh/spread_points.hpp"

#include "lv/mesh/cell.hpp"

#include "support/block_mesh.hpp"
#include "support/cell_kinds.hpp"
#include <catch2/catch.hpp>

using namespace lv;

TEST_CASE("spread points share a cell's volume and have its middle as theirs", "[unit][mesh]") {
  for (const mesh::CellKind kind : test::kinds) {
    const mesh::Mesh mesh = test::block_mesh(kind);
    const auto nodes = mesh.cell(3);
    const auto points = mesh::spread_points(mesh, 3);
    REQUIRE(points.size() == (kind == mesh::CellKind::hexahedron ? 64 : 20));
    double volume = 0.0;
    std::array<double, 8> sum{};
    for (const mesh::CellPoint& point : points) {
      volume += point.volume;
      for (std::size_t a = 0; a < nodes.size(); ++a)
        sum[a] += point.shape[a];
    }
    // the midpoint rule misses what is quadratic in det dX/dxi of a distorted hexahedron
    const double within = kind == mesh::CellKind::hexahedron ? 2e-3 : 1e-13;
    CHECK(volume == Approx(mesh::cell_volume(mesh, 3)).epsilon(within));
    for (std::size_t a = 0; a < nodes.size(); ++a)
      CHECK(sum[a] * static_cast<double>(nodes.size()) ==
            Approx(static_cast<double>(points.size())).epsilon(1e-13));
  }
}
