#include "lv/case_file/beat_fit.hpp"

#include "lv/base/check.hpp"

#include "support/heartbeat_case.hpp"
#include <catch2/catch.hpp>

namespace {

using namespace lv;
using Catch::Matchers::Contains;
using Names = std::vector<std::pair<std::string, std::string>>;

case_file::Case fitted(const std::string& data, const std::string& kind = "windkessel") {
  return test::heartbeat_case(kind, "[calibrate]\ncycle = true\n" + data);
}

/// Parameter and datum of what is fitted.
Names pairs(const case_file::BeatFit& fit) {
  Names all;
  for (const case_file::BeatParameter& p : fit.parameters)
    all.emplace_back(p.parameter->name, fit.data[p.datum].name);
  return all;
}

}  // namespace

TEST_CASE("each datum of a heartbeat tells of one parameter", "[unit][case_file]") {
  const std::string all =
      "edv = \"120 ml\"\nesv = \"50 ml\"\ncuff_systolic = \"120 mmHg\"\n"
      "cuff_diastolic = \"75 mmHg\"\n";
  const auto windkessel = case_file::beat_fit(fitted(all));
  CHECK(pairs(windkessel) == Names{{"circulation.windkessel.p_ven", "EDV"},
                                   {"active.land2017.T_ref", "ESV"},
                                   {"circulation.windkessel.R_p", "diastolic"},
                                   {"circulation.windkessel.C", "systolic"}});
  CHECK(windkessel.left_alone.empty());
  CHECK(pairs(case_file::beat_fit(fitted(all, "closed_loop"))) ==
        Names{{"circulation.closed_loop.blood", "EDV"},
              {"active.land2017.T_ref", "ESV"},
              {"circulation.closed_loop.systemic.R_ar", "diastolic"},
              {"circulation.closed_loop.systemic.C_ar", "systolic"}});
}

TEST_CASE("a datum of a heartbeat that is missing leaves its parameter, and that is said",
          "[unit][case_file]") {
  const auto fit = case_file::beat_fit(fitted("edv = \"120 ml\"\ncuff_systolic = \"120 mmHg\"\n"));
  CHECK(pairs(fit) ==
        Names{{"circulation.windkessel.p_ven", "EDV"}, {"circulation.windkessel.R_p", "systolic"}});
  REQUIRE(fit.left_alone.size() == 2);
  CHECK_THAT(fit.left_alone[0], Contains("active.land2017.T_ref") && Contains("calibrate.esv"));
  CHECK_THAT(fit.left_alone[1],
             Contains("circulation.windkessel.C") && Contains("calibrate.cuff_diastolic"));
  CHECK(pairs(case_file::beat_fit(fitted("cuff_diastolic = \"75 mmHg\"\n"))) ==
        Names{{"circulation.windkessel.R_p", "diastolic"}});
}

TEST_CASE("a fit of blood begins with what the start holds around the measured volume",
          "[unit][case_file]") {
  const auto loop = fitted("edv = \"120 ml\"\n", "closed_loop");
  const auto& blood = *case_file::find_parameter("circulation.closed_loop.blood");
  CHECK(case_file::value_of(blood, loop) == 0.0);
  CHECK(case_file::value_of(blood, case_file::begin_of_beat_fit(loop)) ==
        Approx(1617.876 - 118.52 + 120.0).epsilon(1e-6));
  auto known = loop;
  case_file::set_value(blood, known, 1500.0);
  CHECK(case_file::value_of(blood, case_file::begin_of_beat_fit(known)) == Approx(1500.0));
  const auto windkessel = fitted("edv = \"120 ml\"\n");
  CHECK(case_file::value_of(blood, case_file::begin_of_beat_fit(windkessel)) == 0.0);
  CHECK_THROWS_WITH(
      fitted("edv = \"120 ml\"\n[circulation.closed_loop]\nblood = \"100 ml\"\n", "closed_loop"),
      Contains("case.toml") && Contains("nothing fills the vessels"));
}

TEST_CASE("a parameter's value is given and taken in its own unit", "[unit][case_file]") {
  auto c = fitted("edv = \"120 ml\"\n");
  const auto& p = *case_file::find_parameter("circulation.windkessel.R_p");
  CHECK(case_file::value_of(p, c) == Approx(1.05));
  case_file::set_value(p, c, 1.5);
  CHECK(c.circulation.windkessel.R_p == Approx(1.5 * units::mmHg / units::ml));
}
