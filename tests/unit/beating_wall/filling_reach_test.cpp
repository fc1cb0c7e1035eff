#include "lv/beating_wall/filling_reach.hpp"

#include "lv/base/check.hpp"
#include "lv/base/units.hpp"
#include "lv/verify/small_ventricle.hpp"

#include "support/heartbeat_case.hpp"
#include <catch2/catch.hpp>

namespace {

using namespace lv;
using beating_wall::check_filling;
using beating_wall::fill_until;
using Catch::Matchers::Contains;
using units::ml;
using units::mmHg;

case_file::Case fitted(const std::string& lines, const std::string& kind = "windkessel") {
  return test::heartbeat_case(kind, "[calibrate]\ncycle = true\n" + lines);
}

anatomy::MeshResult few_elements() {
  anatomy::MeshResult wall;
  wall.mesh = verify::ideal_mesh({.edge_length = 18.0, .layers = 1, .order = 2});
  return wall;
}

}  // namespace

TEST_CASE("a wall is filled until it holds a volume, and no farther", "[unit][beating_wall]") {
  const auto wall = few_elements();
  const auto c = fitted("edv = \"120 ml\"\n");
  const auto enough = fill_until(120.0 * ml, 60.0 * mmHg, c, wall.mesh);
  CHECK(enough.pressure == Approx(15.0 * mmHg));
  CHECK(enough.volume > 120.0 * ml);
  const auto all = fill_until(300.0 * ml, 40.0 * mmHg, c, wall.mesh);
  CHECK(all.why_ended.empty());
  CHECK(all.pressure == Approx(40.0 * mmHg));
  CHECK(all.volume > enough.volume);
  CHECK(all.volume < 300.0 * ml);
  CHECK(fill_until(60.0 * ml, 60.0 * mmHg, c, wall.mesh).pressure == 0.0);
}

TEST_CASE(
    "an end-diastolic volume to which no heartbeat fills the wall is refused with what it "
    "holds",
    "[unit][beating_wall]") {
  const auto wall = few_elements();
  for (const char* kind : {"windkessel", "closed_loop"}) {
    CHECK_THROWS_AS(check_filling(fitted("edv = \"300 ml\"\n", kind), wall), InputError);
    CHECK_THROWS_WITH(check_filling(fitted("edv = \"300 ml\"\n", kind), wall),
                      Contains("case.toml:10") && Contains("calibrate.edv is 300.0 ml") &&
                          Contains("under 60 mmHg") && Contains("calibrate.passive"));
    CHECK_NOTHROW(check_filling(fitted("edv = \"150 ml\"\n", kind), wall));
  }
  CHECK_NOTHROW(check_filling(fitted("esv = \"50 ml\"\n"), wall));
}

TEST_CASE("a venous pressure that may not grow bounds what the wall is filled to",
          "[unit][beating_wall]") {
  const auto wall = few_elements();
  CHECK_THROWS_WITH(check_filling(fitted("edv = \"170 ml\"\nfactor_max = 1.2\n"), wall),
                    Contains("under 9.6 mmHg, the most that circulation.windkessel.p_ven") &&
                        Contains("factor_max allows more"));
  CHECK_NOTHROW(check_filling(fitted("edv = \"170 ml\"\n"), wall));
}
