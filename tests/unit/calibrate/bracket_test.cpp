#include "lv/calibrate/bracket.hpp"

#include "lv/base/check.hpp"

#include <catch2/catch.hpp>

#include <cmath>

namespace {

using namespace lv::calibrate;
using Catch::Matchers::Contains;
using lv::InputError;
using lv::Outcome;
using lv::Unsolved;

constexpr double accuracy = 1e-4;
const Target target{80e3, "case.toml:7"};

/// 100 ml at 1, falling.
double falling(double x) {
  return 100e3 / std::sqrt(x);
}

constexpr double root = 1.5625;  // of falling

Unknown from(double start) {
  return {"scale", start, {0.01, 100.0}};
}

/// Whether x makes the target's volume.
void check_root(const Outcome<double>& x) {
  REQUIRE(x);
  CHECK(*x == Approx(root).epsilon(3.0 * accuracy));
}

}  // namespace

TEST_CASE("the root is found from below, from above and from itself", "[calibrate]") {
  for (const double start : {0.01, 0.3, root, 8.0, 100.0})
    check_root(find_root(falling, from(start), target, accuracy));
}

TEST_CASE("the search asks for few volumes, and none beyond the range", "[calibrate]") {
  int asked = 0;
  const auto counted = [&](double x) {
    ++asked;
    CHECK(x > 0.0099);
    CHECK(x < 100.1);
    return falling(x);
  };
  check_root(find_root(counted, from(0.05), target, accuracy));
  CHECK(asked < 15);
}

TEST_CASE("no trial lies far beyond where the last two let expect the root", "[calibrate]") {
  const auto near = [](double x) {
    CHECK(x < 1.5 * root);
    return falling(x);
  };
  check_root(find_root(near, from(0.3), target, accuracy));
}

TEST_CASE("steps to where there is no equilibrium are shortened", "[calibrate]") {
  const auto none_below_root = [](double x) -> Outcome<double> {
    if (x < 0.99 * root)
      return Unsolved{"too soft", "stiffen it"};
    return falling(x);
  };
  check_root(find_root(none_below_root, from(50.0), target, accuracy));
}

TEST_CASE("a start without an equilibrium has no root, and says why", "[calibrate]") {
  const auto none = [](double) -> Outcome<double> { return Unsolved{"too soft", "stiffen it"}; };
  const auto x = find_root(none, from(1.0), target, accuracy);
  REQUIRE_FALSE(x);
  CHECK(x.why().what == "too soft");
}

TEST_CASE("a hole in the bracket ends the search", "[calibrate]") {
  const auto with_hole = [](double x) -> Outcome<double> {
    if (x > 1.0 && x < 2.0)
      return Unsolved{"folds", "take a finer mesh"};
    return falling(x);
  };
  const auto x = find_root(with_hole, {"scale", 0.9, {0.01, 100.0}, 4.0}, target, accuracy);
  REQUIRE_FALSE(x);
  CHECK(x.why().what == "folds");
}

TEST_CASE("a volume that jumps over the target has no root", "[calibrate]") {
  const auto jump = [](double x) { return x < root ? 90e3 : 70e3; };
  const auto x = find_root(jump, from(1.0), target, accuracy);
  REQUIRE_FALSE(x);
  CHECK_THAT(x.why().what, Contains("The volume jumps between scale = 1.5"));
}

TEST_CASE("from a start without an equilibrium the search goes to where there is one",
          "[calibrate]") {
  const auto none_below_one = [](double x) -> Outcome<double> {
    if (x < 1.0)
      return Unsolved{"too soft", "stiffen it"};
    return falling(x);
  };
  check_root(find_root(none_below_one, from(0.3), target, accuracy));
}

TEST_CASE("a target beyond the last equilibrium is refused with it after few trials",
          "[calibrate]") {
  int asked = 0;
  const auto none_from_root = [&](double x) -> Outcome<double> {
    ++asked;
    if (x > 0.95 * root)
      return Unsolved{"turns inside out", ""};
    return falling(x);
  };
  CHECK_THROWS_WITH(find_root(none_from_root, from(1.0), target, accuracy),
                    Contains("80.00 ml cannot be reached: the model's volume is 8") &&
                        Contains("and no farther (turns inside out)"));
  CHECK(asked < 9);
}

TEST_CASE("a target beyond the range is refused with the volume at its end", "[calibrate]") {
  const auto never_at_the_other_end = [](double x) {
    CHECK(x > 0.9);
    return falling(x);
  };
  CHECK_THROWS_AS(find_root(falling, {"scale", 1.0, {0.5, 1.2}}, target, accuracy), InputError);
  CHECK_THROWS_WITH(find_root(falling, {"scale", 1.0, {0.5, 1.2}}, target, accuracy),
                    Contains("case.toml:7: 80.00 ml cannot be reached") &&
                        Contains("91.29 ml at scale = 1.2, the end of its range"));
  CHECK_THROWS_AS(find_root(never_at_the_other_end, {"scale", 1.0, {0.5, 1.2}}, target, accuracy),
                  InputError);
}

TEST_CASE("a target out of reach is told by how much it is missed at the end of the range",
          "[calibrate]") {
  const auto missing = [](const std::function<Outcome<double>(double)>& volume, double end) {
    try {
      static_cast<void>(find_root(volume, {"scale", 1.0, {0.5, end}}, target, accuracy));
    } catch (const OutOfReach& failure) {
      return failure.missing();
    }
    return -1.0;
  };
  CHECK(missing(falling, 1.2) == Approx(std::log(falling(1.2) / 80e3)));
  const auto none_from = [](double last) {
    return [last](double x) -> Outcome<double> {
      if (x > last)
        return Unsolved{"turns inside out", ""};
      return falling(x);
    };
  };
  // ln V is straight in ln x
  CHECK(missing(none_from(1.25), 1.4) == Approx(std::log(falling(1.4) / 80e3)).epsilon(1e-6));
  CHECK(missing(none_from(1.25), 3.0) == 0.0);   // the line meets the target
  CHECK(missing(none_from(1.001), 1.4) == 0.0);  // one volume makes no line
}

TEST_CASE("of a wall with two equilibria the root is found on the branch that it keeps",
          "[calibrate]") {
  bool gave_way = false;  // the second equilibrium has a larger cavity, until it is left for good
  const auto kept = [&](double x) { return 0.98 * falling(x); };
  const auto volume = [&](double x) {
    const double found = gave_way ? kept(x) : falling(x);
    gave_way = gave_way || x > 1.02 * 1.55;
    return found;
  };
  const auto x = find_root(volume, from(1.55), target, accuracy);
  REQUIRE(x);
  CHECK(kept(*x) == Approx(target.volume).epsilon(accuracy));
}
