#include "lv/heartbeat/settling.hpp"

#include <algorithm>
#include <cmath>
#include <span>

namespace lv::heartbeat {
namespace {

using Samples = std::span<const std::pair<double, double>>;

double range(Samples samples) {
  const auto by_volume = [](const auto& a, const auto& b) { return a.second < b.second; };
  const auto [low, high] = std::minmax_element(samples.begin(), samples.end(), by_volume);
  return high->second - low->second;
}

/// Until the last volume that is out of tolerance beside the present one has left the window.
double shortest_left(const Phase& phase, Samples samples) {
  const auto& [now, volume] = samples.back();
  const double band = phase.tolerance * volume;
  for (std::size_t i = samples.size(); i-- > 0;)
    if (std::abs(samples[i].second - volume) > band)
      return std::max(0.0, samples[i].first + phase.window - now);
  return 0.0;
}

/// Until the variation, which falls as it did from the first half of the window to the second, is
/// within the tolerance; 0 where it does not fall.
double while_it_falls(const Phase& phase, Samples samples, double variation) {
  const std::size_t half = samples.size() / 2;
  const double before = range(samples.first(half));
  const double after = range(samples.subspan(half));
  if (!(before > after && after > 0.0))
    return 0.0;
  return 0.5 * phase.window * std::log(variation / phase.tolerance) / std::log(before / after);
}

/// Of the usual time to come to rest: what the stiffest walls that were tried took.
constexpr double least_share = 1.0 / 3.0;

double at_least(const Phase& phase) {
  return phase.ramp + phase.window;
}

/// Whether the volume has fallen by more than it rings.
bool swings_back(const std::vector<CurveRow>& curves) {
  constexpr double rings = 1e-3;  // of the volume
  double largest = 0.0;
  for (const CurveRow& row : curves)
    largest = std::max(largest, row.volume);
  return !curves.empty() && curves.back().volume < (1.0 - rings) * largest;
}

}  // namespace

double settling_time_left(const Phase& phase, double time, const SteadyVolume& volume) {
  const std::vector<std::pair<double, double>> samples(volume.samples().begin(),
                                                       volume.samples().end());
  if (samples.size() < 4)
    return std::min(phase.usual - time, phase.longest - time);
  const double least = std::max(shortest_left(phase, samples), 0.1 * phase.window);
  const double left =
      time < phase.usual ? phase.usual - time : while_it_falls(phase, samples, volume.variation());
  return std::min(std::max(left, least), phase.longest - time);
}

std::vector<Phase> phases_of_wall(std::vector<Phase> phases, const Beat& beat) {
  const Phase& filling = phases.front();
  double share = 1.0;
  if (const NamedMoment* filled = beat.find(filling.marks)) {
    const double took =
        (filled->wall.time - at_least(filling)) / (filling.usual - at_least(filling));
    share = std::clamp(2.0 * took - least_share, least_share, 1.0);
  } else if (swings_back(beat.curves)) {
    share = least_share;
  }
  for (Phase& phase : phases)
    phase.usual = std::lerp(at_least(phase), phase.usual, share);
  return phases;
}

}  // namespace lv::heartbeat
