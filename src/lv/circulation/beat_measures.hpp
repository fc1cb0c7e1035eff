#pragma once

#include "lv/circulation/signals.hpp"

#include <span>

namespace lv::circulation {

/// Signals at a time [s].
struct Sample {
  double time = 0.0;
  Signals signals;
};

/// What a clinic says of a beat. Times are from its beginning; what did not happen is NaN. A valve
/// opens and closes where the pressure across it changes sign.
struct BeatMeasures {
  double end_diastolic_volume, end_systolic_volume;       ///< mitral, aortic valve closes [mm^3]
  double stroke_volume;                                   ///< the difference [mm^3]
  double ejection_fraction;                               ///< of it [-]
  double end_diastolic_pressure, end_systolic_pressure;   ///< at the same moments [kPa]
  double peak_pressure;                                   ///< [kPa]
  double aortic_systolic, aortic_diastolic, aortic_mean;  ///< [kPa]
  double stroke_work;                                     ///< -int p dV [kPa mm^3]
  double largest_pressure_rate, least_pressure_rate;      ///< dp/dt [kPa/s]
  double mitral_closes, aortic_opens, aortic_closes, mitral_opens;      ///< [s]
  double isovolumic_contraction, ejection_time, isovolumic_relaxation;  ///< [s]
  /// Of p = p_0 exp(-t/tau), least squares of log p from the fastest fall to the opening of the
  /// mitral valve [s].
  double relaxation_constant;
};

/// The measures of one beat from samples that begin and end with it.
[[nodiscard]] BeatMeasures measure_beat(std::span<const Sample> beat);

}  // namespace lv::circulation
