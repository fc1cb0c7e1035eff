#pragma once

#include "lv/heartbeat/protocol.hpp"

#include <deque>

namespace lv::heartbeat {

/// Forecasts the end of one phase. Once the loads are final and a whole window has been seen, the
/// variation of the volume falls about exponentially to its tolerance.
class Settling {
 public:
  /// Simulated time left of the phase, `time` after its start, with the present variation (see
  /// SteadyVolume) [s].
  [[nodiscard]] double time_left(const Phase& phase, double time, double variation);

 private:
  struct Sample {
    double time, variation;
  };
  std::deque<Sample> samples_;  ///< of the last window
};

}  // namespace lv::heartbeat
