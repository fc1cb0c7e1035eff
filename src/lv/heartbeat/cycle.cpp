#include "lv/heartbeat/cycle.hpp"

#include "lv/base/check.hpp"
#include "lv/base/interrupt.hpp"
#include "lv/base/log.hpp"
#include "lv/base/parallel.hpp"
#include "lv/base/time_left.hpp"
#include "lv/base/units.hpp"
#include "lv/heartbeat/immersed_beat.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <optional>

namespace lv::heartbeat {
namespace {

using circulation::Sample;
using circulation::Signals;
using implicit::TimeEngine;
using units::mmHg;

constexpr int most_step_halvings = 8;
constexpr int halvings_for_error = 5;
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

std::vector<double> numbers_of(const solid::AffineField& field) {
  std::vector<double> numbers(field.H.data(), field.H.data() + field.H.size());
  numbers.insert(numbers.end(), field.d.begin(), field.d.end());
  return numbers;
}

solid::AffineField load_field(const Archive& archive, const char* name) {
  const double* n = archive.get_rows(name, 12, 1).data();
  return {Eigen::Map<const Mat3>(n), Eigen::Map<const Vec3>(n + 9)};
}

Archive archived(const TimeEngine::Moment& moment) {
  Archive archive;
  archive.add("now", archived(moment.now));
  archive.add("before", archived(moment.before));
  archive.set("dt_before", {moment.dt_before});
  archive.set("velocity", flat(moment.rates.velocity));
  archive.set("acceleration", flat(moment.rates.acceleration));
  archive.set("muscle", moment.muscle);
  archive.set("base_displacement", numbers_of(moment.base.displacement));
  archive.set("base_velocity", numbers_of(moment.base.velocity));
  return archive;
}

/// How much a moment must hold; nothing: as much as there is.
struct MomentSizes {
  std::optional<std::size_t> nodes, pressures, velocities, accelerations, muscle;
};

implicit::State load_state(const Archive& archive, const std::string& name, const MomentSizes& n) {
  return {vectors(archive.get_rows(name + ".positions", 3, n.nodes)),
          archive.get_rows(name + ".pressures", 1, n.pressures),
          archive.number(name + ".cavity_pressure")};
}

TimeEngine::Moment load_moment(const Archive& archive, const MomentSizes& n = {}) {
  TimeEngine::Moment moment;
  moment.dt_before = archive.number("dt_before");
  moment.rates.velocity = vectors(archive.get_rows("velocity", 3, n.velocities));
  moment.rates.acceleration = vectors(archive.get_rows("acceleration", 3, n.accelerations));
  moment.muscle = archive.get_rows("muscle", 1, n.muscle);
  moment.base = {load_field(archive, "base_displacement"), load_field(archive, "base_velocity")};
  moment.now = load_state(archive, "now", n);
  if (moment.dt_before > 0.0)  // else there is none
    moment.before = load_state(archive, "before", n);
  return moment;
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
  [[nodiscard]] BeatBegin other_end() const;
  void leave_end();
  void beat();
  void begin_beat();
  void step();
  void end_beat();
  [[nodiscard]] bool gives_way(const implicit::TimeStep& step,
                               const implicit::VolumeOfPressure& volume);
  [[nodiscard]] bool is_too_long(double dt) const;
  [[nodiscard]] double local_error(double dt) const;
  void halve();
  void shorten(const std::string& why);
  void stop_early(const std::string& why);
  void count_time();

  void add_work(const Passed& before);
  void note_event(const Passed& before);
  void write_frame(const Snapshot& wall);
  void record_curve();
  void report_progress(const implicit::NewtonReport& newton);

  void save();
  void resume(Archive archive);
  [[nodiscard]] TimeEngine::Moment load_engine(const Archive& archive) const;

  [[nodiscard]] Snapshot snapshot(const Passed& at, const Sample& sample) const;
  [[nodiscard]] RunState& state() { return record_.run(); }
  [[nodiscard]] double mean_calcium() const;
  [[nodiscard]] std::vector<implicit::CalciumStep> calcium_between(double since, double then) const;
  [[nodiscard]] double step_size() const;
  [[nodiscard]] double seconds_left() const;  ///< negative: not known

  const CycleSetup& setup_;
  std::filesystem::path folder_;
  const Observers& observers_;
  TimeEngine engine_;
  std::vector<double> delays_;  ///< of this rank's points [s]; a single one: of all
  CycleRecord record_;
  bool is_measured_ = false;  ///< for its measures alone: beats without a solution are an answer
  std::string why_stopped_;
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
      record_({setup.calcium, setup.circuit, setup.cycle, setup.frame_interval}) {}

Beat CycleRun::run() {
  if (!setup_.begin.empty())
    record_.goes_on();
  begin(nullptr);
  beats();
  if (!record_.cycle().cut_short)
    leave_end();
  count_time();
  Beat beat = record_.result(observers_);
  beat.activation_times = setup_.activation_times;
  return beat;
}

Outcome<MeasuredBeats> CycleRun::measure(const BeatBegin* from) {
  is_measured_ = true;
  if (from != nullptr)
    record_.goes_on();
  begin(from);
  beats();
  if (record_.cycle().cut_short)
    return Unsolved{why_stopped_, ""};
  const auto states = record_.circuit_states();
  return MeasuredBeats{record_.cycle(), {engine_.moment(), {states.begin(), states.end()}}};
}

void CycleRun::begin(const BeatBegin* from) {
  const std::filesystem::path checkpoint = folder_ / checkpoint_name;
  if (parallel::root_says(std::filesystem::exists(checkpoint)))
    resume(Archive::read(checkpoint));
  else if (from != nullptr)
    start_from(*from);
  else if (!setup_.begin.empty())
    start_from(other_end());
  else
    start();
}

void CycleRun::beats() {
  try {
    while (!record_.done())
      beat();
  } catch (const Interrupted&) {
    record_.show_progress(observers_);
    throw Interrupted(
        fmt::format("stopped at {:.3f} s of beat {}; run the same command again to go on",
                    record_.since(), record_.beat() + 1));
  }
}

/// Fills the wall to the pressure before the mitral valve, so that it is neither open nor closed.
void CycleRun::start() {
  const double pressure = record_.filling_pressure();
  const solid::AffineField base = setup_.base_motion.at(0.0);
  record_.start(engine_.fill(pressure, setup_.calcium.Ca_0, base).value(), pressure);
  begin_beat();
}

void CycleRun::start_from(const BeatBegin& from) {
  engine_.restore(from.wall);
  record_.start_from(from.circuit, engine_.pressure());
  begin_beat();
}

BeatBegin CycleRun::other_end() const {
  Archive archive =
      read_end_of_beats(setup_.begin, engine_.state().positions.size(), setup_.circuit);
  log::info("beats begin where those of {} have ended", setup_.begin.string());
  const std::vector<double> circuit = archive.get_rows("circuit", 1);
  return {load_engine(archive.take("wall")), circuit};
}

void CycleRun::leave_end() {
  const auto states = record_.circuit_states();
  const BeatBegin end{engine_.moment(), {states.begin(), states.end()}};
  parallel::on_root([&] {
    Archive archive;
    heartbeat::store(end, archive);
    archive.write(folder_ / end_of_beats);
  });
}

void CycleRun::beat() {
  while (!record_.beat_is_over()) {
    step();
    if (record_.done())
      return;
  }
  end_beat();
}

void CycleRun::begin_beat() {
  record_.begin_beat();
  count_time();
  begun_ = state().beat.wall_clock;
  stored_before_ = engine_.stored_energy();
  kinetic_before_ = engine_.kinetic_energy();
  Snapshot now = snapshot(engine_.present(), record_.now());
  if (record_.mitral_valve_is_closed())
    record_.mark(valve_events[0], false, now);
  write_frame(now);
  record_curve();
  save();
}

/// One step, of which nothing remains when it fails.
void CycleRun::step() {
  interrupt::check_together();
  const double dt = step_size();
  const Passed before = engine_.present();
  const auto volume = [&](double p) -> implicit::GivenVolume {
    const auto [after, per_pressure] = record_.volume_after(dt, p);
    return {after, per_pressure};
  };
  const double end = record_.after(dt);
  const implicit::TimeStep step{
      dt,
      calcium_between(record_.since(), end),
      {setup_.base_motion.at(record_.since()), setup_.base_motion.at(end)}};
  const auto newton = engine_.advance(step, volume);
  if (!newton.converged && !gives_way(step, volume)) {
    shorten(newton.why);
    return;
  }
  if (is_too_long(dt)) {
    engine_.go_back(before);
    halve();
    return;
  }
  record_.step(dt, engine_.pressure(), engine_.cavity_volume());
  RunState& run = state();
  ++run.beat.steps;
  add_work(before);
  note_event(before);
  if (record_.frame_is_due())
    write_frame(snapshot(engine_.present(), record_.now()));
  record_curve();
  if (run.halvings > 0 && ++run.good_steps >= good_steps_to_grow) {
    --run.halvings;
    run.good_steps = 0;
  }
  if (reports_.due())
    report_progress(newton);
  if (run.beat.steps % checkpoint_every == 0 && !record_.beat_is_over())
    save();
}

void CycleRun::add_work(const Passed& before) {
  const TimeEngine::Work work = engine_.work_since(before);
  EnergyBalance& sum = state().beat.energy;
  sum.pressure += work.pressure;
  sum.muscle += work.muscle.whole;
  sum.work_density.resize(work.muscle.density.size());
  for (std::size_t e = 0; e < sum.work_density.size(); ++e)
    sum.work_density[e] += work.muscle.density[e];
  sum.supports += work.supports + work.base;
  sum.viscosity += work.viscosity;
  sum.base += work.base;
}

/// Some halvings are left for steps that fail.
bool CycleRun::is_too_long(double dt) const {
  const double most = setup_.cycle.step_error;
  return most > 0.0 && record_.run().halvings < halvings_for_error && local_error(dt) > most;
}

/// Of the step to here, in the cavity's volume or pressure, as a part of the largest of the last
/// four. Backward differences of second order miss y by 2/9 of what the parabola through the three
/// samples before misses on the other side: 2/11 of how far both are apart (Milne's device).
double CycleRun::local_error(double dt) const {
  const auto beat = record_.samples_of_beat();
  if (beat.size() < 3)
    return 0.0;
  const auto last = beat.last(3);
  const double t = record_.now().time + dt;
  const auto apart = [&](double Signals::*value, double now) {
    double parabola = 0.0;
    double scale = std::abs(now);
    for (std::size_t i = 0; i < 3; ++i) {
      const double y = last[i].signals.*value;
      const double t_j = last[(i + 1) % 3].time;
      const double t_k = last[(i + 2) % 3].time;
      parabola += y * (t - t_j) * (t - t_k) / ((last[i].time - t_j) * (last[i].time - t_k));
      scale = std::max(scale, std::abs(y));
    }
    return std::abs(now - parabola) / scale;
  };
  return 2.0 / 11.0 *
         std::max(apart(&Signals::volume, engine_.cavity_volume()),
                  apart(&Signals::pressure, engine_.pressure()));
}

/// Where shorter steps did not help.
bool CycleRun::gives_way(const implicit::TimeStep& step, const implicit::VolumeOfPressure& volume) {
  if (state().halvings != halvings_before_giving_way || !engine_.give_way(step, volume))
    return false;
  record_.gave_way();
  return true;
}

/// The step that was taken back is tried again at half its length.
void CycleRun::halve() {
  ++state().beat.retries;
  ++state().halvings;
  state().good_steps = 0;
}

void CycleRun::shorten(const std::string& why) {
  halve();
  if (state().halvings > most_step_halvings) {
    stop_early(why);
    return;
  }
  log::info("a step at {:.4f} s of beat {} failed ({}); the next is {:.3g} s", record_.since(),
            record_.beat() + 1, why, step_size());
}

/// What whole beats were reached stays; without any there is nothing to show.
void CycleRun::stop_early(const std::string& why) {
  const std::string what = fmt::format(
      "at {:.4f} s of beat {} no equilibrium of wall and circuit was found, even with a step of "
      "{:.2g} s: {}",
      record_.since(), record_.beat() + 1, std::ldexp(setup_.cycle.step, -most_step_halvings), why);
  if (is_measured_) {
    why_stopped_ = what;
    record_.cut_short();
    return;
  }
  const NoSolution error(what,
                         "Look at cycle.csv in 03_beat.part up to there: a circuit that empties "
                         "the heart, or overfills it, has other resistances, pressures or "
                         "contractility than meant; a thin or scarred wall may need what holds "
                         "muscle back (muscle.viscosity = \"100 Pa s\"); else try a finer mesh");
  record_.stop_early(error, what, observers_);
}

void CycleRun::end_beat() {
  count_time();
  RunState& run = state();
  if (begun_)
    seconds_of_beat_ = run.beat.wall_clock - *begun_;
  run.beat.energy.stored = engine_.stored_energy() - stored_before_;
  run.beat.energy.kinetic = engine_.kinetic_energy() - kinetic_before_;
  record_.end_beat();
  if (!record_.done())
    begin_beat();
}

/// Where the valve's pressures crossed, between the walls of the two steps.
void CycleRun::note_event(const Passed& before) {
  const ValveEvent* event = record_.event();
  if (event == nullptr)
    return;
  const double share = event->place(record_.before().signals, record_.now().signals);
  const Snapshot first = snapshot(before, record_.before());
  const Snapshot second = snapshot(engine_.present(), record_.now());
  const Snapshot wall = between(first, second, share);
  record_.mark(*event, true, wall);
  write_frame(wall);
}

void CycleRun::write_frame(const Snapshot& wall) {
  const std::optional<int> number = record_.frame_number(wall.time);
  if (number && observers_.frame)
    observers_.frame({*number, wall, state(), {}});
}

void CycleRun::record_curve() {
  CurveRow row = record_.row();
  row.calcium = mean_calcium();
  row.mean_tension = engine_.mean_tension();
  row.kinetic_energy = engine_.kinetic_energy();
  for (const Vec3& v : engine_.rates().velocity)
    row.largest_velocity = std::max(row.largest_velocity, v.norm());
  row.step = step_size();
  row.min_J = row.max_J = std::numeric_limits<double>::quiet_NaN();  // not looked at
  state().beat.curves.push_back(row);
}

Snapshot CycleRun::snapshot(const Passed& at, const Sample& sample) const {
  return {sample.time, sample.signals.pressure, sample.signals.volume, at.state.positions,
          {},          engine_.cell_stress(at)};
}

std::vector<implicit::CalciumStep> CycleRun::calcium_between(double since, double then) const {
  std::vector<implicit::CalciumStep> steps;
  for (const double delay : delays_)
    steps.push_back({record_.calcium(since, delay), record_.calcium(then, delay)});
  return steps;
}

double CycleRun::mean_calcium() const {
  if (setup_.activation_times.empty())
    return record_.calcium(record_.since());
  std::vector<double> at_points;
  for (const double delay : delays_)
    at_points.push_back(record_.calcium(record_.since(), delay));
  return engine_.equations().mean(at_points);
}

double CycleRun::step_size() const {
  return record_.step_size(std::ldexp(setup_.cycle.step, -record_.run().halvings));
}

/// Steps of different phases take different times, so that only a whole beat tells of others.
double CycleRun::seconds_left() const {
  if (is_measured_)
    return -1.0;  // only who asked for these beats knows for what else
  return seconds_of_beat_ * (1.0 - record_.since() / record_.period() + record_.beats_left());
}

void CycleRun::report_progress(const implicit::NewtonReport& newton) {
  const CurveRow& now = state().beat.curves.back();
  log::info(
      "beat {} (of {} at most)  {:.3f} of {:.3g} s  {}  {:.1f} mmHg  {:.1f} ml  tension {:.1f} kPa "
      " {} corrections, {} {}{}",
      record_.beat() + 1, setup_.cycle.beats, record_.since(), record_.period(), now.phase,
      now.pressure / mmHg, 1e-3 * now.volume, now.mean_tension, newton.iterations,
      newton.factorisations, newton.factorisations == 1 ? "tangent" : "tangents",
      time_left(seconds_left()));
  record_.show_progress(observers_);
}

void CycleRun::count_time() {
  const auto now = std::chrono::steady_clock::now();
  state().beat.wall_clock += std::chrono::duration<double>(now - counted_).count();
  counted_ = now;
}

void CycleRun::save() {
  count_time();
  const TimeEngine::Moment moment = engine_.moment();
  parallel::on_root([&] {
    Archive archive;
    archive.add("engine", archived(moment));
    archive.set("energy_before", {stored_before_, kinetic_before_});
    record_.store(archive);
    archive.write(folder_ / checkpoint_name);
  });
}

void CycleRun::resume(Archive archive) {
  const auto& energy = archive.get_rows("energy_before", 2, 1);
  stored_before_ = energy[0];
  kinetic_before_ = energy[1];
  record_.load(archive, engine_.state().positions.size());
  engine_.restore(load_engine(archive.take("engine")));
  log::info("going on from {:.4f} s of beat {}", record_.since(), record_.beat() + 1);
}

TimeEngine::Moment CycleRun::load_engine(const Archive& archive) const {
  const implicit::Rates& rates = engine_.rates();
  const implicit::State& state = engine_.state();
  return load_moment(archive,
                     {state.positions.size(), state.pressures.size(), rates.velocity.size(),
                      rates.acceleration.size(), engine_.muscle_numbers()});
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

Archive read_end_of_beats(const std::filesystem::path& file, std::size_t nodes,
                          const circulation::CircuitParameters& circuit) {
  const auto require = [&](bool holds, const std::string& why) {
    if (!holds)
      throw InputError(file.string(), why,
                       "Name the 03_beat/end_of_beats.bin of a run with the same anatomy, elements "
                       "and circulation.kind (cycle.begin)");
  };
  Archive archive;
  std::size_t nodes_there = 0;
  std::size_t states_there = 0;
  try {
    archive = Archive::read(file);
    nodes_there = archive.get("wall.now.positions").size() / 3;
    states_there = archive.get("circuit").size();
  } catch (const RunError&) {  // whose advice is for a run's own files
    require(false, "is not where heartbeats have ended, or is damaged");
  }
  require(nodes_there == nodes,
          fmt::format("is where heartbeats of a wall with {} nodes have ended, and this one has {}",
                      nodes_there, nodes));
  require(states_there == circulation::Circuit(circuit).states().size(),
          "is where heartbeats in another circulation have ended");
  return archive;
}

void store(const BeatBegin& begin, Archive& archive) {
  archive.add("wall", archived(begin.wall));
  archive.set("circuit", begin.circuit);
}

BeatBegin load_begin(Archive archive) {
  return {load_moment(archive.take("wall")), archive.get("circuit")};
}

}  // namespace lv::heartbeat
