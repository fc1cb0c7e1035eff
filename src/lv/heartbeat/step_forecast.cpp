#include "lv/heartbeat/step_forecast.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace lv::heartbeat {
namespace {

constexpr double growth = 1.5;          // of a step from the one before it
constexpr double crumb = 1e-9;          // of the way: what is left when the phase has ended
constexpr std::size_t last_steps = 10;  // that tell how long the next ones take

}  // namespace

void StepForecast::begin() {
  done_ = 0.0;
  left_of_phase_ = usual_.at(begun_++);
}

void StepForecast::record(double seconds, double progress, double length) {
  done_ += 1.0;
  durations_.push_back(seconds);
  if (durations_.size() > last_steps)
    durations_.pop_front();
  if (progress > 1.0 - crumb) {
    left_of_phase_ = 0.0;
    return;
  }
  const double in_lengths = (1.0 - progress) / length;
  const double growing = std::log(1.0 + (growth - 1.0) * in_lengths) / std::log(growth);
  left_of_phase_ = std::max(growing, usual_[begun_ - 1] - done_);
}

double StepForecast::steps_left() const {
  return std::accumulate(usual_.begin() + static_cast<std::ptrdiff_t>(begun_), usual_.end(),
                         left_of_phase_);
}

double StepForecast::seconds_left() const {
  if (durations_.empty())
    return -1.0;
  const double sum = std::accumulate(durations_.begin(), durations_.end(), 0.0);
  return steps_left() * sum / static_cast<double>(durations_.size());
}

}  // namespace lv::heartbeat
