#include "lv/beating_wall/heartbeat_record.hpp"

#include "lv/base/table.hpp"

#include "support/temporary_folder.hpp"
#include <catch2/catch.hpp>

#include <cmath>

namespace {

using namespace lv;
using beating_wall::HeartbeatFit;

/// Two of four data were measured; ESV follows both parameters.
HeartbeatFit some_fit() {
  const double none = std::numeric_limits<double>::quiet_NaN();
  HeartbeatFit fit{{{"EDV", "ml", 120.0, 120.1},
                    {"ESV", "ml", 50.0, 49.9},
                    {"systolic", "mmHg", none, 110.0},
                    {"diastolic", "mmHg", none, 70.0}},
                   {{"circulation.windkessel.p_ven", "filling pressure", "mmHg", "EDV", 8.0, 10.0},
                    {"active.land2017.T_ref", "contractility", "kPa", "ESV", 120.0, 100.0}},
                   Eigen::MatrixXd(4, 2),
                   {"The arterial resistance keeps the case's value"},
                   0.01,
                   9,
                   25};
  fit.sensitivity << 0.5, 0.0, 0.2, -0.8, 0.1, 0.2, 0.1, 0.2;
  return fit;
}

}  // namespace

TEST_CASE("a fit of heartbeats is read as it was written, and its values are set",
          "[unit][beating_wall]") {
  const test::TemporaryFolder folder;
  const auto file = folder / "heartbeats.bin";
  beating_wall::write_heartbeats(some_fit(), file);
  const HeartbeatFit read = beating_wall::read_heartbeats(file);
  REQUIRE(read.data.size() == 4);
  CHECK(read.data[0].model == 120.1);
  CHECK(std::isnan(read.data[2].measured));
  REQUIRE(read.parameters.size() == 2);
  CHECK(read.parameters[0].datum == "EDV");
  CHECK(read.left_alone == some_fit().left_alone);
  CHECK(read.sensitivity == some_fit().sensitivity);
  CHECK(read.moved(0, 0, 0.05) == some_fit().moved(0, 0, 0.05));
  const case_file::Case c = beating_wall::with_values({}, read, file);
  CHECK(c.circulation.windkessel.p_ven == Approx(10.0 * units::mmHg));
  CHECK(c.land2017.T_ref == Approx(100.0));
  CHECK(c.origin.at("active.land2017.T_ref") == file.string());
}

TEST_CASE("what a wrong datum does to a value follows from the inverse of the sensitivities",
          "[unit][beating_wall]") {
  const HeartbeatFit fit = some_fit();
  CHECK(fit.moved(0, 0, 0.05) == Approx(10.0 * std::exp(0.1)));
  CHECK(fit.moved(1, 0, 0.05) == Approx(100.0 * std::exp(0.2 * 0.1 / 0.8)));
  CHECK(fit.moved(0, 1, 0.05) == Approx(10.0));
  CHECK(fit.moved(1, 1, -0.05) == Approx(100.0 * std::exp(0.05 / 0.8)));
}

TEST_CASE("the text of a fit says what was measured, fitted and left alone",
          "[unit][beating_wall]") {
  const std::string text = beating_wall::text(some_fit());
  CHECK_THAT(text, Catch::Contains("EDV (ml)") && Catch::Contains("filling pressure (mmHg)") &&
                       Catch::Contains("keeps the case's value.") &&
                       Catch::Contains("9 evaluations, 25 heartbeats"));
}
