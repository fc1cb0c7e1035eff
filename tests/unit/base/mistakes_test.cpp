#include "lv/base/mistakes.hpp"

#include <catch2/catch.hpp>

using lv::InputError;
using lv::Mistakes;

TEST_CASE("mistakes are told together, each with its place, and others pass through",
          "[unit][base]") {
  Mistakes mistakes;
  mistakes.attempt([] {});
  CHECK_NOTHROW(mistakes.raise());
  mistakes.attempt([] { throw InputError("a.toml:1", "is wrong", "Mend it"); });
  CHECK_THROWS_WITH(mistakes.raise(), "a.toml:1: is wrong. Mend it");
  mistakes.attempt([] { throw InputError("b.csv", "is absent", ""); });
  CHECK_THROWS_WITH(mistakes.raise(), "a.toml:1: is wrong. Mend it\nb.csv: is absent");
  CHECK_THROWS_AS(mistakes.attempt([] { throw lv::RunError("no memory", ""); }), lv::RunError);
}
