#include "lv/heartbeat/run_state.hpp"

#include "lv/base/check.hpp"

#include "support/temporary_folder.hpp"
#include <catch2/catch.hpp>

#include <cmath>
#include <functional>
#include <limits>

namespace {

using namespace lv;
using namespace heartbeat;

/// Stresses whose every number differs.
solid::CellStress stress(double seed) {
  solid::CellStress s;
  s.tension = seed + 0.6;
  s.pressure = seed + 0.7;
  s.cauchy_passive << 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, seed;
  s.cauchy_active << seed, 9.0, 10.0, 11.0, 12.0, 13.0, 14.0, 15.0, 16.0;
  s.fibre_stress_passive = seed + 0.8;
  s.fibre_stress_active = seed + 0.9;
  return s;
}

/// A snapshot whose every number differs from those of other seeds.
Snapshot snapshot(double seed) {
  return {seed + 0.1,
          seed + 0.2,
          seed + 0.3,
          {{seed, 1.0, 2.0}, {3.0, seed, 4.0}},
          {seed + 0.4, seed + 0.5},
          {stress(seed), stress(seed + 0.5)}};
}

void check_equal(const Snapshot& a, const Snapshot& b) {
  CHECK(a.time == b.time);
  CHECK(a.pressure == b.pressure);
  CHECK(a.volume == b.volume);
  CHECK(a.positions == b.positions);
  CHECK(a.tension == b.tension);
  REQUIRE(a.stress.size() == b.stress.size());
  for (std::size_t c = 0; c < a.stress.size(); ++c) {
    CHECK(a.stress[c].tension == b.stress[c].tension);
    CHECK(a.stress[c].pressure == b.stress[c].pressure);
    CHECK(a.stress[c].cauchy_passive == b.stress[c].cauchy_passive);
    CHECK(a.stress[c].cauchy_active == b.stress[c].cauchy_active);
    CHECK(a.stress[c].fibre_stress_passive == b.stress[c].fibre_stress_passive);
    CHECK(a.stress[c].fibre_stress_active == b.stress[c].fibre_stress_active);
  }
}

void check_equal(const CurveRow& a, const CurveRow& b) {
  CHECK(a.time == b.time);
  CHECK(a.phase == b.phase);
  CHECK(a.pressure == b.pressure);
  CHECK(a.volume == b.volume);
  CHECK(a.calcium == b.calcium);
  CHECK(a.mean_tension == b.mean_tension);
  CHECK(a.kinetic_energy == b.kinetic_energy);
  CHECK(a.largest_velocity == b.largest_velocity);
  CHECK(a.min_J == b.min_J);
  CHECK(a.max_J == b.max_J);
  CHECK(a.step == b.step);
}

/// A run in the middle of its contraction, no two members alike and none at its default.
RunState example(const std::vector<Phase>& phases) {
  RunState run;
  run.time = 0.91;
  run.phase = 1;
  run.phase_start = 0.62;
  run.next_frame = 1.0;
  run.next_curve = 0.92;
  run.frames = 3;
  run.frame_times = {0.0, 0.5, 0.62};
  run.largest_velocity = 431.0;
  run.halvings = 2;
  run.good_steps = 117;
  run.patience = 1000;
  run.flips = 13;
  run.steady = criterion(phases[run.phase]);
  for (int i = 0; i < 500; ++i)
    run.steady.record(0.62 + 1e-3 * i, 100.0 + 0.01 * (i % 7));
  run.volume_was_falling = true;
  run.least = snapshot(10.0);
  run.beat.curves = {{0.1, "filling", 2, 3, 4, 5, 6, 7, 8, 9, 10},
                     {0.2, "contraction", 12, 13, 14, 15, 16, 17, 18, 19, 20}};
  run.beat.moments = {{end_diastole, "filling", true, snapshot(20.0)},
                      {"early_systole", "isovolumic", false, snapshot(30.0)}};
  run.beat.steps = 9100;
  run.beat.retries = 5;
  return run;
}

RunState through_file(const RunState& run, const std::vector<Phase>& phases) {
  const test::TemporaryFolder folder;
  Archive archive;
  store(run, archive);
  archive.write(folder / "checkpoint.bin");
  return load_run_state(Archive::read(folder / "checkpoint.bin"), phases);
}

}  // namespace

TEST_CASE("a run's state comes back from a checkpoint as it was", "[unit][heartbeat]") {
  const std::vector<Phase> all = phases({});
  const RunState run = example(all);
  const RunState loaded = through_file(run, all);
  CHECK(loaded.time == run.time);
  CHECK(loaded.phase == run.phase);
  CHECK(loaded.phase_start == run.phase_start);
  CHECK(loaded.next_frame == run.next_frame);
  CHECK(loaded.next_curve == run.next_curve);
  CHECK(loaded.frames == run.frames);
  CHECK(loaded.frame_times == run.frame_times);
  CHECK(loaded.largest_velocity == run.largest_velocity);
  CHECK(loaded.halvings == run.halvings);
  CHECK(loaded.good_steps == run.good_steps);
  CHECK(loaded.patience == run.patience);
  CHECK(loaded.flips == run.flips);
  CHECK(loaded.volume_was_falling == run.volume_was_falling);
  CHECK(loaded.beat.steps == run.beat.steps);
  CHECK(loaded.beat.retries == run.beat.retries);
  check_equal(loaded.least, run.least);
  REQUIRE(loaded.beat.moments.size() == 2);
  for (int i = 0; i < 2; ++i) {
    CHECK(loaded.beat.moments[i].name == run.beat.moments[i].name);
    CHECK(loaded.beat.moments[i].phase == run.beat.moments[i].phase);
    CHECK(loaded.beat.moments[i].by_criterion == run.beat.moments[i].by_criterion);
    check_equal(loaded.beat.moments[i].wall, run.beat.moments[i].wall);
  }
  REQUIRE(loaded.beat.curves.size() == 2);
  for (int i = 0; i < 2; ++i)
    check_equal(loaded.beat.curves[i], run.beat.curves[i]);
}

TEST_CASE("the steadiness criterion goes on where it was", "[unit][heartbeat]") {
  const std::vector<Phase> all = phases({});
  RunState run = example(all);
  RunState loaded = through_file(run, all);
  CHECK(loaded.steady.samples() == run.steady.samples());
  CHECK(loaded.steady.variation() == run.steady.variation());
  CHECK(loaded.steady.reached() == run.steady.reached());
  for (int i = 500; i < 900; ++i) {
    for (RunState* state : {&run, &loaded})
      state->steady.record(0.62 + 1e-3 * i, 99.0 - 0.01 * (i % 5));
    CHECK(loaded.steady.variation() == run.steady.variation());
  }
}

TEST_CASE("a fresh run comes back as a fresh run", "[unit][heartbeat]") {
  const RunState loaded = through_file(RunState{}, phases({}));
  CHECK(loaded.phase == 0);
  CHECK(loaded.beat.curves.empty());
  CHECK(loaded.least.positions.empty());
  CHECK(loaded.beat.find(end_diastole) == nullptr);
  CHECK_FALSE(loaded.steady.reached());
}

TEST_CASE("each phase has its own criterion", "[unit][heartbeat]") {
  Protocol protocol;
  protocol.filling_window = 0.05;
  protocol.contraction_window = 0.2;
  for (const auto& [phase, window] : {std::pair{0, 0.05}, {1, 0.2}}) {
    SteadyVolume steady = criterion(phases(protocol)[phase]);
    steady.record(0.0, 1.0);
    steady.record(0.9 * window, 1.0);
    CHECK_FALSE(steady.reached());
    steady.record(1.1 * window, 1.0);
    CHECK(steady.reached());
  }
}

TEST_CASE("a checkpoint without the run's state is refused", "[unit][heartbeat]") {
  CHECK_THROWS_AS(load_run_state(Archive{}, {}), RunError);
}

TEST_CASE("a checkpoint of a run that cannot be is refused", "[unit][heartbeat]") {
  const auto refused = [](const std::function<void(RunState&)>& change) {
    RunState run = example(phases({}));
    change(run);
    Archive archive;
    store(run, archive);
    CHECK_THROWS_AS(load_run_state(archive, phases({}), 2), RunError);
  };
  refused([](RunState& run) { run.time = std::nan(""); });
  refused([](RunState& run) { run.time = -1.0; });
  refused([](RunState& run) { run.halvings = 1000; });
  refused([](RunState& run) { run.frames = 4; });
  refused([](RunState& run) { run.frame_times[1] = std::numeric_limits<double>::infinity(); });
  refused([](RunState& run) { run.beat.steps = -1; });
  refused([](RunState& run) { run.phase = 2; });
  refused([](RunState& run) { run.beat.moments.clear(); });
  refused([](RunState& run) { run.beat.moments[0].wall.positions.resize(3, Vec3::Zero()); });
  refused([](RunState& run) { run.least.tension.resize(7); });
}
