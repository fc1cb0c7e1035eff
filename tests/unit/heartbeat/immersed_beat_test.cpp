#include "lv/heartbeat/immersed_beat.hpp"

#include "lv/verify/small_ventricle.hpp"

#include "support/temporary_folder.hpp"
#include <catch2/catch.hpp>

namespace {

using namespace lv;
using heartbeat::Beat;
using heartbeat::BeatSetup;
using heartbeat::CurveRow;

/// A coarse ventricle that is filled a little and twitches: calcium rises and falls again.
BeatSetup twitch(const mesh::Mesh& mesh) {
  BeatSetup setup = verify::default_beat(mesh, {20, 20, 27}, 4e-4);
  setup.protocol.filling_ramp = 0.04;
  setup.protocol.filling_longest = 0.05;
  setup.protocol.contraction_ramp = 0.04;
  setup.protocol.es_pressure = 10.0 * units::mmHg;
  setup.protocol.calcium = {.mode = material::Calcium::Mode::transient, .tau = 0.03};
  return setup;
}

mesh::Mesh coarse_mesh() {
  return verify::ideal_mesh({.edge_length = 9.0});
}

/// The row of the contraction with the smallest volume.
CurveRow least(const Beat& beat) {
  CurveRow smallest{.volume = 1e9};
  for (const CurveRow& row : beat.curves)
    if (row.phase == "contraction" && row.volume < smallest.volume)
      smallest = row;
  return smallest;
}

}  // namespace

TEST_CASE("end-systole of a calcium transient is where the cavity is smallest", "[heartbeat]") {
  const mesh::Mesh mesh = coarse_mesh();
  const BeatSetup setup = twitch(mesh);
  const test::TemporaryFolder folder;
  const Beat beat = heartbeat::run_immersed_beat(setup, folder / "", {});
  REQUIRE(beat.moments.size() == 2);
  CHECK(beat.moments[0].name == heartbeat::end_diastole);
  CHECK(beat.moments[1].phase == "contraction");
  CHECK(beat.moments[1].by_criterion);  // it ended because the ventricle filled again
  CHECK(beat.at(heartbeat::end_systole).volume < beat.at(heartbeat::end_diastole).volume);
  CHECK(beat.at(heartbeat::end_systole).volume == Approx(least(beat).volume).epsilon(1e-3));
  CHECK(beat.at(heartbeat::end_systole).time == Approx(least(beat).time).margin(2e-3));
  CHECK(beat.curves.back().time > beat.at(heartbeat::end_systole).time);
  CHECK(beat.curves.back().volume > 1.02 * beat.at(heartbeat::end_systole).volume);
  CHECK(beat.curves.back().calcium < beat.curves[beat.curves.size() / 2].calcium);
}

TEST_CASE("a transient that is cut short ends with what it has, and says so", "[heartbeat]") {
  const mesh::Mesh mesh = coarse_mesh();
  BeatSetup setup = twitch(mesh);
  setup.protocol.contraction_longest = 0.02;
  const test::TemporaryFolder folder;
  const Beat beat = heartbeat::run_immersed_beat(setup, folder / "", {});
  CHECK_FALSE(beat.find(heartbeat::end_systole)->by_criterion);
  CHECK(beat.at(heartbeat::end_systole).time == Approx(0.07).margin(1e-3));
}

TEST_CASE("springs around the wall keep it from filling and hold its base", "[heartbeat]") {
  const mesh::Mesh mesh = coarse_mesh();
  BeatSetup setup = twitch(mesh);
  setup.protocol.filling_ramp = 0.1;
  setup.protocol.filling_longest = 0.3;
  const test::TemporaryFolder folder, other;
  const Beat sliding = heartbeat::run_immersed_beat(setup, folder / "", {});
  setup.heart.base.kind = solid::BasalSupport::Kind::elastic;
  setup.heart.surroundings.base = {20.0, 5.0, 0.005, 0.005, {}};
  setup.heart.surroundings.epicardium = {2.0, 0.0, 0.005, 0.0, {}};
  const Beat held = heartbeat::run_immersed_beat(setup, other / "", {});
  CHECK(held.at(heartbeat::end_diastole).volume <
        0.95 * sliding.at(heartbeat::end_diastole).volume);
  CHECK(held.find(heartbeat::end_systole)->by_criterion);
  CHECK(held.retries == 0);
  double shift = 0.0;
  for (const int node : mesh.base.nodes)
    shift = std::max(shift, std::abs(held.at(heartbeat::end_diastole).positions[node].z() -
                                     mesh.nodes[node].z()));
  // 8 mmHg on an opening of 1500 mm^2 are 1.6 N, on springs of 20 kPa/mm on as large a base 0.05 mm
  CHECK(shift < 0.5);
  CHECK(shift > 0.0);
}
