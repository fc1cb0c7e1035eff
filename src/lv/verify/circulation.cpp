#include "lv/circulation/closed_loop.hpp"
#include "lv/circulation/cycle.hpp"
#include "lv/verify/problems.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

/// Reference values: the same equations by an explicit method of fourth order with steps of 5e-5 s
/// (windkessel) and 1e-4 s (closed loop).
namespace lv::verify {
namespace {

using circulation::BeatMeasures;
using circulation::CircuitParameters;
using circulation::Cycle;
using circulation::elastance;
using circulation::Sample;
using units::ml;
using units::mmHg;

constexpr double of_reference = 1e-3;  ///< of the reference
constexpr double moment = 0.15e-3;     ///< a step, and the last digit of a printed time [s]

CircuitParameters windkessel() {
  CircuitParameters p;
  p.kind = circulation::Kind::windkessel;
  p.step = 1e-4;
  p.beats = 20;
  p.tolerance = 0.0;  // all beats
  p.left_ventricle = {2.5 * elastance, 0.08 * elastance, 0.25, 0.15, 0.0, 15.0 * ml};
  p.start.V_lv = 140.0 * ml;
  p.start.p_ar_sys = 80.0 * mmHg;
  return p;
}

/// The atria contract with the ventricles there: 0.9 s is 0.1 s in a beat of 0.8 s.
CircuitParameters closed_loop(circulation::ValveLaw law) {
  CircuitParameters p;
  p.kind = circulation::Kind::closed_loop;
  p.step = 1e-4;
  p.beats = 10;
  p.tolerance = 0.0;
  p.valves.law = law;
  p.left_ventricle = {4.482 * elastance, 0.17 * elastance, 0.25, 0.4, 0.1, 42.0 * ml};
  p.closed_loop.left_atrium.t_C = p.closed_loop.right_atrium.t_C = 0.9;
  return p;
}

/// The least and the largest of a number over the last beat.
struct Extent {
  double least = std::numeric_limits<double>::infinity();
  double largest = -std::numeric_limits<double>::infinity();
};

template <class Number>
Extent over_last_beat(const Cycle& cycle, const Number& number) {
  Extent e;
  for (std::size_t i = cycle.samples.size() - cycle.samples.size() / cycle.beats.size();
       i < cycle.samples.size(); ++i) {
    e.least = std::min(e.least, number(cycle.samples[i]));
    e.largest = std::max(e.largest, number(cycle.samples[i]));
  }
  return e;
}

void check_limit_cycle(Findings& found, const BeatMeasures& m) {
  const auto check = [&](const char* name, double value, double reference, const char* unit) {
    found.add_within(name, value, reference, of_reference, unit);
  };
  check("EDV", m.end_diastolic_volume / ml, 112.801, "ml");
  check("ESV", m.end_systolic_volume / ml, 53.115, "ml");
  check("ejection of_reference", m.ejection_fraction, 0.5291, "");
  check("peak pressure", m.peak_pressure / mmHg, 113.610, "mmHg");
  check("aortic systolic pressure", m.aortic_systolic / mmHg, 108.865, "mmHg");
  check("aortic diastolic pressure", m.aortic_diastolic / mmHg, 60.876, "mmHg");
  check("largest dp/dt", m.largest_pressure_rate / mmHg, 1266.0, "mmHg/s");
  check("least dp/dt", m.least_pressure_rate / mmHg, -998.0, "mmHg/s");
  check("stroke work", m.stroke_work / (mmHg * ml), 5947.9, "mmHg ml");
  found.add("mitral valve closes", m.mitral_closes, 4.3e-3, moment, "s");
  found.add("aortic valve opens", m.aortic_opens, 77.2e-3, moment, "s");
  found.add("aortic valve closes", m.aortic_closes, 267.6e-3, moment, "s");
  found.add("mitral valve opens", m.mitral_opens, 378.1e-3, moment, "s");
}

void check_loop(Findings& found, const std::string& name, const Cycle& cycle, double tolerance) {
  const auto check = [&](const char* what, double value, double reference, const char* unit) {
    found.add_within(fmt::format("{}: {}", name, what), value, reference, tolerance, unit);
  };
  const BeatMeasures& m = cycle.beats.back();
  const auto other = [&](std::size_t column) {
    return over_last_beat(cycle, [&](const Sample& s) { return s.signals.others.at(column); });
  };
  const Extent V = over_last_beat(cycle, [](const Sample& s) { return s.signals.volume; });
  check("largest volume", V.largest / ml, 136.744, "ml");
  check("least volume", V.least / ml, 66.964, "ml");
  check("ejection of_reference", 1.0 - V.least / V.largest, 0.5103, "");
  check("peak pressure", m.peak_pressure / mmHg, 119.681, "mmHg");
  check("largest arterial pressure", m.aortic_systolic / mmHg, 118.715, "mmHg");
  check("least arterial pressure", m.aortic_diastolic / mmHg, 79.825, "mmHg");
  check("largest right ventricular volume", other(2).largest / ml, 181.56, "ml");
  check("least right ventricular volume", other(2).least / ml, 111.78, "ml");
  check("right ventricular peak pressure", other(4).largest / mmHg, 25.055, "mmHg");
  check("largest pulmonary pressure", other(6).largest / mmHg, 21.39, "mmHg");
  check("least pulmonary pressure", other(6).least / mmHg, 18.51, "mmHg");
  check("stroke work", m.stroke_work / (mmHg * ml), 6609.8, "mmHg ml");
  found.add_error(fmt::format("{}: change of the total volume", name), cycle.blood_lost, 1e-10);
}

}  // namespace

void circulation_windkessel(Findings& found) {
  const Cycle cycle = circulation::run_alone(windkessel());
  const BeatMeasures& first = cycle.beats.front();
  found.add_within("first beat: ESV", first.end_systolic_volume / ml, 63.108, of_reference, "ml");
  found.add_within("first beat: peak pressure", first.peak_pressure / mmHg, 143.590, of_reference,
                   "mmHg");
  const std::size_t beat = cycle.samples.size() / cycle.beats.size();
  found.add_within("first beat: arterial pressure at its end",
                   cycle.samples.at(beat).signals.others.at(0) / mmHg, 81.2998, of_reference,
                   "mmHg");
  check_limit_cycle(found, cycle.beats.back());

  // of valves that open over more pressure than changes in a step: an event meets a step anywhere
  const auto pressure = [](double step) {
    CircuitParameters p = windkessel();
    p.beats = 1;
    p.step = step;
    p.valves.smoothing = 1.0 * mmHg;
    const Cycle c = circulation::run_alone(p);
    return c.samples.at(std::lround(0.4 / step)).signals.others.at(0);
  };
  const double p1 = pressure(2e-3);
  const double p2 = pressure(1e-3);
  const double p4 = pressure(5e-4);
  found.add("order in time", std::log2(std::abs((p1 - p2) / (p2 - p4))), 2.0, 0.1);
}

void circulation_closed_loop(Findings& found) {
  using circulation::ValveLaw;
  check_loop(found, "the published valves",
             circulation::run_alone(closed_loop(ValveLaw::arctangent)), of_reference);
  // which are not quite open at small pressures
  check_loop(found, "monotone valves", circulation::run_alone(closed_loop(ValveLaw::quadratic)),
             2e-3);
  const circulation::ClosedLoop circuit({}, {}, 0.8);
  found.add_within("total volume at the start", circuit.blood(circuit.start({})) / ml, 1617.876,
                   1e-6, "ml");
}

}  // namespace lv::verify
