#include "lv/base/time_left.hpp"

#include "lv/base/log.hpp"

#include <algorithm>
#include <chrono>

namespace lv {

std::string time_left(double seconds) {
  return seconds < 0.0 ? "" : ", about " + log::duration(seconds) + " left";
}

TimeLeft::TimeLeft(double interval) : interval_(interval) {}

double TimeLeft::now() {
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration<double>(now).count();
}

void TimeLeft::record(double done, double at) {
  samples_.push_back({at, done});
  constexpr double shortest = 10.0;  // [s]
  const double window = std::max(shortest, (at - begun_) / 3.0);
  while (samples_.size() > 2 && samples_[1].at <= at - window)
    samples_.pop_front();
}

double TimeLeft::seconds(double left) const {
  const Sample& first = samples_.front();
  const Sample& last = samples_.back();
  if (!(last.done > first.done) || !(last.at > first.at))
    return -1.0;
  return std::max(0.0, left) * (last.at - first.at) / (last.done - first.done);
}

bool TimeLeft::due() {
  const double at = now();
  if (at - reported_ < interval_)
    return false;
  reported_ = at;
  return true;
}

void Progress::add() {
  const std::lock_guard lock(mutex_);
  const auto done = static_cast<double>(++done_);
  const auto all = static_cast<double>(pieces_);
  left_.record(done);
  if (left_.due() && done_ < pieces_)
    log::info("{}: {:.0f}%{}", what_, 100.0 * done / all, left_.words(all - done));
}

}  // namespace lv
