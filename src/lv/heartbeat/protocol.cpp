#include "lv/heartbeat/protocol.hpp"

#include <algorithm>
#include <limits>

namespace lv::heartbeat {

std::string name(Phase phase) {
  return phase == Phase::filling ? "filling" : "contraction";
}

double smooth_step(double s) {
  s = std::clamp(s, 0.0, 1.0);
  return s * s * s * (10.0 - 15.0 * s + 6.0 * s * s);
}

solid::Loads loads(const Protocol& p, Phase phase, double time) {
  if (phase == Phase::filling)
    return {p.ed_pressure * smooth_step(time / p.filling_ramp), 0.0, p.calcium.Ca_0};
  const double rise = smooth_step(time / p.contraction_ramp);
  return {p.ed_pressure + (p.es_pressure - p.ed_pressure) * rise, rise, p.calcium.at(time)};
}

double drag(const Protocol& p, Phase phase, double time) {
  if (!loads_are_final(p, phase, time))
    return 0.0;
  if (phase == Phase::filling)
    return p.filling_drag;
  return p.calcium.mode == material::Calcium::Mode::hold ? p.contraction_drag : 0.0;
}

bool loads_are_final(const Protocol& p, Phase phase, double time) {
  if (phase == Phase::filling)
    return time >= p.filling_ramp;
  return time >= std::max(p.contraction_ramp, p.calcium.peak_time());
}

void SteadyVolume::record(double time, double volume) {
  samples_.emplace_back(time, volume);
  while (samples_.size() > 2 && samples_[1].first <= time - window_)
    samples_.pop_front();
}

double SteadyVolume::variation() const {
  if (samples_.empty() || samples_.back().first - samples_.front().first < window_)
    return std::numeric_limits<double>::infinity();
  double low = samples_.front().second;
  double high = low;
  double sum = 0.0;
  for (const auto& [time, volume] : samples_) {
    low = std::min(low, volume);
    high = std::max(high, volume);
    sum += volume;
  }
  return (high - low) * static_cast<double>(samples_.size()) / sum;
}

bool SteadyVolume::reached() const {
  return variation() <= tolerance_;
}

}  // namespace lv::heartbeat
