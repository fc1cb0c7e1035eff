#include "lv/pipeline/confirmation.hpp"

#include "lv/base/check.hpp"
#include "lv/base/table.hpp"
#include "lv/pipeline/calibration.hpp"
#include "lv/pipeline/fit_archive.hpp"
#include "lv/pipeline/validate.hpp"

#include "support/temporary_folder.hpp"
#include <catch2/catch.hpp>

#include <utility>

using namespace lv;

TEST_CASE("beats with fitted parameters are read as they were written", "[unit][pipeline]") {
  const test::TemporaryFolder folder;
  const auto file = folder / "confirmation.bin";
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
  CHECK(pipeline::load_parameters(heartbeat::Archive::read(file)) == written.parameters);
  CHECK_THAT(read_file(folder / "confirmation.json"), Catch::Contains("\"beat_ml\": 123.0"));
}

TEST_CASE("a fit is read with its derivatives and with other pressures, to the last bit",
          "[unit][pipeline]") {
  const test::TemporaryFolder folder;
  calibrate::RecordedFit written{{1.0, 2.0, 1.5, 1.0 / 3.0}, {}, {}, 9.0, {}};
  for (const calibrate::Fitted& p : calibrate::all_parameters())
    if (p.name == "scale" || p.name == "T_scale")
      written.fitted.push_back(p);
  written.volumes.push_back({"ESV", 13.3, 60e3, 61e3 / 7.0, {{"scale", 0.5}, {"T_scale", -7e3}}});
  written.other_pressures.push_back({5.0, {}, 0.0, "too soft at 5\u00a0mmHg"});
  written.other_pressures.push_back({13.0, {{1.0, 2.5, 1.5, 4.0}}, 55e3, ""});
  written.parameters.segments[6] = 1.0 / 7.0;
  written.segments.push_back({7, 1.0 / 7.0, 0.2, 0.4});
  written.shape = calibrate::ShapeFit{{}, {2.0, 0.5}, {1.0 / 3.0, -0.125}};
  heartbeat::Archive archive;
  pipeline::store(written, archive);
  archive.write(folder / "calibration.bin");
  const auto fit = pipeline::load_fit(heartbeat::Archive::read(folder / "calibration.bin"));
  CHECK(fit.parameters == written.parameters);
  REQUIRE(fit.fitted.size() == 2);
  CHECK(fit.parameters.*fit.fitted[1].member == 1.0 / 3.0);
  CHECK(fit.volumes.at(0).by_parameter == written.volumes[0].by_parameter);
  CHECK(fit.volumes.at(0).model == 61e3 / 7.0);
  CHECK(fit.klotz_pressure == 9.0);
  REQUIRE(fit.other_pressures.size() == 2);
  CHECK_FALSE(fit.other_pressures[0].parameters);
  CHECK(fit.other_pressures[0].why_not == written.other_pressures[0].why_not);
  CHECK(fit.other_pressures[1].parameters == written.other_pressures[1].parameters);
  REQUIRE(fit.segments.size() == 1);
  CHECK(fit.segments[0].segment == 7);
  CHECK(fit.segments[0].factor == 1.0 / 7.0);
  CHECK(fit.segments[0].error == 0.2);
  CHECK(fit.segments[0].resolution == 0.4);
  CHECK(fit.shape.value().before.rms == 2.0);
  CHECK(fit.shape->after.bias == -0.125);
  archive.set_words("fitted", {"scale", "colour"});
  CHECK_THROWS_AS(pipeline::load_fit(archive), RunError);
}

TEST_CASE("what is recorded of a fit has the derivatives by the parameters themselves",
          "[unit][pipeline]") {
  calibrate::Fit fit;
  fit.parameters.scale = 2.0;
  fit.observations.push_back({"EDV", {1.0, 0.0}, 120e3});
  fit.volumes = {119e3};
  fit.sensitivity.parameters = {calibrate::all_parameters()[1]};
  fit.sensitivity.by_parameter = Eigen::MatrixXd::Constant(1, 1, -0.25);
  const calibrate::RecordedFit record = calibrate::recorded({}, fit);
  REQUIRE(record.volumes.size() == 1);
  CHECK(record.volumes[0].by_parameter.at("scale") == Approx(-0.25 * 119e3 / 2.0));
  CHECK_FALSE(record.klotz_pressure);
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

TEST_CASE("muscle that is not fitted to a heart that was seen is assumed", "[unit][pipeline]") {
  case_file::Case c;
  c.origin["protocol.ed_pressure"] = c.origin["protocol.es_pressure"] = "case.toml:3";
  const auto assumed = [&] {
    std::string parts;
    for (const geometry::Assumption& a : pipeline::fit_record(c, "", "").assumed)
      parts += a.part + ";";
    return parts;
  };
  CHECK(assumed().empty());  // of an ellipsoid all is
  c.anatomy.source = case_file::AnatomySource::labels;
  CHECK(assumed() == "stiffness;contractility;");
  CHECK_FALSE(pipeline::fits_contractility(c));
  c.calibration.active = true;
  CHECK(pipeline::fits_contractility(c));
  c.calibration.passive = calibrate::FittedPassive::klotz;
  CHECK(pipeline::fitted_names(c).size() == 9);
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
