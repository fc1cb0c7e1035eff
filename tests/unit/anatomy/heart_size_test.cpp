#include "lv/anatomy/heart_size.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

using Catch::Matchers::Contains;
using lv::anatomy::odd_size;

TEST_CASE("the mean thickness of half a spherical shell", "[unit][anatomy]") {
  const auto shell = [](double u, double theta, double t) {
    const double polar = 0.5 * std::numbers::pi * u;
    return lv::Vec3((20.0 + 8.0 * t) * lv::Vec3(std::sin(polar) * std::cos(theta),
                                                std::sin(polar) * std::sin(theta),
                                                -std::cos(polar)));
  };
  const double volume = 2.0 / 3.0 * std::numbers::pi * (std::pow(28.0, 3) - std::pow(20.0, 3));
  CHECK(lv::anatomy::mean_thickness(shell, volume) == Approx(8.0).epsilon(0.02));
}

TEST_CASE("a heart of twice the voxel size, or half of it, is no human one", "[unit][anatomy]") {
  constexpr double cavity = 195e3;  // of a dilated ventricle [mm^3]
  constexpr double wall = 115e3;
  constexpr double thickness = 7.0;
  CHECK(odd_size(cavity, wall, thickness).empty());
  CHECK_THAT(odd_size(8.0 * cavity, 8.0 * wall, 2.0 * thickness),
             Contains("the cavity holds") && Contains("the wall has") && Contains("20 to 600 ml") &&
                 Contains("check the voxel size"));
  CHECK_THAT(odd_size(0.25 * cavity, 0.25 * wall, 0.5 * thickness),
             Contains("the wall has 28.8 ml"));
  CHECK_THAT(odd_size(cavity, wall, 2.9), Contains("mean thickness is 2.9 mm"));
  CHECK_THAT(odd_size(0.05e3, 0.1e3, {}), Contains("the cavity holds 0.05 ml"));  // a mouse's
}
