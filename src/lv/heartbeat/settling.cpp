#include "lv/heartbeat/settling.hpp"

#include <algorithm>
#include <cmath>

namespace lv::heartbeat {

double Settling::time_left(const Phase& phase, double time, double variation) {
  const double longest = phase.longest - time;
  const double usual = std::max(phase.usual - time, 0.1 * phase.window);
  if (time < phase.settled || !std::isfinite(variation))
    return std::min(usual, longest);
  samples_.push_back({time, variation});
  while (samples_.size() > 2 && samples_.front().time < time - phase.window)
    samples_.pop_front();
  const Sample& first = samples_.front();
  const double fall = std::log(first.variation / variation) / (time - first.time);
  if (!(fall > 0.0) || !std::isfinite(fall))
    return std::min(usual, longest);
  return std::clamp(std::log(variation / phase.tolerance) / fall, 0.0, longest);
}

}  // namespace lv::heartbeat
