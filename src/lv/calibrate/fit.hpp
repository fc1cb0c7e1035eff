#pragma once

#include "lv/calibrate/bracket.hpp"
#include "lv/calibrate/forecast.hpp"
#include "lv/calibrate/model.hpp"
#include "lv/calibrate/sensitivity.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

namespace lv::calibrate {

/// What of the passive muscle is fitted to the end-diastolic volume.
enum class FittedPassive {
  none,
  C_a,                 ///< the paper's way for a patient (2.25)
  scale,               ///< all stiffnesses by one factor
  scale_and_exponent,  ///< all exponents by another besides, to the normalised Klotz curve
  klotz                ///< both, to Klotz's V0 and filling curve, for a shape of end-diastole
};

/// A measured mean strain of a part of the wall.
struct MeasuredStrain {
  std::string region;
  double value = 0.0;
};

/// What a calibration is to do. Ranges are of the parameters themselves.
struct Plan {
  FittedPassive passive = FittedPassive::none;
  bool active = false;                          ///< T_scale, to the end-systolic volume
  double ed_pressure = 0.0, es_pressure = 0.0;  ///< [kPa]
  Target edv, esv;
  double tolerance = 0.01;  ///< of the volumes, as a fraction
  Range stiffness;          ///< of C_a or scale
  Range exponent, T_scale;
  std::vector<MeasuredStrain> strains;  ///< end-systolic; fitted to, besides the volumes, when any
  Errors errors;
  /// AHA segments whose factors of contractility are fitted to the strains besides, and the
  /// standard deviation of the factors' logarithms beforehand.
  std::vector<int> segments = {};
  double spread = 0.5;
  /// Drawn parts of the end-systolic surfaces, by their names; fitted to likewise, when any.
  std::vector<std::string> drawn = {};
  bool starts_near = false;       ///< the start is near the end
  bool parameters_alone = false;  ///< finds no sensitivities
  /// Of a fit near by (Fit::slopes), where the one to Klotz's V0 and curve begins with them.
  std::optional<Eigen::MatrixXd> slopes = {};

  [[nodiscard]] bool fits_regions() const { return !strains.empty() || !drawn.empty(); }
  [[nodiscard]] bool fits_exponent() const {
    return passive == FittedPassive::scale_and_exponent || passive == FittedPassive::klotz;
  }
};

/// One equilibrium of the search.
struct Evaluation {
  std::string purpose;  ///< which fit asked for it
  FitParameters parameters;
  solid::Loads loads;
  double volume = 0.0;  ///< [mm^3]
};

/// Of many values.
struct Misfit {
  double rms = 0.0, bias = 0.0;
};

/// How far the model's end-systolic surfaces lie outside of what was drawn of them [mm].
struct ShapeFit {
  std::vector<double> distances;  ///< in the order of Plan::drawn
  Misfit before;                  ///< of the fit to volumes, with which this one began
  Misfit after;
};

/// Of drawn parts, those that say something: one above the model's base is at no distance.
[[nodiscard]] inline std::size_t counted_parts(const std::vector<double>& distances) {
  return distances.size() -
         static_cast<std::size_t>(std::count(distances.begin(), distances.end(), 0.0));
}

/// How a model fits measured strains and a shape.
struct RegionalFit {
  std::vector<double> strains;      ///< of the model, in the order of Plan::strains
  double chi_squared = 0.0;         ///< |r|^2 of all that is fitted to, each by its error
  double degrees_of_freedom = 0.0;  ///< data less the unknowns that they determine
  Misfit strain;                    ///< of model minus measured
  std::optional<ShapeFit> shape;
};

/// The factor of contractility of an AHA segment.
struct FittedSegment {
  int segment = 0;
  double factor = 1.0;
  double error = 0.0;       ///< standard deviation of its logarithm
  double resolution = 0.0;  ///< share that the data determine and not the penalty (posterior.hpp)
};

/// What the fit would be, had the shape been seen under another end-diastolic pressure.
struct OtherPressure {
  double pressure = 0.0;                    ///< [kPa]
  std::optional<FitParameters> parameters;  ///< none where there is no fit
  double unloaded_volume = 0.0;             ///< [mm^3]
  std::string why_not;
};

/// By how much a volume may miss what is out of reach, as a fraction, before a rough model is
/// believed: with the scale alone the volume without load is right to 3%.
inline constexpr double reach_margin = 0.05;

struct Fit {
  FitParameters parameters;
  double unloaded_volume = 0.0;  ///< of the model [mm^3]
  double edv = 0.0, esv = 0.0;   ///< of the model with these parameters [mm^3]
  std::vector<ObservedVolume> observations;
  std::vector<double> volumes;  ///< of the model at the observations [mm^3]
  std::optional<RegionalFit> regional_fit;
  std::vector<FittedSegment> segments;  ///< empty unless they are fitted
  Sensitivity sensitivity;
  std::vector<OtherPressure> other_pressures;  ///< of an end-diastolic shape; not filled by `fit`
  std::vector<Evaluation> history;
  /// Of the fit to Klotz's V0 and curve: weighted misfits by ln scale and ln exponent.
  std::optional<Eigen::MatrixXd> slopes;
};

/// Fits the passive parameters to the end-diastolic volume, then T_scale to the end-systolic one
/// (section 3.1), and finds out how sure the values are.
///
/// C_a, scale and T_scale are bracketed (find_root). The exponent minimises, with the scale that
/// keeps the end-diastolic volume,
///
///   sum_k [V(p_k)/V_k - 1]^2,   V_k = V_0 + (EDV - V_0) (p_k/p_ED)^(1/B_n)
///
/// at p_k/p_ED = 1/4, 1/2 and 2: the Klotz curve in normalised form through the measured point and
/// the model's own volume without load, since the shape at early diastole, not the formula for V_0,
/// is where the model starts.
///
/// For a shape of end-diastole (FittedPassive::klotz), whose volume under p_ED is EDV whatever its
/// stiffness, scale and exponent minimise
///
///   [3 (V(0)/V_0 - 1)]^2 + sum_k [V(p_k)/V_k - 1]^2,   V_0 = EDV (0.6 - 0.006 p_ED/mmHg),
///
/// at p_k/p_ED = 1/4 and 1/2, V_k as above with this V_0; the scale alone then brings V(0) within
/// the tolerance, if need be. V(0) is V(0) of the wall that is unloaded with these values.
///
/// Before scale and exponent are sought T_scale is bracketed roughly, with the stiffness that is
/// known by then: an end-systolic volume that is out of reach by more than reach_margin is refused
/// before the fit takes its time. Every fit may start from that of a coarse wall (starts_near).
///
/// With measured strains E_i, or with distances d_n of the end-systolic surfaces from what was
/// drawn of them, those values are the start of a least-squares fit of all fitted parameters,
///
///   sum_k [(V_k/V_k,measured - 1)/sigma_V]^2 + sum_i [(E_i - E_i,measured)/sigma_E]^2
///     + sum_n [d_n/sigma_d]^2,
///
/// by Gauss-Newton steps in their logarithms (least_squares.hpp; the points of the Klotz curve
/// count as volumes). It need not meet the volumes within the tolerance. Where factors c_j of
/// segments are fitted besides, the penalty sum_j (ln c_j/spread)^2 is added. Where the data are
/// missed by more than their errors, these count as larger by (chi^2/degrees of freedom)^(1/2); the
/// errors of the other parameters then know that the factors move with them.
///
/// Throws OutOfReach for a volume out of reach and NoSolution when a fitted model misses the
/// measured volumes, to which alone it was fitted, by more than the tolerance.
///
/// The log says what is left of all that `forecast` knows of; this fit is its next one.
[[nodiscard]] Fit fit(const Model& model, const FitParameters& start, const Plan& plan,
                      FitForecast& forecast);
/// Alone.
[[nodiscard]] Fit fit(const Model& model, const FitParameters& start, const Plan& plan);

}  // namespace lv::calibrate
