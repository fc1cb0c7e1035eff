#include "lv/report/summary.hpp"

#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <set>

namespace {

using namespace lv;
using nlohmann::json;

/// Results whose means are numbered: 100 for the first quantity of the first region and so on.
analysis::Results results(bool infarcted) {
  analysis::Results r;
  r.rotation.push_back({7, 0.1, 0.1, 0.0});
  r.moments = {{"end_diastole", {}}, {"end_systole", {}}};
  double mean = 100.0;
  std::vector<std::pair<std::string, std::string>> regions{{"whole", "wall"}};
  if (infarcted)
    for (const char* zone : {"infarct", "border", "remote"})
      regions.emplace_back("zone", zone);
  for (const char* state : {"end_diastole", "end_systole"})
    for (const auto& [scheme, region] : regions)
      for (const char* quantity :
           {"active_tension", "fibre_stress", "fibre_strain", "circumferential_strain",
            "longitudinal_strain", "radial_strain", "J"})
        r.regional.push_back(
            {state, scheme, region, quantity, "1", 5e4, {mean++, 0.5, 0.0, 0.0, 0.0}});
  return r;
}

}  // namespace

TEST_CASE("the summary of an infarcted ventricle gives its zones at end-systole",
          "[unit][report]") {
  const analysis::Results r = results(true);
  const json summary = json::parse(report::summary_json({}, {}, r));
  for (const auto& v : r.regional)
    if (v.scheme == "zone")
      CHECK(summary["zones"][v.region][v.state][v.quantity]["mean"] == v.statistics.mean);
  CHECK(summary["zones"]["border"]["volume_ml"] == 50.0);
  // 4 regions of 7 quantities before those of end-systole, the wall's 7 before the zones'
  const std::string text = report::summary_text({}, {}, r);
  CHECK_THAT(text, Catch::Contains("  whole elements (ml) "));
  CHECK_THAT(text, Catch::Contains(fmt::format("  {:<24}{:>18}{:>18}{:>18}\n", "fibre_strain",
                                               "137.000 +- 0.500", "144.000 +- 0.500",
                                               "151.000 +- 0.500")));
}

TEST_CASE("the summary of a healthy ventricle has no zones", "[unit][report]") {
  const analysis::Results r = results(false);
  CHECK_FALSE(json::parse(report::summary_json({}, {}, r)).contains("zones"));
  CHECK_THAT(report::summary_text({}, {}, r), !Catch::Contains("remote"));
}

namespace {

/// The paths of all numbers in a JSON value, in lists that of the list.
void number_paths(const json& value, const std::string& path, std::set<std::string>& found) {
  if (value.is_number())
    found.insert(path);
  if (value.is_object())
    for (const auto& [key, inner] : value.items())
      number_paths(inner, path.empty() ? key : fmt::format("{}.{}", path, key), found);
  if (value.is_array())
    for (const auto& inner : value)
      number_paths(inner, path, found);
}

/// The mark of the longest path that a figure's own begins with.
std::string mark_of(const json& marks, std::string path) {
  while (!path.empty() && !marks.contains(path))
    path.resize(path.find('.') == std::string::npos ? 0 : path.rfind('.'));
  return path.empty() ? "" : marks[path].get<std::string>();
}

report::RunFacts calibrated_facts() {
  report::RunFacts facts;
  facts.shape = report::Mark::measured;
  facts.parameters = {{"passive.C_a", "1"}, {"calibrate.edv", "\"140 ml\""}, {"box.size", "1"}};
  facts.fitted_parameters = {"passive.C_a"};
  facts.measured_parameters = {"calibrate.edv"};
  facts.fitted = {{"EDV", 1.4e5, 1.4e5, 1.41e5, true}};
  facts.unloaded = report::UnloadedShape{};
  facts.scar = {{"apex", 1e3, 1e-3, 0.1, 0.5}};
  facts.assumed = {{"septum", "nothing shows it"}, {"apex", "not drawn"}};
  facts.warnings = {"nothing shows it"};
  return facts;
}

}  // namespace

TEST_CASE("every figure of the summary is measured, fitted, assumed or computed",
          "[unit][report]") {
  const json summary = json::parse(report::summary_json(calibrated_facts(), {}, results(true)));
  std::set<std::string> paths;
  number_paths(summary, "", paths);
  for (const std::string& path : paths)
    if (!path.starts_with("resolution."))  // of the computation, not of the heart
      CHECK_FALSE(mark_of(summary["marks"], path).empty());
  const auto mark = [&](const char* path) { return mark_of(summary["marks"], path); };
  CHECK(mark("edv_ml") == "fitted");
  CHECK(mark("esv_ml") == "computed");
  CHECK(mark("end_systole.pressure_mmHg") == "assumed");
  CHECK(mark("unloaded.seen_volume_ml") == "measured");
  CHECK(mark("early_diastole.cavity_volume_ml") == "computed");
  CHECK(mark("parameters.passive.C_a") == "fitted");
  CHECK(mark("parameters.calibrate.edv") == "measured");
  CHECK(mark("parameters.box.size") == "assumed");
  CHECK(mark("mass_g") == "computed");

  report::RunFacts ellipsoid;
  const json assumed = json::parse(report::summary_json(ellipsoid, {}, results(true)));
  CHECK(mark_of(assumed["marks"], "mass_g") == "assumed");  // its shape is

  report::RunFacts heartbeat = calibrated_facts();
  heartbeat.pressure = report::Mark::computed;
  const json other = json::parse(report::summary_json(heartbeat, {}, results(true)));
  CHECK(mark_of(other["marks"], "edv_ml") == "computed");
}

TEST_CASE("what is judged of the computation is told from what is judged of the heart",
          "[unit][report]") {
  const json summary = json::parse(report::summary_json({}, {}, results(true)));
  std::set<std::string> of_computation;
  for (const json& judged : summary["plausibility"])
    if (judged["of"] == "computation")
      of_computation.insert(judged["quantity"]);
    else
      CHECK(judged["of"] == "heart");
  CHECK(of_computation == std::set<std::string>{"base_axial_shift_mm", "wall_volume_mean_percent",
                                                "wall_volume_tails_percent"});
}

TEST_CASE("what was assumed is said at the end, once", "[unit][report]") {
  const report::RunFacts facts = calibrated_facts();
  const json summary = json::parse(report::summary_json(facts, {}, results(true)));
  CHECK(summary["assumptions"][0]["part"] == "septum");
  CHECK(summary["assumptions"][1]["text"] == "not drawn");
  const std::string text = report::summary_text(facts, {}, results(true));
  CHECK_THAT(text, Catch::Contains("assumed: apex: not drawn"));
  CHECK_THAT(text, Catch::Contains("warning: nothing shows it"));
  CHECK_THAT(text, !Catch::Contains("assumed: septum"));
}

TEST_CASE("mass is the wall's volume times the density of muscle", "[unit][report]") {
  analysis::Results r = results(true);
  r.early_diastole.wall_volume = 1e5;
  report::RunFacts facts = calibrated_facts();
  CHECK(json::parse(report::summary_json(facts, {}, r))["mass_g"] == 105.0);
  facts.muscle_density = 1e-6;
  const json summary = json::parse(report::summary_json(facts, {}, r));
  CHECK(summary["mass_g"] == 100.0);
  CHECK(summary["infarct"]["mass_g"] == 1.0);
  CHECK(summary["infarct"]["percent_of_wall"] == 1.0);
}
