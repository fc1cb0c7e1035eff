#include "lv/heartbeat/immersed_cycle.hpp"

#include "lv/base/check.hpp"
#include "lv/base/interrupt.hpp"
#include "lv/verify/small_ventricle.hpp"

#include "support/temporary_folder.hpp"
#include <catch2/catch.hpp>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <filesystem>

namespace {

using namespace lv;
using heartbeat::Beat;
using heartbeat::BeatSetup;

mesh::Mesh blood_sized_mesh() {
  return verify::ideal_mesh({.edge_length = 9.0});
}

BeatSetup quick_immersed(const mesh::Mesh& mesh) {
  BeatSetup setup = verify::quick_heartbeat(mesh);
  setup.protocol.cycle = {.beats = 1, .tolerance = 0.0};
  return setup;
}

circulation::CircuitParameters windkessel() {
  circulation::CircuitParameters circuit;
  circuit.kind = circulation::Kind::windkessel;
  circuit.period = 0.4;
  return circuit;
}

/// Ends a run in the middle of a step, as a kill would.
struct Kill {};

/// Killed at every frame once; a checkpoint is written every ten steps.
Beat through_kills(BeatSetup setup, const circulation::CircuitParameters& circuit) {
  const test::TemporaryFolder folder;
  setup.output.checkpoint_interval = 0.0;
  double survived = 0.0;
  int kills = 0;
  heartbeat::Observers observers;
  observers.frame = [&](const heartbeat::Frame& frame) {
    if (frame.run.time <= survived)
      return;
    survived = frame.run.time;
    ++kills;
    throw Kill();
  };
  for (;;) {
    try {
      Beat beat = heartbeat::run_immersed_cycle(setup, circuit, folder / "", observers);
      CHECK(kills > 3);
      return beat;
    } catch (const Kill&) {
    }
  }
}

void check_bitwise(const Beat& a, const Beat& b) {
  REQUIRE(a.cycle->samples.size() == b.cycle->samples.size());
  for (std::size_t i = 0; i < a.cycle->samples.size(); ++i) {
    CHECK(a.cycle->samples[i].time == b.cycle->samples[i].time);
    CHECK(a.cycle->samples[i].signals.pressure == b.cycle->samples[i].signals.pressure);
    CHECK(a.cycle->samples[i].signals.volume == b.cycle->samples[i].signals.volume);
  }
  REQUIRE(a.moments.size() == b.moments.size());
  for (std::size_t i = 0; i < a.moments.size(); ++i) {
    CHECK(a.moments[i].wall.positions == b.moments[i].wall.positions);
    CHECK(a.moments[i].wall.tension == b.moments[i].wall.tension);
  }
  REQUIRE(a.curves.size() == b.curves.size());
  CHECK(a.curves.back().kinetic_energy == b.curves.back().kinetic_energy);
}

/// Whether the checkpoint of a run is of a wall that is being filled.
bool is_of_filling(const std::filesystem::path& checkpoint) {
  return heartbeat::Archive::read(checkpoint).number("filling") == 1.0;
}

/// Lets a run that fills go on for a few steps, in a process of its own that is asked to stop.
void run_until_stopped(const BeatSetup& setup, const std::filesystem::path& folder) {
  constexpr int stopped = 3;
  const pid_t child = fork();
  if (child == 0) {
    interrupt::install();
    std::raise(SIGTERM);
    try {
      static_cast<void>(heartbeat::run_immersed_cycle(setup, windkessel(), folder, {}));
    } catch (const Interrupted&) {
      _exit(stopped);
    }
    _exit(0);
  }
  int status = 0;
  waitpid(child, &status, 0);
  REQUIRE(WIFEXITED(status));
  REQUIRE(WEXITSTATUS(status) == stopped);
}

/// A base on springs and dashpots.
BeatSetup on_springs(BeatSetup setup) {
  setup.heart.base.kind = solid::BasalSupport::Kind::elastic;
  setup.heart.surroundings.base = {20.0, 5.0, 0.005, 0.005, {}};
  return setup;
}

/// So far towards the apex and back within a beat [mm], from where the undeformed wall has it at a
/// time.
heartbeat::BaseMotion down_and_up(const mesh::Mesh& mesh, double axial, double zero) {
  return {{{0.0, 0.1, 0.25, 0.35}, {{0.0}, {0.8 * axial}, {axial}, {0.2 * axial}}},
          solid::base_frame(mesh, 0.0),
          {0.4, 0.0, zero}};
}

/// How far the nodes of the base have gone along the axis in the mean [mm].
double axial_shift(const mesh::Mesh& mesh, const std::vector<Vec3>& positions) {
  double sum = 0.0;
  for (const int node : mesh.base.nodes)
    sum += positions[node].z() - mesh.nodes[node].z();
  return sum / static_cast<double>(mesh.base.nodes.size());
}

}  // namespace

TEST_CASE("the pressure of a step is that at which wall and circuit agree", "[unit][heartbeat]") {
  const immersed::StepVolume wall{1.0, 100.0, 0.25};
  // a valve that opens at 2 kPa with a conductance hundreds of times the wall's
  const auto valve = [](double p) -> circulation::VolumeAfter {
    return p < 2.0 ? circulation::VolumeAfter{101.0, 0.0}
                   : circulation::VolumeAfter{101.0 - 75.0 * (p - 2.0), -75.0};
  };
  const double p = heartbeat::matching_pressure(wall, valve);
  CHECK(100.0 + 0.25 * (p - 1.0) == Approx(valve(p).volume).epsilon(1e-10));
  CHECK(p > 2.0);
  const auto closed = [](double) -> circulation::VolumeAfter { return {100.1, 0.0}; };
  CHECK(heartbeat::matching_pressure(wall, closed) == Approx(1.4));
  const auto broken = [](double) -> circulation::VolumeAfter { return {std::nan(""), 0.0}; };
  CHECK(std::isnan(heartbeat::matching_pressure(wall, broken)));
}

TEST_CASE("the immersed wall beats in a circulation", "[unit][heartbeat]") {
  const mesh::Mesh mesh = blood_sized_mesh();
  const test::TemporaryFolder folder;
  const Beat beat =
      heartbeat::run_immersed_cycle(quick_immersed(mesh), windkessel(), folder / "", {});
  REQUIRE(beat.cycle);
  REQUIRE(beat.cycle->beats.size() == 1);
  const circulation::BeatMeasures& m = beat.cycle->beats.back();
  CHECK(beat.cycle->volume_gap < 0.01);  // of the fan at the base, which yields on its springs
  CHECK(m.end_systolic_volume < 0.9 * m.end_diastolic_volume);
  CHECK(m.peak_pressure > 80.0 * units::mmHg);
  CHECK(m.aortic_opens > m.mitral_closes);
  CHECK(m.aortic_closes > m.aortic_opens);
  CHECK(beat.at(heartbeat::end_systole).volume ==
        Approx(m.end_systolic_volume).epsilon(0.01));  // with the fan at the base
  CHECK(beat.at(heartbeat::end_systole).tension.size() == mesh.nodes.size());
  CHECK(beat.curves.front().time == 0.0);
  CHECK(beat.curves.back().time == Approx(0.4));
}

TEST_CASE("an immersed heartbeat that was killed goes on bit for bit", "[unit][heartbeat]") {
  const mesh::Mesh mesh = blood_sized_mesh();
  BeatSetup setup = quick_immersed(mesh);
  setup.output.frame_interval = 0.05;
  const test::TemporaryFolder folder;
  heartbeat::Observers frames;
  frames.frame = [](const heartbeat::Frame&) {};
  const Beat undisturbed = heartbeat::run_immersed_cycle(setup, windkessel(), folder / "", frames);
  check_bitwise(undisturbed, through_kills(setup, windkessel()));
}

TEST_CASE("an immersed heartbeat that was stopped while it was filled goes on bit for bit",
          "[unit][heartbeat]") {
  const mesh::Mesh mesh = blood_sized_mesh();
  BeatSetup setup = on_springs(quick_immersed(mesh));
  setup.base_motion = down_and_up(mesh, 4.0, 0.1);
  const test::TemporaryFolder folder, other;
  const Beat undisturbed = heartbeat::run_immersed_cycle(setup, windkessel(), folder / "", {});
  for (int stops = 0; stops < 5; ++stops) {
    run_until_stopped(setup, other / "");
    REQUIRE(is_of_filling(other / heartbeat::checkpoint_name));
  }
  check_bitwise(undisturbed, heartbeat::run_immersed_cycle(setup, windkessel(), other / "", {}));
}

TEST_CASE("the immersed wall beats on springs at its base", "[unit][heartbeat]") {
  const mesh::Mesh mesh = blood_sized_mesh();
  const test::TemporaryFolder folder;
  const Beat beat = heartbeat::run_immersed_cycle(on_springs(quick_immersed(mesh)), windkessel(),
                                                  folder / "", {});
  const circulation::BeatMeasures& m = beat.cycle->beats.back();
  CHECK(beat.retries == 0);
  CHECK(m.end_systolic_volume < 0.9 * m.end_diastolic_volume);
  CHECK(m.peak_pressure > 80.0 * units::mmHg);
  // 90 mmHg on an opening of 1050 mm^2 are 13 N, on springs of 20 kPa/mm on as large a base 0.4 mm
  const double shift = axial_shift(mesh, beat.at(heartbeat::end_systole).positions);
  CHECK(shift < -0.2);
  CHECK(shift > -0.8);
  // of the edge, which the pressure draws down before the base in elements of 9 mm
  CHECK(beat.cycle->volume_gap < 0.02);
}

TEST_CASE("an immersed wall goes along with its base", "[unit][heartbeat]") {
  const mesh::Mesh mesh = blood_sized_mesh();
  for (const BeatSetup& still : {quick_immersed(mesh), on_springs(quick_immersed(mesh))}) {
    BeatSetup moving = still;
    moving.base_motion = down_and_up(mesh, 8.0, 0.0);
    const test::TemporaryFolder folder, other;
    const Beat stays = heartbeat::run_immersed_cycle(still, windkessel(), folder / "", {});
    const Beat moves = heartbeat::run_immersed_cycle(moving, windkessel(), other / "", {});
    const circulation::BeatMeasures& a = stays.cycle->beats.back();
    const circulation::BeatMeasures& b = moves.cycle->beats.back();
    CHECK(axial_shift(mesh, moves.at(heartbeat::end_systole).positions) < -6.0);
    // 8 mm over the opening are a tenth of the volume; what is left is the blood's inertia
    CHECK(b.end_diastolic_volume == Approx(a.end_diastolic_volume).epsilon(0.02));
    CHECK(b.end_systolic_volume == Approx(a.end_systolic_volume).epsilon(0.02));
    CHECK(b.peak_pressure == Approx(a.peak_pressure).epsilon(0.05));
    CHECK(moves.cycle->volume_gap < stays.cycle->volume_gap + 5e-3);
  }
}

TEST_CASE("immersed muscle that is activated later contracts later, and goes on bit for bit",
          "[unit][heartbeat]") {
  const mesh::Mesh mesh = blood_sized_mesh();
  BeatSetup setup = quick_immersed(mesh);
  const test::TemporaryFolder folder;
  const auto opens = [](const Beat& beat) { return beat.cycle->beats.back().aortic_opens; };
  const Beat at_once = heartbeat::run_immersed_cycle(setup, windkessel(), folder / "", {});
  constexpr double delay = 0.02;
  setup.activation_times.assign(mesh.nodes.size(), delay);
  const Beat later = heartbeat::run_immersed_cycle(setup, windkessel(), folder / "", {});
  const auto calcium_rises = [](const Beat& beat) {
    return std::find_if(beat.curves.begin(), beat.curves.end(),
                        [](const heartbeat::CurveRow& row) { return row.calcium > 0.3; })
        ->time;
  };
  CHECK(calcium_rises(later) - calcium_rises(at_once) ==
        Approx(delay).margin(2.0 * setup.output.curve_interval));
  CHECK(opens(later) > opens(at_once));  // by less than the delay: it is filled for longer
  CHECK(later.activation_times == setup.activation_times);
  CHECK(later.curves.front().calcium == Approx(0.1));
  for (std::size_t a = 0; a < mesh.nodes.size(); ++a)
    setup.activation_times[a] = 0.02 * mesh.transmural[a];
  setup.output.frame_interval = 0.05;
  heartbeat::Observers frames;
  frames.frame = [](const heartbeat::Frame&) {};
  const Beat by_depth = heartbeat::run_immersed_cycle(setup, windkessel(), folder / "", frames);
  CHECK(opens(by_depth) > opens(at_once));
  CHECK(opens(by_depth) < opens(later));
  check_bitwise(by_depth, through_kills(setup, windkessel()));
}

TEST_CASE("steps that fail in an immersed heartbeat are taken back and repeated smaller",
          "[unit][heartbeat]") {
  const mesh::Mesh mesh = blood_sized_mesh();
  BeatSetup setup = quick_immersed(mesh);
  setup.control.longest = 2e-3;  // far too long
  setup.output.frame_interval = 0.05;
  circulation::CircuitParameters circuit = windkessel();
  const test::TemporaryFolder folder;
  heartbeat::Observers frames;
  frames.frame = [](const heartbeat::Frame&) {};
  const Beat undisturbed = heartbeat::run_immersed_cycle(setup, circuit, folder / "", frames);
  CHECK(undisturbed.retries > 0);
  CHECK(undisturbed.cycle->samples.back().time == Approx(0.4));
  for (std::size_t i = 1; i < undisturbed.cycle->samples.size(); ++i)
    CHECK(undisturbed.cycle->samples[i].time > undisturbed.cycle->samples[i - 1].time);
  check_bitwise(undisturbed, through_kills(setup, circuit));
}

TEST_CASE("immersed heartbeats without a circulation are refused", "[unit][heartbeat]") {
  const mesh::Mesh mesh = blood_sized_mesh();
  const test::TemporaryFolder folder;
  CHECK_THROWS_AS(heartbeat::run_immersed_cycle(quick_immersed(mesh), {}, folder / "", {}),
                  InputError);
}
