#include "lv/implicit/unload_forecast.hpp"

#include "lv/base/median.hpp"

#include <algorithm>
#include <cmath>

namespace lv::implicit {
namespace {

constexpr std::size_t remembered = 3;  // equilibria, and falls of the distance
constexpr double recorded = 1e-3;      // an equilibrium of a search that was stopped [s]
constexpr double usual_fall = 0.1;     // of the distance in one step; counts as one step of its own
constexpr double slow = 0.5;           // a fall after which the search may end at any time

// usual, in times of the first equilibrium
constexpr double of_second = 0.6;
constexpr double of_others = 0.17;

// in tangents of the inverse problem
constexpr double of_last_corrections = 0.5;
constexpr double of_loading = 1.3;  // an engine and an equilibrium near by

}  // namespace

double PathForecast::seconds_left(double steps) const {
  if (tangents_ == 0)
    return -1.0;
  const double corrections = steps > 0.0 ? of_last_corrections : 0.0;
  return (steps + corrections + of_loading) * seconds_ / tangents_;
}

void UnloadForecast::sought(double seconds) {
  if (seconds < recorded)
    goes_on_ = true;
  else
    seconds_.push_back(seconds);
}

double UnloadForecast::equilibria_left() const {
  if (distances_.empty() || distances_.back() <= goal_)
    return 0.0;
  if (distances_.size() > 1 && distances_.back() > slow * distances_[distances_.size() - 2])
    return std::max(1, patience - since_halved_);
  const std::size_t n = std::min(remembered, distances_.size() - 1);
  const double falls = distances_.back() / distances_[distances_.size() - 1 - n];
  const double fall = std::pow(falls * usual_fall, 1.0 / static_cast<double>(n + 1));
  const double steps = std::log(goal_ / distances_.back()) / std::log(fall);
  return std::max(1.0, std::round(steps));
}

double UnloadForecast::seconds_left() const {
  const double equilibria = equilibria_left();
  if (seconds_.empty() || equilibria == 0.0)
    return seconds_.empty() ? -1.0 : 0.0;
  const std::size_t from_afar = goes_on_ ? 0 : 2;
  if (seconds_.size() <= from_afar)
    return seconds_.front() *
           (of_others * equilibria + (seconds_.size() == 1 ? of_second - of_others : 0.0));
  const auto n = static_cast<std::ptrdiff_t>(std::min(remembered, seconds_.size() - from_afar));
  return equilibria * median({seconds_.end() - n, seconds_.end()});
}

}  // namespace lv::implicit
