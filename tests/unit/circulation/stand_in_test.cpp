#include "lv/circulation/stand_in.hpp"

#include "lv/circulation/circuit.hpp"
#include "lv/circulation/cycle.hpp"

#include <catch2/catch.hpp>

#include <cmath>

namespace {

using namespace lv;
using namespace lv::circulation;

CircuitParameters beating(Kind kind) {
  CircuitParameters p;
  p.kind = kind;
  p.step = 2e-3;
  p.tolerance = 1e-6;
  p.beats = 200;
  if (kind == Kind::closed_loop)
    p.left_ventricle = {4.482 * elastance, 0.17 * elastance, 0.25, 0.4, 0.1, 42.0 * units::ml};
  return p;
}

/// Made of the last beat of an elastance, whose passive pressure is E_B (V - V_0).
StandIn stand_in(const CircuitParameters& p, const Cycle& cycle) {
  const BeatMeasures& beat = cycle.beats.back();
  const double V = beat.end_diastolic_volume;
  return {samples_of(cycle, static_cast<int>(cycle.beats.size()) - 1),
          V,
          {beat.end_diastolic_pressure, V / (V - p.left_ventricle.V_0)}};
}

double relative(double a, double b) {
  return std::abs(a / b - 1.0);
}

}  // namespace

TEST_CASE("a stand-in beats in its circulation as the ventricle that it was made of",
          "[unit][circulation]") {
  for (const Kind kind : {Kind::windkessel, Kind::closed_loop}) {
    const CircuitParameters p = beating(kind);
    const Cycle ventricle = run_alone(p);
    const Cycle other = run_alone(p, stand_in(p, ventricle)).cycle;
    const BeatMeasures& a = other.beats.back();
    const BeatMeasures& b = ventricle.beats.back();
    CHECK(relative(a.end_diastolic_volume, b.end_diastolic_volume) < 2e-3);
    CHECK(relative(a.end_systolic_volume, b.end_systolic_volume) < 2e-3);
    CHECK(relative(a.aortic_systolic, b.aortic_systolic) < 2e-3);
    CHECK(relative(a.aortic_diastolic, b.aortic_diastolic) < 2e-3);
  }
}

TEST_CASE("a stand-in foretells what other loads and contractility do to its ventricle",
          "[unit][circulation]") {
  const CircuitParameters p = beating(Kind::windkessel);
  const Cycle cycle = run_alone(p);
  const StandIn wall = stand_in(p, cycle);
  const auto check = [&](const CircuitParameters& changed, double contractility) {
    const auto logs = [](const BeatMeasures& now, const BeatMeasures& then) {
      return std::array{std::log(now.end_diastolic_volume / then.end_diastolic_volume),
                        std::log(now.end_systolic_volume / then.end_systolic_volume),
                        std::log(now.aortic_systolic / then.aortic_systolic),
                        std::log(now.aortic_diastolic / then.aortic_diastolic)};
    };
    const auto real = logs(run_alone(changed).beats.back(), cycle.beats.back());
    const auto foretold =
        logs(run_alone(changed, wall.with_contractility(contractility)).cycle.beats.back(),
             run_alone(p, wall).cycle.beats.back());
    double largest = 0.0;
    for (const double change : real)
      largest = std::max(largest, std::abs(change));
    for (std::size_t k = 0; k < real.size(); ++k)
      CHECK(foretold[k] == Approx(real[k]).margin(0.3 * largest));
  };
  CircuitParameters changed = p;
  changed.windkessel.R_p *= 1.1;
  check(changed, 1.0);
  changed = p;
  changed.windkessel.p_ven *= 1.1;
  check(changed, 1.0);
  changed = p;
  changed.windkessel.C *= 1.1;
  check(changed, 1.0);
  changed = p;
  changed.left_ventricle.E_A *= 1.1;
  check(changed, 1.1);
}

TEST_CASE("a circuit is started in states, with other blood and another arterial pressure",
          "[unit][circulation]") {
  for (const Kind kind : {Kind::windkessel, Kind::closed_loop}) {
    const CircuitParameters p = beating(kind);
    Circuit circuit(p);
    circuit.advance(0.01, 0.01, 2.0);
    const std::vector<double> states(circuit.states().begin(), circuit.states().end());
    Circuit other(p);
    other.start_from(states);
    CHECK(std::vector<double>(other.states().begin(), other.states().end()) == states);
    const double before = other.signals(0.0, 2.0).aortic_pressure;
    other.scale_arterial_pressure(1.2);
    CHECK(other.signals(0.0, 2.0).aortic_pressure == Approx(1.2 * before));
    other.fill_to(circuit.blood());
    CHECK(other.blood() == Approx(circuit.blood()).epsilon(1e-12));
    CircuitParameters restarted = p;
    restarted.start = start_of(states);
    const Circuit third(restarted);
    CHECK(std::vector<double>(third.states().begin(), third.states().end()) == states);
  }
}
