#pragma once

#include <deque>
#include <string>
#include <vector>

namespace lv::implicit {

/// How long a search for the wall without load will still take: the equilibria that are left at the
/// rate at which the distance has fallen, each as long as the last ones took. An equilibrium that
/// is found from no load tells nothing of those that begin near one.
class UnloadForecast {
 public:
  /// The distance at which the search ends [mm].
  explicit UnloadForecast(double goal) : goal_(goal) {}

  /// The search begins anew.
  void begin() { distances_.clear(); }

  /// An equilibrium was sought for so many seconds, from one near it or from no load.
  void sought(double seconds, bool is_near);

  /// It came nearer, to a largest distance [mm].
  void accepted(double distance) { distances_.push_back(distance); }

  /// Negative when the distance hardly falls any more: nobody knows then.
  [[nodiscard]] double equilibria_left() const;

  /// Negative while no equilibrium began near another, or when their number is not known.
  [[nodiscard]] double seconds_left() const;

  /// ", about 20 s left", or ", 4 equilibria left" while the seconds are not known; or nothing.
  [[nodiscard]] std::string words() const;

 private:
  double goal_;
  std::vector<double> distances_;
  std::deque<double> durations_;
};

}  // namespace lv::implicit
