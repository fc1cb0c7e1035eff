#include "lv/segment/kept_muscle.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

using namespace lv::segment;

namespace {

constexpr PolarGrid rays{};
constexpr double pi = std::numbers::pi;

/// Darkness between two radii, and of a papillary muscle of an eighth of a turn inside the first.
Polar ring(double inner, double outer, double papillary) {
  Polar dark = Polar::Zero(rays.rays, rays.radii);
  for (int i = 0; i < rays.rays; ++i)
    for (int k = 0; k < rays.radii; ++k) {
      const double from = i < rays.rays / 8 ? inner - papillary : inner;
      dark(i, k) = rays.radius(k) > from && rays.radius(k) < outer ? 1.0 : 0.0;
    }
  return dark;
}

/// Slices of 1000, 1500, ... mm^2 that hold, in frame t, a part of `grow` more.
Areas slices_that(const std::vector<double>& grow) {
  Areas held;
  for (int s = 0; s < 5; ++s) {
    held.emplace_back();
    for (const double part : grow)
      held.back().push_back((1000.0 + 500.0 * s) * (1.0 + part));
  }
  return held;
}

/// Slices the middle of whose walls encloses this in each frame.
Areas equal_slices(const std::vector<double>& areas) {
  return Areas(5, areas);
}

}  // namespace

TEST_CASE("what is dark within a line counts wherever it lies", "[segment]") {
  const Polar dark = ring(20.1, 30.1, 5.0);
  const double expected =
      pi * (std::pow(30.1, 2) - std::pow(20.1, 2)) + pi / 8.0 * (std::pow(20.1, 2) - 15.1 * 15.1);
  CHECK(dark_area(dark, Radii::Constant(rays.rays, 35.0), rays) == Approx(expected).epsilon(0.03));
  CHECK(dark_area(dark, Radii::Constant(rays.rays, 14.0), rays) == Approx(0.0).margin(1e-9));
}

TEST_CASE("the line that holds an area leaves room for what lies in the cavity", "[segment]") {
  const Radii endo = Radii::Constant(rays.rays, 20.0);
  const Radii thickness = Radii::Constant(rays.rays, 7.0);
  const Polar wide = ring(20.0, 40.0, 5.0);
  const double dark = dark_area(wide, endo + 10.0, rays);
  CHECK(line_that_holds(wide, endo, thickness, dark, rays).mean() == Approx(30.0).margin(0.01));
  const Polar alone = ring(20.0, 40.0, 0.0);
  CHECK(line_that_holds(alone, endo, thickness, dark, rays).mean() > 30.2);
}

TEST_CASE("a slice that alone holds more in a frame is told to hold what the others do",
          "[segment]") {
  Areas held = slices_that({0.0, 0.02, 0.04, 0.02, 0.0});
  held[2][2] *= 1.5;
  const Areas kept = kept_areas(held, equal_slices({3000.0, 2800.0, 2600.0, 2800.0, 3000.0})).areas;
  CHECK(kept[2][2] == Approx(2000.0 * 1.04));
  CHECK(kept[4][1] == Approx(held[4][1]));
}

TEST_CASE("muscle grows in slices by no more than the wall shortens round the cavity",
          "[segment]") {
  const Areas middle = equal_slices({3000.0, 2800.0, 2700.0, 2700.0, 2800.0, 3000.0});
  const Areas kept = kept_areas(slices_that({0.0, 0.1, 0.3, 0.3, 0.1, 0.0}), middle).areas;
  CHECK(kept[0][0] == Approx(1000.0));
  CHECK(kept[0][2] == Approx(1000.0 * std::sqrt(3000.0 / 2700.0)));
  const Areas lost = kept_areas(slices_that({0.0, -0.1, -0.3, -0.3, -0.1, 0.0}), middle).areas;
  CHECK(lost[0][2] == Approx(1000.0));
}

TEST_CASE(
    "a slice that the base passes is trusted less, one that a single frame is wrong of is not",
    "[segment]") {
  Areas held = slices_that({0.0, 0.0, 0.0, 0.0, 0.0});
  const std::vector<double> passing{0.15, -0.15, 0.0, 0.15, -0.15};
  for (std::size_t t = 0; t < passing.size(); ++t)
    held[4][t] *= std::exp(passing[t]);
  held[2][3] *= 1.5;
  const Kept kept = kept_areas(held, equal_slices({3000.0, 2800.0, 2600.0, 2800.0, 3000.0}));
  CHECK(kept.agreement[0] == Approx(1.0));
  CHECK(kept.agreement[2] == Approx(1.0));
  CHECK(kept.agreement[4] == Approx(std::pow(0.03 / 0.15, 2)));
}

TEST_CASE("a slice that shows the atrium while the ventricle empties does not tell when it is full",
          "[segment]") {
  const std::vector<double> grown{0.0, 0.05, 0.1, 0.1, 0.05, 0.0};
  Areas middle = equal_slices({3000.0, 2800.0, 2700.0, 2700.0, 2800.0, 3000.0});
  middle[0] = {3000.0, 2800.0, 7000.0, 7000.0, 2800.0, 3000.0};
  const Areas kept = kept_areas(slices_that(grown), middle).areas;
  CHECK(kept[1][0] == Approx(1500.0));
  CHECK(kept[1][2] == Approx(1500.0 * std::sqrt(3000.0 / 2700.0)));
}
