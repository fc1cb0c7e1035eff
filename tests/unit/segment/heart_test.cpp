#include "lv/segment/heart.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>
#include <vector>

using namespace lv;

namespace {

/// Blood round the middle in a wall of 10 mm, in lung.
image::Picture ring_picture(double radius) {
  image::Picture picture;
  picture.plane.columns = picture.plane.rows = 100;
  picture.plane.spacing_i = picture.plane.spacing_j = 1.5;
  for (int j = 0; j < 100; ++j)
    for (int i = 0; i < 100; ++i) {
      const double r = 1.5 * std::hypot(i - 49.5, j - 49.5);
      picture.values.push_back(r < radius ? 900.0F : r < radius + 10.0 ? 300.0F : 60.0F);
    }
  return picture;
}

}  // namespace

TEST_CASE("a large ventricle, whose middle is still, is found", "[segment]") {
  image::Cine cine;
  for (int s = 0; s < 3; ++s) {
    image::CineSlice slice;
    for (int t = 0; t < 8; ++t) {
      slice.frames.push_back(ring_picture(33.0 + 2.0 * std::cos(0.25 * std::numbers::pi * t)));
      slice.frames.back().plane.origin.z() = 10.0 * s;
    }
    cine.slices.push_back(slice);
  }
  const segment::Heart heart = segment::find_heart(cine, {});
  for (const segment::Centre& centre : heart.centres) {
    CHECK((centre.at - segment::Pixel(49.5, 49.5)).norm() < 1.0);
    CHECK(centre.radius == Approx(33.0).margin(2.5));
  }
}
