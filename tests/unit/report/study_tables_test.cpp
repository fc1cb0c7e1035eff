#include "lv/report/study_tables.hpp"

#include "lv/circulation/cycle.hpp"

#include <catch2/catch.hpp>

namespace {

using namespace lv;
using circulation::LoadedBeat;

/// Beats under two preloads, of which the second may be no limit cycle.
std::vector<circulation::Contractility> family(bool second_is_limit) {
  std::vector<LoadedBeat> beats;
  for (const double preload : {1.0, 1.2}) {
    circulation::CircuitParameters p;
    p.kind = circulation::Kind::windkessel;
    p.step = 2e-3;
    p.beats = 2;
    p.windkessel.p_ven *= preload;
    const circulation::Cycle cycle = circulation::run_alone(p);
    LoadedBeat beat{preload == 1.0 ? "case" : "preload_1.2", {.preload = preload}, 2,
                    preload == 1.0 || second_is_limit,       cycle.beats.back(),   {}};
    for (const circulation::Sample& s : circulation::samples_of(cycle, 1))
      beat.loop.push_back({s.signals.volume, s.signals.pressure});
    beats.push_back(std::move(beat));
  }
  return circulation::by_contractility(beats);
}

}  // namespace

TEST_CASE("lines that rest on beats without a limit cycle say so in text and figure",
          "[unit][report]") {
  const auto all = family(true);
  CHECK(report::study_text(all).find("limit cycle") == std::string::npos);
  CHECK(report::study_figure(all).footnote.empty());
  const auto some = family(false);
  CHECK_THAT(report::study_text(some),
             Catch::Contains("1 of 2 loads did not come to a limit cycle, and these lines rest on "
                             "them: preload_1.2"));
  const drawing::Figure figure = report::study_figure(some);
  CHECK_THAT(figure.footnote, Catch::Contains("1 of 2 loads did not come to a limit cycle"));
  for (const drawing::Panel& panel : figure.panels) {
    const auto& series = std::get<drawing::LineChart>(panel.content).series;
    const auto triangles =
        std::ranges::find(series, drawing::Marker::triangle, &drawing::Series::marker);
    REQUIRE(triangles != series.end());
    CHECK(triangles->x.size() == 1);
  }
}
