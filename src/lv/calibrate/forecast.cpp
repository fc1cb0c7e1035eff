#include "lv/calibrate/forecast.hpp"

#include "lv/base/median.hpp"
#include "lv/base/time_left.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace lv::calibrate {
namespace {

constexpr std::size_t remembered = 5;       // equilibria of each kind
constexpr double remembered_answer = 1e-3;  // of a fit that was stopped and goes on [s]

constexpr double near_to_far = 0.6;         // of a neighbour's duration, before one is known
constexpr double trials_before_root = 2.0;  // until it lies between two

double median_of(const std::deque<double>& values) {
  return median({values.begin(), values.end()});
}

void remember(double seconds, std::deque<double>& durations) {
  durations.push_back(seconds);
  if (durations.size() > remembered)
    durations.pop_front();
}

}  // namespace

void FitForecast::begin() {
  part_ += begun_ ? 1 : 0;
  begun_ = true;
  done_ = {0.0, 0.0};
  misfits_.clear();
  for (Muscle& muscle : muscles_)
    muscle.near.clear();
}

void FitForecast::record(MuscleState muscle, double seconds) {
  const auto m = static_cast<std::size_t>(muscle);
  done_[m] += 1.0;
  if (seconds < remembered_answer)
    return;
  if (!muscles_[m].is_known) {
    muscles_[m].is_known = true;
    return;
  }
  const bool is_near = part_ < parts_.size() && parts_[part_].is_near;
  remember(seconds, is_near ? muscles_[m].near : muscles_[m].far);
}

void FitForecast::misfit(double value, double accuracy) {
  if (part_ >= parts_.size() || parts_[part_].end != FitEnd::by_misfit)
    return;
  misfits_.push_back(value);
  accuracy_ = accuracy;
}

double FitForecast::left_of_bracket() const {
  double smallest = std::abs(misfits_.front());
  for (const double f : misfits_)
    smallest = std::min(smallest, std::abs(f));
  if (smallest <= accuracy_)
    return 0.0;
  const auto [low, high] = std::minmax_element(misfits_.begin(), misfits_.end());
  const bool is_between = *low * *high < 0.0;
  const double digits = std::log(accuracy_) / std::log(std::min(smallest, 0.5));
  const double trials = std::ceil(std::log(digits) / std::log(std::numbers::phi));
  return std::max(1.0, trials) + (is_between ? 0.0 : trials_before_root);
}

/// A part that takes longer than usual is taken to end soon.
double FitForecast::left_of_part(std::size_t muscle) const {
  const double usual = parts_[part_].equilibria[muscle];
  if (usual == 0.0)
    return 0.0;
  const double least = parts_[part_].end == FitEnd::counted ? 0.0 : 1.0;
  return misfits_.empty() ? std::max(least, usual - done_[muscle]) : left_of_bracket();
}

std::array<double, 2> FitForecast::left() const {
  std::array<double, 2> equilibria{};
  for (std::size_t m = 0; m < 2; ++m)
    for (std::size_t p = part_; p < parts_.size(); ++p)
      equilibria[m] += p > part_ ? parts_[p].equilibria[m] : left_of_part(m);
  return equilibria;
}

/// Neighbours with parameters of their own are unloaded, others not: those of another part tell
/// nothing.
std::optional<double> FitForecast::duration(const Muscle& muscle, std::size_t part) const {
  const auto& recent = muscle.near;
  if (part == part_ && recent.size() > 1)
    return std::accumulate(recent.begin(), recent.end(), 0.0) / static_cast<double>(recent.size());
  if (muscle.far.empty())
    return {};
  return median_of(muscle.far) * (parts_[part].is_near ? near_to_far : 1.0);
}

bool FitForecast::is_open() const {
  return std::any_of(parts_.begin() + static_cast<std::ptrdiff_t>(part_), parts_.end(),
                     [](const FitPart& part) { return part.end == FitEnd::open; });
}

double FitForecast::seconds_left() const {
  if (is_open())
    return -1.0;
  double seconds = 0.0;
  for (std::size_t p = part_; p < parts_.size(); ++p)
    for (std::size_t m = 0; m < 2; ++m) {
      const double equilibria = p > part_ ? parts_[p].equilibria[m] : left_of_part(m);
      if (equilibria == 0.0)
        continue;
      const auto each = duration(muscles_[m], p);
      if (!each)
        return -1.0;
      seconds += equilibria * *each;
    }
  return seconds;
}

std::string FitForecast::words() const {
  const double seconds = seconds_left();
  if (seconds >= 0.0)
    return time_left(seconds);
  const auto equilibria = left();
  return fmt::format(", {}{:.0f} equilibria left", is_open() ? "at least " : "",
                     equilibria[0] + equilibria[1]);
}

}  // namespace lv::calibrate
