#include "lv/segment/kept_muscle.hpp"

#include "lv/base/median.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace lv::segment {
namespace {

/// What all slices do in each frame and what each is by itself, as logarithms whose sum is near
/// what the slices hold.
struct Parts {
  std::vector<double> of_frame, of_slice;
};

Areas logarithms(Areas areas) {
  constexpr double least = 1.0;  // [mm^2]: a slice beyond the tip
  for (std::vector<double>& slice : areas)
    for (double& a : slice)
      a = std::log(std::max(a, least));
  return areas;
}

Parts parts_of(const Areas& held) {
  constexpr int rounds = 4;
  const std::size_t frames = held.front().size();
  Parts parts{std::vector<double>(frames, 0.0), std::vector<double>(held.size(), 0.0)};
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t s = 0; s < held.size(); ++s) {
      std::vector<double> own = held[s];
      for (std::size_t t = 0; t < frames; ++t)
        own[t] -= parts.of_frame[t];
      parts.of_slice[s] = median(std::move(own));
    }
    for (std::size_t t = 0; t < frames; ++t) {
      std::vector<double> all;
      for (std::size_t s = 0; s < held.size(); ++s)
        all.push_back(held[s][t] - parts.of_slice[s]);
      parts.of_frame[t] = median(std::move(all));
    }
  }
  return parts;
}

/// How far each slice strays from what all do: the median of the frames, as logarithms.
std::vector<double> strayings(const Areas& logarithms, const Parts& parts) {
  std::vector<double> all;
  for (std::size_t s = 0; s < logarithms.size(); ++s) {
    std::vector<double> off;
    for (std::size_t t = 0; t < parts.of_frame.size(); ++t)
      off.push_back(std::abs(logarithms[s][t] - parts.of_slice[s] - parts.of_frame[t]));
    all.push_back(median(std::move(off)));
  }
  return all;
}

std::vector<double> agreements(std::vector<double> strayings) {
  constexpr double exact = 0.03;  // a third of the grid's step, of a wall of 8 mm
  const double usual = std::max(exact, median(strayings));
  for (double& straying : strayings)
    straying = straying > usual ? std::pow(usual / straying, 2) : 1.0;
  return strayings;
}

/// Logarithms of how far the middle of the wall has shortened since it was widest, per frame: of
/// what most slices do, since some show the atrium for a part of the cycle.
std::vector<double> shortened(const Areas& within_middle) {
  std::vector<double> shorter = parts_of(logarithms(within_middle)).of_frame;
  const double widest = *std::max_element(shorter.begin(), shorter.end());
  for (double& frame : shorter)
    frame = 0.5 * (widest - frame);
  return shorter;
}

/// What all slices do at end-diastole.
double at_end_diastole(const std::vector<double>& of_frame, const std::vector<double>& shorter) {
  constexpr double near = 0.02;
  std::vector<double> diastolic;
  for (std::size_t t = 0; t < of_frame.size(); ++t)
    if (shorter[t] < near)
      diastolic.push_back(of_frame[t]);
  return median(std::move(diastolic));
}

}  // namespace

double dark_area(const Polar& darkness, const Radii& line, const PolarGrid& grid) {
  double sum = 0.0;
  for (int i = 0; i < grid.rays; ++i)
    for (int k = 0; k < grid.radii; ++k) {
      const double inner = k == 0 ? 0.0 : grid.radius(k) - 0.5 * grid.step;
      const double outer = std::min(line(i), grid.radius(k) + 0.5 * grid.step);
      if (outer <= inner)
        break;
      sum += darkness(i, k) * (outer * outer - inner * inner);
    }
  return 0.5 * ray_angle(1, grid.rays) * sum;
}

Radii line_that_holds(const Polar& darkness, const Radii& endo, const Radii& thickness, double dark,
                      const PolarGrid& grid) {
  constexpr int halvings = 20;
  double low = 0.3;
  double high = 3.0;
  for (int n = 0; n < halvings; ++n) {
    const double middle = 0.5 * (low + high);
    (dark_area(darkness, endo + middle * thickness, grid) < dark ? low : high) = middle;
  }
  return endo + 0.5 * (low + high) * thickness;
}

Kept kept_areas(const Areas& held, const Areas& within_middle) {
  const Areas seen = logarithms(held);
  const Parts parts = parts_of(seen);
  const std::vector<double> shorter = shortened(within_middle);
  const double diastolic = at_end_diastole(parts.of_frame, shorter);
  Kept kept{held, agreements(strayings(seen, parts))};
  for (std::size_t t = 0; t < shorter.size(); ++t) {
    const double grown = std::clamp(parts.of_frame[t] - diastolic, 0.0, shorter[t]);
    for (std::size_t s = 0; s < held.size(); ++s)
      kept.areas[s][t] = std::exp(parts.of_slice[s] + diastolic + grown);
  }
  return kept;
}

}  // namespace lv::segment
