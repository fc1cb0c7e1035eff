#include "lv/material/stress_stretch.hpp"

#include <cmath>

namespace lv::material {
namespace {

/// sigma at a stretch l [kPa].
double stress_at(double l, const AnyPassiveLaw& any) {
  const double w = 1.0 / std::sqrt(l);
  Mat3 F = Mat3::Zero();
  F.diagonal() << l, w, w;
  const Mat3 P = std::visit([&](const auto& law) { return law.stress(F); }, any);
  return P(0, 0) * l - P(1, 1) * w;
}

const std::string paper = "Gao et al. 2014: ";  // its subjects' names begin so

}  // namespace

StressStretch pulled_along_fibre(const std::string& muscle, const AnyPassiveLaw& law) {
  constexpr double highest = 12.0;
  constexpr int steps = 120;
  StressStretch curve;
  curve.muscle = muscle;
  for (int i = 0; i <= steps; ++i) {
    const double l = 1.0 + 0.3 * i / steps;
    const double stress = stress_at(l, law);
    if (stress > highest)
      break;
    curve.stretch.push_back(l);
    curve.stress.push_back(stress);
  }
  return curve;
}

std::vector<StressStretch> published_muscles() {
  const HolzapfelOgden healthy;
  const HolzapfelOgden excised{0.059, 8.023, 18.472, 16.026, 2.481, 11.12, 0.216, 11.436};
  std::vector<StressStretch> all{
      pulled_along_fibre(paper + "healthy subject", healthy),
      pulled_along_fibre(paper + "patient's remote muscle", healthy.with_anisotropy_scaled(7.5)),
      pulled_along_fibre("Holzapfel & Ogden 2009: excised pig muscle", excised)};
  for (StressStretch& curve : all)
    curve.is_published = true;
  return all;
}

bool is_subject_of_paper(const std::string& muscle) {
  return muscle.starts_with(paper);
}

}  // namespace lv::material
