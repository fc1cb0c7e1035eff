#include "lv/image/slice_registration.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <functional>
#include <random>

namespace {

using namespace lv;
using namespace lv::image;

constexpr double endo = 20.0, epi = 29.0;  // radii of the wall [mm]

Plane plane() {
  Plane p;
  p.along_row = Vec3(0.0, 0.6, 0.8);
  p.along_column = Vec3(1.0, 0.0, 0.0);
  p.spacing_i = p.spacing_j = 1.5;
  p.columns = p.rows = 80;
  p.origin = Vec3(5.0, -7.0, 11.0) - 59.25 * (p.along_row + p.along_column);
  return p;
}

/// Places in the plane about its middle [mm].
Vec3 at(double x, double y) {
  return plane().point(39.5 + x / 1.5, 39.5 + y / 1.5);
}

SliceTissue ring() {
  SliceTissue tissue{{}, 0.5625};
  for (double y = -40.0; y <= 40.0; y += 0.75)
    for (double x = -40.0; x <= 40.0; x += 0.75) {
      const double r = std::hypot(x, y);
      const int L = r < endo ? 0 : r < epi ? 1 : 2;
      tissue.points.push_back(
          {at(x, y), {L == 0 ? 1.0 : 0.0, L == 1 ? 1.0 : 0.0, L == 2 ? 1.0 : 0.0}});
    }
  return tissue;
}

/// Late enhancement with a heart whose middle lies at (x, y): the mean over each pixel and noise.
/// `scar`: angle of the sector that is bright through the whole wall [rad].
Picture enhanced(double x, double y, double scar, double noise) {
  const auto signal = [&](double a, double b) {
    const double r = std::hypot(a - x, b - y);
    const double theta = std::atan2(b - y, a - x);
    if (r < endo)
      return 450.0;
    if (r < epi)
      return std::abs(theta) < 0.5 * scar ? 900.0 : 60.0;
    return a - x < -0.2 * epi && std::hypot(a - x + 25.0, b - y) < 32.0 ? 450.0 : 60.0;
  };
  std::mt19937 generator(3);
  std::normal_distribution<double> normal(0.0, noise);
  Picture picture{plane(), {}};
  for (int j = 0; j < 80; ++j)
    for (int i = 0; i < 80; ++i) {
      double sum = 0.0;
      for (int a = 0; a < 4; ++a)
        for (int b = 0; b < 4; ++b)
          sum += signal(1.5 * (i - 39.5) + (a - 1.5) * 0.375, 1.5 * (j - 39.5) + (b - 1.5) * 0.375);
      picture.values.push_back(
          static_cast<float>(std::hypot(sum / 16.0 + (noise > 0.0 ? normal(generator) : 0.0),
                                        noise > 0.0 ? normal(generator) : 0.0)));
    }
  return picture;
}

double error(const Registration& found, double x, double y) {
  // what lies at (x, y) belongs into the middle
  return (found.move + x * plane().along_row + y * plane().along_column).norm();
}

}  // namespace

TEST_CASE("a slice is moved to where its grey values fit to cavity, wall and surroundings",
          "[unit][image]") {
  // a tenth of a pixel without noise; the scar takes the edge of the cavity away
  for (const double scar : {0.0, 1.5, 3.0}) {
    const Registration found = register_slice(enhanced(2.4, -3.1, scar, 0.0), ring(), 8.0);
    CHECK(error(found, 2.4, -3.1) < 0.25);
    CHECK(found.doubt < 3.0);
  }
  const Registration noisy = register_slice(enhanced(-3.7, 1.2, 1.5, 40.0), ring(), 8.0);
  CHECK(error(noisy, -3.7, 1.2) < 0.5);
  CHECK(noisy.doubt < 3.0);
}

TEST_CASE("a slice that shows nothing of the wall leaves its move in doubt", "[unit][image]") {
  Picture noise = enhanced(0.0, 0.0, 0.0, 0.0);
  std::mt19937 generator(5);
  std::normal_distribution<double> normal(100.0, 10.0);
  for (float& value : noise.values)
    value = static_cast<float>(normal(generator));
  CHECK(register_slice(noise, ring(), 8.0).doubt > 4.0);
  Picture flat = noise;
  std::fill(flat.values.begin(), flat.values.end(), 100.0F);
  CHECK(register_slice(flat, ring(), 8.0).doubt > 4.0);
}
