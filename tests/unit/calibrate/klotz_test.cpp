#include "lv/calibrate/klotz.hpp"

#include "lv/base/units.hpp"

#include <catch2/catch.hpp>

#include <cmath>

namespace {

using namespace lv::calibrate;
using lv::units::mmHg;

}  // namespace

TEST_CASE("the Klotz relation through 144 ml at 8 mmHg", "[calibrate]") {
  const Klotz k = klotz(144e3, 8.0 * mmHg);
  CHECK(k.V0 == Approx(79.49e3).epsilon(1e-4));
  CHECK(k.V30 == Approx(180.77e3).epsilon(1e-4));
  CHECK(k.beta == Approx(5.8124).epsilon(1e-4));
  CHECK(k.pressure(144e3) == Approx(8.0 * mmHg).epsilon(1e-10));
  CHECK(k.pressure(k.V30) == Approx(30.0 * mmHg).epsilon(1e-10));
  CHECK(k.volume(k.pressure(120e3)) == Approx(120e3).epsilon(1e-10));
}

TEST_CASE("above 22 mmHg the Klotz relation is drawn through the volume at 15 mmHg",
          "[calibrate]") {
  const Klotz k = klotz(180e3, 25.0 * mmHg);
  CHECK(k.pressure(180e3) == Approx(25.0 * mmHg).epsilon(1e-10));
  CHECK(k.pressure(k.V0 + 0.8 * (k.V30 - k.V0)) == Approx(15.0 * mmHg).epsilon(1e-10));
}

TEST_CASE("the normalised Klotz curve fills to V30 at 27.78 mmHg", "[calibrate]") {
  const Klotz k = klotz(144e3, 8.0 * mmHg);
  CHECK(k.V0 + (144e3 - k.V0) * klotz_filling(27.78 / 8.0) == Approx(k.V30).epsilon(1e-10));
  CHECK(klotz_filling(1.0) == 1.0);
}
