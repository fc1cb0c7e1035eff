#include "lv/heartbeat/settling.hpp"

#include <algorithm>
#include <cmath>

namespace lv::heartbeat {

double usual_duration(const Protocol& p, Phase phase) {
  return phase == Phase::filling ? p.filling_ramp + 2.0 * p.filling_window
                                 : p.contraction_ramp + 3.0 * p.contraction_window;
}

double Settling::time_left(const Protocol& p, Phase phase, double time, double variation) {
  const bool fills = phase == Phase::filling;
  const double window = fills ? p.filling_window : p.contraction_window;
  const double tolerance = fills ? p.filling_tolerance : p.contraction_tolerance;
  const double longest = (fills ? p.filling_longest : p.contraction_longest) - time;
  if (phase != phase_)
    samples_.clear();
  phase_ = phase;
  const double usual = std::max(usual_duration(p, phase) - time, 0.1 * window);
  if (!loads_are_final(p, phase, time) || !std::isfinite(variation))
    return std::min(usual, longest);
  samples_.push_back({time, variation});
  while (samples_.size() > 2 && samples_.front().time < time - window)
    samples_.pop_front();
  const Sample& first = samples_.front();
  const double fall = std::log(first.variation / variation) / (time - first.time);
  if (!(fall > 0.0) || !std::isfinite(fall))
    return std::min(usual, longest);
  return std::clamp(std::log(variation / tolerance) / fall, 0.0, longest);
}

}  // namespace lv::heartbeat
