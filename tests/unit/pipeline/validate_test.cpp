#include "lv/pipeline/validate.hpp"

#include "lv/base/units.hpp"
#include "lv/case_file/case.hpp"
#include "lv/pipeline/circulation.hpp"
#include "lv/pipeline/measured_volumes.hpp"

#include <catch2/catch.hpp>

#include <algorithm>

using namespace lv;
using units::mmHg;

TEST_CASE("an end-diastole that is not that of the images is warned of", "[unit][pipeline]") {
  case_file::Case c;
  c.protocol.ed_pressure = 8.0 * mmHg;
  CHECK(pipeline::unlike_end_diastole(c).empty());
  c.unloaded.pressure = 40.0 * mmHg;
  c.origin["unloaded.pressure"] = "case.toml:2";
  CHECK_THAT(pipeline::unlike_end_diastole(c), Catch::Contains("bears 40 mmHg"));
  c.unloaded.pressure = 8.5 * mmHg;
  CHECK(pipeline::unlike_end_diastole(c).empty());
  c.unloaded.pressure = 3.0 * mmHg;  // it may be that of early diastole
  CHECK(pipeline::unlike_end_diastole(c).empty());
  c.anatomy.source = case_file::AnatomySource::cine;
  c.anatomy.cine.moment = case_file::ShapeMoment::end_diastole;
  CHECK_THAT(pipeline::unlike_end_diastole(c), Catch::Contains("filled to 8 mmHg"));
  c.protocol.kind = heartbeat::ProtocolKind::cycle;  // which has no such pressure
  CHECK(pipeline::unlike_end_diastole(c).empty());
}

TEST_CASE("a heart that would eject next to nothing is warned of", "[unit][pipeline]") {
  case_file::Case c;
  c.calibration.esv = 113.0 * units::ml;
  CHECK(pipeline::little_ejection(c, {}).empty());  // of what is not said
  c.calibration.edv = 113.6 * units::ml;
  CHECK_THAT(pipeline::little_ejection(c, {}), Catch::Contains("an ejection fraction of 1%"));
  c.calibration.esv = 100.0 * units::ml;
  CHECK(pipeline::little_ejection(c, {}).empty());
}

TEST_CASE("pressures and calcium that no heart has are warned of", "[unit][pipeline]") {
  case_file::Case c;
  c.circulation.windkessel.p_ven = 12.0 * mmHg;
  c.origin["circulation.windkessel.p_ven"] = "case.toml:2";
  CHECK(pipeline::high_filling_pressure(c).empty());
  c.circulation.windkessel.p_ven = 12.0;  // kPa
  CHECK_THAT(pipeline::high_filling_pressure(c), Catch::Contains("p_ven is 90.0074 mmHg"));
  c.protocol.calcium.Ca_max = 0.7;
  c.origin["calcium.Ca_max"] = "case.toml:3";
  CHECK(pipeline::high_calcium(c).empty());
  c.protocol.calcium.Ca_max = 700.0;
  CHECK_THAT(pipeline::high_calcium(c), Catch::Contains("calcium.Ca_max is 700 uM"));
}

TEST_CASE("a chamber that contracts after the beat's end is warned of", "[unit][pipeline]") {
  case_file::Case c;
  CHECK(pipeline::chamber_beyond_beat(c).empty());
  c.circulation.kind = circulation::Kind::closed_loop;
  CHECK(pipeline::chamber_beyond_beat(c).empty());
  c.circulation.period = 0.6;
  const std::string beyond = pipeline::chamber_beyond_beat(c);
  CHECK_THAT(beyond, Catch::Contains("left_atrium.t_C is 0.72 s and begins 0.12 s after a beat") &&
                         Catch::Contains("right_atrium.t_C"));
  CHECK_THAT(beyond, !Catch::Contains("right_ventricle.t_C is 0.1 s and begins"));
  const auto warnings = pipeline::cycle_warnings(c, {});
  CHECK(std::find(warnings.begin(), warnings.end(), beyond) != warnings.end());
  c.circulation.period = 1.5;
  CHECK_THAT(pipeline::chamber_beyond_beat(c),
             Catch::Contains("left_atrium.t_C is 0.72 s, 0.88 s before the right ventricle"));
  c.circulation.closed_loop.left_atrium.t_C = c.circulation.closed_loop.right_atrium.t_C = 1.42;
  CHECK(pipeline::chamber_beyond_beat(c).empty());
  c.circulation.kind = circulation::Kind::windkessel;  // which has no such chambers
  CHECK(pipeline::chamber_beyond_beat(c).empty());
}
