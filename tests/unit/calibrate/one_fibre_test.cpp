#include "lv/calibrate/one_fibre.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

using lv::calibrate::one_fibre_volume;

TEST_CASE("the volume of unstretched fibres is that without load", "[calibrate]") {
  CHECK(one_fibre_volume(70e3, 110e3, 1.0) == Approx(70e3));
}

TEST_CASE("a thin shell's fibres are stretched as its radius", "[calibrate]") {
  const double r = 30.0, thickness = 1e-3;
  const auto volume = [](double radius) {
    return 4.0 / 3.0 * std::numbers::pi * std::pow(radius, 3);
  };
  const double wall = volume(r + thickness) - volume(r);
  CHECK(one_fibre_volume(volume(r), wall, 1.2) == Approx(volume(1.2 * r)).epsilon(1e-3));
}

TEST_CASE("a wall that is thick enough closes its cavity before its fibres are short",
          "[calibrate]") {
  CHECK(one_fibre_volume(20e3, 250e3, 0.8) == 0.0);
}
