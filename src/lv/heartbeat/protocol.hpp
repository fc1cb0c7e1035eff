#pragma once

#include "lv/heartbeat/parameters.hpp"
#include "lv/solid/loads.hpp"

#include <deque>
#include <string>
#include <utility>

namespace lv::heartbeat {

enum class Phase { filling, contraction };

[[nodiscard]] std::string name(Phase phase);

/// Rises from 0 to 1 over s in [0,1] with zero slope and curvature at both ends, so that wall and
/// blood ring little: s^3 (10 - 15 s + 6 s^2).
[[nodiscard]] double smooth_step(double s);

/// The loads at `time` seconds after the start of a phase.
[[nodiscard]] solid::Loads loads(const Protocol& protocol, Phase phase, double time);

/// The resistance to the velocity then [1/s].
[[nodiscard]] double drag(const Protocol& protocol, Phase phase, double time);

/// Whether the loads have reached their final values (the end of the ramps, calcium at its
/// plateau).
[[nodiscard]] bool loads_are_final(const Protocol& protocol, Phase phase, double time);

/// Knows when a volume has settled: over a whole window its range is below a fraction of its mean.
/// A turning point of a swing does not fool it, since the window is longer than half a swing.
class SteadyVolume {
 public:
  SteadyVolume(double window, double tolerance) : window_(window), tolerance_(tolerance) {}

  void record(double time, double volume);
  [[nodiscard]] bool reached() const;

  /// Range over mean of the present window [-].
  [[nodiscard]] double variation() const;

  [[nodiscard]] const std::deque<std::pair<double, double>>& samples() const { return samples_; }

 private:
  double window_;
  double tolerance_;
  std::deque<std::pair<double, double>> samples_;  ///< time and volume
};

}  // namespace lv::heartbeat
