#include "lv/heartbeat/cycle.hpp"

#include "lv/base/check.hpp"
#include "lv/base/interrupt.hpp"
#include "lv/base/log.hpp"
#include "lv/base/parallel.hpp"
#include "lv/base/time_left.hpp"
#include "lv/base/units.hpp"
#include "lv/circulation/circuit.hpp"
#include "lv/heartbeat/immersed_beat.hpp"
#include "lv/implicit/time_engine.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <optional>

namespace lv::heartbeat {
namespace {

using circulation::Circuit;
using circulation::Cycle;
using circulation::Sample;
using circulation::Signals;
using implicit::TimeEngine;
using units::mmHg;

/// An event of a valve: the pressure across it changes its sign.
struct ValveEvent {
  const char* moment;
  const char* ends;  ///< the phase before it
  double Signals::*gradient;
  bool opens;

  [[nodiscard]] bool between(const Signals& a, const Signals& b) const {
    const double x = a.*gradient;
    const double y = b.*gradient;
    return opens ? x <= 0.0 && y > 0.0 : x >= 0.0 && y < 0.0;
  }
  /// Share of the way from one to the other.
  [[nodiscard]] double place(const Signals& a, const Signals& b) const {
    return a.*gradient / (a.*gradient - b.*gradient);
  }
};

constexpr std::array<ValveEvent, 4> valve_events{
    {{end_diastole, "filling", &Signals::mitral_gradient, false},
     {aortic_opening, "contraction", &Signals::aortic_gradient, true},
     {end_systole, "ejection", &Signals::aortic_gradient, false},
     {mitral_opening, "relaxation", &Signals::mitral_gradient, true}}};
constexpr std::array<const char*, 5> phase_after{"filling", "contraction", "ejection", "relaxation",
                                                 "filling"};

constexpr int most_step_halvings = 8;
constexpr int halvings_before_giving_way = 3;
constexpr int good_steps_to_grow = 10;
constexpr int checkpoint_every =
    25;  ///< steps; not seconds, since the solver begins anew with each

/// Between two walls of one step, where a valve opens or closes.
Snapshot between(Snapshot a, const Snapshot& b, double share) {
  a.time = std::lerp(a.time, b.time, share);
  a.pressure = std::lerp(a.pressure, b.pressure, share);
  a.volume = std::lerp(a.volume, b.volume, share);
  for (std::size_t i = 0; i < a.positions.size(); ++i)
    a.positions[i] += share * (b.positions[i] - a.positions[i]);
  for (std::size_t c = 0; c < a.stress.size(); ++c) {
    const solid::CellStress first = a.stress[c];
    a.stress[c].add(-share, first);
    a.stress[c].add(share, b.stress[c]);
  }
  return a;
}

Archive archived(const implicit::State& state) {
  Archive archive;
  archive.set("positions", flat(state.positions));
  archive.set("pressures", state.pressures);
  archive.set("cavity_pressure", {state.cavity_pressure});
  return archive;
}

Archive archived(const TimeEngine::Moment& moment) {
  Archive archive;
  archive.add("now", archived(moment.now));
  archive.add("before", archived(moment.before));
  archive.set("dt_before", {moment.dt_before});
  archive.set("velocity", flat(moment.rates.velocity));
  archive.set("acceleration", flat(moment.rates.acceleration));
  archive.set("muscle", moment.muscle);
  return archive;
}

implicit::State load_state(const Archive& archive, const std::string& name) {
  return {vectors(archive.get_rows(name + ".positions", 3)),
          archive.get_rows(name + ".pressures", 1), archive.number(name + ".cavity_pressure")};
}

TimeEngine::Moment load_moment(const Archive& archive) {
  TimeEngine::Moment moment;
  moment.dt_before = archive.number("dt_before");
  moment.rates.velocity = vectors(archive.get_rows("velocity", 3));
  moment.rates.acceleration = vectors(archive.get_rows("acceleration", 3));
  moment.muscle = archive.get_rows("muscle", 1);
  moment.now = load_state(archive, "now");
  if (moment.dt_before > 0.0)  // else there is none
    moment.before = load_state(archive, "before");
  return moment;
}

Archive archived(const Beat& beat) {
  Archive archive;
  store(beat.curves, archive);
  store(beat.moments, archive);
  store(beat.energy, archive);
  return archive;
}

class CycleRun {
 public:
  CycleRun(const CycleSetup& setup, std::filesystem::path folder, const Observers& observers);

  Beat run();
  Outcome<MeasuredBeats> measure(const BeatBegin* from);

 private:
  using Passed = TimeEngine::Passed;

  void begin(const BeatBegin* from);
  void beats();
  void start();
  void start_from(const BeatBegin& from);
  void beat();
  void begin_beat();
  void step();
  void end_beat();
  [[nodiscard]] bool gives_way(const implicit::TimeStep& step,
                               const implicit::VolumeOfPressure& volume);
  void shorten(const std::string& why);
  void stop_early(const std::string& why);
  void show_progress();
  void count_time();
  Beat result();

  void add_work(const Passed& before);
  void note_events(const Passed& before);
  void mark(const ValveEvent& event, bool by_criterion, Snapshot wall);
  void write_frame(const Snapshot& wall);
  void record_curve();
  void report_progress(const implicit::NewtonReport& newton);

  void save();
  void resume(Archive archive);
  [[nodiscard]] TimeEngine::Moment load_engine(const Archive& archive) const;
  void load_part(const Archive& archive, Beat& beat) const;

  [[nodiscard]] Snapshot snapshot(const Passed& at, const Sample& sample) const;
  [[nodiscard]] double begin_of_beat() const { return beat_ * cycle_.period; }
  [[nodiscard]] double calcium(double since, double delay) const;
  [[nodiscard]] double mean_calcium() const;
  [[nodiscard]] std::vector<implicit::CalciumStep> calcium_between(double since, double then) const;
  [[nodiscard]] double step_size() const;
  [[nodiscard]] double beats_left() const;
  [[nodiscard]] double seconds_left() const;  ///< negative: not known
  [[nodiscard]] bool done() const {
    return cycle_.is_limit || beat_ >= setup_.cycle.beats || cycle_.cut_short;
  }

  const CycleSetup& setup_;
  std::filesystem::path folder_;
  const Observers& observers_;
  TimeEngine engine_;
  std::vector<double> delays_;  ///< of this rank's points [s]; a single one: of all
  Circuit circuit_;
  Cycle cycle_;
  RunState run_;           ///< of the beat underway; its phase is the number of the next event
  Beat whole_;             ///< the last whole beat: curves and moments
  int beat_ = 0;           ///< whole ones so far
  int beats_before_ = 0;   ///< of the same kind, before the first; as many as calcium lasts
  bool may_stop_ = false;  ///< without a single whole beat
  std::string why_stopped_;
  double since_ = 0.0;                 ///< the beat began [s]
  std::vector<std::size_t> begins_;    ///< the samples that beats begin with
  std::vector<double> states_before_;  ///< of the circuit when the beat began
  double change_before_ =
      std::numeric_limits<double>::quiet_NaN();  ///< of the beat before the last
  double blood_at_start_ = 0.0;
  double stored_before_ = 0.0, kinetic_before_ = 0.0;  ///< energy when the beat began [mN mm]
  TimeLeft reports_;
  std::optional<double> begun_;    ///< the beat underway, if in this process [s]
  double seconds_of_beat_ = -1.0;  ///< the last whole one of this process; negative: none [s]
  std::chrono::steady_clock::time_point counted_ = std::chrono::steady_clock::now();
};

CycleRun::CycleRun(const CycleSetup& setup, std::filesystem::path folder,
                   const Observers& observers)
    : setup_(setup),
      folder_(std::move(folder)),
      observers_(observers),
      engine_(setup.mesh, setup.model, setup.solver, setup.cycle.spectral_radius),
      delays_(setup.activation_times.empty()
                  ? std::vector<double>{0.0}
                  : engine_.equations().at_points(setup.activation_times)),
      circuit_(setup.circuit) {
  cycle_.period = setup.circuit.period;
  cycle_.columns = circuit_.columns();
}

Beat CycleRun::run() {
  begin(nullptr);
  beats();
  return result();
}

Outcome<MeasuredBeats> CycleRun::measure(const BeatBegin* from) {
  may_stop_ = true;
  beats_before_ = from == nullptr ? 0 : 1;
  begin(from);
  beats();
  if (cycle_.cut_short)
    return Unsolved{why_stopped_, ""};
  const auto states = circuit_.states();
  return MeasuredBeats{std::move(cycle_), {engine_.moment(), {states.begin(), states.end()}}};
}

void CycleRun::begin(const BeatBegin* from) {
  const std::filesystem::path checkpoint = folder_ / checkpoint_name;
  if (parallel::root_says(std::filesystem::exists(checkpoint)))
    resume(Archive::read(checkpoint));
  else if (from != nullptr)
    start_from(*from);
  else
    start();
}

void CycleRun::beats() {
  try {
    while (!done())
      beat();
  } catch (const Interrupted&) {
    show_progress();
    throw Interrupted(fmt::format(
        "stopped at {:.3f} s of beat {}; run the same command again to go on", since_, beat_ + 1));
  }
}

/// Fills the wall to the pressure before the mitral valve, so that it is neither open nor closed.
void CycleRun::start() {
  const double pressure = circuit_.signals(0.0, 0.0).filling_pressure;
  const double volume = engine_.fill(pressure, setup_.calcium.Ca_0).value();
  circuit_.start_around(volume);
  blood_at_start_ = circuit_.blood();
  cycle_.samples.push_back({0.0, circuit_.signals(0.0, pressure)});
  log::info("filled to {:.2f} mmHg, the pressure before the mitral valve: {:.2f} ml",
            pressure / mmHg, 1e-3 * volume);
  begin_beat();
}

void CycleRun::start_from(const BeatBegin& from) {
  engine_.restore(from.wall);
  circuit_.start_from(from.circuit);
  blood_at_start_ = circuit_.blood();
  cycle_.samples.push_back({0.0, circuit_.signals(0.0, engine_.pressure())});
  begin_beat();
}

void CycleRun::beat() {
  while (since_ < cycle_.period) {
    step();
    if (cycle_.cut_short)
      return;
  }
  end_beat();
}

void CycleRun::begin_beat() {
  since_ = 0.0;
  count_time();
  begun_ = run_.beat.wall_clock;
  begins_.push_back(cycle_.samples.size() - 1);
  const auto states = circuit_.states();
  states_before_.assign(states.begin(), states.end());
  run_.phase = 0;
  run_.beat.curves.clear();
  run_.beat.energy = {};
  stored_before_ = engine_.stored_energy();
  kinetic_before_ = engine_.kinetic_energy();
  run_.frames = 0;
  run_.frame_times.clear();
  run_.next_frame = begin_of_beat();
  const Snapshot now = snapshot(engine_.present(), cycle_.samples.back());
  if (cycle_.samples.back().signals.mitral_gradient < 0.0)
    mark(valve_events[0], false, now);
  else
    write_frame(now);
  record_curve();
  save();
}

/// One step, of which nothing remains when it fails.
void CycleRun::step() {
  interrupt::check_together();
  const double dt = step_size();
  const double since = dt < cycle_.period - since_ ? since_ + dt : cycle_.period;
  const double t = begin_of_beat() + since;
  const Passed before = engine_.present();
  const auto volume = [&](double p) -> implicit::GivenVolume {
    const auto [after, per_pressure] = circuit_.after(t, dt, p);
    return {after, per_pressure};
  };
  const implicit::TimeStep step{dt, calcium_between(since_, since)};
  const auto newton = engine_.advance(step, volume);
  if (!newton.converged && !gives_way(step, volume)) {
    shorten(newton.why);
    return;
  }
  circuit_.advance(t, dt, engine_.pressure());
  since_ = since;
  run_.time = t;
  ++run_.beat.steps;
  cycle_.samples.push_back({t, circuit_.signals(t, engine_.pressure())});
  cycle_.volume_gap = std::max(cycle_.volume_gap,
                               std::abs(engine_.cavity_volume() / circuit_.states().front() - 1.0));
  add_work(before);
  note_events(before);
  if (t >= run_.next_frame)
    write_frame(snapshot(engine_.present(), cycle_.samples.back()));
  record_curve();
  if (run_.halvings > 0 && ++run_.good_steps >= good_steps_to_grow) {
    --run_.halvings;
    run_.good_steps = 0;
  }
  if (reports_.due())
    report_progress(newton);
  if (run_.beat.steps % checkpoint_every == 0 && since_ < cycle_.period)
    save();
}

void CycleRun::add_work(const Passed& before) {
  const TimeEngine::Work work = engine_.work_since(before);
  EnergyBalance& sum = run_.beat.energy;
  sum.pressure += work.pressure;
  sum.muscle += work.muscle;
  sum.supports += work.supports;
  sum.viscosity += work.viscosity;
}

/// Where shorter steps did not help.
bool CycleRun::gives_way(const implicit::TimeStep& step, const implicit::VolumeOfPressure& volume) {
  if (run_.halvings != halvings_before_giving_way || !engine_.give_way(step, volume))
    return false;
  ++cycle_.gave_way;
  return true;
}

void CycleRun::shorten(const std::string& why) {
  ++run_.beat.retries;
  run_.good_steps = 0;
  if (++run_.halvings > most_step_halvings) {
    stop_early(why);
    return;
  }
  log::info("a step at {:.4f} s of beat {} failed ({}); the next is {:.3g} s", since_, beat_ + 1,
            why, step_size());
}

/// What whole beats were reached stays; without any there is nothing to show.
void CycleRun::stop_early(const std::string& why) {
  const std::string what = fmt::format(
      "at {:.4f} s of beat {} no equilibrium of wall and circuit was found, even with a step of "
      "{:.2g} s: {}",
      since_, beat_ + 1, std::ldexp(setup_.cycle.step, -most_step_halvings), why);
  if (beat_ == 0 && !may_stop_) {
    show_progress();
    throw RunError(what,
                   "Look at cycle.csv up to there: a circuit that empties the heart, or overfills "
                   "it, has other resistances, pressures or contractility than meant; a thin or "
                   "scarred wall may need what holds muscle back (muscle.viscosity = \"100 Pa "
                   "s\"); else try a finer mesh");
  }
  cycle_.cut_short = true;
  cycle_.samples.resize(begins_.back() + 1);
  why_stopped_ = what;
  if (may_stop_)
    return;
  log::warn("{}; what follows is of the {} whole beat{} before it", what, beat_,
            beat_ == 1 ? "" : "s");
}

void CycleRun::end_beat() {
  const auto samples = std::span(cycle_.samples).subspan(begins_.back());
  cycle_.beats.push_back(circulation::measure_beat(samples));
  change_before_ = cycle_.change;
  cycle_.change = circulation::largest_change(states_before_, circuit_.states());
  const auto& now = cycle_.beats.back();
  if (beat_ > 0) {
    const auto& before = cycle_.beats[cycle_.beats.size() - 2];
    cycle_.change = std::max(
        cycle_.change, circulation::largest_change(
                           std::array{before.end_diastolic_volume, before.end_systolic_volume},
                           std::array{now.end_diastolic_volume, now.end_systolic_volume}));
    cycle_.is_limit = cycle_.change <= setup_.cycle.tolerance;
  }
  if (blood_at_start_ > 0.0)
    cycle_.blood_lost = std::abs(circuit_.blood() / blood_at_start_ - 1.0);
  std::erase_if(run_.beat.moments, [&](const NamedMoment& m) {
    return m.wall.time < begin_of_beat();  // what did not happen in this beat
  });
  ++beat_;
  count_time();
  if (begun_)
    seconds_of_beat_ = run_.beat.wall_clock - *begun_;
  run_.beat.energy.stored = engine_.stored_energy() - stored_before_;
  run_.beat.energy.kinetic = engine_.kinetic_energy() - kinetic_before_;
  whole_.energy = run_.beat.energy;
  whole_.curves = run_.beat.curves;
  whole_.moments = run_.beat.moments;
  log::info(
      "beat {}: EDV {:.1f} ml, ESV {:.1f} ml, peak {:.1f} mmHg; it changed the states by {:.2g} of "
      "themselves at most",
      beat_, 1e-3 * now.end_diastolic_volume, 1e-3 * now.end_systolic_volume,
      now.peak_pressure / mmHg, cycle_.change);
  if (!done())
    begin_beat();
}

Beat CycleRun::result() {
  count_time();
  whole_.steps = run_.beat.steps;
  whole_.retries = run_.beat.retries;
  whole_.wall_clock = run_.beat.wall_clock;
  if (whole_.find(end_systole) == nullptr || whole_.find(end_diastole) == nullptr)
    throw RunError(
        "The aortic valve did not open and close in the last beat, which has no "
        "end-systole",
        "Look at cycle.csv: the ventricle does not reach the aorta's pressure, or does "
        "not relax within a beat");
  if (!cycle_.is_limit)
    log::warn("no limit cycle after {} beats: the last changed the states by {:.2g} of themselves",
              beat_, cycle_.change);
  whole_.cycle = std::move(cycle_);
  whole_.activation_times = setup_.activation_times;
  if (observers_.curves) {
    run_.beat = whole_;
    observers_.curves(run_);
  }
  return std::move(whole_);
}

void CycleRun::note_events(const Passed& before) {
  const Sample& a = cycle_.samples[cycle_.samples.size() - 2];
  const Sample& b = cycle_.samples.back();
  // one event may be missed: the mitral valve was closed all the time, or was not
  for (std::size_t e = run_.phase; e < valve_events.size() && e < run_.phase + 2; ++e) {
    const ValveEvent& event = valve_events[e];
    if (!event.between(a.signals, b.signals))
      continue;
    const double share = event.place(a.signals, b.signals);
    const Snapshot first = snapshot(before, a);
    const Snapshot second = snapshot(engine_.present(), b);
    mark(event, true, between(first, second, share));
    break;
  }
}

void CycleRun::mark(const ValveEvent& event, bool by_criterion, Snapshot wall) {
  run_.phase = static_cast<std::size_t>(&event - valve_events.data()) + 1;
  auto& moments = run_.beat.moments;
  std::erase_if(moments, [&](const NamedMoment& m) { return m.name == event.moment; });
  moments.push_back({event.moment, event.ends, by_criterion, std::move(wall)});
  write_frame(moments.back().wall);
}

void CycleRun::write_frame(const Snapshot& wall) {
  while (run_.next_frame <= wall.time)
    run_.next_frame += setup_.frame_interval;
  const bool is_there = !run_.frame_times.empty() && run_.frame_times.back() == wall.time;
  if (!observers_.frame || is_there)
    return;
  const int number = run_.frames++;
  run_.frame_times.push_back(wall.time);
  observers_.frame({number, wall, run_, {}});
}

void CycleRun::record_curve() {
  const Sample& s = cycle_.samples.back();
  CurveRow row;
  row.time = s.time;
  row.phase = phase_after[run_.phase];
  row.pressure = s.signals.pressure;
  row.volume = s.signals.volume;
  row.calcium = mean_calcium();
  row.mean_tension = engine_.mean_tension();
  row.kinetic_energy = engine_.kinetic_energy();
  for (const Vec3& v : engine_.rates().velocity)
    row.largest_velocity = std::max(row.largest_velocity, v.norm());
  row.step = step_size();
  row.min_J = row.max_J = std::numeric_limits<double>::quiet_NaN();  // not looked at
  run_.beat.curves.push_back(row);
}

Snapshot CycleRun::snapshot(const Passed& at, const Sample& sample) const {
  return {sample.time, sample.signals.pressure, sample.signals.volume, at.state.positions,
          {},          engine_.cell_stress(at)};
}

/// At a point that is activated so long after the others' calcium begins. What began in an earlier
/// beat goes on until the point is activated again.
double CycleRun::calcium(double since, double delay) const {
  const bool is_loop = setup_.circuit.kind == circulation::Kind::closed_loop;
  double s = since - delay - (is_loop ? setup_.circuit.left_ventricle.t_C : 0.0);
  for (int b = beat_ + beats_before_; s < 0.0 && b > 0; --b)
    s += cycle_.period;
  material::Calcium transient = setup_.calcium;
  transient.mode = material::Calcium::Mode::transient;
  return transient.at(s);
}

std::vector<implicit::CalciumStep> CycleRun::calcium_between(double since, double then) const {
  std::vector<implicit::CalciumStep> steps;
  for (const double delay : delays_)
    steps.push_back({calcium(since, delay), calcium(then, delay)});
  return steps;
}

double CycleRun::mean_calcium() const {
  if (setup_.activation_times.empty())
    return calcium(since_, 0.0);
  std::vector<double> at_points;
  for (const double delay : delays_)
    at_points.push_back(calcium(since_, delay));
  return engine_.equations().mean(at_points);
}

/// The rest of the beat in equal steps.
double CycleRun::step_size() const {
  const double rest = cycle_.period - since_;
  const double longest = std::ldexp(setup_.cycle.step, -run_.halvings);
  return rest / std::max(1.0, std::ceil(rest / longest - 1e-9));
}

/// After the one underway, if changes go on falling as they did.
double CycleRun::beats_left() const {
  const double most = setup_.cycle.beats - beat_ - 1;
  constexpr double usual = 6.0;
  const double fall = std::log(change_before_ / cycle_.change);
  if (beat_ < 3 || !(fall > 0.0))
    return std::min(most, std::max(usual - beat_ - 1.0, 0.0));
  return std::clamp(std::ceil(std::log(cycle_.change / setup_.cycle.tolerance) / fall) - 1.0, 0.0,
                    most);
}

/// Steps of different phases take different times, so that only a whole beat tells of others.
double CycleRun::seconds_left() const {
  return seconds_of_beat_ * (1.0 - since_ / cycle_.period + beats_left());
}

void CycleRun::report_progress(const implicit::NewtonReport& newton) {
  const CurveRow& now = run_.beat.curves.back();
  log::info(
      "beat {} (of {} at most)  {:.3f} of {:.3g} s  {}  {:.1f} mmHg  {:.1f} ml  tension {:.1f} "
      "kPa  {} corrections, {} {}{}",
      beat_ + 1, setup_.cycle.beats, since_, cycle_.period, now.phase, now.pressure / mmHg,
      1e-3 * now.volume, now.mean_tension, newton.iterations, newton.factorisations,
      newton.factorisations == 1 ? "tangent" : "tangents", time_left(seconds_left()));
  show_progress();
}

/// Tells of all beats so far.
void CycleRun::show_progress() {
  if (!observers_.curves)
    return;
  run_.beat.cycle = cycle_;
  observers_.curves(run_);
  run_.beat.cycle.reset();
}

void CycleRun::count_time() {
  const auto now = std::chrono::steady_clock::now();
  run_.beat.wall_clock += std::chrono::duration<double>(now - counted_).count();
  counted_ = now;
}

void CycleRun::save() {
  count_time();
  const TimeEngine::Moment moment = engine_.moment();
  parallel::on_root([&] {
    Archive archive;
    archive.add("engine", archived(moment));
    archive.set("circuit", circuit_.numbers());
    archive.set("run",
                {run_.time, static_cast<double>(run_.phase), run_.next_frame,
                 static_cast<double>(run_.halvings), static_cast<double>(run_.good_steps),
                 static_cast<double>(run_.beat.steps), static_cast<double>(run_.beat.retries),
                 run_.beat.wall_clock, static_cast<double>(beat_), since_, change_before_,
                 blood_at_start_, stored_before_, kinetic_before_});
    archive.set("states_before", states_before_);
    archive.set("begins", {begins_.begin(), begins_.end()});
    archive.set("frame_times", run_.frame_times);
    store(cycle_, archive);
    archive.add("beat", archived(run_.beat));
    archive.add("whole", archived(whole_));
    archive.write(folder_ / checkpoint_name);
  });
}

void CycleRun::resume(Archive archive) {
  const auto& n = archive.get_rows("run", 14, 1, {.missing = true});
  const auto whole = [&](double number, double most) {
    return archive.whole_number(number, {0.0, most});
  };
  constexpr double any = std::numeric_limits<int>::max();
  run_.time = n[0];
  run_.phase = static_cast<std::size_t>(whole(n[1], valve_events.size()));
  run_.next_frame = n[2];
  run_.halvings = whole(n[3], most_step_halvings);
  run_.good_steps = whole(n[4], any);
  run_.beat.steps = whole(n[5], any);
  run_.beat.retries = whole(n[6], any);
  run_.beat.wall_clock = n[7];
  beat_ = whole(n[8], setup_.cycle.beats);
  since_ = n[9];
  change_before_ = n[10];
  blood_at_start_ = n[11];
  stored_before_ = n[12];
  kinetic_before_ = n[13];
  cycle_ = load_cycle(archive);
  states_before_ = archive.get_rows("states_before", 1, circuit_.states().size());
  for (const int begin : archive.get_whole("begins", beat_ + 1,
                                           {0.0, static_cast<double>(cycle_.samples.size()) - 1.0}))
    begins_.push_back(static_cast<std::size_t>(begin));
  run_.frame_times = archive.get_rows("frame_times", 1);
  run_.frames = static_cast<int>(run_.frame_times.size());
  load_part(archive.take("beat"), run_.beat);
  load_part(archive.take("whole"), whole_);
  if (!circuit_.takes(archive.get("circuit").size()))
    archive.refuse("its circuit is another");
  circuit_.set_numbers(archive.get_rows("circuit", 1));
  engine_.restore(load_engine(archive.take("engine")));
  log::info("going on from {:.4f} s of beat {}", since_, beat_ + 1);
}

TimeEngine::Moment CycleRun::load_engine(const Archive& archive) const {
  const implicit::Rates& rates = engine_.rates();
  const implicit::State& state = engine_.state();
  archive.get_rows("velocity", 3, rates.velocity.size());
  archive.get_rows("acceleration", 3, rates.acceleration.size());
  archive.get_rows("muscle", 1, engine_.muscle_numbers());
  archive.get_rows("now.positions", 3, state.positions.size());
  archive.get_rows("now.pressures", 1, state.pressures.size());
  TimeEngine::Moment moment = load_moment(archive);
  if (moment.dt_before > 0.0)
    archive.get_rows("before.positions", 3, state.positions.size());
  return moment;
}

void CycleRun::load_part(const Archive& archive, Beat& beat) const {
  beat.curves = load_curves(archive);
  beat.moments = load_moments(archive, engine_.state().positions.size());
  beat.energy = load_energy(archive);
}

}  // namespace

Beat run_cycle(const CycleSetup& setup, const std::filesystem::path& folder,
               const Observers& observers) {
  return CycleRun(setup, folder, observers).run();
}

Outcome<MeasuredBeats> measure_beats(const CycleSetup& setup, const BeatBegin* begin,
                                     const std::filesystem::path& folder) {
  return CycleRun(setup, folder, {}).measure(begin);
}

void store(const BeatBegin& begin, Archive& archive) {
  archive.add("wall", archived(begin.wall));
  archive.set("circuit", begin.circuit);
}

BeatBegin load_begin(Archive archive) {
  return {load_moment(archive.take("wall")), archive.get("circuit")};
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
  archive.set("cycle.facts",
              {cycle.period, static_cast<double>(cycle.beats.size()), cycle.is_limit ? 1.0 : 0.0,
               cycle.cut_short ? 1.0 : 0.0, cycle.change, cycle.blood_lost, cycle.volume_gap,
               static_cast<double>(cycle.gave_way)});
}

namespace {

std::vector<Sample> load_samples(const Archive& archive, std::size_t columns) {
  constexpr std::size_t own = 9;
  const auto& numbers = archive.get_rows("cycle.samples", own + columns);
  std::vector<Sample> samples;
  for (auto n = numbers.begin(); n != numbers.end(); n += static_cast<int>(own + columns))
    samples.push_back({n[0],
                       {n[1],
                        n[2],
                        n[3],
                        n[4],
                        n[5],
                        n[6],
                        n[7],
                        n[8],
                        {n + own, n + static_cast<int>(own + columns)}}});
  return samples;
}

}  // namespace

void store(const EnergyBalance& energy, Archive& archive) {
  archive.set("energy", {energy.pressure, energy.muscle, energy.stored, energy.kinetic,
                         energy.supports, energy.viscosity});
}

EnergyBalance load_energy(const Archive& archive) {
  const auto& n = archive.get_rows("energy", 6, 1);
  return {n[0], n[1], n[2], n[3], n[4], n[5]};
}

circulation::Cycle load_cycle(const Archive& archive) {
  const auto& facts = archive.get_rows("cycle.facts", 8, 1, not_negative);
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
  cycle.is_limit = archive.whole_number(facts[2], {0.0, 1.0}) == 1;
  cycle.cut_short = archive.whole_number(facts[3], {0.0, 1.0}) == 1;
  cycle.change = facts[4];
  cycle.blood_lost = facts[5];
  cycle.volume_gap = facts[6];
  cycle.gave_way = archive.whole_number(facts[7], {0.0, 1e6});
  const double most = cycle.samples.back().time / cycle.period + 1e-9;
  const int beats = archive.whole_number(facts[1], {0.0, most});
  for (int b = 0; b < beats; ++b)
    cycle.beats.push_back(circulation::measure_beat(circulation::samples_of(cycle, b)));
  return cycle;
}

}  // namespace lv::heartbeat
