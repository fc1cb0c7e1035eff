#include "lv/heartbeat/cycle.hpp"

#include "lv/base/check.hpp"
#include "lv/circulation/circuit.hpp"
#include "lv/circulation/elastance.hpp"
#include "lv/geometry/ellipsoid.hpp"
#include "lv/mesh/wall_mesh.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <filesystem>

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

/// A beat too short for a heart, for the test's sake.
CycleSetup quick(const mesh::Mesh& mesh) {
  solid::CardiacModel heart{.base = {.stiffness = implicit::rigid_base}};
  heart.myocardium.active = material::Land2017{};
  const material::Calcium calcium{.Ca_0 = 0.1,
                                  .Ca_max = 0.7,
                                  .shape = material::Calcium::Shape::double_exponential,
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

/// Ends a run in the middle of a step, as a kill would.
struct Stop {};

}  // namespace

TEST_CASE("a circuit around an elastance beats as the circulation alone does",
          "[unit][circulation]") {
  circulation::Parameters p;
  p.kind = circulation::Kind::closed_loop;
  p.beats = 1;
  p.step = 2e-3;
  const circulation::Cycle alone = circulation::run_alone(p);
  circulation::Circuit circuit(p);
  const circulation::Elastance ventricle(p.left_ventricle, p.period);
  for (int i = 1; i <= 200; ++i) {
    const double t = i * p.step;
    double pressure = ventricle.pressure(t, circuit.states().front());
    for (int k = 0; k < 50; ++k) {  // Newton's method for V_circuit(p) = p/E + V_0
      const auto [volume, slope] = circuit.after(t, p.step, pressure);
      const double E = ventricle.at(t);
      pressure -= (volume - pressure / E - p.left_ventricle.V_0) / (slope - 1.0 / E);
    }
    circuit.advance(t, p.step, pressure);
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
  REQUIRE(undisturbed.cycle);

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
  const Beat resumed = heartbeat::run_cycle(setup, folder, {});

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
  CHECK(undisturbed.energy.muscle == resumed.energy.muscle);
}

TEST_CASE("heartbeats in an archive are those that were put in", "[unit][heartbeat]") {
  circulation::Parameters p;
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
