#include "lv/heartbeat/cycle_record.hpp"

#include "lv/base/log.hpp"
#include "lv/base/units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace lv::heartbeat {
namespace {

using circulation::Cycle;
using circulation::Sample;
using circulation::Signals;
using units::mmHg;

constexpr double most_growth = 1.5;  // of a beat's change after a leap, which may overshoot

Archive archived(const Beat& beat) {
  Archive archive;
  store(beat.curves, archive);
  store(beat.moments, archive);
  store(beat.energy, archive);
  return archive;
}

void load_part(const Archive& archive, std::size_t nodes, Beat& beat) {
  beat.curves = load_curves(archive);
  beat.moments = load_moments(archive, nodes);
  beat.energy = load_energy(archive);
}

/// Why a beat has no end-diastole or no end-systole, by the pressures across its valves.
std::string why_incomplete(std::span<const Sample> beat) {
  const auto range = [&](double Signals::*gradient) {
    const auto [low, high] = std::minmax_element(beat.begin(), beat.end(), [&](auto& a, auto& b) {
      return a.signals.*gradient < b.signals.*gradient;
    });
    return std::pair(low->signals.*gradient, high->signals.*gradient);
  };
  const auto [lowest, highest] = range(&Signals::aortic_gradient);
  const Signals& end = beat.back().signals;
  if (lowest > 0.0 || (end.aortic_gradient > 0.0 && end.mitral_gradient > 0.0))
    return "the aortic valve is open while the heart fills: the arteries' pressure is less than "
           "that which fills it, so their resistance or compliance is too small";
  if (highest < 0.0)
    return fmt::format(
        "the aortic valve stays closed: the ventricle's pressure is less than the aorta's, by "
        "{:.3g} mmHg at least",
        -highest / mmHg);
  if (range(&Signals::mitral_gradient).first > 0.0)
    return "the mitral valve is open all the time: the pressure that fills the heart is more than "
           "the ventricle's";
  return "the ventricle does not relax within a beat";
}

}  // namespace

CycleRecord::CycleRecord(const CycleCourse& course) : course_(course), circuit_(course.circuit) {
  course_.calcium.mode = material::Calcium::Mode::transient;
  cycle_.period = period();
  cycle_.atrium = circulation::atrial_contraction(course_.circuit);
  cycle_.columns = circuit_.columns();
}

double CycleRecord::filling_pressure() const {
  return circuit_.signals(0.0, 0.0).filling_pressure;
}

void CycleRecord::start(double volume, double pressure) {
  circuit_.start_around(volume);
  blood_at_start_ = circuit_.blood();
  run_.time = 0.0;
  now_ = {0.0, circuit_.signals(0.0, pressure)};
  cycle_.samples.push_back(now_);
  log::info("filled to {:.2f} mmHg, the pressure before the mitral valve: {:.2f} ml",
            pressure / mmHg, 1e-3 * volume);
}

void CycleRecord::start_from(const std::vector<double>& states, double pressure) {
  circuit_.start_from(states);
  blood_at_start_ = circuit_.blood();
  run_.time = 0.0;
  now_ = {0.0, circuit_.signals(0.0, pressure)};
  cycle_.samples.push_back(now_);
}

void CycleRecord::begin_beat() {
  since_ = 0.0;
  begins_.push_back(cycle_.samples.size() - 1);
  const auto states = circuit_.states();
  states_before_.assign(states.begin(), states.end());
  run_.phase = 0;
  run_.beat.curves.clear();
  run_.beat.energy = {};
  run_.frames = 0;
  run_.frame_times.clear();
  run_.next_frame = begin();
  run_.next_curve = begin();
}

double CycleRecord::step_size(double longest) const {
  const double rest = period() - since_;
  return rest / std::max(1.0, std::ceil(rest / longest - 1e-9));
}

double CycleRecord::after(double dt) const {
  return dt < period() - since_ ? since_ + dt : period();
}

double CycleRecord::calcium(double since, double delay) const {
  const bool is_loop = course_.circuit.kind == circulation::Kind::closed_loop;
  double s = since - delay - (is_loop ? course_.circuit.left_ventricle.t_C : 0.0);
  for (int b = beat_ + beats_before_; s < 0.0 && b > 0; --b)
    s += period();
  return course_.calcium.at(s);
}

circulation::VolumeAfter CycleRecord::volume_after(double dt, double p) const {
  return circuit_.after(begin() + after(dt), dt, p);
}

void CycleRecord::step(double dt, double p, double cavity_volume, bool is_sample) {
  const double since = after(dt);
  const double t = begin() + since;
  circuit_.advance(t, dt, p);
  since_ = since;
  run_.time = t;
  before_ = std::exchange(now_, {t, circuit_.signals(t, p)});
  if (is_sample || beat_is_over())
    cycle_.samples.push_back(now_);
  cycle_.volume_gap =
      std::max(cycle_.volume_gap, std::abs(cavity_volume / circuit_.states().front() - 1.0));
}

const ValveEvent* CycleRecord::event() const {
  // a mitral valve that was closed may have opened once more before ejection
  const std::size_t first = run_.phase == 1 ? 0 : run_.phase;
  for (std::size_t e = first; e < valve_events.size() && e < run_.phase + 2; ++e)
    if (valve_events[e].between(before_.signals, now_.signals))
      return &valve_events[e];
  return nullptr;
}

void CycleRecord::mark(const ValveEvent& event, bool by_criterion, Snapshot wall) {
  run_.phase = static_cast<std::size_t>(&event - valve_events.data()) + 1;
  auto& moments = run_.beat.moments;
  std::erase_if(moments, [&](const NamedMoment& m) { return m.name == event.moment; });
  moments.push_back({event.moment, event.ends, by_criterion, std::move(wall)});
}

std::optional<int> CycleRecord::frame_number(double time) {
  while (run_.next_frame <= time)
    run_.next_frame += course_.frame_interval;
  if (!run_.frame_times.empty() && run_.frame_times.back() == time)
    return {};
  run_.frame_times.push_back(time);
  return run_.frames++;
}

CurveRow CycleRecord::row() const {
  CurveRow row;
  row.time = now_.time;
  row.phase = phase();
  row.pressure = now_.signals.pressure;
  row.volume = now_.signals.volume;
  return row;
}

const char* CycleRecord::phase() const {
  return valve_events[run_.phase % valve_events.size()].ends;
}

void CycleRecord::end_beat() {
  cycle_.beats.push_back(circulation::measure_beat(samples_of_beat(), cycle_.atrium));
  change_before_ = cycle_.change;
  const double of_states = circulation::largest_change(states_before_, circuit_.states());
  cycle_.change = of_states;
  const auto& now = cycle_.beats.back();
  if (beat_ > 0) {
    const auto& before = cycle_.beats[cycle_.beats.size() - 2];
    cycle_.change = std::max(
        cycle_.change, circulation::largest_change(
                           std::array{before.end_diastolic_volume, before.end_systolic_volume},
                           std::array{now.end_diastolic_volume, now.end_systolic_volume}));
    judge();
  }
  if (blood_at_start_ > 0.0)
    cycle_.blood_lost = std::abs(circuit_.blood() / blood_at_start_ - 1.0);
  std::erase_if(run_.beat.moments, [&](const NamedMoment& m) {
    return m.wall.time < begin();  // what did not happen in this beat
  });
  ++beat_;
  whole_.energy = run_.beat.energy;
  whole_.curves = run_.beat.curves;
  whole_.moments = run_.beat.moments;
  const auto in_ml = [](double volume) {
    return std::isnan(volume) ? "none" : fmt::format("{:.1f} ml", 1e-3 * volume);
  };
  log::info(
      "beat {}: EDV {}, ESV {}, peak {:.1f} mmHg; it changed the states by {:.2g} of themselves at "
      "most",
      beat_, in_ml(now.end_diastolic_volume), in_ml(now.end_systolic_volume),
      now.peak_pressure / mmHg, cycle_.change);
  if (cycle_.leaps > 0 && cycle_.change > most_growth * change_before_)
    leaps_settle_ = false;
  if (course_.cycle.leap && leaps_settle_ && !done() && of_states > course_.cycle.tolerance)
    leap();
}

/// What beats to come would add costs a fraction of a second, but tells nothing where this one's
/// change is too large already.
void CycleRecord::judge() {
  const double tolerance = course_.cycle.tolerance;
  const bool changed_little = tolerance > 0.0 && cycle_.change <= tolerance;
  cycle_.to_come = changed_little
                       ? circulation::change_to_come(course_.circuit, course_.cycle.step, beaten())
                       : 0.0;
  cycle_.is_limit = circulation::is_limit_cycle(cycle_.change, cycle_.to_come, tolerance);
}

circulation::BeatenStates CycleRecord::beaten() const {
  return {states_before_, circuit_.states(), samples_of_beat(), cycle_.beats.back()};
}

/// The vessels of a closed loop take tens of beats to share out its blood: this saves them.
void CycleRecord::leap() {
  const bool is_loop = course_.circuit.kind == circulation::Kind::closed_loop;
  if (!is_loop || course_.cycle.tolerance == 0.0)
    return;
  const auto limit = circulation::foretold_limit(course_.circuit, course_.cycle.step, beaten());
  if (!limit)
    return;
  circuit_.leap_to(*limit);
  now_.signals = circuit_.signals(now_.time, pressure());
  ++cycle_.leaps;
}

void CycleRecord::stop_early(const NoSolution& error, const std::string& words,
                             const Observers& observers) {
  if (beat_ == 0) {
    show_progress(observers);
    throw error;
  }
  cut_short();
  log::warn("{}; what follows is of the {} whole beat{} before it", words, beat_,
            beat_ == 1 ? "" : "s");
}

void CycleRecord::cut_short() {
  cycle_.cut_short = true;
  cycle_.samples.resize(begins_.back() + 1);
}

bool CycleRecord::done() const {
  return cycle_.is_limit || beat_ >= course_.cycle.beats || cycle_.cut_short;
}

double CycleRecord::beats_left() const {
  const double most = course_.cycle.beats - beat_ - 1;
  constexpr double usual = 6.0;
  const double fall = std::log(change_before_ / cycle_.change);
  if (beat_ < 3 || !(fall > 0.0))
    return std::min(most, std::max(usual - beat_ - 1.0, 0.0));
  const double above = std::max(cycle_.change, cycle_.to_come / circulation::most_to_come);
  return std::clamp(std::ceil(std::log(above / course_.cycle.tolerance) / fall) - 1.0, 0.0, most);
}

void CycleRecord::show_progress(const Observers& observers) {
  if (!observers.curves || cycle_.samples.empty())
    return;
  run_.beat.cycle = cycle_;
  observers.curves(run_);
  run_.beat.cycle.reset();
}

Beat CycleRecord::result(const Observers& observers) {
  whole_.steps = run_.beat.steps;
  whole_.retries = run_.beat.retries;
  whole_.wall_clock = run_.beat.wall_clock;
  if (whole_.find(end_systole) == nullptr || whole_.find(end_diastole) == nullptr) {
    show_progress(observers);
    throw NoSolution("the last beat has no end-diastole or no end-systole: " +
                         why_incomplete(circulation::samples_of(cycle_, beat_ - 1)),
                     "Look at cycle.csv in 03_beat.part");
  }
  if (!cycle_.is_limit)
    log::warn(
        "no limit cycle after {} beat{}: the last changed the states by {:.2g} of themselves{}",
        beat_, beat_ == 1 ? "" : "s", cycle_.change,
        cycle_.to_come > 0.0 ? fmt::format(", and beats to come would add {:.2g}", cycle_.to_come)
                             : "");
  whole_.cycle = std::move(cycle_);
  if (observers.curves) {
    run_.beat = whole_;
    observers.curves(run_);
  }
  return std::move(whole_);
}

void CycleRecord::store(Archive& archive) const {
  archive.set("circuit", circuit_.numbers());
  archive.set("run", {run_.time, static_cast<double>(run_.phase), run_.next_frame, run_.next_curve,
                      run_.largest_velocity, static_cast<double>(run_.halvings),
                      static_cast<double>(run_.good_steps), static_cast<double>(run_.patience),
                      static_cast<double>(run_.flips), static_cast<double>(run_.beat.steps),
                      static_cast<double>(run_.beat.retries), run_.beat.wall_clock,
                      static_cast<double>(beat_), since_, change_before_, blood_at_start_,
                      pressure(), leaps_settle_ ? 1.0 : 0.0});
  archive.set("states_before", states_before_);
  archive.set("begins", {begins_.begin(), begins_.end()});
  archive.set("frame_times", run_.frame_times);
  heartbeat::store(cycle_, archive);
  archive.add("beat", archived(run_.beat));
  archive.add("whole", archived(whole_));
}

void CycleRecord::load(Archive& archive, std::size_t nodes) {
  const auto& n = archive.get_rows("run", 18, 1, {.missing = true});
  const auto whole = [&](double number, double most = std::numeric_limits<int>::max()) {
    return archive.whole_number(number, {0.0, most});
  };
  run_.time = n[0];
  run_.phase = static_cast<std::size_t>(whole(n[1], valve_events.size()));
  run_.next_frame = n[2];
  run_.next_curve = n[3];
  run_.largest_velocity = n[4];
  run_.halvings = whole(n[5], most_halvings);
  run_.good_steps = whole(n[6]);
  run_.patience = whole(n[7]);
  run_.flips = whole(n[8]);
  run_.beat.steps = whole(n[9]);
  run_.beat.retries = whole(n[10]);
  run_.beat.wall_clock = n[11];
  beat_ = whole(n[12], course_.cycle.beats);
  since_ = n[13];
  change_before_ = n[14];
  blood_at_start_ = n[15];
  leaps_settle_ = whole(n[17], 1.0) == 1;
  cycle_ = load_cycle(archive);
  states_before_ = archive.get_rows("states_before", 1, circuit_.states().size());
  for (const int begin : archive.get_whole("begins", beat_ + 1,
                                           {0.0, static_cast<double>(cycle_.samples.size()) - 1.0}))
    begins_.push_back(static_cast<std::size_t>(begin));
  run_.frame_times = archive.get_rows("frame_times", 1);
  run_.frames = static_cast<int>(run_.frame_times.size());
  load_part(archive.take("beat"), nodes, run_.beat);
  load_part(archive.take("whole"), nodes, whole_);
  if (!circuit_.takes(archive.get("circuit").size()))
    archive.refuse("its circuit is another");
  circuit_.set_numbers(archive.get_rows("circuit", 1));
  now_ = {run_.time, circuit_.signals(run_.time, n[16])};
}

void store(const circulation::Cycle& cycle, Archive& archive) {
  std::vector<double> numbers;
  for (const Sample& s : cycle.samples) {
    const Signals& g = s.signals;
    numbers.insert(numbers.end(),
                   {s.time, g.volume, g.pressure, g.filling_pressure, g.aortic_pressure,
                    g.mitral_gradient, g.aortic_gradient, g.mitral_flow, g.aortic_flow});
    numbers.insert(numbers.end(), g.others.begin(), g.others.end());
  }
  std::vector<std::string> names, units;
  for (const circulation::Column& c : cycle.columns) {
    names.push_back(c.name);
    units.push_back(c.unit);
  }
  archive.set("cycle.samples", std::move(numbers));
  archive.set_words("cycle.columns", names);
  archive.set_words("cycle.units", units);
  archive.set("cycle.atrium", {cycle.atrium});
  archive.set(
      "cycle.facts",
      {cycle.period, static_cast<double>(cycle.beats.size()), cycle.is_limit ? 1.0 : 0.0,
       cycle.cut_short ? 1.0 : 0.0, cycle.change, cycle.blood_lost, cycle.volume_gap,
       static_cast<double>(cycle.gave_way), static_cast<double>(cycle.leaps), cycle.to_come});
}

namespace {

std::vector<Sample> load_samples(const Archive& archive, std::size_t columns) {
  constexpr std::size_t own = 9;
  const auto& numbers = archive.get_rows("cycle.samples", own + columns);
  std::vector<Sample> samples;
  for (auto n = numbers.begin(); n != numbers.end(); n += static_cast<int>(own + columns)) {
    const std::vector<double> others(n + own, n + static_cast<int>(own + columns));
    samples.push_back({n[0], {n[1], n[2], n[3], n[4], n[5], n[6], n[7], n[8], others}});
  }
  return samples;
}

}  // namespace

void store(const EnergyBalance& energy, Archive& archive) {
  archive.set("energy", {energy.pressure, energy.muscle, energy.stored, energy.kinetic,
                         energy.supports, energy.viscosity, energy.base});
  archive.set("work_density", energy.work_density);
}

EnergyBalance load_energy(const Archive& archive) {
  const auto& n = archive.get_rows("energy", 7, 1);
  return {n[0], n[1], archive.get_rows("work_density", 1), n[2], n[3], n[4], n[5], n[6]};
}

circulation::Cycle load_cycle(const Archive& archive) {
  const auto& facts = archive.get_rows("cycle.facts", 10, 1, not_negative);
  const auto names = archive.get_words("cycle.columns");
  const auto units = archive.get_words("cycle.units");
  if (names.size() != units.size())
    archive.refuse("it has more columns than units, or fewer");
  Cycle cycle;
  for (std::size_t i = 0; i < names.size(); ++i)
    cycle.columns.push_back({names[i], units[i]});
  cycle.samples = load_samples(archive, names.size());
  if (cycle.samples.empty())
    archive.refuse("it has no samples of its heartbeats");
  cycle.period = facts[0];
  cycle.atrium = archive.get_rows("cycle.atrium", 1, 1, {0.0, cycle.period, true})[0];
  cycle.is_limit = archive.whole_number(facts[2], {0.0, 1.0}) == 1;
  cycle.cut_short = archive.whole_number(facts[3], {0.0, 1.0}) == 1;
  cycle.change = facts[4];
  cycle.blood_lost = facts[5];
  cycle.volume_gap = facts[6];
  cycle.gave_way = archive.whole_number(facts[7], {0.0, 1e6});
  cycle.leaps = archive.whole_number(facts[8], {0.0, 1e6});
  cycle.to_come = facts[9];
  const double most = cycle.samples.back().time / cycle.period + 1e-9;
  const int beats = archive.whole_number(facts[1], {0.0, most});
  for (int b = 0; b < beats; ++b)
    cycle.beats.push_back(
        circulation::measure_beat(circulation::samples_of(cycle, b), cycle.atrium));
  return cycle;
}

}  // namespace lv::heartbeat
