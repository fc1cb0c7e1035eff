#include "lv/circulation/family.hpp"

#include "lv/circulation/cycle.hpp"

#include <catch2/catch.hpp>

#include <cmath>

namespace {

using namespace lv::circulation;
using lv::units::mmHg;

/// The last beat of the circulation alone under other loads.
LoadedBeat beat_under(const Factors& factors) {
  CircuitParameters p;
  p.kind = Kind::windkessel;
  p.step = 1e-3;
  p.windkessel.p_ven *= factors.preload;
  p.windkessel.R_p *= factors.afterload;
  p.left_ventricle.E_A *= factors.contractility;
  const Cycle cycle = run_alone(p);
  LoadedBeat beat{
      "", factors, static_cast<int>(cycle.beats.size()), cycle.is_limit, cycle.beats.back(), {}};
  for (const Sample& s : samples_of(cycle, beat.beats - 1))
    beat.loop.push_back({s.signals.volume, s.signals.pressure});
  return beat;
}

}  // namespace

TEST_CASE("a line through points knows its slope, intercept and how far they are off",
          "[unit][circulation]") {
  const Line line =
      line_through(std::vector{1.0, 2.0, std::nan(""), 3.0}, std::vector{1.0, 5.0, 0.0, 7.0});
  CHECK(line.points == 3);
  CHECK(line.slope == Approx(3.0));
  CHECK(line.intercept == Approx(2.0 - 13.0 / 9.0));
  CHECK(line.deviation == Approx(std::sqrt(2.0) / 3.0));
  CHECK(std::isnan(line_through(std::vector{2.0, 2.0}, std::vector{1.0, 3.0}).slope));
  CHECK(std::isnan(line_through({}, {}).slope));
  const Line through_two = line_through(std::vector{1.0, 2.0}, std::vector{3.0, 1.0});
  CHECK(through_two.slope == Approx(-2.0));
  CHECK(std::isnan(through_two.deviation));  // it says nothing
}

TEST_CASE("the end-systolic relation of an elastance is its greatest stiffness and its own V_0",
          "[unit][circulation]") {
  std::vector<LoadedBeat> family;
  for (const double contractility : {1.0, 1.4})
    for (const auto& [preload, afterload] :
         {std::pair{1.0, 1.0}, {0.7, 1.0}, {1.3, 1.0}, {1.0, 1.6}})
      family.push_back(
          beat_under({.preload = preload, .afterload = afterload, .contractility = contractility}));
  const auto states = by_contractility(family);
  REQUIRE(states.size() == 2);
  for (const Contractility& state : states) {
    const double E = 2.5 * state.beats.front().factors.contractility + 0.08;
    const Line& line = state.end_systole.line;
    CHECK(line.points == 4);
    CHECK(line.slope / elastance == Approx(E).epsilon(1e-6));
    CHECK(line.intercept / ml == Approx(15.0).epsilon(1e-5));
    CHECK(line.deviation / mmHg < 1e-4);
    CHECK(state.stroke_work.points == 3);  // the afterload is no preload
    CHECK(state.stroke_work.slope > 0.0);
  }
  CHECK(states[1].stroke_work.slope > states[0].stroke_work.slope);
}

TEST_CASE("one load says nothing of the end-systolic relation", "[unit][circulation]") {
  const std::vector<LoadedBeat> alone{beat_under({})};
  CHECK(std::isnan(end_systolic_relation(alone).line.slope));
}
