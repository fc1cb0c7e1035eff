#include "lv/material/muscle_states.hpp"

#include "lv/base/check.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <utility>

namespace {

using namespace lv;
using material::ActiveLaw;
using material::Land2017;
using material::MuscleStates;
using material::NiedererHunterSmith;

constexpr std::size_t count = 2 * pack_size + 1;  // the last pack is not full

std::vector<double> stretches() {
  std::vector<double> result;
  for (std::size_t a = 0; a < count; ++a)
    result.push_back(1.0 + 0.1 * std::sin(static_cast<double>(a)));
  return result;
}

}  // namespace

TEMPLATE_TEST_CASE("states side by side are the same numbers as states one by one",
                   "[unit][material]", NiedererHunterSmith, Land2017) {
  MuscleStates<double> single(TestType{}, count);
  MuscleStates<Pack> packed(TestType{}, count);
  single.relax(0.4, stretches());
  packed.relax(0.4, stretches());
  CHECK(single.numbers().size() == count * single.numbers_per_point());
  const auto expected = single.numbers();
  REQUIRE(packed.numbers().size() == expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i)
    CHECK(packed.numbers()[i] == Approx(expected[i]).epsilon(1e-13));
  single.visit([](const auto& law, const auto& states) {
    REQUIRE(states.size() == count);
    for (std::size_t a = 0; a < count; ++a)
      CHECK(states[a].tension ==
            Approx(law.steady_state(0.4, stretches()[a]).tension).epsilon(1e-13));
  });
  packed.visit([](const auto&, const auto& states) {
    REQUIRE(states.size() == 3);
    for (int i = 1; i < pack_size; ++i)  // beyond the end: its last point again
      CHECK(states[2].tension.get(i) == states[2].tension.get(0));
  });
}

TEMPLATE_TEST_CASE("states come back from their numbers", "[unit][material]", double, Pack) {
  MuscleStates<TestType> muscle(Land2017{}, count);
  std::vector<double> numbers(count * muscle.numbers_per_point());
  for (std::size_t i = 0; i < numbers.size(); ++i)
    numbers[i] = 0.5 + 0.01 * static_cast<double>(i);
  muscle.set_numbers(numbers);
  CHECK(muscle.numbers() == numbers);
  numbers.pop_back();
  CHECK_THROWS_AS(muscle.set_numbers(numbers), LogicError);
}

TEST_CASE("one stretch for all relaxes all alike", "[unit][material]") {
  MuscleStates<Pack> muscle(NiedererHunterSmith{}, count);
  MuscleStates<Pack> each(NiedererHunterSmith{}, count);
  muscle.relax(0.2, std::vector{1.05});
  each.relax(0.2, std::vector<double>(count, 1.05));
  CHECK(muscle.numbers() == each.numbers());
}

TEST_CASE("a law without kinetics has no states", "[unit][material]") {
  MuscleStates<double> muscle(material::PrescribedTension{60.0}, count);
  muscle.relax(0.2, std::vector{1.0});
  muscle.visit([](const auto&, const auto&) { FAIL("it has states"); });
  CHECK(muscle.numbers_per_point() == 0);
  CHECK(muscle.numbers().empty());
}
