#include "lv/circulation/leap.hpp"

#include "lv/base/check.hpp"
#include "lv/circulation/circuit.hpp"

#include "support/circuit_step.hpp"
#include <catch2/catch.hpp>

#include <cmath>

namespace {

using namespace lv;
using namespace lv::circulation;
using units::ml;

/// The published loop with its own ventricle.
CircuitParameters published_loop() {
  CircuitParameters p;
  p.kind = Kind::closed_loop;
  p.step = 2e-3;
  p.left_ventricle = {4.482 * elastance, 0.17 * elastance, 0.25, 0.4, 0.1, 42.0 * ml};
  return p;
}

Cycle limit_cycle(CircuitParameters p) {
  p.tolerance = 1e-6;
  p.beats = 300;
  return run_alone(p);
}

/// The states of the elastance's own loop at the end of a cycle, from what is known of it.
std::vector<double> states_at_end(const CircuitParameters& p, int beats) {
  Circuit circuit(p);
  const int steps = static_cast<int>(std::lround(beats * p.period / p.step));
  for (int i = 1; i <= steps; ++i)
    test::step(circuit, p, i * p.step);
  return {circuit.states().begin(), circuit.states().end()};
}

}  // namespace

TEST_CASE("blood alone, and not where it is at first, says how a closed loop beats in the end",
          "[unit][circulation]") {
  CircuitParameters p = published_loop();
  const BeatMeasures usual = limit_cycle(p).beats.back();
  p.start.p_ven_sys *= 0.7;
  p.closed_loop.blood = 1617.876 * ml;
  const BeatMeasures shared_otherwise = limit_cycle(p).beats.back();
  CHECK(shared_otherwise.end_diastolic_volume == Approx(usual.end_diastolic_volume).epsilon(1e-4));
  CHECK(shared_otherwise.aortic_systolic == Approx(usual.aortic_systolic).epsilon(1e-4));
  p.closed_loop.blood *= 1.1;
  const BeatMeasures more = limit_cycle(p).beats.back();
  // all parts are linear: what is beyond V_0 grows by as much as the blood beyond all V_0
  const double unstressed = (42.0 + 4.0 + 4.0 + 16.0) * ml;
  const double factor = (p.closed_loop.blood - unstressed) / (1617.876 * ml - unstressed);
  CHECK((more.end_diastolic_volume - 42.0 * ml) / (usual.end_diastolic_volume - 42.0 * ml) ==
        Approx(factor).epsilon(1e-3));
}

TEST_CASE("a closed loop with less blood than its chambers hold without pressure is refused",
          "[unit][circulation]") {
  CircuitParameters p = published_loop();
  p.closed_loop.blood = 140.0 * ml;
  CHECK_THROWS_WITH(Circuit(p), Catch::Contains("nothing is left that would fill vessels"));
}

TEST_CASE("a circuit that leaps keeps its blood and the ventricle's volume",
          "[unit][circulation]") {
  for (const Kind kind : {Kind::windkessel, Kind::closed_loop}) {
    CircuitParameters p = published_loop();
    p.kind = kind;
    Circuit circuit(p);
    const double volume = circuit.states().front();
    const double blood = circuit.blood();
    std::vector<double> states(circuit.states().begin(), circuit.states().end());
    for (double& y : states)
      y *= 1.1;
    circuit.leap_to(states);
    CHECK(circuit.states().front() == Approx(volume).epsilon(1e-14));
    CHECK(circuit.blood() == Approx(blood).epsilon(1e-14));
    CHECK(circuit.states()[1] != states[1] / 1.1);
  }
}

TEST_CASE("a stand-in tells what is to come of a circuit that fills slowly",
          "[unit][circulation]") {
  CircuitParameters p;
  p.kind = Kind::windkessel;
  p.step = 2e-3;
  p.windkessel.C = 100.0 * compliance;
  const std::vector<double> begin = states_at_end(p, 2);
  const std::vector<double> end = states_at_end(p, 3);
  CircuitParameters three_beats = p;
  three_beats.beats = 3;
  const Cycle beats = run_alone(three_beats);
  const BeatenStates beaten{begin, end, samples_of(beats, 2), beats.beats.back()};
  const double came = largest_change(end, states_at_end(p, 1000));
  CHECK(largest_change(begin, end) < 1e-3);
  CHECK(came > 0.02);
  CHECK(change_to_come(p, p.step, beaten) == Approx(came).epsilon(0.4));
  BeatMeasures none;
  none.end_diastolic_volume = std::nan("");
  CHECK(change_to_come(p, p.step, {begin, end, samples_of(beats, 2), none}) == 1.0);
}

TEST_CASE("a loop joined to a wall has its blood once the wall's volume is known",
          "[unit][circulation]") {
  CircuitParameters p = published_loop();
  const double filling = Circuit(p).signals(0.0, 0.0).filling_pressure;
  p.closed_loop.blood = 1350.0 * ml;
  p.start.V_lv = std::nan("");
  Circuit circuit(p);
  CHECK(circuit.signals(0.0, 0.0).filling_pressure == Approx(filling));
  circuit.start_around(130.0 * ml);
  CHECK(circuit.blood() == Approx(1350.0 * ml).epsilon(1e-12));
}

TEST_CASE("the limit cycle is foretold from one beat that is far from it", "[unit][circulation]") {
  CircuitParameters p = published_loop();
  p.start.p_ven_sys *= 1.4;  // where the blood takes long to come from
  const std::vector<double> begin = states_at_end(p, 0);
  const std::vector<double> first = states_at_end(p, 1);
  const std::vector<double> limit = states_at_end(p, 60);
  CircuitParameters one_beat = p;
  one_beat.beats = 1;
  const Cycle beat = run_alone(one_beat);
  const auto foretold =
      foretold_limit(p, p.step, {begin, first, samples_of(beat, 0), beat.beats.back()});
  REQUIRE(foretold);
  const auto distance = [&](const std::vector<double>& y, int state) {
    return std::abs(y[static_cast<std::size_t>(state)] / limit[static_cast<std::size_t>(state)] -
                    1.0);
  };
  for (const int state :
       {ClosedLoop::V_lv, ClosedLoop::V_ra, ClosedLoop::p_ven_sys, ClosedLoop::p_ar_pul}) {
    INFO("state " << state << " after a beat " << distance(first, state) << ", foretold "
                  << distance(*foretold, state));
    CHECK(distance(*foretold, state) < 0.5 * distance(first, state));
  }
  BeatMeasures none;
  none.end_diastolic_volume = std::nan("");
  CHECK_FALSE(foretold_limit(p, p.step, {begin, first, samples_of(beat, 0), none}));
  // a ventricle that is in its limit cycle stays there, whatever its stand-in would do
  const auto stays =
      foretold_limit(p, p.step, {first, first, samples_of(beat, 0), beat.beats.back()});
  REQUIRE(stays);
  CHECK(*stays == first);
}
