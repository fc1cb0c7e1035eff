#include "lv/pipeline/confirmation.hpp"

#include "lv/base/check.hpp"
#include "lv/base/table.hpp"
#include "lv/calibrate/record.hpp"
#include "lv/pipeline/calibration.hpp"
#include "lv/pipeline/validate.hpp"

#include "support/temporary_folder.hpp"
#include <catch2/catch.hpp>

#include <utility>

using namespace lv;

TEST_CASE("beats with fitted parameters are read as they were written", "[unit][pipeline]") {
  const test::TemporaryFolder folder;
  const auto file = folder / "confirmation.json";
  const pipeline::Confirmation written{
      {1.25, 0.9, 1.1, 3.7},
      0.01,
      {{{1.0, 0.9, 1.1, 3.0}, {{"EDV", 120e3, 119.5e3, 123e3}, {"ESV", 60e3, 60.2e3, 60.1e3}}}}};
  pipeline::write_confirmation(written, file);
  const pipeline::Confirmation read = pipeline::read_confirmation(file);
  CHECK(read.parameters == written.parameters);
  CHECK(read.tolerance == 0.01);
  REQUIRE(read.beats.size() == 1);
  CHECK(read.beats[0].parameters == written.beats[0].parameters);
  CHECK_FALSE(read.beats[0].is_within);
  REQUIRE(read.beats[0].volumes.size() == 2);
  CHECK(read.beats[0].volumes[0].off() == Approx(0.025));
  CHECK(read.beats[0].volumes[1].within(0.01));
  CHECK(calibrate::read_parameters(file) == written.parameters);
}

TEST_CASE("a fit is read with its derivatives and with other pressures", "[unit][pipeline]") {
  const test::TemporaryFolder folder;
  const auto file = folder / "calibration.json";
  write_file(file,
             R"({"parameters": {"C_a": 1, "scale": 2, "exponent": 1.5, "T_scale": 3},
 "volumes": [{"name": "ESV", "pressure_mmHg": 100, "target_ml": 60, "model_ml": 61,
              "dV_dparameter_ml": {"scale": 0.5, "T_scale": -7}}],
 "uncertainty": [{"parameter": "scale"}, {"parameter": "T_scale"}],
 "klotz": {"pressure_mmHg": 9},
 "other_pressures": [{"pressure_mmHg": 5, "no_fit": "too soft"},
                     {"pressure_mmHg": 13, "scale": 2.5, "T_scale": 4, "unloaded_volume_ml": 55}]})");
  const calibrate::RecordedFit fit = calibrate::read_fit(file);
  REQUIRE(fit.fitted.size() == 2);
  CHECK(fit.parameters.*fit.fitted[1].member == 3.0);
  CHECK(fit.volumes.at(0).by_parameter.at("T_scale") == Approx(-7e3));
  CHECK(fit.volumes.at(0).target == Approx(60e3));
  REQUIRE(fit.other_pressures.size() == 2);
  CHECK(fit.other_pressures[0].why_not == "too soft");
  CHECK(fit.other_pressures[1].parameters->scale == 2.5);
  CHECK(fit.other_pressures[1].parameters->exponent == 1.5);  // not fitted
  write_file(file, "{\"parameters\": {\"C_a\": 1}}");
  CHECK_THROWS_AS(calibrate::read_fit(file), RunError);
}

TEST_CASE("pressures are assumed where a case leaves them out, not in heartbeats",
          "[unit][pipeline]") {
  case_file::Case c;
  CHECK(pipeline::fit_record(c, "", "").assumed.size() == 2);
  c.origin["protocol.ed_pressure"] = "case.toml:3";
  CHECK(pipeline::fit_record(c, "", "").assumed.size() == 1);
  c.origin.clear();
  c.protocol.kind = heartbeat::ProtocolKind::cycle;
  CHECK(pipeline::fit_record(c, "", "").assumed.empty());
}

TEST_CASE("a fit beside heartbeats is said to be made at the pressures of the protocol",
          "[unit][pipeline]") {
  case_file::Case c;
  c.calibration.active = true;
  CHECK(pipeline::fit_outside_heartbeats(c).empty());
  c.protocol.kind = heartbeat::ProtocolKind::cycle;
  CHECK_THAT(pipeline::fit_outside_heartbeats(c),
             Catch::Contains("protocol.ed_pressure (8 mmHg) and protocol.es_pressure (150 mmHg)"));
  c.calibration.cycle = true;  // the heartbeats are fitted themselves
  CHECK(pipeline::fit_outside_heartbeats(c).empty());
}

TEST_CASE("fibres of a left-handed helix are told with the angles to write", "[unit][pipeline]") {
  case_file::Case c;
  CHECK(pipeline::left_handed_fibres(c).empty());
  std::swap(c.fibres.helix_endo, c.fibres.helix_epi);
  CHECK_THAT(pipeline::left_handed_fibres(c),
             Catch::Contains("left-handed") && Catch::Contains("write -60 and 60"));
}
