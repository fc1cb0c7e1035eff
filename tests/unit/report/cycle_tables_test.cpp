#include "lv/report/cycle_tables.hpp"

#include "lv/circulation/cycle.hpp"

#include <catch2/catch.hpp>

#include <limits>

namespace {

using namespace lv;

circulation::Cycle two_beats() {
  circulation::CircuitParameters p;
  p.kind = circulation::Kind::windkessel;
  p.step = 2e-3;
  p.beats = 2;
  return circulation::run_alone(p);
}

}  // namespace

TEST_CASE("cycle.csv has every step with its beat, in clinical units", "[unit][report]") {
  const circulation::Cycle cycle = two_beats();
  const Table table = report::cycle_table(cycle.samples, cycle.columns, 0.8);
  CHECK(table.rows().size() == 801);
  CHECK(table.whole_numbers("beat").front() == 0);
  CHECK(table.whole_numbers("beat").at(1) == 1);
  CHECK(table.whole_numbers("beat").at(400) == 1);
  CHECK(table.whole_numbers("beat").at(401) == 2);
  CHECK(table.numbers("volume_ml").front() == Approx(118.52));
  CHECK(table.numbers("arterial_pressure_mmHg").front() == Approx(87.675));
}

TEST_CASE("beats.csv has a row per beat, and nothing for what did not happen", "[unit][report]") {
  circulation::Cycle cycle = two_beats();
  cycle.beats.back().mitral_opens = std::numeric_limits<double>::quiet_NaN();
  const Table table = report::beats_table(cycle.beats);
  REQUIRE(table.rows().size() == 2);
  CHECK(table.numbers("edv_ml").back() ==
        Approx(1e-3 * cycle.beats.back().end_diastolic_volume).epsilon(1e-6));
  CHECK(table.words("mitral_opens_ms").back().empty());
  CHECK_THAT(report::beat_text(cycle.beats.back()),
             Catch::Contains("mitral valve opens at      not again in this beat"));
}

TEST_CASE("of valves that are open or closed as a beat begins it says so", "[unit][report]") {
  const circulation::Cycle cycle = two_beats();
  auto last = circulation::samples_of(cycle, 1);
  const double opens = cycle.beats.back().aortic_opens;
  while (last.front().time < 0.8 + opens + 0.01)
    last = last.subspan(1);
  CHECK_THAT(report::beat_text(circulation::measure_beat(last)),
             Catch::Contains("aortic valve opens at      is open when the beat begins") &&
                 Catch::Contains("mitral valve closes at     is closed when the beat begins") &&
                 Catch::Contains("isovolumic contraction     began before the beat") &&
                 Catch::Contains("ejection time              began before the beat"));
}

TEST_CASE("the loop marks the last beat, the Wiggers diagram its phases", "[unit][report]") {
  const circulation::Cycle cycle = two_beats();
  const Table table = report::cycle_table(cycle.samples, cycle.columns, 0.8);
  const drawing::Figure loops =
      report::pressure_volume_figure(table, report::beats_table(cycle.beats));
  const auto loop = std::get<drawing::LineChart>(loops.panels.at(0).content);
  REQUIRE(loop.series.size() == 6);  // two beats, four events
  CHECK(loop.series[1].label == "beat 2");
  CHECK(loop.series[1].x.size() == 401);
  CHECK(loop.series[4].label == "aortic valve closes");
  CHECK(loop.series[4].x.at(0) ==
        Approx(1e-3 * cycle.beats.back().end_systolic_volume).epsilon(1e-5));
  CHECK(loop.series[4].y.at(0) ==
        Approx(cycle.beats.back().end_systolic_pressure / units::mmHg).epsilon(1e-5));
  const drawing::Figure wiggers = report::wiggers_figure(table);
  const auto pressures = std::get<drawing::LineChart>(wiggers.panels.at(0).content);
  std::vector<std::string> names;
  for (const drawing::Phase& phase : pressures.phases)
    names.push_back(phase.label);
  CHECK(names ==
        std::vector<std::string>{"filling", "contraction", "ejection", "relaxation", "filling"});
}
