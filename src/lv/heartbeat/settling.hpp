#pragma once

#include "lv/heartbeat/protocol.hpp"

#include <deque>

namespace lv::heartbeat {

/// Simulated time that a phase usually takes: its ramp, and some windows until the volume is steady
/// [s].
[[nodiscard]] double usual_duration(const Protocol& protocol, Phase phase);

/// Forecasts the end of a phase. Once the loads are final and a whole window has been seen, the
/// variation of the volume falls about exponentially to its tolerance.
class Settling {
 public:
  /// Simulated time left of the phase, `time` after its start, with the present variation (see
  /// SteadyVolume) [s].
  [[nodiscard]] double time_left(const Protocol& protocol, Phase phase, double time,
                                 double variation);

 private:
  struct Sample {
    double time, variation;
  };
  Phase phase_ = Phase::filling;
  std::deque<Sample> samples_;  ///< of the last window
};

}  // namespace lv::heartbeat
