#pragma once

#include "lv/circulation/signals.hpp"

#include <limits>
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
  /// What flows in through the mitral valve, and its greatest flow: from its opening until the
  /// atrium contracts, or else until it closes, and from then on (E and A of an echocardiogram)
  /// [mm^3], [mm^3/s].
  double early_filling, early_filling_flow, late_filling, late_filling_flow;
  double largest_pressure_rate, least_pressure_rate;                    ///< dp/dt [kPa/s]
  double mitral_closes, aortic_opens, aortic_closes, mitral_opens;      ///< [s]
  double isovolumic_contraction, ejection_time, isovolumic_relaxation;  ///< [s]
  /// Of p = p_0 exp(-t/tau), least squares of log p over the time from the fastest fall to the
  /// opening of the mitral valve, both found between samples [s].
  double relaxation_constant;
};

/// The measures of one beat from samples that begin and end with it. `atrium` is when the left
/// atrium begins to contract, from the beat's beginning [s]; not a number: there is none. Filling
/// that goes on in the next beat is taken from this one's beginning.
[[nodiscard]] BeatMeasures measure_beat(std::span<const Sample> beat,
                                        double atrium = std::numeric_limits<double>::quiet_NaN());

}  // namespace lv::circulation
