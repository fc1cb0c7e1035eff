#pragma once

#include "lv/heartbeat/parameters.hpp"
#include "lv/solid/loads.hpp"

#include <deque>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace lv::heartbeat {

/// Rises from 0 to 1 over s in [0,1] with zero slope and curvature at both ends, so that wall and
/// blood ring little: s^3 (10 - 15 s + 6 s^2).
[[nodiscard]] double smooth_step(double s);

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

/// One part of a beat: what acts while it lasts, how it ends and which moment that is.
struct Phase {
  enum class End {
    steady,    ///< the volume has settled (SteadyVolume)
    refilling  ///< the cavity fills again; the moment is that of its smallest volume
  };

  std::string name;
  std::string marks;                          ///< name of the moment
  std::function<solid::Loads(double)> loads;  ///< so many seconds after its start
  double ramp = 0.0;                          ///< how long the loads rise [s]
  double settled = 0.0;                       ///< from when on they are final [s]
  double drag = 0.0;                          ///< resistance to the velocity once they are [1/s]
  End end = End::steady;
  double tolerance = 0.0, window = 0.0;  ///< see SteadyVolume [-], [s]
  double longest = 0.0;                  ///< gives up waiting for its end after this long [s]
  double usual = 0.0;                    ///< how long it usually takes [s]
};

/// The paper's two phases, filling and contraction.
[[nodiscard]] std::vector<Phase> phases(const Protocol& protocol);

}  // namespace lv::heartbeat
