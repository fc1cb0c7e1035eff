#include "lv/base/check.hpp"

#include <catch2/catch.hpp>

using namespace lv;
using Catch::Matchers::Contains;

TEST_CASE("an input error says where, what and what to do", "[unit][base]") {
  const InputError error("case.toml:7", "the radius is negative", "Make it positive");
  CHECK(error.what() == std::string("case.toml:7: the radius is negative. Make it positive"));
  CHECK(error.where() == "case.toml:7");
  CHECK(InputError("here", "wrong", "").what() == std::string("here: wrong"));
}

TEST_CASE("a run error says what and what to do", "[unit][base]") {
  CHECK(RunError("the disk is full", "Free it").what() == std::string("the disk is full. Free it"));
  CHECK(RunError("stopped", "").what() == std::string("stopped"));
}

TEST_CASE("a failed check names its condition and place, a good one is evaluated once",
          "[unit][base]") {
  int evaluations = 0;
  const auto count = [&](bool result) {
    ++evaluations;
    return result;
  };
  CHECK_NOTHROW([&] { LV_CHECK(count(true)); }());
  CHECK(evaluations == 1);
  CHECK_THROWS_AS([&] { LV_CHECK(count(false)); }(), LogicError);
  CHECK_THROWS_WITH([&] { LV_CHECK(1 + 1 == 3); }(),
                    Contains("1 + 1 == 3") && Contains("check_test.cpp"));
}
