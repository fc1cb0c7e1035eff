#include "lv/heartbeat/cycle.hpp"

#include "lv/base/check.hpp"
#include "lv/circulation/circuit.hpp"
#include "lv/circulation/elastance.hpp"
#include "lv/geometry/ellipsoid.hpp"
#include "lv/heartbeat/cycle_record.hpp"
#include "lv/mesh/quadratic.hpp"
#include "lv/mesh/wall_mesh.hpp"

#include "support/circuit_step.hpp"
#include <catch2/catch.hpp>

#include <cmath>
#include <filesystem>
#include <fstream>

namespace {

using namespace lv;
using heartbeat::Beat;
using heartbeat::CycleSetup;

/// A wall of one layer and few elements: what it does is right to some per cent.
mesh::Mesh coarse_wall() {
  const geometry::Ellipsoid ellipsoid;
  return mesh::wall_mesh(
      [&](double u, double theta, double t) { return ellipsoid.point(u, theta, t); },
      {.edge_length = 15.0, .layers = 2, .order = 2});
}

mesh::Mesh coarsest_wall() {
  const geometry::Ellipsoid ellipsoid;
  return mesh::wall_mesh(
      [&](double u, double theta, double t) { return ellipsoid.point(u, theta, t); },
      {.edge_length = 20.0, .layers = 1, .order = 2});
}

/// A beat too short for a heart, for the test's sake.
CycleSetup quick(const mesh::Mesh& mesh) {
  solid::CardiacModel heart{.base = {.stiffness = implicit::rigid_base}};
  heart.myocardium.active = material::Land2017{};
  const material::Calcium calcium{.Ca_0 = 0.1,
                                  .Ca_max = 0.7,
                                  .shape = material::Calcium::CurveShape::double_exponential,
                                  .t_1 = 0.02,
                                  .t_2 = 0.08};
  CycleSetup setup{.mesh = mesh,
                   .model = {heart, calcium},
                   .solver = {},
                   .calcium = calcium,
                   .circuit = {},
                   .cycle = {.beats = 1, .tolerance = 0.0, .step = 8e-3}};
  setup.circuit.kind = circulation::Kind::windkessel;
  setup.circuit.period = 0.4;
  return setup;
}

std::filesystem::path empty_folder(const char* name) {
  const auto folder = std::filesystem::temp_directory_path() / name;
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  return folder;
}

/// The same with all that an implicit wall may have: base and epicardium on springs and dashpots.
/// Viscosities are some ten times those of a heart, so that the balance of energy sees them.
CycleSetup moving(const mesh::Mesh& mesh) {
  CycleSetup setup = quick(mesh);
  setup.cycle.step = 4e-3;
  setup.model.heart.base.kind = solid::BasalSupport::Kind::elastic;
  setup.model.heart.surroundings.base = {20.0, 5.0, 0.05, 0.05, {}};
  setup.model.heart.surroundings.epicardium = {
      0.2, 0.0, 0.05, 0.0, {solid::AxialWeight::WeightShape::sigmoid, 0.3}};
  setup.model.heart.myocardium.viscosity.eta = 1.0;
  setup.model.density = 1.05e-6;
  for (const double t : mesh.transmural)
    setup.activation_times.push_back(0.02 * t);
  return setup;
}

/// A base that goes down and comes back, tilts and turns.
heartbeat::BaseMotion moving_base(const mesh::Mesh& mesh, double period) {
  heartbeat::MeasuredMotion motion;
  motion.times = {0.0, 0.15 * period, 0.35 * period, 0.55 * period, 0.8 * period};
  motion.poses = {{},
                  {5.0, 0.02, -0.01, 0.03},
                  {12.0, 0.05, -0.03, -0.05},
                  {8.0, 0.03, 0.0, 0.0},
                  {2.0, 0.0, 0.0, 0.0}};
  return {motion, solid::base_frame(mesh, 0.3), {period, 0.0, 0.0}};
}

/// Ends a run in the middle of a step, as a kill would.
struct Stop {};

/// Stopped after its first checkpoint.
Beat stopped_and_resumed(const CycleSetup& setup) {
  const auto folder = empty_folder("lv_cycle_stopped");
  int frames = 0;
  heartbeat::Observers stopping;
  stopping.frame = [&](const heartbeat::Frame& frame) {
    frames = frame.number;
    if (frame.run.beat.steps > 30)  // after the checkpoint at 25
      throw Stop();
  };
  CycleSetup watched = setup;
  watched.frame_interval = 1e-3;
  CHECK_THROWS_AS(heartbeat::run_cycle(watched, folder, stopping), Stop);
  CHECK(frames > 25);
  return heartbeat::run_cycle(setup, folder, {});
}

void check_same(const Beat& undisturbed, const Beat& resumed) {
  REQUIRE(undisturbed.cycle);
  const auto& a = undisturbed.cycle->samples;
  const auto& b = resumed.cycle->samples;
  REQUIRE(a.size() == b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    CHECK(a[i].time == b[i].time);
    CHECK(a[i].signals.pressure == b[i].signals.pressure);
    CHECK(a[i].signals.volume == b[i].signals.volume);
  }
  REQUIRE(undisturbed.moments.size() == resumed.moments.size());
  for (std::size_t i = 0; i < undisturbed.moments.size(); ++i)
    CHECK(undisturbed.moments[i].wall.positions == resumed.moments[i].wall.positions);
  const heartbeat::EnergyBalance& before = undisturbed.energy;
  const heartbeat::EnergyBalance& after = resumed.energy;
  CHECK(before.muscle == after.muscle);
  CHECK(before.work_density == after.work_density);
  CHECK(before.supports == after.supports);
  CHECK(before.viscosity == after.viscosity);
  CHECK(before.kinetic == after.kinetic);
  CHECK(before.base == after.base);
}

}  // namespace

TEST_CASE("a circuit around an elastance beats as the circulation alone does",
          "[unit][circulation]") {
  circulation::CircuitParameters p;
  p.kind = circulation::Kind::closed_loop;
  p.beats = 1;
  p.step = 2e-3;
  const circulation::Cycle alone = circulation::run_alone(p);
  circulation::Circuit circuit(p);
  for (int i = 1; i <= 200; ++i) {
    test::step(circuit, p, i * p.step);
    CHECK(circuit.states().front() ==
          Approx(alone.samples[static_cast<std::size_t>(i)].signals.volume).epsilon(1e-9));
  }
}

TEST_CASE("a cycle without a circulation is refused", "[unit][heartbeat]") {
  const mesh::Mesh mesh = coarse_wall();
  CycleSetup setup = quick(mesh);
  setup.circuit.kind = circulation::Kind::none;
  CHECK_THROWS_AS(heartbeat::run_cycle(setup, empty_folder("lv_cycle_none"), {}), InputError);
}

TEST_CASE("a heartbeat that was stopped goes on bit for bit", "[unit][heartbeat]") {
  const mesh::Mesh mesh = coarse_wall();
  const CycleSetup setup = quick(mesh);
  const Beat undisturbed = heartbeat::run_cycle(setup, empty_folder("lv_cycle_whole"), {});
  check_same(undisturbed, stopped_and_resumed(setup));
  CHECK(undisturbed.energy.error() < 0.01);
  CHECK(undisturbed.energy.kinetic == 0.0);
  CHECK(undisturbed.energy.viscosity == 0.0);
}

TEST_CASE(
    "with inertia, viscosity, springs, dashpots and activation it does too, and its energy is "
    "all there",
    "[unit][heartbeat]") {
  const mesh::Mesh mesh = coarse_wall();
  const CycleSetup setup = moving(mesh);
  const Beat undisturbed = heartbeat::run_cycle(setup, empty_folder("lv_cycle_moving"), {});
  check_same(undisturbed, stopped_and_resumed(setup));
  const heartbeat::EnergyBalance& e = undisturbed.energy;
  INFO("pressure " << e.pressure << " muscle " << e.muscle << " stored " << e.stored << " kinetic "
                   << e.kinetic << " supports " << e.supports << " viscosity " << e.viscosity);
  CHECK(e.error() < 0.01);
  CHECK(e.supports > 0.01 * e.muscle);  // else the balance would not see them
  CHECK(e.viscosity > 0.01 * e.muscle);
  CHECK(undisturbed.curves.back().largest_velocity > 0.0);
}

TEST_CASE("a base that moves alone takes the heart along, whose beat stays", "[unit][heartbeat]") {
  const mesh::Mesh mesh = coarse_wall();
  CycleSetup setup = quick(mesh);
  setup.model.heart.base.kind = solid::BasalSupport::Kind::fixed;
  const Beat still = heartbeat::run_cycle(setup, empty_folder("lv_cycle_still_base"), {});
  setup.base_motion = moving_base(mesh, setup.circuit.period);
  const Beat beat = heartbeat::run_cycle(setup, empty_folder("lv_cycle_moving_base"), {});
  const auto& a = still.cycle->beats.back();
  const auto& b = beat.cycle->beats.back();
  // Newton's method ends elsewhere within its tolerance, and valves are found between steps
  CHECK(b.end_systolic_volume == Approx(a.end_systolic_volume).epsilon(1e-4));
  CHECK(b.peak_pressure == Approx(a.peak_pressure).epsilon(1e-4));
  CHECK(still.energy.base == 0.0);
  CHECK(beat.energy.error() < 0.01);
  // it bears what the pressure does on the opening, and rigid springs take nothing of it
  CHECK(std::abs(beat.energy.base) > 0.1 * beat.energy.muscle);
  CHECK(std::abs(beat.energy.supports) < 0.005 * beat.energy.muscle);
  const Vec3& before = still.at(heartbeat::end_systole).positions.front();
  const Vec3& after = beat.at(heartbeat::end_systole).positions.front();
  CHECK((after - before).norm() > 5.0);
}

TEST_CASE(
    "the work of a base that moves within its surroundings is in the balance of energy, and a "
    "beat goes on bit for bit",
    "[unit][heartbeat]") {
  const mesh::Mesh mesh = coarse_wall();
  CycleSetup setup = moving(mesh);
  const Beat still = heartbeat::run_cycle(setup, empty_folder("lv_cycle_still_base"), {});
  setup.base_motion = moving_base(mesh, setup.circuit.period);
  const Beat beat = heartbeat::run_cycle(setup, empty_folder("lv_cycle_moving_base"), {});
  check_same(beat, stopped_and_resumed(setup));
  const heartbeat::EnergyBalance& e = beat.energy;
  INFO("pressure " << e.pressure << " muscle " << e.muscle << " stored " << e.stored << " kinetic "
                   << e.kinetic << " supports " << e.supports << " viscosity " << e.viscosity
                   << " base " << e.base);
  CHECK(e.error() < 0.01);
  CHECK(std::abs(e.base) > 0.03 * e.muscle);         // else the balance would not see it
  CHECK(e.supports > 1.05 * still.energy.supports);  // dashpots of the epicardium are drawn along
  const std::vector<double> volumes = mesh::cell_volumes(mesh);
  REQUIRE(8 * e.work_density.size() == volumes.size());
  double work = 0.0;
  for (std::size_t c = 0; c < volumes.size(); ++c)
    work += e.work_density[c / 8] * volumes[c];
  CHECK(work == Approx(e.muscle).epsilon(1e-9));
}

TEST_CASE("steps are as short as their local error asks", "[unit][heartbeat]") {
  const mesh::Mesh mesh = coarsest_wall();
  CycleSetup setup = quick(mesh);
  const auto esv = [](const Beat& beat) { return beat.cycle->beats.back().end_systolic_volume; };
  setup.cycle.step = 2e-3;
  const Beat fine = heartbeat::run_cycle(setup, empty_folder("lv_cycle_fine"), {});
  setup.cycle.step = 1.6e-2;
  const Beat rough = heartbeat::run_cycle(setup, empty_folder("lv_cycle_rough"), {});
  setup.cycle.step_error = 2e-3;
  const Beat adaptive = heartbeat::run_cycle(setup, empty_folder("lv_cycle_adaptive"), {});
  CHECK(adaptive.retries > rough.retries);
  CHECK(adaptive.steps < fine.steps / 2);
  INFO("ESV " << esv(fine) << " fine, " << esv(rough) << " rough, " << esv(adaptive));
  CHECK(std::abs(esv(adaptive) - esv(fine)) < 0.5 * std::abs(esv(rough) - esv(fine)));
  check_same(adaptive, stopped_and_resumed(setup));
}

TEST_CASE("muscle that is activated later contracts later", "[unit][heartbeat]") {
  const mesh::Mesh mesh = coarse_wall();
  CycleSetup setup = quick(mesh);
  setup.circuit.period = 0.24;
  const Beat at_once = heartbeat::run_cycle(setup, empty_folder("lv_cycle_at_once"), {});
  constexpr double delay = 0.04;  // of five steps
  setup.activation_times.assign(mesh.nodes.size(), delay);
  const Beat later = heartbeat::run_cycle(setup, empty_folder("lv_cycle_later"), {});
  const auto opens = [](const Beat& beat) { return beat.cycle->beats.back().aortic_opens; };
  CHECK(opens(later) - opens(at_once) == Approx(delay).margin(1e-3));
  CHECK(later.curves.front().calcium == Approx(0.1));
}

TEST_CASE("measured heartbeats are those of a run, and go on from where others ended",
          "[unit][heartbeat]") {
  const mesh::Mesh mesh = coarse_wall();
  CycleSetup setup = quick(mesh);
  setup.circuit.start.p_ar_sys = 70.0 * units::mmHg;
  const auto first = heartbeat::measure_beats(setup, nullptr, empty_folder("lv_measured"));
  REQUIRE(first);
  heartbeat::Archive archive;
  heartbeat::store(first->end, archive);
  const heartbeat::BeatBegin begin = heartbeat::load_begin(archive);
  CHECK(begin.wall.now.positions == first->end.wall.now.positions);
  CHECK(begin.wall.muscle == first->end.wall.muscle);
  CHECK(begin.circuit == first->end.circuit);
  const auto second = heartbeat::measure_beats(setup, &begin, empty_folder("lv_measured_more"));
  REQUIRE(second);
  setup.cycle.beats = 2;
  const Beat both = heartbeat::run_cycle(setup, empty_folder("lv_measured_both"), {});
  const auto& run = both.cycle->beats;
  REQUIRE(run.size() == 2);
  CHECK(first->cycle.beats.back().end_systolic_volume == run[0].end_systolic_volume);
  // the circuit's first step is of first order again
  CHECK(second->cycle.beats.back().end_systolic_volume ==
        Approx(run[1].end_systolic_volume).epsilon(1e-3));
  CHECK(second->cycle.beats.back().aortic_systolic == Approx(run[1].aortic_systolic).epsilon(1e-3));
}

TEST_CASE("a run begins where another has ended, if both have the same wall and circuit",
          "[unit][heartbeat]") {
  const mesh::Mesh mesh = coarse_wall();
  CycleSetup setup = quick(mesh);
  const auto first = empty_folder("lv_cycle_first");
  static_cast<void>(heartbeat::run_cycle(setup, first, {}));
  setup.begin = first / heartbeat::end_of_beats;
  const Beat next = heartbeat::run_cycle(setup, empty_folder("lv_cycle_next"), {});
  setup.begin.clear();
  setup.cycle.beats = 2;
  const Beat both = heartbeat::run_cycle(setup, empty_folder("lv_cycle_both"), {});
  CHECK(next.cycle->beats.back().end_systolic_volume ==
        Approx(both.cycle->beats.back().end_systolic_volume).epsilon(1e-3));
  setup.begin = first / heartbeat::end_of_beats;
  setup.circuit.kind = circulation::Kind::closed_loop;
  CHECK_THROWS_WITH(heartbeat::run_cycle(setup, empty_folder("lv_cycle_other"), {}),
                    Catch::Contains("in another circulation"));
  const mesh::Mesh coarser = coarsest_wall();
  CycleSetup other = quick(coarser);
  other.begin = first / heartbeat::end_of_beats;
  CHECK_THROWS_WITH(heartbeat::run_cycle(other, empty_folder("lv_cycle_other"), {}),
                    Catch::Contains("of a wall with"));
  other.begin = std::filesystem::temp_directory_path() / "lv_cycle_no_end.bin";
  std::ofstream(other.begin) << "0.1\n";
  CHECK_THROWS_WITH(heartbeat::run_cycle(other, empty_folder("lv_cycle_other"), {}),
                    Catch::Contains("is not where heartbeats have ended") &&
                        !Catch::Contains("Delete"));  // a folder that is the user's
}

TEST_CASE("why a beat has no end-systole is told by its valves", "[unit][heartbeat]") {
  const mesh::Mesh mesh = coarsest_wall();
  CycleSetup setup = quick(mesh);
  setup.cycle = {.beats = 1, .step = 1e-2};
  double shown = 0.0;
  heartbeat::Observers observers;
  observers.curves = [&](const heartbeat::RunState& run) {
    shown = run.beat.cycle->samples.back().time;
  };
  const auto refused = [&](const std::string& why) {
    shown = 0.0;
    CHECK_THROWS_WITH(heartbeat::run_cycle(setup, empty_folder("lv_cycle_incomplete"), observers),
                      Catch::Contains("no end-systole: the aortic valve " + why));
    CHECK(shown == Approx(setup.circuit.period));  // all of it, for cycle.csv
  };
  setup.circuit.start.p_ar_sys = 400.0 * units::mmHg;
  refused("stays closed");
  setup.circuit.start.p_ar_sys = 0.0;
  setup.circuit.windkessel.R_p = 1e-6 * circulation::resistance;
  refused("is open while the heart fills");
}

TEST_CASE("a wall in a closed loop leaps to its limit cycle and keeps the loop's blood",
          "[unit][heartbeat]") {
  const mesh::Mesh mesh = coarsest_wall();
  CycleSetup setup = quick(mesh);
  setup.circuit.kind = circulation::Kind::closed_loop;
  setup.circuit.period = 0.6;
  setup.circuit.closed_loop.left_atrium.t_C = setup.circuit.closed_loop.right_atrium.t_C = 0.54;
  setup.circuit.closed_loop.right_ventricle.T_R = 0.3;
  setup.circuit.closed_loop.blood = 1400.0 * units::ml;
  setup.cycle = {.beats = 3, .tolerance = 1e-3, .step = 1e-2};
  const Beat leaping = heartbeat::run_cycle(setup, empty_folder("lv_cycle_leaping"), {});
  setup.cycle.leap = false;
  const Beat walking = heartbeat::run_cycle(setup, empty_folder("lv_cycle_walking"), {});
  CHECK(leaping.cycle->leaps > 0);
  CHECK(walking.cycle->leaps == 0);
  CHECK(leaping.cycle->blood_lost < 1e-10);
  CHECK(leaping.cycle->change < 0.3 * walking.cycle->change);
  CHECK(circulation::blood_of(setup.circuit, leaping.cycle->samples.back().signals) ==
        Approx(1400.0 * units::ml).epsilon(1e-10));
}

namespace {

/// Beats of a closed loop around an elastance, the last of 20 or that of a limit cycle. Each is
/// stronger or weaker by up to `noise` of itself.
circulation::Cycle loop_with_noise(double noise) {
  heartbeat::CycleCourse course;
  course.circuit.kind = circulation::Kind::closed_loop;
  course.cycle = {.beats = 20, .tolerance = 1e-3, .step = 8e-3};
  heartbeat::CycleRecord record(course);
  double volume = course.circuit.start.V_lv;
  record.start(volume, record.filling_pressure());
  while (!record.done()) {
    record.begin_beat();
    circulation::ElastanceParameters beating = course.circuit.left_ventricle;
    beating.E_A *= 1.0 + noise * std::cos(7.0 * record.beat() * record.beat());
    const circulation::Elastance ventricle(beating, record.period());
    while (!record.beat_is_over()) {
      const double dt = record.step_size(course.cycle.step);
      const double E = ventricle.at(record.after(dt));
      double p = E * (volume - beating.V_0);
      for (int k = 0; k < 50; ++k) {
        const auto [after, slope] = record.volume_after(dt, p);
        p -= (after - p / E - beating.V_0) / (slope - 1.0 / E);
      }
      volume = p / E + beating.V_0;
      record.step(dt, p, volume);
    }
    record.end_beat();
  }
  return record.cycle();
}

}  // namespace

TEST_CASE("leaps end where beats that differ leave larger changes after them",
          "[unit][heartbeat]") {
  const circulation::Cycle same = loop_with_noise(0.0);
  CHECK(same.is_limit);
  const circulation::Cycle other = loop_with_noise(0.01);
  CHECK_FALSE(other.is_limit);
  CHECK(other.leaps > 1);
  CHECK(other.leaps < 8);  // of 19
  CHECK(same.leaps > other.leaps);
}

TEST_CASE("heartbeats in an archive are those that were put in", "[unit][heartbeat]") {
  circulation::CircuitParameters p;
  p.kind = circulation::Kind::windkessel;
  p.beats = 2;
  p.tolerance = 0.0;
  const circulation::Cycle cycle = circulation::run_alone(p);
  heartbeat::Archive archive;
  heartbeat::store(cycle, archive);
  const circulation::Cycle again = heartbeat::load_cycle(archive);
  REQUIRE(again.samples.size() == cycle.samples.size());
  CHECK(again.samples.back().signals.others == cycle.samples.back().signals.others);
  REQUIRE(again.beats.size() == 2);
  CHECK(again.beats[1].end_systolic_volume == cycle.beats[1].end_systolic_volume);
  CHECK(again.columns.front().name == cycle.columns.front().name);
}
