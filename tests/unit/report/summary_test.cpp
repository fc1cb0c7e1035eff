#include "lv/report/summary.hpp"

#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

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
  CHECK_THAT(text, Catch::Contains(fmt::format("  {:<24}{:>18}{:>18}{:>18}\n", "fibre_strain",
                                               "137.000 +- 0.500", "144.000 +- 0.500",
                                               "151.000 +- 0.500")));
}

TEST_CASE("the summary of a healthy ventricle has no zones", "[unit][report]") {
  const analysis::Results r = results(false);
  CHECK_FALSE(json::parse(report::summary_json({}, {}, r)).contains("zones"));
  CHECK_THAT(report::summary_text({}, {}, r), !Catch::Contains("remote"));
}
