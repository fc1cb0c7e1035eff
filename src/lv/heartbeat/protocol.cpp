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

immersed::Loads loads(const Protocol& p, Phase phase, double time) {
  const bool holds = loads_are_final(p, phase, time);
  immersed::Loads now;
  if (phase == Phase::filling) {
    now = {.pressure = p.ed_pressure * smooth_step(time / p.filling_ramp),
           .calcium = p.calcium.Ca_0,
           .drag = holds ? p.filling_drag : 0.0};
    if (p.tension)
      now.tension = 0.0;
    return now;
  }
  const double rise = smooth_step(time / p.contraction_ramp);
  now = {
      .pressure = p.ed_pressure + (p.es_pressure - p.ed_pressure) * rise,
      .calcium = p.calcium.at(time),
      .drag = holds && p.calcium.mode == material::Calcium::Mode::hold ? p.contraction_drag : 0.0};
  if (p.tension)
    now.tension = *p.tension * rise;
  return now;
}

bool loads_are_final(const Protocol& p, Phase phase, double time) {
  if (phase == Phase::filling)
    return time >= p.filling_ramp;
  return time >= std::max(p.contraction_ramp, p.calcium.tau);
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
