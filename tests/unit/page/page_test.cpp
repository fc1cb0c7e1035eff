#include "lv/page/page.hpp"

#include "lv/base/check.hpp"
#include "lv/base/table.hpp"
#include "lv/page/bundle.hpp"
#include "lv/page/modes.hpp"
#include "lv/page/packing.hpp"
#include "lv/page/place.hpp"
#include "lv/report/work_folder.hpp"

#include "support/temporary_folder.hpp"
#include <catch2/catch.hpp>

#include <cmath>
#include <filesystem>

using namespace lv;
using page::Modes;
using page::NodalSeries;

namespace {

NodalSeries travelling_wave(int times, int places) {
  NodalSeries series(times);
  for (int t = 0; t < times; ++t)
    for (int i = 0; i < places; ++i)
      series[t].push_back(
          static_cast<float>(100.0 + 3.0 * std::sin(0.05 * i - 0.2 * t) + 0.01 * i));
  return series;
}

double value(const Modes& m, std::size_t t, std::size_t i) {
  double sum = m.offset;
  for (std::size_t k = 0; k < m.shapes.size(); ++k)
    sum += m.courses[k][t] * m.step * m.shapes[k][i];
  return sum;
}

}  // namespace

TEST_CASE("modes repeat a series within the tolerance, and say how closely", "[page]") {
  const NodalSeries series = travelling_wave(30, 500);
  for (const double tolerance : {0.1, 0.001}) {
    const Modes m = page::modes(series, tolerance);
    double largest = 0.0;
    for (std::size_t t = 0; t < series.size(); ++t)
      for (std::size_t i = 0; i < series[t].size(); ++i)
        largest = std::max(largest, std::abs(value(m, t, i) - series[t][i]));
    CHECK(largest <= tolerance);
    CHECK(m.largest_error == Approx(largest).epsilon(1e-6));
  }
}

TEST_CASE("a wave that travels needs two shapes, and a slope one more", "[page]") {
  CHECK(page::modes(travelling_wave(30, 500), 0.01).shapes.size() == 3);
  CHECK(page::modes(NodalSeries(4, std::vector<float>(10, 0.0F)), 0.01).shapes.empty());
}

TEST_CASE("packed numbers are small where neighbours are alike", "[page]") {
  std::vector<std::int16_t> slope(10000);
  for (std::size_t i = 0; i < slope.size(); ++i)
    slope[i] = static_cast<std::int16_t>(7 * i);  // wraps
  CHECK(page::packed(slope).size() < 300);
  // zlib and base64 of the two bytes 1, 0
  CHECK(page::packed(std::vector<std::int16_t>{1}).substr(0, 3) == "eNp");
}

TEST_CASE("the program carries a page with a place for data", "[page]") {
  const std::string page(page::page_bundle());
  CHECK(page.starts_with("<!doctype html>"));
  CHECK(page.find("<!-- data -->") < page.find("<!-- wall data -->"));
  CHECK(page.find("<!-- wall data -->") < page.find("<!-- more data -->"));
  CHECK(page.find("<!-- more data -->") != std::string::npos);
  CHECK(page.find("http-equiv") == std::string::npos);
}

TEST_CASE("a page of an empty work folder has its state and no wall", "[page]") {
  const test::TemporaryFolder folder;
  const std::filesystem::path work = folder / "work";
  std::filesystem::create_directories(work / "04_results");
  write_file(work / "04_results" / "rotation.csv", "slice\n<1>\n");
  const std::string page = page::page({{work, false, {"03_beat is unfinished."}}}, "1.2.3");
  CHECK(page.find("\"complete\":false") != std::string::npos);
  CHECK(page.find("03_beat is unfinished.") != std::string::npos);
  CHECK(page.find("\"version\":\"1.2.3\"") != std::string::npos);
  CHECK(page.find("\\u003c1>") != std::string::npos);  // no file ends the script element
  CHECK(page.find("\"wall\":") == std::string::npos);
}

TEST_CASE("a page is not made of a summary that is damaged", "[page]") {
  const test::TemporaryFolder folder;
  const std::filesystem::path results = folder / "work" / "04_results";
  std::filesystem::create_directories(results);
  write_file(results / "summary.json", "{\n");
  CHECK_THROWS_WITH(page::page({{folder / "work", true, {}}}, "1"),
                    Catch::Contains("summary.json is damaged"));
}

TEST_CASE("a page of a run without results knows its case's name", "[page]") {
  const test::TemporaryFolder folder;
  const std::filesystem::path work = folder / "work";
  std::filesystem::create_directories(work / "04_results");
  const auto page = [&] { return page::page({{work, false, {}}}, "1"); };
  CHECK(report::case_name(work).empty());
  CHECK(page().find("\"name\":\"HV01\"") == std::string::npos);
  report::write_case_name(work, "HV01");
  CHECK(report::case_name(work) == "HV01");
  CHECK(page().find("\"name\":\"HV01\"") != std::string::npos);
}

TEST_CASE("two cases whose moments are not defined alike are told apart", "[page]") {
  const test::TemporaryFolder folder;
  std::vector<page::PageCase> cases;
  for (const char* name : {"paper", "beats", "others"}) {
    const std::filesystem::path beat = folder / name / "03_beat";
    std::filesystem::create_directories(beat);
    write_file(beat / "moments.csv", "moment,phase,time_s,by_criterion\n");
    cases.push_back({folder / name, true, {}});
  }
  CHECK(page::unlike_moments({cases[0], cases[1]}).empty());
  write_file(folder / "beats" / "03_beat" / "cycle.csv", "beat\n");
  CHECK_THAT(page::unlike_moments({cases[0], cases[1]}), Catch::Contains("not defined alike"));
  CHECK(page::unlike_moments({cases[1]}).empty());
  write_file(folder / "others" / "03_beat" / "cycle.csv", "beat\n");
  CHECK(page::unlike_moments({cases[1], cases[2]}).empty());
}

TEST_CASE("a page of frames without named moments says so", "[page]") {
  const test::TemporaryFolder folder;
  const std::filesystem::path beat = folder / "work" / "03_beat";
  std::filesystem::create_directories(beat);
  const auto page = [&] { return page::page({{folder / "work", true, {}}}, "1"); };
  CHECK(page().find("no moments.csv") == std::string::npos);
  write_file(beat / "wall.pvd", "<VTKFile type=\"Collection\"><Collection/></VTKFile>\n");
  CHECK(page().find("03_beat has no moments.csv") != std::string::npos);
  write_file(beat / "moments.csv", "moment,phase,time_s,by_criterion\n");
  CHECK(page().find("no moments.csv") == std::string::npos);
}

TEST_CASE("a page of a name that nobody chose replaces that of the same run alone", "[page]") {
  using Catch::Matchers::Contains;
  const test::TemporaryFolder folder;
  for (const char* name : {"one", "two"})
    std::filesystem::create_directories(folder / name);
  const std::filesystem::path page = folder / "report.html";
  const auto one = folder / "one";
  CHECK_NOTHROW(page::require_same_runs(page, {one}));
  write_file(page, page::page({{one, true, {}}}, "1"));
  CHECK_NOTHROW(page::require_place(page));
  for (const std::filesystem::path& same : {one, one / "", folder / "two" / ".." / "one"})
    CHECK_NOTHROW(page::require_same_runs(page, {same}));
  const std::filesystem::path two = folder / "two";
  for (const auto& others : {std::vector{two}, std::vector{one, two}})
    CHECK_THROWS_WITH(page::require_same_runs(page, others),
                      Contains("report.html: exists already and is the page of another run") &&
                          Contains("--output"));
}

TEST_CASE("a page takes the place of a page alone", "[page]") {
  using Catch::Matchers::Contains;
  const test::TemporaryFolder folder;
  CHECK_NOTHROW(page::require_place(folder / "new.html"));
  CHECK_NOTHROW(page::require_place("new.html"));
  write_file(folder / "empty.html", "");
  CHECK_NOTHROW(page::require_place(folder / "empty.html"));
  write_file(folder / "report.html", std::string(page::page_bundle()));
  CHECK_NOTHROW(page::require_place(folder / "report.html"));
  write_file(folder / "a.toml", "name = \"heart\"\n");
  write_file(folder / "other.html", "<!doctype html>\n<title>Ours</title>\n");
  for (const char* name : {"a.toml", "other.html"})
    CHECK_THROWS_WITH(page::require_place(folder / name),
                      Contains(name) && Contains("no page that this program wrote"));
  CHECK_THROWS_WITH(page::require_place(folder / ""), Contains("is a folder"));
  CHECK_THROWS_AS(page::require_place(folder / "absent/report.html"), InputError);
  CHECK_THROWS_WITH(page::require_place(folder / "absent/report.html"),
                    Contains("there is no folder") && Contains("Make it"));
}
