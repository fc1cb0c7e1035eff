#include "lv/report/plausibility.hpp"

#include "lv/circulation/cycle.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <limits>

namespace {

using namespace lv;
using report::Answer;

/// A beat as healthy as the means of the ranges.
analysis::Results healthy() {
  analysis::Results r;
  r.early_diastole.wall_volume = 1.1e5;
  r.moments = {{"end_diastole", {}}, {"end_systole", {}}};
  r.moments[0].second.cavity_volume = 1.44e5;
  r.moments[1].second.cavity_volume = 6.0e4;
  r.rotation.push_back({7, 0.21, 0.2, 0.0});  // 12 degrees
  r.fibre_shortening = 0.2;
  r.thickening = 0.4;
  for (const char* moment : {"end_diastole", "end_systole"})
    r.regional.push_back({moment, "whole", "wall", "J", "1", 1e5, {1.0, 0.01, 0.98, 1.0, 1.02}});
  for (const char* quantity : {"circumferential_strain", "longitudinal_strain"})
    r.regional.push_back({"end_systole", "whole", "wall", quantity, "1", 1e5, {-0.2, 0, 0, 0, 0}});
  return r;
}

report::Judgement judged(const report::JudgedBeat& beat, const std::string& quantity) {
  const auto all = report::judge(beat);
  return *std::find_if(all.begin(), all.end(),
                       [&](const auto& j) { return j.range->quantity == quantity; });
}

report::JudgedBeat of(const analysis::Results& results) {
  return {results, 1.05e-6, false, true};
}

}  // namespace

TEST_CASE("a circulation's beat that no patient has is said to be one", "[unit][report]") {
  circulation::CircuitParameters p;
  p.kind = circulation::Kind::windkessel;
  p.step = 2e-3;
  CHECK(report::unlike_any_patient(circulation::run_alone(p).beats.back()).empty());
  p.windkessel.p_ven = 100.0 * units::mmHg;
  const auto said = report::unlike_any_patient(circulation::run_alone(p).beats.back());
  std::string all;
  for (const std::string& sentence : said)
    all += sentence + "\n";
  for (const char* label : {"end-diastolic volume", "stroke volume", "peak pressure"})
    CHECK_THAT(all, Catch::Contains(std::string("the ") + label + " is "));
  CHECK_THAT(all, !Catch::Contains("isovolumic"));
}

TEST_CASE("an aortic valve that is open in diastole is said to be", "[unit][report]") {
  circulation::CircuitParameters p;
  p.kind = circulation::Kind::windkessel;
  p.step = 2e-3;
  p.windkessel.R_p = 0.05 * units::mmHg / units::ml;
  const auto said = report::unlike_any_patient(circulation::run_alone(p).beats.back());
  CHECK_THAT(said.front(), Catch::StartsWith("the aortic valve is open in diastole"));
  for (const std::string& sentence : said)
    CHECK_THAT(sentence, !Catch::Contains("isovolumic contraction is"));
}

TEST_CASE("every range is a range, lies in what is possible and has a source", "[report]") {
  for (const report::PlausibleRange& range : report::plausible_ranges()) {
    CHECK(range.low < range.high);
    CHECK(range.possible_low <= range.low);
    CHECK(range.possible_high >= range.high);
    CHECK(range.source.size() > 10);
    CHECK_FALSE(range.label.empty());
  }
}

TEST_CASE("a healthy beat is within every range", "[report]") {
  const analysis::Results r = healthy();
  for (const report::Judgement& j : report::judge(of(r))) {
    INFO(j.range->quantity << " " << j.value);
    CHECK(j.answer == Answer::within);
    CHECK_FALSE(j.is_impossible);
  }
}

TEST_CASE("a wall's heartbeat is held against what people have", "[report]") {
  const analysis::Results r = healthy();
  CHECK(report::judge(of(r)).back().range->measure == nullptr);  // without one
  circulation::BeatMeasures measures{};
  measures.aortic_systolic = 110.0 * units::mmHg;
  measures.least_pressure_rate = -900.0 * units::mmHg;
  measures.largest_pressure_rate = 2e4 * units::mmHg;
  measures.isovolumic_contraction = -0.01;
  measures.isovolumic_relaxation = std::numeric_limits<double>::quiet_NaN();
  report::JudgedBeat beat = of(r);
  beat.heartbeat = &measures;
  CHECK(judged(beat, "aortic_systolic_mmHg").answer == Answer::within);
  CHECK(judged(beat, "dp_dt_min_mmHg_per_s").answer == Answer::outside);
  CHECK_FALSE(judged(beat, "dp_dt_min_mmHg_per_s").is_impossible);
  CHECK(judged(beat, "dp_dt_max_mmHg_per_s").is_impossible);
  CHECK(judged(beat, "isovolumic_contraction_ms").is_impossible);
  measures.ejection_time = 0.24;
  CHECK(judged(beat, "ejection_time_ms").answer == Answer::outside);
  beat.period = 0.6;  // QS2 = 336 ms instead of 388.5
  CHECK(judged(beat, "ejection_time_ms").answer == Answer::within);
  CHECK(judged(beat, "ejection_time_ms").low == Approx(248.0 * 336.0 / 388.5));
  CHECK(judged(beat, "isovolumic_contraction_ms").low == 20.0);
  CHECK(judged(beat, "isovolumic_relaxation_ms").answer == Answer::not_applicable);
  CHECK_FALSE(judged(beat, "isovolumic_relaxation_ms").is_impossible);
}

TEST_CASE("an apex that turns by 30 degrees is outside", "[report]") {
  analysis::Results r = healthy();
  r.rotation.back().from_end_diastole = 0.52;
  CHECK(judged(of(r), "apex_rotation_deg").answer == Answer::outside);
}

TEST_CASE("an infarcted heart is not compared with healthy muscle, but its ejection fraction is",
          "[report]") {
  analysis::Results r = healthy();
  r.moments[1].second.cavity_volume = 0.74 * r.moments[0].second.cavity_volume;
  report::JudgedBeat beat = of(r);
  beat.is_infarcted = true;
  CHECK(judged(beat, "ejection_fraction_percent").answer == Answer::outside);
  CHECK(judged(beat, "esv_ml").answer == Answer::outside);
  CHECK(judged(beat, "fibre_shortening_percent").answer == Answer::not_applicable);
  CHECK_FALSE(judged(beat, "fibre_shortening_percent").reason.empty());
}

TEST_CASE("a base on springs is not judged by one that is held", "[report]") {
  analysis::Results r = healthy();
  r.moments[1].second.base_axial_shift = 9.0;
  report::JudgedBeat beat = of(r);
  CHECK(judged(beat, "base_axial_shift_mm").answer == Answer::outside);
  beat.base_is_held = false;
  for (const char* quantity : {"base_axial_shift_mm", "apex_rotation_deg"})
    CHECK(judged(beat, quantity).answer == Answer::not_applicable);
}

TEST_CASE("without an end-systole nothing is said of it", "[report]") {
  const analysis::Results r = healthy();
  report::JudgedBeat beat = of(r);
  beat.contraction_was_steady = false;
  CHECK(judged(beat, "ejection_fraction_percent").answer == Answer::not_applicable);
  CHECK(judged(beat, "edv_ml").answer == Answer::within);
}

TEST_CASE("an ejection fraction below zero is impossible and is told as a sentence", "[report]") {
  analysis::Results r = healthy();
  r.moments[1].second.cavity_volume = 1.26 * r.moments[0].second.cavity_volume;
  const auto j = judged(of(r), "ejection_fraction_percent");
  CHECK(j.is_impossible);
  CHECK(j.answer == Answer::outside);
  const auto sentences = report::impossible_values(report::judge(of(r)));
  REQUIRE(sentences.size() == 1);
  CHECK_THAT(sentences.front(), Catch::StartsWith("ejection fraction is -26 %, which no beating"));
}
