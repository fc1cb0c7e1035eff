#include "lv/report/table_figures.hpp"

#include "lv/analysis/quantities.hpp"
#include "lv/base/table.hpp"
#include "lv/material/stress_stretch.hpp"

#include "support/temporary_folder.hpp"
#include <catch2/catch.hpp>

#include <filesystem>
#include <set>

using namespace lv;
using drawing::BullsEye;
using drawing::Figure;
using drawing::LineChart;

namespace {

const LineChart& chart(const Figure& figure, std::size_t panel = 0) {
  return std::get<LineChart>(figure.panels.at(panel).content);
}

Table curves() {
  Table table({"time_s", "phase", "pressure_mmHg", "cavity_volume_ml", "calcium_uM",
               "mean_active_tension_kPa"});
  table.add_row({"0", "filling", "0", "70", "0.01", "0"});
  table.add_row({"1", "filling", "8", "140", "0.01", "0"});
  table.add_row({"2", "contraction", "150", "60", "1", "80"});
  return table;
}

report::CurveFacts both_moments() {
  report::CurveFacts facts;
  facts.moments = {{heartbeat::end_diastole, 1.0}, {heartbeat::end_systole, 2.0}};
  return facts;
}

Table segments(const std::string& quantity, double least, double greatest) {
  Table table({"state", "scheme", "region", "quantity", "unit", "mean"});
  for (int i = 0; i < 38; ++i)
    table.add_row({"end_systole", "sector", std::to_string(i), quantity, "1",
                   Table::number(least + (greatest - least) * i / 37.0)});
  for (int i = 0; i < 17; ++i)
    table.add_row({"end_systole", "aha17", std::to_string(i), quantity, "1",
                   i == 3 ? "" : Table::number(least)});
  return table;
}

}  // namespace

TEST_CASE("curves are drawn from the table's columns, each with an axis of its own", "[report]") {
  const Figure figure = report::curves_figure(curves(), both_moments());
  const LineChart& time = chart(figure);
  CHECK(time.series[0].y == std::vector<double>{0.0, 8.0, 150.0});
  REQUIRE(time.phases.size() == 2);
  CHECK(time.phases[1].label == "contraction");
  CHECK(time.phases[1].begin == 1.0);
  CHECK(chart(figure, 1).y.label == "cavity volume [ml]");
  CHECK(chart(figure, 2).y.label == "mean active tension [kPa]");
}

TEST_CASE("the path of pressure and volume has its end-diastole and end-systole", "[report]") {
  const Figure figure = report::curves_figure(curves(), both_moments());
  const LineChart& path = chart(figure, 3);
  CHECK(figure.panels[3].title == "pressure-volume path (no valves)");
  REQUIRE(path.series.size() == 3);
  CHECK(path.series[0].x == std::vector<double>{70.0, 140.0, 60.0});
  CHECK(path.series[1].label == "end-diastole");
  CHECK(path.series[1].x == std::vector<double>{140.0});
  CHECK(path.series[2].y == std::vector<double>{150.0});
}

TEST_CASE("equilibria are drawn against the load", "[report]") {
  Table table({"time_s", "phase", "pressure_mmHg", "cavity_volume_ml", "calcium_uM",
               "mean_active_tension_kPa"});
  table.add_row({"0", "filling", "0", "70", "0.01", "0"});
  table.add_row({"0.3", "filling", "8", "140", "0.01", "0"});
  table.add_row({"0.35", "contraction", "43.5", "70", "", "20"});
  table.add_row({"0.5", "contraction", "150", "60", "1", "80"});
  const Figure figure = report::curves_figure(table, {true, false, {}});
  const LineChart& pressure = chart(figure);
  CHECK_THAT(pressure.x.label, Catch::StartsWith("load"));
  CHECK(pressure.series[0].x.at(1) == Approx(1.0));
  CHECK(pressure.series[0].x.at(2) == Approx(1.25));
  CHECK(pressure.series[0].x.at(3) == Approx(2.0));
  const auto calcium = report::calcium_figure(table, {true, false, {}});
  REQUIRE(calcium);
  CHECK(std::isnan(chart(*calcium).series[0].y.at(2)));  // a gap and no ramp
  CHECK(chart(*calcium).y.label == "calcium [µM]");
}

TEST_CASE("a curve without values makes no figure", "[report]") {
  Table table({"time_s", "phase", "calcium_uM"});
  table.add_row({"0", "filling", ""});
  table.add_row({"1", "filling", ""});
  CHECK_FALSE(report::calcium_figure(table, {}));
}

TEST_CASE("strains have a scale about no strain, and a missing region stays missing", "[report]") {
  const Figure figure = report::bulls_eyes_figure(segments("fibre_strain", -0.2, 0.05),
                                                  "fibre_strain", "end_systole", {});
  const auto& slices = std::get<BullsEye>(figure.panels.at(0).content);
  const auto& aha = std::get<BullsEye>(figure.panels.at(1).content);
  CHECK(slices.sectors == drawing::seven_slices());
  CHECK(slices.scale.min == Approx(-slices.scale.max));
  CHECK(slices.scale.min <= -0.2);
  CHECK(std::isnan(aha.values.at(3)));
  CHECK(drawing::svg(figure).find("<svg") != std::string::npos);
}

TEST_CASE("both states of a quantity have one scale, and an assumed septum has stars", "[report]") {
  Table table = segments("active_tension", 50.0, 60.0);
  for (int i = 0; i < 17; ++i)
    table.add_row({"end_diastole", "aha17", std::to_string(i), "active_tension", "kPa", "0.007"});
  for (int i = 0; i < 38; ++i)
    table.add_row({"end_diastole", "sector", std::to_string(i), "active_tension", "kPa", "0.007"});
  const drawing::Orientation assumed{0.0, {{"septum", "nothing shows it"}}};
  const Figure ed = report::bulls_eyes_figure(table, "active_tension", "end_diastole", assumed);
  CHECK(ed.colour_bar->scale.max >= 60.0);
  CHECK(std::get<BullsEye>(ed.panels.at(1).content).walls[1] == "septal*");
  CHECK(std::get<BullsEye>(ed.panels.at(1).content).territories.at(0).name == "LAD*");
  CHECK_THAT(ed.footnote, Catch::EndsWith(". * assumed: nothing shows it"));
}

TEST_CASE("17 segments bear their numbers, names and coronary territories", "[report]") {
  Table table = segments("fibre_strain", -0.2, 0.05);
  for (const char* quantity : {"fibre_stress", "active_tension", "radial_strain"})
    for (int i = 0; i < 17; ++i)
      table.add_row({"end_systole", "aha17", std::to_string(i), quantity, "1", "0.5"});
  const Figure figure = report::segments_figure(table, {});
  for (const drawing::Panel& panel : figure.panels) {
    const auto& plot = std::get<BullsEye>(panel.content);
    CHECK(plot.is_numbered);
    std::set<int> fed;
    for (const drawing::Territory& territory : plot.territories)
      for (const int i : territory.sectors)
        CHECK(fed.insert(i).second);
    CHECK(fed.size() == 17);
  }
  CHECK_THAT(figure.footnote,
             Catch::Contains("1\u00a0basal\u00a0anterior, 2\u00a0basal\u00a0anteroseptal") &&
                 Catch::Contains("lateral, 17\u00a0apex") && Catch::Contains("right (RCA)"));
  const Figure both = report::bulls_eyes_figure(segments("J", 0.9, 1.1), "J", "end_systole", {});
  CHECK_FALSE(std::get<BullsEye>(both.panels.at(0).content).is_numbered);  // seven slices
  CHECK(std::get<BullsEye>(both.panels.at(1).content).is_numbered);
}

TEST_CASE("a tension of nearly nothing has no colour, as on the page", "[report]") {
  const Figure figure = report::bulls_eyes_figure(segments("active_tension", 0.007, 60.0),
                                                  "active_tension", "end_systole", {});
  const drawing::ColourScale& scale = std::get<BullsEye>(figure.panels.at(0).content).scale;
  CHECK(scale.floor == analysis::quantity("active_tension").floor);
  CHECK(scale(0.007)->b == drawing::uncoloured.b);
  CHECK(scale(60.0)->b != drawing::uncoloured.b);
  CHECK(figure.colour_bar->scale.floor == scale.floor);
}

TEST_CASE("each muscle is a line of its table, published ones dashed", "[report]") {
  Table table({"muscle", "published", "fibre_stretch", "cauchy_stress_kPa"});
  table.add_row({"this case", "no", "1", "0"});
  table.add_row({"this case", "no", "1.1", "0.97"});
  table.add_row({"excised", "yes", "1", "0"});
  const Figure figure = report::muscle_figure(table);
  const auto& series = chart(figure).series;
  REQUIRE(series.size() == 2);
  CHECK(series[0].y == std::vector<double>{0.0, 0.97});
  CHECK_FALSE(series[0].dashed);
  CHECK(series[1].label == "excised");
  CHECK(series[1].dashed);
}

TEST_CASE("the paper's subjects stand beside no case that did not ask for them", "[report]") {
  Table table({"muscle", "published", "fibre_stretch", "cauchy_stress_kPa"});
  for (const auto& curve : material::published_muscles())
    table.add_row({curve.muscle, "yes", "1.1", "2"});
  table.add_row({"this case", "no", "1", "0"});
  const Figure figure = report::muscle_figure(table);
  const auto& series = chart(figure).series;
  REQUIRE(series.size() == 2);  // of four
  CHECK_THAT(series[0].label, Catch::Contains("excised"));
  CHECK(series[1].label == "this case");
}

TEST_CASE("slices hang on apex and base: a figure says which of them was assumed", "[report]") {
  Table table({"slice", "end_diastole_to_end_systole_deg", "early_to_end_diastole_deg"});
  table.add_row({"1", "0", "0"});
  table.add_row({"7", "20", "1"});
  const drawing::Orientation assumed{0.0, {{"apex", "not drawn"}, {"septum", "nothing shows it"}}};
  const Figure figure = report::rotation_figure(table, assumed);
  CHECK(chart(figure).x.label == "slice, from the base (1) to the apex* (7)");
  CHECK_THAT(figure.footnote, Catch::EndsWith("* assumed: not drawn"));
  const Figure segments_of =
      report::bulls_eyes_figure(segments("J", 0.9, 1.1), "J", "end_systole", assumed);
  CHECK(segments_of.panels.at(1).title == "17 segments (AHA)*");
  CHECK_THAT(segments_of.footnote, Catch::EndsWith(". * assumed: not drawn; nothing shows it"));
  CHECK(chart(report::rotation_figure(table, {})).x.label ==
        "slice, from the base (1) to the apex (7)");
}

TEST_CASE("figures are written for what there is and for nothing else", "[report]") {
  const test::TemporaryFolder folder;
  const std::filesystem::path work = folder / "work";
  std::filesystem::create_directories(work / "03_beat.part");
  curves().write_csv(work / "03_beat.part" / "curves.csv");
  report::write_figures(work, folder / "figures");
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder / "figures"))
    names.insert(entry.path().filename());
  CHECK(names == std::set<std::string>{"calcium.svg", "curves.svg"});
  CHECK(read_file(folder / "figures" / "curves.svg").find("<svg") != std::string::npos);
}
