#pragma once

#include "lv/base/units.hpp"

namespace lv::circulation {

/// Clinical units in those of the inside [kPa, mm^3, s].
using units::ml;
inline constexpr double resistance = units::mmHg / ml;  ///< of a mmHg s/ml, and an inertance
inline constexpr double compliance = ml / units::mmHg;  ///< of a ml/mmHg
inline constexpr double elastance = units::mmHg / ml;   ///< of a mmHg/ml

/// What the ventricle is joined to.
enum class Kind { none, windkessel, closed_loop };

/// How a valve's flow depends on the pressure across it: see Valve.
enum class ValveLaw { quadratic, arctangent };

/// What all valves have in common.
struct ValveParameters {
  ValveLaw law = ValveLaw::quadratic;
  double closed_resistance = 10.0;        ///< [kPa s/mm^3]
  double smoothing = 0.01 * units::mmHg;  ///< width of the change from closed to open [kPa]
};

/// Three elements behind the aortic valve, and a venous source before the mitral one.
struct WindkesselParameters {
  double R_mv = 0.01 * resistance;   ///< mitral valve [kPa s/mm^3]
  double R_ao = 0.01 * resistance;   ///< aortic valve
  double R_c = 0.05 * resistance;    ///< characteristic resistance of the aorta
  double R_p = 1.05 * resistance;    ///< peripheral resistance
  double C = 1.3 * compliance;       ///< arterial compliance [mm^3/kPa]
  double p_ven = 8.0 * units::mmHg;  ///< pressure of the source [kPa]
};

/// Arteries and veins of the body or of the lungs.
struct VesselParameters {
  double R_ar, C_ar, L_ar;  ///< resistance [kPa s/mm^3], compliance [mm^3/kPa], inertance
                            ///< [kPa s^2/mm^3]
  double R_ven, C_ven, L_ven;
};

/// A chamber whose stiffness is a function of time alone, p = (E_B + E_A e(t)) (V - V_0): e rises
/// from t_C on within T_C and falls within T_R, both as half a cosine.
struct ElastanceParameters {
  double E_A, E_B;  ///< active and passive elastance [kPa/mm^3]
  double T_C, T_R;  ///< duration of contraction and relaxation [s]
  double t_C;       ///< when contraction starts in a beat [s]
  double V_0;       ///< volume without pressure [mm^3]
};

/// The closed loop of Regazzoni et al. (J. Comput. Phys. 457:111083, 2022).
struct ClosedLoopParameters {
  /// In chambers and stressed vessels, shared out as the start has it; 0: what the start holds
  /// [mm^3].
  double blood = 0.0;
  double valve_resistance = 0.0075 * resistance;  ///< of an open valve [kPa s/mm^3]
  VesselParameters systemic{0.733 * resistance, 1.372 * compliance,  0.005 * resistance,
                            0.32 * resistance,  11.363 * compliance, 5e-4 * resistance};
  VesselParameters pulmonary{0.046 * resistance,  20.0 * compliance, 5e-4 * resistance,
                             0.0015 * resistance, 16.0 * compliance, 5e-4 * resistance};
  ElastanceParameters left_atrium{0.07 * elastance, 0.18 * elastance, 0.17, 0.17, 0.72, 4.0 * ml};
  ElastanceParameters right_atrium{0.06 * elastance, 0.07 * elastance, 0.17, 0.17, 0.72, 4.0 * ml};
  ElastanceParameters right_ventricle{0.2 * elastance, 0.029 * elastance, 0.25, 0.4, 0.1,
                                      16.0 * ml};
};

/// Where a circulation starts. A closed loop keeps the blood that it starts with.
struct Start {
  double V_lv = 118.52 * ml;
  double V_la = 87.183 * ml;
  double V_ra = 86.833 * ml;
  double V_rv = 166.177 * ml;
  double p_ar_sys = 87.675 * units::mmHg;
  double p_ven_sys = 35.898 * units::mmHg;
  double p_ar_pul = 19.545 * units::mmHg;
  double p_ven_pul = 15.004 * units::mmHg;
  double Q_ar_sys = 71.104 * ml;  ///< flows [mm^3/s]
  double Q_ven_sys = 94.039 * ml;
  double Q_ar_pul = 94.084 * ml;
  double Q_ven_pul = 473.279 * ml;
};

/// A circulation and how it is run.
struct CircuitParameters {
  Kind kind = Kind::none;
  double period = 0.8;      ///< of a beat, RR [s]
  double step = 1e-3;       ///< of time [s]
  int beats = 100;          ///< at most
  double tolerance = 1e-3;  ///< of the limit cycle: largest relative change from beat to beat
  ValveParameters valves;
  WindkesselParameters windkessel;
  ClosedLoopParameters closed_loop;
  /// What stands for the ventricle where there is no wall.
  ElastanceParameters left_ventricle{2.5 * elastance, 0.08 * elastance, 0.25, 0.15, 0.1, 15.0 * ml};
  Start start;

  [[nodiscard]] bool asked() const { return kind != Kind::none; }
};

}  // namespace lv::circulation
