#include "lv/pipeline/validate.hpp"

#include "lv/base/units.hpp"
#include "lv/case_file/case.hpp"

#include <catch2/catch.hpp>

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
