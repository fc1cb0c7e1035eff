#include "lv/report/table_figures.hpp"

#include "lv/base/table.hpp"

#include "support/temporary_folder.hpp"
#include <catch2/catch.hpp>

#include <filesystem>
#include <set>

using namespace lv;
using report::BullsEye;
using report::Figure;
using report::LineChart;

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

TEST_CASE("curves are drawn from the table's columns, contraction where filling ends", "[report]") {
  const Figure figure = report::curves_figure(curves());
  const LineChart& time = chart(figure);
  CHECK(time.series[0].y == std::vector<double>{0.0, 8.0, 150.0});
  REQUIRE(time.phases.size() == 2);
  CHECK(time.phases[1].label == "contraction");
  CHECK(time.phases[1].begin == 1.0);
  CHECK(chart(figure, 1).series[0].x == std::vector<double>{70.0, 140.0, 60.0});
}

TEST_CASE("strains have a scale about no strain, and a missing region stays missing", "[report]") {
  const Figure figure = report::bulls_eyes_figure(segments("fibre_strain", -0.2, 0.05),
                                                  "fibre_strain", "end_systole");
  const auto& slices = std::get<BullsEye>(figure.panels.at(0).content);
  const auto& aha = std::get<BullsEye>(figure.panels.at(1).content);
  CHECK(slices.sectors == report::seven_slices());
  CHECK(slices.scale.min == Approx(-slices.scale.max));
  CHECK(slices.scale.min <= -0.2);
  CHECK(std::isnan(aha.values.at(3)));
  CHECK(report::svg(figure).find("<svg") != std::string::npos);
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
