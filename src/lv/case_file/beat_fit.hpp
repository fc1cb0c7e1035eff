#pragma once

#include "lv/case_file/parameters.hpp"

#include <string>
#include <vector>

namespace lv::case_file {

/// What is measured of a heartbeat.
struct BeatDatum {
  std::string name;  ///< "EDV", "ESV", "systolic", "diastolic"
  std::string key;   ///< where a case file says it: "calibrate.edv"
  const char* unit;  ///< in which it is shown
  double circulation::BeatMeasures::*of_beat;
  double measured;  ///< [mm^3] or [kPa]; 0: not measured

  [[nodiscard]] bool is_measured() const { return measured > 0.0; }
  /// A value in the unit.
  [[nodiscard]] double shown(double value) const;
};

/// A parameter that is fitted to heartbeats.
struct BeatParameter {
  const Parameter* parameter;
  std::string words;  ///< "filling pressure", "blood"
  std::size_t datum;  ///< which of BeatFit::data tells of it
};

/// What a case fits to which measured data of its heartbeats (calibrate.cycle): the pressure or the
/// blood that fills the heart to the end-diastolic volume, contractility to the end-systolic one,
/// and to the cuff's pressures the arteries' resistance and, where both are given, their
/// compliance.
struct BeatFit {
  std::vector<BeatDatum> data;            ///< all four, measured or not
  std::vector<BeatParameter> parameters;  ///< as many as were measured
  std::vector<std::string> left_alone;    ///< what is not fitted and why, as sentences
};
[[nodiscard]] BeatFit beat_fit(const Case& c);

/// The case that such a fit begins with: one that fits a closed loop's blood and does not say how
/// much there is begins with what circulation.start holds around the measured end-diastolic volume.
[[nodiscard]] Case begin_of_beat_fit(Case c);

/// A number's value in the parameter's own unit, and back.
[[nodiscard]] double value_of(const Parameter& p, const Case& c);
void set_value(const Parameter& p, Case& c, double value);

}  // namespace lv::case_file
