#include "lv/heartbeat/protocol.hpp"

#include "lv/heartbeat/beat.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lv::heartbeat {

double smooth_step(double s) {
  s = std::clamp(s, 0.0, 1.0);
  return s * s * s * (10.0 - 15.0 * s + 6.0 * s * s);
}

namespace {

/// Of a volume that comes to rest like exp(-t/relaxation) after the ramp, and is then watched for a
/// window [s].
double usual_duration(double ramp, double tolerance, double window, double relaxation) {
  return ramp + relaxation * std::log(1.0 / tolerance) + window;
}

Phase filling(const Protocol& p) {
  return {.name = "filling",
          .marks = end_diastole,
          .loads =
              [p](double time) {
                return solid::Loads{p.ed_pressure * smooth_step(time / p.filling_ramp), 0.0,
                                    p.calcium.Ca_0};
              },
          .ramp = p.filling_ramp,
          .settled = p.filling_ramp,
          .drag = p.filling_drag,
          .tolerance = p.filling_tolerance,
          .window = p.filling_window,
          .longest = p.filling_longest,
          .usual = usual_duration(p.filling_ramp, p.filling_tolerance, p.filling_window, 0.04)};
}

Phase contraction(const Protocol& p) {
  const bool transient = p.calcium.mode == material::Calcium::Mode::transient;
  return {.name = "contraction",
          .marks = end_systole,
          .loads =
              [p](double time) {
                const double rise = smooth_step(time / p.contraction_ramp);
                return solid::Loads{std::lerp(p.ed_pressure, p.es_pressure, rise), rise,
                                    p.calcium.at(time)};
              },
          .ramp = p.contraction_ramp,
          .settled = std::max(p.contraction_ramp, p.calcium.peak_time()),
          .drag = transient ? 0.0 : p.contraction_drag,
          .end = transient ? Phase::End::refilling : Phase::End::steady,
          .tolerance = p.contraction_tolerance,
          .window = p.contraction_window,
          .longest = p.contraction_longest,
          .usual = usual_duration(p.contraction_ramp, p.contraction_tolerance, p.contraction_window,
                                  0.125)};
}

}  // namespace

std::vector<Phase> phases(const Protocol& protocol) {
  return {filling(protocol), contraction(protocol)};
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
