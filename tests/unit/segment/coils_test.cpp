#include "lv/segment/coils.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <vector>

using namespace lv::segment;

namespace {

constexpr PolarGrid grid{};

/// Blood of 20 mm radius as coils of this gradient receive it, with two papillary muscles on one
/// side, of two grey values: more blood flows in at one time.
std::vector<Polar> pool(const CoilGradient& gradient) {
  std::vector<Polar> frames;
  for (const double blood : {900.0, 1000.0}) {
    Polar values = blood * sensitivity(gradient, grid);
    for (int i = 0; i < grid.rays; ++i)
      for (int k = 0; k < grid.radii; ++k)
        if (const double x = grid.radius(k) * std::cos(grid.angle(i));
            x > 5.0 && x < 9.0 && std::abs(grid.radius(k) * std::sin(grid.angle(i))) > 3.0)
          values(i, k) *= 0.3;
    frames.push_back(values);
  }
  return frames;
}

}  // namespace

TEST_CASE("the gradient of coils is seen in blood, papillary muscles or not", "[segment]") {
  for (const CoilGradient& gradient :
       {CoilGradient(0.0, 0.0), CoilGradient(0.007, -0.003), CoilGradient(-0.002, 0.010)}) {
    const std::vector<Polar> frames = pool(gradient);
    const CoilGradient found = coil_gradient({{frames, 15.0}}, grid);
    CHECK((found - gradient).norm() < 5e-4);
  }
}

TEST_CASE("no coil is taken to fall by more than a factor of four over 100 mm", "[segment]") {
  const std::vector<Polar> frames = pool({0.05, 0.0});
  CHECK(coil_gradient({{frames, 4.0}}, grid).norm() < 0.0139);
}

TEST_CASE("where there is no blood coils are taken to receive equally", "[segment]") {
  const std::vector<Polar> black(2, Polar::Zero(grid.rays, grid.radii));
  CHECK(coil_gradient({{black, 15.0}}, grid).norm() == 0.0);
  CHECK(coil_gradient({}, grid).norm() == 0.0);
}
