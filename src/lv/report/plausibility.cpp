#include "lv/report/plausibility.hpp"

#include "lv/analysis/quantities.hpp"
#include "lv/base/units.hpp"
#include "lv/circulation/heart_rate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace lv::report {
namespace {

using analysis::Statistics;

constexpr double infinity = std::numeric_limits<double>::infinity();

constexpr const char* normal_values =
    "Kawel-Boehm et al., J. Cardiovasc. Magn. Reson. 17:29, 2015, papillary muscles in the muscle: "
    "men {}, women {}; both +- 2 SD";
constexpr const char* feature_tracking =
    "Taylor et al., Eur. Heart J. Cardiovasc. Imaging 16:871, 2015, feature tracking in 100 "
    "healthy adults: {}, +- 2 SD{}; the borders of the wall were tracked, this is a mean over it";
constexpr const char* incompressible = "the model: muscle keeps its volume";

double off(double J) {
  return 100.0 * (J - 1.0);
}

/// The worst of all moments.
double mean_J(const JudgedBeat& beat) {
  double worst = 0.0;
  for (const auto& [moment, shape] : beat.results.moments)
    if (const double here = off(beat.results.whole(moment, "J").mean);
        std::abs(here) > std::abs(worst))
      worst = here;
  return worst;
}

double tail_J(const JudgedBeat& beat) {
  double most = 0.0;
  for (const auto& [moment, shape] : beat.results.moments) {
    const Statistics& J = beat.results.whole(moment, "J");
    most = std::max({most, std::abs(off(J.p1)), std::abs(off(J.p99))});
  }
  return most;
}

double base_shift(const JudgedBeat& beat) {
  double most = 0.0;
  for (const auto& [moment, shape] : beat.results.moments)
    most = std::max(most, shape.base_axial_shift);
  return most;
}

double volume(const JudgedBeat& beat, const char* moment) {
  return 1e-3 * beat.results.at(moment).cavity_volume;
}

double end_systolic(const JudgedBeat& beat, const char* quantity) {
  return beat.results.whole(heartbeat::end_systole, quantity).mean;
}

double apex_rotation(const JudgedBeat& beat) {
  return beat.results.rotation.back().from_end_diastole / units::degree;
}

/// Of heartbeats in a circulation. Where no beating heart can be is wide: shock, exercise and
/// hypertensive crises lie within.
std::vector<PlausibleRange> ranges_of_heartbeats() {
  using circulation::BeatMeasures;
  using enum Population;
  constexpr const char* blood_pressure =
      "Williams et al., Eur. Heart J. 39:3021, 2018: hypertension begins at 140/90 mmHg, measured "
      "at the arm; below 90/60 is low";
  const auto intervals = [](const char* mean, const char* rate = "") {
    return fmt::format(
        "Alhakak et al., Clin. Res. Cardiol., 2023, the Copenhagen City Heart Study: {} ms in "
        "1969 healthy adults, 95% of them{}",
        mean, rate);
  };
  return {
      {"peak_pressure_mmHg", "peak pressure", "mmHg", nullptr, 90.0, 140.0, 40.0, 300.0,
       healthy_ventricle, false, blood_pressure, &BeatMeasures::peak_pressure},
      {"aortic_systolic_mmHg", "aortic systolic pressure", "mmHg", nullptr, 90.0, 140.0, 30.0,
       300.0, healthy_ventricle, false, blood_pressure, &BeatMeasures::aortic_systolic},
      {"aortic_diastolic_mmHg", "aortic diastolic pressure", "mmHg", nullptr, 60.0, 90.0, 10.0,
       200.0, healthy_ventricle, false, blood_pressure, &BeatMeasures::aortic_diastolic},
      {"dp_dt_max_mmHg_per_s", "largest dp/dt", "mmHg/s", nullptr, 841.0, 1696.0, 150.0, 8000.0,
       healthy_ventricle, false,
       "Gleason and Braunwald, J. Clin. Invest. 41:80, 1962: 841 to 1696 mmHg/s in patients "
       "whose left ventricle was healthy",
       &BeatMeasures::largest_pressure_rate},
      {"dp_dt_min_mmHg_per_s", "least dp/dt", "mmHg/s", nullptr, -2644.0, -1084.0, -8000.0, -150.0,
       healthy_ventricle, false,
       "Hirota, Circulation 62:756, 1980: -1864 +- 390 mmHg/s in 18 healthy adults, +- 2 SD",
       &BeatMeasures::least_pressure_rate},
      {"isovolumic_contraction_ms", "isovolumic contraction", "ms", nullptr, 20.0, 59.0, 0.0, 300.0,
       healthy_ventricle, false, intervals("40 +- 10"), &BeatMeasures::isovolumic_contraction},
      {"ejection_time_ms", "ejection time", "ms", nullptr, 248.0, 336.0, 50.0, 600.0,
       healthy_ventricle, false,
       intervals("292 +- 23",
                 ", taken for those at 75 beats a minute; at other rates as much "
                 "shorter or longer as systole"),
       &BeatMeasures::ejection_time},
      {"isovolumic_relaxation_ms", "isovolumic relaxation", "ms", nullptr, 59.0, 134.0, 0.0, 400.0,
       healthy_ventricle, false, intervals("96 +- 19"), &BeatMeasures::isovolumic_relaxation}};
}

std::vector<PlausibleRange> make_ranges() {
  using enum Population;
  const auto volumes = [](const char* men, const char* women) {
    return fmt::format(fmt::runtime(normal_values), men, women);
  };
  const auto tracked = [](const char* mean, const char* converted) {
    return fmt::format(fmt::runtime(feature_tracking), mean, converted);
  };
  constexpr const char* green = ", as (e + e^2/2)";
  return {
      {"edv_ml", "end-diastolic volume", "ml",
       [](const JudgedBeat& b) { return volume(b, heartbeat::end_diastole); }, 86.0, 214.0, 0.0,
       1000.0, healthy_ventricle, false, volumes("160 +- 27", "132 +- 23")},
      {"esv_ml", "end-systolic volume", "ml",
       [](const JudgedBeat& b) { return volume(b, heartbeat::end_systole); }, 22.0, 82.0, 0.0,
       1000.0, healthy_ventricle, true, volumes("54 +- 14", "44 +- 11")},
      {"ejection_fraction_percent", "ejection fraction", "%",
       [](const JudgedBeat& b) { return 100.0 * b.results.ejection_fraction(); }, 48.0, 77.0, 5.0,
       90.0, healthy_ventricle, true,
       "Petersen et al., J. Cardiovasc. Magn. Reson. 19:18, 2017, papillary muscles in the cavity: "
       "men 58 +- 5, women 61 +- 5; Kawel-Boehm et al., the same journal 17:29, 2015, in the "
       "muscle: 67 +- 5; from the lowest - 2 SD to the highest + 2 SD"},
      {"mass_g", "mass of the wall", "g",
       [](const JudgedBeat& b) {
         return 1e3 * b.muscle_density * b.results.early_diastole.wall_volume;
       },
       56.0, 176.0, 0.0, 2000.0, healthy_ventricle, false, volumes("134 +- 21", "98 +- 21")},
      {"fibre_shortening_percent", "fibre shortening", "%",
       [](const JudgedBeat& b) { return 100.0 * b.results.fibre_shortening; }, 12.0, 32.0, 0.0,
       60.0, healthy_muscle, true,
       "Gao et al., IMA J. Appl. Math. 79:978, 2014, healthy subject: fibre strain -0.19 +- 0.04 "
       "over the wall, +- 2 SD, as 1 - sqrt(1 + 2 E)"},
      {"circumferential_strain", analysis::quantity("circumferential_strain").title, "1",
       [](const JudgedBeat& b) { return end_systolic(b, "circumferential_strain"); }, -0.280,
       -0.168, -0.5, infinity, healthy_muscle, true, tracked("-26.1 +- 3.8%", green)},
      {"longitudinal_strain", analysis::quantity("longitudinal_strain").title, "1",
       [](const JudgedBeat& b) { return end_systolic(b, "longitudinal_strain"); }, -0.261, -0.110,
       -0.5, infinity, healthy_muscle, true, tracked("-21.3 +- 4.8%", green)},
      {"thickening_percent", "thickening of the wall", "%",
       [](const JudgedBeat& b) { return 100.0 * b.results.thickening; }, 23.0, 57.0, -100.0, 300.0,
       healthy_muscle, true, tracked("radial strain 39.8 +- 8.3%", "")},
      {"apex_rotation_deg", "rotation of the apex, anticlockwise seen from the apex", "deg",
       apex_rotation, 9.0, 16.0, -90.0, 90.0, healthy_muscle, true,
       "Lorenz et al., J. Cardiovasc. Magn. Reson. 2:97, 2000, tagging in 10 healthy adults: apex "
       "against base 12.6 +- 1.5 deg, +- 2 SD; the base of the model does not turn"},
      {"base_axial_shift_mm", "axial shift of the base", "mm", base_shift, 0.0, 0.5, 0.0, infinity,
       any_wall, false, "the model: the base stays in its plane"},
      {"wall_volume_mean_percent", "change of the wall's volume, mean", "%", mean_J, -0.5, 0.5,
       -100.0, infinity, any_wall, false, incompressible},
      {"wall_volume_tails_percent", "change of an element's volume, 1st and 99th percentile", "%",
       tail_J, 0.0, 5.0, 0.0, infinity, any_wall, false, incompressible},
  };
}

std::string why_not_applicable(const PlausibleRange& range, const JudgedBeat& beat) {
  if (range.needs_end_systole && !beat.contraction_was_steady)
    return "contraction ended before it was steady, so there is no end-systole to judge";
  if (!beat.base_is_held && range.quantity == "base_axial_shift_mm")
    return "springs hold the base, which may move, or take it along";
  if (!beat.base_is_held && range.quantity == "apex_rotation_deg")
    return "the base may turn too; the range is that of the apex against it";
  if (range.population == Population::healthy_muscle && beat.is_infarcted)
    return "the range is that of muscle without an infarct";
  return "";
}

/// Of a range that the beat has, in the range's unit; not a number where it did not happen.
double value_in(const PlausibleRange& range, const circulation::BeatMeasures& heartbeat) {
  return heartbeat.*range.measure / units::parse_unit(range.unit).factor;
}

/// Whether the value cannot be: a volume, mass or fraction that is not positive and so on.
bool is_impossible(const PlausibleRange& range, double value) {
  return !(value >= range.possible_low && value <= range.possible_high);
}

std::string why_impossible(const PlausibleRange& range, double value) {
  if (range.quantity == "ejection_fraction_percent" && value < 0.0)
    return "the cavity holds more at end-systole than at end-diastole: the muscle does not hold "
           "the pressure";
  if (range.quantity == "fibre_shortening_percent" && value < 0.0)
    return "the fibres are longer at end-systole than at end-diastole: the muscle does not hold "
           "the pressure";
  return fmt::format("a beating heart has {:g} to {:g} {}", range.possible_low, range.possible_high,
                     range.unit);
}

Judgement judge(const PlausibleRange& range, const JudgedBeat& beat) {
  const double at_rate = range.measure == &circulation::BeatMeasures::ejection_time
                             ? circulation::relative_systole(beat.period)
                             : 1.0;
  Judgement j{&range,
              at_rate * range.low,
              at_rate * range.high,
              range.measure != nullptr ? value_in(range, *beat.heartbeat) : range.value(beat),
              Answer::not_applicable,
              why_not_applicable(range, beat),
              false};
  if (range.measure != nullptr && std::isnan(j.value)) {
    j.reason = "it did not happen within the last beat";
    return j;
  }
  j.is_impossible = is_impossible(range, j.value);
  if (j.is_impossible)
    j.reason = why_impossible(range, j.value);
  else if (!j.reason.empty())
    return j;
  j.answer = j.value >= j.low && j.value <= j.high ? Answer::within : Answer::outside;
  return j;
}

}  // namespace

const std::vector<PlausibleRange>& plausible_ranges() {
  static const std::vector<PlausibleRange> all = [] {
    std::vector<PlausibleRange> ranges = make_ranges();
    for (PlausibleRange& range : ranges_of_heartbeats())
      ranges.push_back(std::move(range));
    return ranges;
  }();
  return all;
}

std::string name(Answer answer) {
  return answer == Answer::within    ? "within"
         : answer == Answer::outside ? "outside"
                                     : "not applicable";
}

std::vector<Judgement> judge(const JudgedBeat& beat) {
  std::vector<Judgement> all;
  for (const PlausibleRange& range : plausible_ranges())
    if (range.measure == nullptr || beat.heartbeat != nullptr)
      all.push_back(judge(range, beat));
  return all;
}

std::vector<std::string> impossible_values(const std::vector<Judgement>& judgements) {
  std::vector<std::string> sentences;
  for (const Judgement& j : judgements)
    if (j.is_impossible)
      sentences.push_back(fmt::format("{} is {:.3g} {}, which no beating heart has: {}",
                                      j.range->label, j.value, j.range->unit, j.reason));
  return sentences;
}

namespace {

const PlausibleRange& range_of(const char* quantity) {
  const auto& all = plausible_ranges();
  return *std::find_if(all.begin(), all.end(),
                       [&](const PlausibleRange& r) { return r.quantity == quantity; });
}

/// A number of a beat, and what patients have.
struct OfPatients {
  std::string label, unit;
  double value, low, high;
};

}  // namespace

bool is_open_in_diastole(const circulation::BeatMeasures& beat) {
  const double opens = std::isnan(beat.aortic_opens) ? 0.0 : beat.aortic_opens;  // before the beat
  return beat.mitral_closes >= opens && beat.mitral_closes < beat.aortic_closes;
}

std::string open_aortic_valve(const circulation::BeatMeasures& beat) {
  if (!is_open_in_diastole(beat))
    return "";
  return "the aortic valve is open in diastole: the arteries' pressure falls below that which "
         "fills the ventricle, so that their resistance or compliance is too small, and there is "
         "no isovolumic contraction";
}

std::vector<std::string> unlike_any_patient(const circulation::BeatMeasures& beat) {
  constexpr double wide = 2.0;
  const PlausibleRange& edv = range_of("edv_ml");
  const PlausibleRange& fraction = range_of("ejection_fraction_percent");
  std::vector<OfPatients> all{
      {"end-diastolic volume", "ml", beat.end_diastolic_volume / units::ml, edv.low / wide,
       edv.high * wide},
      {"ejection fraction", "%", 100.0 * beat.ejection_fraction, fraction.possible_low,
       fraction.possible_high},
      {"stroke volume", "ml", beat.stroke_volume / units::ml, edv.low / wide * fraction.low / 100.0,
       edv.high * wide * fraction.high / 100.0}};
  for (const PlausibleRange& r : plausible_ranges())
    if (r.measure != nullptr)
      all.push_back({r.label, r.unit, value_in(r, beat), r.possible_low, r.possible_high});
  std::vector<std::string> sentences;
  if (std::string open = open_aortic_valve(beat); !open.empty())
    sentences.push_back(std::move(open));
  for (const OfPatients& m : all)
    if (m.value < m.low || m.value > m.high)
      sentences.push_back(fmt::format(
          "the {} is {:.4g} {}, and no patient's is outside of {:.3g} to {:.3g} {}: check the "
          "circulation's values and their units",
          m.label, m.value, m.unit, m.low, m.high, m.unit));
  return sentences;
}

}  // namespace lv::report
