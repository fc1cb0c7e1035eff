#include "lv/heartbeat/step_forecast.hpp"

#include <algorithm>
#include <cmath>

namespace lv::heartbeat {
namespace {

constexpr double growth = 1.5;  // of a step from the one before it
constexpr double crumb = 1e-9;  // of the way: what is left when the phase has ended

}  // namespace

void StepForecast::begin() {
  later_ -= 1.0;
  left_of_phase_ = usual_steps;
  phase_ = {};
}

void StepForecast::record(double seconds, double progress, double length) {
  for (Steps* steps : {&all_, &phase_}) {
    steps->number += 1.0;
    steps->seconds += seconds;
  }
  if (progress > 1.0 - crumb) {
    left_of_phase_ = 0.0;
    return;
  }
  const double in_lengths = (1.0 - progress) / length;
  const double growing = std::log(1.0 + (growth - 1.0) * in_lengths) / std::log(growth);
  left_of_phase_ = std::max(growing, usual_steps - phase_.number);
}

double StepForecast::seconds_left() const {
  if (all_.number == 0.0)
    return -1.0;
  const double usual = all_.seconds / all_.number;
  const double of_phase = phase_.number == 0.0 ? usual : phase_.seconds / phase_.number;
  return left_of_phase_ * of_phase + later_ * usual_steps * usual;
}

}  // namespace lv::heartbeat
