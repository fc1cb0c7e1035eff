#include "lv/segment/grey_levels.hpp"

#include "lv/base/median.hpp"
#include "lv/segment/smooth_border.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace lv::segment {
namespace {

/// Weights of a Gaussian of three bins or rays, -9 to 9.
std::array<double, 19> gaussian() {
  std::array<double, 19> weights{};
  double sum = 0.0;
  for (int d = -9; d <= 9; ++d)
    sum += weights.at(d + 9) = std::exp(-d * d / 18.0);
  for (double& w : weights)
    w /= sum;
  return weights;
}

/// How many values lie near each of 61 between two; one between neighbours is shared by both.
std::vector<double> histogram(const std::vector<double>& values, double low, double high) {
  constexpr int bins = 60;
  std::vector<double> counts(bins + 1, 0.0);
  for (const double v : values) {
    if (v < low || v >= high)
      continue;
    const double at = (v - low) / (high - low) * bins;
    const int before = std::min(static_cast<int>(at), bins - 1);
    const double part = at - before;
    counts.at(before) += 1.0 - part;
    counts.at(before + 1) += part;
  }
  return counts;
}

/// The most frequent value between two, from a histogram smoothed over three bins; its top is that
/// of a parabola, so that it moves as smoothly as the values do.
double most_frequent(const std::vector<double>& values, double low, double high) {
  const std::vector<double> counts = histogram(values, low, high);
  const int n = static_cast<int>(counts.size());
  const std::array<double, 19> weights = gaussian();
  std::vector<double> density(counts.size(), 0.0);
  for (int bin = 0; bin < n; ++bin)
    for (int d = std::max(-9, -bin); d <= std::min(9, n - 1 - bin); ++d)
      density.at(bin + d) += weights.at(d + 9) * counts.at(bin);
  const auto peak = std::max_element(density.begin() + 1, density.end() - 1);
  const double bend = peak[-1] - 2.0 * peak[0] + peak[1];
  const double beside = bend < 0.0 ? 0.5 * (peak[-1] - peak[1]) / bend : 0.0;
  const double top = static_cast<double>(peak - density.begin()) + std::clamp(beside, -0.5, 0.5);
  return low + top / (n - 1) * (high - low);
}

/// The grey values 2 to 10 mm outside the blood on a ray.
void add_outside(const std::vector<Polar>& frames, const std::vector<Radii>& blood, int ray,
                 const PolarGrid& grid, std::vector<double>& values) {
  constexpr double nearest = 2.0;
  constexpr double farthest = 10.0;
  for (std::size_t t = 0; t < frames.size(); ++t)
    for (int k = 0; k < grid.radii; ++k)
      if (const double away = grid.radius(k) - blood[t](ray); away > nearest && away < farthest)
        values.push_back(frames[t](ray, k));
}

}  // namespace

Levels guess_levels(const std::vector<Polar>& frames, double radius, const PolarGrid& grid) {
  constexpr double usual = 0.35;
  const int inner = grid.index(surely_blood * radius) + 1;
  std::vector<double> middle;
  for (const Polar& values : frames)
    for (const double v : values.leftCols(inner).reshaped())
      middle.push_back(v);
  const double blood = std::max(median(std::move(middle)), 1e-6);  // a black image has none
  return {blood, Radii::Constant(grid.rays, usual * blood), 0.0};
}

double fullest_blood(const std::vector<Polar>& frames, double radius, const PolarGrid& grid) {
  const int inner = grid.index(surely_blood * radius) + 1;
  std::vector<double> shown;
  for (const Polar& values : frames) {
    const auto middle = values.leftCols(inner).reshaped();
    shown.push_back(median({middle.begin(), middle.end()}));
  }
  const auto quartile = shown.begin() + static_cast<std::ptrdiff_t>(3 * shown.size() / 4);
  std::nth_element(shown.begin(), quartile, shown.end());
  return *quartile;
}

std::vector<double> around_blood(const std::vector<Polar>& frames, const std::vector<Radii>& blood,
                                 const PolarGrid& grid) {
  std::vector<double> values;
  for (int i = 0; i < grid.rays; ++i)
    add_outside(frames, blood, i, grid, values);
  return values;
}

std::vector<double> muscle_levels(const std::vector<std::vector<double>>& outside,
                                  const std::vector<double>& blood) {
  constexpr double own = 0.35;  // how far a slice may be from the study
  std::vector<double> all;
  for (const auto& values : outside)
    all.insert(all.end(), values.begin(), values.end());
  const double usual_blood = median(blood);
  const double usual = most_frequent(all, 0.1 * usual_blood, 0.6 * usual_blood);
  std::vector<double> slices;
  for (const auto& values : outside)
    slices.push_back(most_frequent(values, (1.0 - own) * usual, (1.0 + own) * usual));
  std::vector<double> levels;
  for (std::size_t s = 0; s < slices.size(); ++s) {
    const auto from = slices.begin() + static_cast<std::ptrdiff_t>(s > 0 ? s - 1 : 0);
    const auto to = slices.begin() + static_cast<std::ptrdiff_t>(std::min(s + 2, slices.size()));
    levels.push_back(median({from, to}));
  }
  return levels;
}

std::vector<double> whole_blood(const std::vector<double>& inside,
                                const std::vector<double>& muscle) {
  std::vector<double> ratios;
  for (std::size_t s = 0; s < inside.size(); ++s)
    ratios.push_back(inside[s] / muscle[s]);
  const auto quarter = ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 4);
  std::nth_element(ratios.begin(), quarter, ratios.end());
  std::vector<double> whole;
  for (std::size_t s = 0; s < inside.size(); ++s)
    whole.push_back(std::max(inside[s], *quarter * muscle[s]));
  return whole;
}

Contrast contrast_of(const std::vector<double>& muscle, const std::vector<double>& blood) {
  return {median(blood), median(muscle)};
}

double with_usual_contrast(double value, const Contrast& contrast) {
  const auto [b, m] = contrast;
  const double usual = 0.28 * b;
  if (m <= usual)
    return value;
  const double g = std::log(usual / b) / std::log(m / b);
  return value > m ? usual + (value - m) * (b - usual) / (b - m)
                   : usual * std::pow(std::max(value, 0.0) / m, g);
}

Radii muscle_round(const std::vector<Polar>& frames, const std::vector<Radii>& blood,
                   double of_slice, const PolarGrid& grid) {
  constexpr double darkest = 0.3;  // of the slice's level
  constexpr double brightest = 1.6;
  constexpr double unclear = 0.1;  // so near the darkest lies the foot of lung, no peak
  const int beside = grid.rays / 12;
  Radii round(grid.rays);
  for (int i = 0; i < grid.rays; ++i) {
    std::vector<double> near;
    for (int d = -beside; d <= beside; ++d)
      add_outside(frames, blood, (i + d + grid.rays) % grid.rays, grid, near);
    const double found = most_frequent(near, darkest * of_slice, brightest * of_slice);
    round(i) = found > (darkest + unclear) * of_slice ? found : of_slice;
  }
  return harmonics_of(round, 2).max(darkest * of_slice);
}

Radii muscle_along(const std::vector<Polar>& frames, const std::vector<Radii>& middle,
                   const Radii& usual, const PolarGrid& grid) {
  constexpr double band = 1.6;      // [mm]
  constexpr double darkest = 0.65;  // of the usual level
  constexpr double brightest = 1.5;
  Radii along(grid.rays);
  for (int i = 0; i < grid.rays; ++i) {
    std::vector<double> near;
    for (std::size_t t = 0; t < frames.size(); ++t)
      for (int k = 0; k < grid.radii; ++k)
        if (std::abs(grid.radius(k) - middle[t](i)) < band)
          near.push_back(frames[t](i, k));
    along(i) = std::clamp(median(std::move(near)), darkest * usual(i), brightest * usual(i));
  }
  const std::array<double, 19> weights = gaussian();
  Radii smooth = Radii::Zero(grid.rays);
  for (int i = 0; i < grid.rays; ++i)
    for (int d = -9; d <= 9; ++d)
      smooth(i) += weights.at(d + 9) * along((i + d + grid.rays) % grid.rays);
  return smooth;
}

}  // namespace lv::segment
