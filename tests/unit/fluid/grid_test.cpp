#include "lv/fluid/grid.hpp"

#include "lv/base/check.hpp"

#include <catch2/catch.hpp>

using namespace lv;
using fluid::Grid;

TEST_CASE("velocity points lie on the faces normal to their component", "[unit][fluid]") {
  const Grid grid{{4, 6, 8}, {-1, -2, -3}, {0.5, 1.0, 2.0}};
  CHECK(grid.face(0, 0, 0, 0).isApprox(Vec3(-1.0, -1.5, -2.0)));
  CHECK(grid.face(1, 0, 0, 0).isApprox(Vec3(-0.75, -2.0, -2.0)));
  CHECK(grid.face(2, 3, 5, 8).isApprox(Vec3(0.75, 3.5, 13.0)));
  CHECK(grid.upper().isApprox(Vec3(1.0, 4.0, 13.0)));
  CHECK(grid.cell_volume() == 1.0);
  CHECK(grid.points(0, 0) == 5);
  CHECK(grid.points(0, 1) == 6);
  CHECK(grid.points(2, 2) == 9);
}

TEST_CASE("slabs share all planes of cells, the last one has the upper faces", "[unit][fluid]") {
  const Grid grid{{8, 4, 13}};
  for (const int ranks : {1, 2, 3, 6}) {
    int next = 0;
    int faces = 0;
    for (int rank = 0; rank < ranks; ++rank) {
      const fluid::Slab slab = fluid::slab_of(grid, rank, ranks);
      CHECK(slab.planes.begin == next);
      CHECK(slab.planes.size() >= 2);
      CHECK(slab.first == (rank == 0));
      CHECK(slab.last == (rank == ranks - 1));
      next = slab.planes.end;
      faces += slab.points(2);
    }
    CHECK(next == 13);
    CHECK(faces == 14);
  }
}

TEST_CASE("slabs thinner than two planes are refused with what would do", "[unit][fluid]") {
  const Grid grid{{8, 4, 13}};
  CHECK_THROWS_AS(fluid::slab_of(grid, 0, 7), InputError);
  CHECK_THROWS_WITH(fluid::slab_of(grid, 0, 7), Catch::Matchers::Contains("at most 6 ranks"));
}

TEST_CASE("every rank needs a mode along x", "[unit][fluid]") {
  CHECK_THROWS_WITH(fluid::slab_of({{4, 4, 13}}, 0, 6),
                    Catch::Matchers::Contains("at most 4 ranks"));
}
