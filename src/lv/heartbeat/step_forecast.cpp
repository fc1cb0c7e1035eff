#include "lv/heartbeat/step_forecast.hpp"

#include <algorithm>
#include <cmath>
#include <span>

namespace lv::heartbeat {
namespace {

/// What share has passed at a share of the load.
struct Mark {
  double load, share;
};
constexpr Mark time_of_filling[]{
    {0.0025, 0.16}, {0.01, 0.30}, {0.1, 0.50}, {0.3, 0.68}, {1.0, 1.0}};
constexpr Mark steps_of_filling[]{
    {0.0025, 0.035}, {0.01, 0.11}, {0.1, 0.31}, {0.3, 0.55}, {1.0, 1.0}};
constexpr Mark time_of_contraction[]{{0.002, 0.05}, {0.01, 0.20}, {0.05, 0.52},
                                     {0.1, 0.67},   {0.3, 0.84},  {1.0, 1.0}};

constexpr double contraction_in_steps = 30.0;  // its time, in mean steps of filling

/// Between the marks on lines over the load's logarithm.
double share_at(double load, std::span<const Mark> marks) {
  const auto next = std::find_if(marks.begin(), marks.end() - 1,
                                 [&](const Mark& mark) { return load <= mark.load; });
  if (next == marks.begin())
    return next->share * load / next->load;
  const Mark& last = *(next - 1);
  return std::lerp(last.share, next->share,
                   std::log(load / last.load) / std::log(next->load / last.load));
}

}  // namespace

void StepForecast::begin() {
  ++begun_;
  spent_ = left_ = 0.0;
  steps_ = 0;
}

void StepForecast::record(double seconds, double progress) {
  spent_ += seconds;
  ++steps_;
  if (phases_[begun_ - 1] == Kind::filling) {
    const double whole = spent_ / share_at(progress, time_of_filling);
    const double steps = steps_ / share_at(progress, steps_of_filling);
    contraction_ = contraction_in_steps * whole / steps;
    left_ = whole - spent_;
  } else {
    const double left = 1.0 - share_at(progress, time_of_contraction);
    left_ = left * (spent_ + left * std::max(contraction_, 0.0));
  }
}

double StepForecast::seconds_left() const {
  if (contraction_ < 0.0)
    return -1.0;
  return left_ + static_cast<double>(phases_.size() - begun_) * contraction_;
}

}  // namespace lv::heartbeat
