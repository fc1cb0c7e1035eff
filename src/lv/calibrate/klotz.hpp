#pragma once

/// Measured volumes and pressures in, parameters of the muscle out.
namespace lv::calibrate {

/// The end-diastolic pressure-volume relation of any human heart from one measured point (V_m, P_m)
/// of it (Klotz et al., Am. J. Physiol. Heart Circ. Physiol. 291:H403, 2006; Nat. Protoc. 2:2152,
/// 2007). With pressures in mmHg:
///
///   V0  = V_m (0.6 - 0.006 P_m)                                  without pressure
///   V30 = V0 + (V_m - V0) / (P_m/A_n)^(1/B_n)                    at 30 mmHg, A_n = 27.78, B_n = 2.76
///   P   = alpha V^beta through (V_m, P_m) and (V30, 30 mmHg); for P_m > 22 mmHg through (V_m, P_m)
///         and (V15, 15 mmHg), V15 = V0 + 0.8 (V30 - V0)
///
/// In normalised form all hearts share P = A_n [(V - V0)/(V30 - V0)]^B_n.
struct Klotz {
  double V0 = 0.0;     ///< [mm^3]
  double V30 = 0.0;    ///< [mm^3]
  double alpha = 0.0;  ///< [mmHg/ml^beta]
  double beta = 0.0;   ///< [-]

  [[nodiscard]] double pressure(double V) const;  ///< alpha V^beta [kPa]
  [[nodiscard]] double volume(double P) const;    ///< (P/alpha)^(1/beta) [mm^3]
};

/// From the volume [mm^3] at a pressure [kPa] above zero.
[[nodiscard]] Klotz klotz(double V_m, double P_m);

/// (P/P_m)^(1/B_n): what share of the volume V_m - V0 a heart has taken up at the pressure P, by
/// the normalised form.
[[nodiscard]] double klotz_filling(double pressure_ratio);

}  // namespace lv::calibrate
