#include "lv/material/law.hpp"

#include <catch2/catch.hpp>

using namespace lv;

TEST_CASE("scar is fifty times as stiff and does not contract (2.23)-(2.24)", "[unit][material]") {
  const material::InfarctScaling infarct;
  CHECK(infarct.passive(0.0) == 1.0);
  CHECK(infarct.passive(1.0) == 50.0);
  CHECK(infarct.passive(0.5) == 25.5);
  CHECK(infarct.active(0.0) == 1.0);
  CHECK(infarct.active(1.0) == 0.0);
  CHECK(infarct.active(0.25) == 0.75);
  CHECK(material::InfarctScaling{0.0}.passive(1.0) == 1.0);
}
