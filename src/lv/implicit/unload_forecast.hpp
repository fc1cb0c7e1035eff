#pragma once

#include <string>
#include <vector>

namespace lv::implicit {

/// How long a path of walls without load along the pressure (find_reference) will still take, in
/// tangents at the time per tangent so far: one for each step, the corrections of the last step and
/// the wall that is loaded again. Nobody knows before whether fixed points follow.
class PathForecast {
 public:
  /// So many seconds, for so many tangents.
  void spent(double seconds, int tangents) {
    seconds_ += seconds;
    tangents_ += tangents;
  }

  /// Of so many steps; negative before the first tangent.
  [[nodiscard]] double seconds_left(double steps) const;

 private:
  double seconds_ = 0.0;
  int tangents_ = 0;
};

/// How long the search by fixed points will still take: the equilibria that are left at the
/// rate at which the distance has fallen, each as long as the last ones took. The first, from no
/// load, and the second, which begins far from it, take longer: what follows them takes a usual
/// part of their time until it is seen.
class UnloadForecast {
 public:
  /// Equilibria without halving the distance after which a wall that is near enough is taken.
  static constexpr int patience = 4;

  /// The distance at which the search ends [mm].
  explicit UnloadForecast(double goal) : goal_(goal) {}

  /// The search begins anew, from no load or from an equilibrium that is near its first.
  void begin(bool is_near = false) {
    distances_.clear();
    seconds_.clear();
    goes_on_ = is_near;
  }

  /// An equilibrium was sought for so many seconds.
  void sought(double seconds);

  /// It came nearer, to a largest distance [mm], so many equilibria after one that halved it.
  void accepted(double distance, int since_halved = 0) {
    distances_.push_back(distance);
    since_halved_ = since_halved;
  }

  /// Where the distance hardly falls, those until the search gives up.
  [[nodiscard]] double equilibria_left() const;

  /// Negative before the first equilibrium that is not of a search that was stopped.
  [[nodiscard]] double seconds_left() const;

 private:
  double goal_;
  std::vector<double> distances_;
  std::vector<double> seconds_;  ///< of the equilibria since the search began anew
  int since_halved_ = 0;         ///< equilibria
  bool goes_on_ = false;         ///< after equilibria that had been kept, or from one nearby
};

}  // namespace lv::implicit
