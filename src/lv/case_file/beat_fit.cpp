#include "lv/case_file/beat_fit.hpp"

#include "lv/base/check.hpp"
#include "lv/base/units.hpp"
#include "lv/case_file/family.hpp"

#include <fmt/format.h>

namespace lv::case_file {
namespace {

/// Where the data stand in BeatFit::data.
enum Datum : std::size_t { edv, esv, systolic, diastolic };

double& number_at(const Parameter& p, Case& c) {
  return *std::get<double*>(p.slot(c));
}

}  // namespace

double BeatDatum::shown(double value) const {
  return value / units::parse_unit(unit).factor;
}

BeatFit beat_fit(const Case& c) {
  using Measures = circulation::BeatMeasures;
  const Calibration& k = c.calibration;
  BeatFit fit{
      {{"EDV", "calibrate.edv", "ml", &Measures::end_diastolic_volume, k.edv},
       {"ESV", "calibrate.esv", "ml", &Measures::end_systolic_volume, k.esv},
       {"systolic", "calibrate.cuff_systolic", "mmHg", &Measures::aortic_systolic, k.cuff_systolic},
       {"diastolic", "calibrate.cuff_diastolic", "mmHg", &Measures::aortic_diastolic,
        k.cuff_diastolic}},
      {},
      {}};
  const auto measured = [&](Datum datum) { return fit.data[datum].is_measured(); };
  const auto add = [&](const char* name, const char* words, Datum datum) {
    const Parameter* parameter = find_parameter(name);
    LV_CHECK(parameter != nullptr);
    if (measured(datum))
      fit.parameters.push_back({parameter, words, datum});
    else
      fit.left_alone.push_back(fmt::format("The {} ({}) keeps the case's value: {} is not set",
                                           words, name, fit.data[datum].key));
  };
  const Levers lever = levers(c);
  const bool is_loop = c.circulation.kind == circulation::Kind::closed_loop;
  add(lever.filling, is_loop ? "blood" : "filling pressure", edv);
  add(lever.contractility, "contractility", esv);
  add(lever.resistance, "arterial resistance", measured(diastolic) ? diastolic : systolic);
  if (measured(diastolic) || !measured(systolic))
    add(lever.compliance, "arterial compliance", systolic);
  else
    add(lever.compliance, "arterial compliance", diastolic);
  return fit;
}

Case begin_of_beat_fit(Case c) {
  const double edv = c.calibration.edv;
  return edv > 0.0 ? with_blood_around(edv, std::move(c)) : c;
}

double value_of(const Parameter& p, const Case& c) {
  Case copy = c;
  return number_at(p, copy) / units::parse_unit(p.unit).factor;
}

void set_value(const Parameter& p, Case& c, double value) {
  number_at(p, c) = value * units::parse_unit(p.unit).factor;
}

}  // namespace lv::case_file
