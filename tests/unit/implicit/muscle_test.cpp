#include "lv/implicit/muscle.hpp"

#include "lv/base/check.hpp"

#include <catch2/catch.hpp>

#include <vector>

namespace {

using namespace lv;
using implicit::Muscle;
using implicit::TimeStep;
using material::Land2017;
using material::NiedererHunterSmith;

const std::vector<double> stretch{0.95, 1.03, 1.1};

/// Muscle that a transient has reached, so that nothing is at rest.
template <class Law>
Muscle contracting() {
  Muscle muscle(Law{}, stretch.size());
  muscle.relax(0.1, stretch);
  for (int i = 0; i < 20; ++i)
    muscle.advance({2e-3, {{0.6, 0.6}}}, stretch);
  return muscle;
}

}  // namespace

TEMPLATE_TEST_CASE("the slope of the tension after a step is that of the step's stretch",
                   "[unit][implicit]", Land2017, NiedererHunterSmith) {
  const Muscle muscle = contracting<TestType>();
  const TimeStep step{2e-3, {{0.6, 0.7}}};
  constexpr double h = 1e-7;
  for (std::size_t i = 0; i < stretch.size(); ++i) {
    const double to = stretch[i] - 0.004;
    const double slope =
        (muscle.after(step, i, to + h).value - muscle.after(step, i, to - h).value) / (2 * h);
    CHECK(muscle.after(step, i, to).derivative == Approx(slope).epsilon(1e-5));
  }
}

TEST_CASE("the factor of a point's tension is one of the law's strength", "[unit][implicit]") {
  NiedererHunterSmith weak;
  weak.T_scale *= 0.5;
  const std::vector<double> half(stretch.size(), 0.5);
  Muscle by_law(weak, stretch.size());
  Muscle by_factor(NiedererHunterSmith{}, stretch.size(), half);
  for (Muscle* muscle : {&by_law, &by_factor}) {
    muscle->relax(0.1, stretch);
    for (int i = 0; i < 20; ++i)
      muscle->advance({2e-3, {{0.6, 0.6}}}, stretch);
  }
  const TimeStep step{2e-3, {{0.6, 0.7}}};
  for (std::size_t i = 0; i < stretch.size(); ++i) {
    const auto expected = by_law.after(step, i, 1.02);
    CHECK(by_factor.after(step, i, 1.02).value == Approx(expected.value));
    CHECK(by_factor.after(step, i, 1.02).derivative == Approx(expected.derivative));
    CHECK(by_factor.now(i).value == Approx(by_law.now(i).value));
  }
}

TEMPLATE_TEST_CASE("muscle that takes a step has the tension that was foretold", "[unit][implicit]",
                   Land2017, NiedererHunterSmith) {
  Muscle muscle = contracting<TestType>();
  const TimeStep step{2e-3, {{0.6, 0.7}}};
  const std::vector<double> next{0.94, 1.02, 1.11};
  std::vector<double> foretold;
  for (std::size_t i = 0; i < next.size(); ++i)
    foretold.push_back(muscle.after(step, i, next[i]).value);
  muscle.advance(step, next);
  for (std::size_t i = 0; i < next.size(); ++i)
    CHECK(muscle.now(i).value == Approx(foretold[i]).epsilon(1e-12));
}

TEMPLATE_TEST_CASE("muscle restored from its numbers goes on bit for bit", "[unit][implicit]",
                   Land2017, NiedererHunterSmith) {
  Muscle muscle = contracting<TestType>();
  Muscle restored(TestType{}, stretch.size());
  restored.set_numbers(muscle.numbers());
  CHECK(muscle.numbers().size() == stretch.size() * muscle.numbers_per_point());
  for (Muscle* m : {&muscle, &restored})
    m->advance({2e-3, {{0.6, 0.7}}}, stretch);
  CHECK(muscle.numbers() == restored.numbers());
}

TEMPLATE_TEST_CASE("muscle whose calcium differs from point to point is so many muscles",
                   "[unit][implicit]", Land2017, NiedererHunterSmith) {
  Muscle muscle = contracting<TestType>();
  const TimeStep step{2e-3, {{0.6, 0.7}, {0.6, 0.2}, {0.1, 0.6}}};
  std::vector<double> foretold;
  for (std::size_t i = 0; i < stretch.size(); ++i) {
    const TimeStep of_point{2e-3, {step.calcium[i]}};
    CHECK(muscle.after(step, i, stretch[i]).value == muscle.after(of_point, i, stretch[i]).value);
    foretold.push_back(muscle.after(step, i, stretch[i]).value);
  }
  muscle.advance(step, stretch);
  for (std::size_t i = 0; i < stretch.size(); ++i)
    CHECK(muscle.now(i).value == Approx(foretold[i]).epsilon(1e-12));
}

TEST_CASE("a prescribed tension knows no time and is refused", "[unit][implicit]") {
  CHECK_THROWS_AS(Muscle(material::PrescribedTension{60.0}, 3), InputError);
  CHECK(Muscle(material::PrescribedTension{}, 3).after({1e-3}, 1, 1.1).value == 0.0);
}
