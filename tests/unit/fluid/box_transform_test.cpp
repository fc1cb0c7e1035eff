#include "lv/fluid/box_transform.hpp"

#include "support/fluid_fields.hpp"
#include <catch2/catch.hpp>

#include <cmath>

namespace {

using namespace lv;
using fluid::BoxTransform;
using fluid::FaceField;
using test::uneven_grid;

}  // namespace

TEST_CASE("a field transformed to modes and back is itself times 8 Nx Ny Nz", "[unit][fluid]") {
  BoxTransform transform(uneven_grid, test::whole_box(uneven_grid));
  FaceField field = test::random_field(uneven_grid, 1);
  fluid::ModeField modes = transform.zero_modes();
  transform.to_modes(field, modes);
  FaceField back(uneven_grid, test::whole_box(uneven_grid));
  transform.to_points(modes, back);
  for (int c = 0; c < 3; ++c)
    test::for_points(back.component[c], 0, [&](int i, int j, int k, double& u) {
      // rounding of sums of some hundred terms
      CHECK(u == Approx(8.0 * 240 * field.component[c].at(i, j, k)).margin(1e-11));
    });
}

TEST_CASE("a product of waves is one mode", "[unit][fluid]") {
  BoxTransform transform(uneven_grid, test::whole_box(uneven_grid));
  const FaceField field = test::field_of(uneven_grid, [](int c, const Vec3& x) {
    const auto wave = [&](int d, double m) {
      const double phase = M_PI * m * x[d] / (uneven_grid.cells[d] * uneven_grid.spacing[d]);
      return d == c ? std::cos(phase) : std::sin(phase);
    };
    return wave(0, 2) * wave(1, 3) * wave(2, 5);
  });
  fluid::ModeField modes = transform.zero_modes();
  transform.to_modes(field, modes);
  for (int c = 0; c < 3; ++c) {
    const fluid::ModeLayout& layout = transform.layout(c);
    REQUIRE(modes[c].size() == layout.size());
    for (int z = 0; z < layout.count_z; ++z)
      for (int x = 0; x < layout.count_x; ++x)
        for (int y = 0; y < layout.count_y; ++y) {
          const bool it =
              x + layout.first_x == 2 && y + layout.first_y == 3 && z + layout.first_z == 5;
          const double value = modes[c][(z * layout.count_x + x) * layout.count_y + y];
          // each axis: sum of wave^2, twice, is N
          CHECK(value == Approx(it ? 240.0 : 0.0).margin(1e-11));
        }
  }
}

TEST_CASE("modes gathered and scattered are themselves", "[unit][fluid]") {
  BoxTransform transform(uneven_grid, test::whole_box(uneven_grid));
  fluid::ModeField modes = transform.zero_modes();
  transform.to_modes(test::random_field(uneven_grid, 2), modes);
  fluid::ModeField back = transform.zero_modes();
  for (int c = 0; c < 3; ++c)
    transform.scatter(transform.gather(modes, c), c, back);
  CHECK(back == modes);
}
