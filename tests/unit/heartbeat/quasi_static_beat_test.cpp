#include "lv/heartbeat/quasi_static_beat.hpp"

#include "lv/verify/small_ventricle.hpp"

#include <catch2/catch.hpp>

namespace {

using namespace lv;
using heartbeat::Beat;

const mesh::Mesh& quadratic_mesh() {
  static const mesh::Mesh mesh = verify::ideal_mesh({.edge_length = 9.0, .layers = 2, .order = 2});
  return mesh;
}

heartbeat::Protocol weak() {
  heartbeat::Protocol protocol;
  protocol.ed_pressure = 1.0 * units::mmHg;
  protocol.es_pressure = 10.0 * units::mmHg;
  return protocol;
}

}  // namespace

TEST_CASE("a quasi-static beat goes through the phases of its protocol and comes to their moments",
          "[heartbeat]") {
  const solid::CardiacModel heart;
  const Beat beat = heartbeat::run_quasi_static_beat({quadratic_mesh(), heart, {}, weak()}, {});
  const std::vector<heartbeat::Phase> phases = heartbeat::phases(weak());
  REQUIRE(beat.moments.size() == phases.size());
  double end = 0.0;
  for (std::size_t i = 0; i < phases.size(); ++i) {
    const heartbeat::NamedMoment& moment = beat.moments[i];
    end += phases[i].ramp;
    CHECK(moment.name == phases[i].marks);
    CHECK(moment.phase == phases[i].name);
    CHECK(moment.wall.time == Approx(end));
    CHECK(moment.wall.pressure == phases[i].loads(phases[i].settled).pressure);
  }
  CHECK(beat.curves.front().phase == phases.front().name);
  CHECK(beat.curves.back().phase == phases.back().name);
}

TEST_CASE("the calcium of a quasi-static beat is known where the muscle rests or is fully active",
          "[heartbeat]") {
  const solid::CardiacModel heart;
  const heartbeat::Protocol protocol = weak();
  const Beat beat = heartbeat::run_quasi_static_beat({quadratic_mesh(), heart, {}, protocol}, {});
  for (const heartbeat::CurveRow& row : beat.curves)
    if (row.phase == "filling")
      CHECK(row.calcium == protocol.calcium.Ca_0);
    else if (&row != &beat.curves.back())
      CHECK(std::isnan(row.calcium));
  CHECK(beat.curves.back().calcium == protocol.calcium.Ca_max);
}
