#include "lv/implicit/unload_forecast.hpp"

#include "lv/base/median.hpp"
#include "lv/base/time_left.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace lv::implicit {
namespace {

constexpr std::size_t remembered = 3;  // equilibria, and falls of the distance
constexpr double recorded = 1e-3;      // an equilibrium of a search that was stopped [s]
constexpr double usual_fall = 0.1;     // of the distance in one step; counts as one step of its own
constexpr double slow = 0.5;           // a fall after which it is not known how many steps follow

}  // namespace

void UnloadForecast::sought(double seconds, bool is_near) {
  if (!is_near || seconds < recorded)
    return;
  durations_.push_back(seconds);
  if (durations_.size() > remembered)
    durations_.pop_front();
}

double UnloadForecast::equilibria_left() const {
  if (distances_.empty() || distances_.back() <= goal_)
    return 0.0;
  if (distances_.size() > 1 && distances_.back() > slow * distances_[distances_.size() - 2])
    return -1.0;
  const std::size_t n = std::min(remembered, distances_.size() - 1);
  const double falls = distances_.back() / distances_[distances_.size() - 1 - n];
  const double fall = std::pow(falls * usual_fall, 1.0 / static_cast<double>(n + 1));
  const double steps = std::log(goal_ / distances_.back()) / std::log(fall);
  return std::max(1.0, std::round(steps));
}

double UnloadForecast::seconds_left() const {
  const double equilibria = equilibria_left();
  if (durations_.empty() || equilibria < 0.0)
    return -1.0;
  return equilibria * median({durations_.begin(), durations_.end()});
}

std::string UnloadForecast::words() const {
  if (equilibria_left() < 0.0)
    return "";
  const double seconds = seconds_left();
  return seconds < 0.0 ? fmt::format(", {:.0f} equilibria left", equilibria_left())
                       : time_left(seconds);
}

}  // namespace lv::implicit
