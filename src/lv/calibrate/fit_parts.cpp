#include "lv/calibrate/fit_parts.hpp"

namespace lv::calibrate {
namespace {

/// The parts of Fitter::fit_passive, the first time or after T_scale was found.
void add_passive(const Plan& plan, bool first, std::vector<FitPart>& parts) {
  const bool klotz = plan.passive == FittedPassive::klotz;
  const bool far = first && !plan.starts_near;
  if (klotz)
    parts.push_back({of_unloaded, {1, 0, 0, 0}, far ? 2.0 : 0.0});
  else if (plan.passive != FittedPassive::none)
    parts.push_back({bracket_of(plan.passive == FittedPassive::C_a ? "C_a" : "scale"),
                     {1, 0, 0, 0},
                     far     ? 5.0
                     : first ? 2.0
                             : 1.0});
  if (plan.fits_exponent() && plan.active && far)
    parts.push_back({of_first_tension, {0, 0, 1, 0}, 4.0});
  if (klotz)
    parts.push_back(first ? FitPart{of_curve, {1, 2, 0, 0}, far ? 8.0 : 3.0}
                          : FitPart{of_curve, {0, 3, 0, 0}});
  else if (plan.fits_exponent())
    parts.push_back({of_curve, {5, 7, 0, 0}, first ? 3.0 : 1.0});
}

/// What is asked of each muscle that was not asked before: volumes at rest, and the end-systolic
/// one.
Equilibria of_muscle(double at_rest, bool is_anew, bool active) {
  const bool rests_anew = is_anew && at_rest > 0.0;
  const double anew = rests_anew ? 1.0 : 0.0;
  const double contracts = active ? 1.0 : 0.0;
  return {anew, at_rest - anew, is_anew && !rests_anew ? contracts : 0.0,
          is_anew && !rests_anew ? 0.0 : contracts};
}

/// What is asked of each end-systole besides its volume: strains, distances.
double regional_answers(const Plan& plan) {
  return (plan.strains.empty() ? 0.0 : 1.0) + (plan.drawn.empty() ? 0.0 : 1.0);
}

/// By pressures and parameters, from both sides.
Equilibria of_differences(double fitted, double at_rest, const Plan& plan) {
  const Equilibria by_pressure = of_muscle(at_rest, false, plan.active);
  const Equilibria by_parameter = of_muscle(at_rest, true, plan.active);
  Equilibria all{};
  for (std::size_t k = 0; k < all.size(); ++k)
    all[k] = 2.0 * (by_pressure[k] + fitted * by_parameter[k]);
  all[3] += regional_answers(plan) * (4.0 + 2.0 * fitted);
  return all;
}

}  // namespace

std::vector<FitPart> parts_of(const Plan& plan) {
  std::vector<FitPart> parts;
  add_passive(plan, true, parts);
  if (plan.active) {
    if (plan.passive == FittedPassive::none)
      parts.push_back({of_filling, {1, 0, 0, 0}});
    const bool has_tension = plan.starts_near || plan.fits_exponent();
    parts.push_back({bracket_of("T_scale"), {0, 0, 1, 0}, has_tension ? 3.0 : 5.0});
    add_passive(plan, false, parts);
    // where the passive muscle is usually left as it was, no wall is unloaded for it again
    const bool is_kept =
        plan.passive == FittedPassive::none || plan.passive == FittedPassive::klotz;
    parts.push_back(
        {bracket_of("T_scale"), is_kept ? Equilibria{0, 0, 0, 1} : Equilibria{0, 0, 1, 0}});
  }
  const double passive = plan.passive == FittedPassive::none ? 0.0 : 1.0;
  const double exponent = plan.fits_exponent() ? 1.0 : 0.0;
  const double fitted = passive + exponent + (plan.active ? 1.0 : 0.0);
  const double at_rest = plan.passive == FittedPassive::klotz ? 3.0 : passive + 3.0 * exponent;
  Equilibria trial = of_muscle(at_rest, true, plan.active);
  trial[3] += regional_answers(plan);
  if (plan.fits_regions())
    parts.push_back(
        {of_regions, trial, 3.0 * (fitted + static_cast<double>(plan.segments.size()) + 1.0)});
  parts.push_back(
      {of_result, of_muscle(at_rest + (exponent > 0.0 ? 1.0 : 0.0), false, plan.active)});
  if (!plan.parameters_alone)
    parts.push_back({of_sensitivity, of_differences(fitted, at_rest, plan)});
  return parts;
}

}  // namespace lv::calibrate
