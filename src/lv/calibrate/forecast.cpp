#include "lv/calibrate/forecast.hpp"

#include "lv/base/median.hpp"
#include "lv/base/time_left.hpp"

#include <algorithm>

namespace lv::calibrate {
namespace {

constexpr std::size_t remembered = 5;       // equilibria of each muscle
constexpr double remembered_answer = 1e-3;  // of a fit that was stopped and goes on [s]
constexpr double contraction_ratio = 2;  // of durations, before one of contracting muscle is known

double median_of(const std::deque<double>& values) {
  return median({values.begin(), values.end()});
}

}  // namespace

void FitForecast::begin() {
  part_ += begun_ ? 1 : 0;
  begun_ = true;
  done_ = {0.0, 0.0};
}

void FitForecast::record(MuscleState muscle, double seconds) {
  const auto m = static_cast<std::size_t>(muscle);
  done_[m] += 1.0;
  if (seconds < remembered_answer)
    return;
  durations_[m].push_back(seconds);
  if (durations_[m].size() > remembered)
    durations_[m].pop_front();
}

/// A part that takes longer than usual is taken to end soon.
double FitForecast::left(std::size_t muscle) const {
  double equilibria = 0.0;
  for (std::size_t p = part_; p < parts_.size(); ++p) {
    const double usual = parts_[p].equilibria[muscle];
    equilibria += p > part_ ? usual : usual == 0.0 ? 0.0 : std::max(1.0, usual - done_[muscle]);
  }
  return equilibria;
}

double FitForecast::seconds_left() const {
  if (durations_[0].empty() && durations_[1].empty())
    return -1.0;
  const double rests = durations_[0].empty() ? median_of(durations_[1]) / contraction_ratio
                                             : median_of(durations_[0]);
  const double contracts =
      durations_[1].empty() ? contraction_ratio * rests : median_of(durations_[1]);
  return left(0) * rests + left(1) * contracts;
}

std::string FitForecast::words() const {
  return time_left(seconds_left());
}

}  // namespace lv::calibrate
