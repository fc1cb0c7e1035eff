#pragma once

#include <cstddef>
#include <utility>
#include <vector>

namespace lv::heartbeat {

/// How long a quasi-static beat will still take. In a phase a share of its time and of its steps
/// has passed that follows from how much of the load is on: nearly the same in all hearts that were
/// recorded, of whatever shape, muscle and elements (docs/verification.md). What a contraction
/// takes follows from the steps of the filling before it, and ever more from its own share.
class StepForecast {
 public:
  /// What loads do in a phase.
  enum class Kind { filling, contraction };

  explicit StepForecast(std::vector<Kind> phases) : phases_(std::move(phases)) {}

  /// A phase begins.
  void begin();

  /// A step took so many seconds, with attempts that failed; `progress` of the phase is reached.
  void record(double seconds, double progress);

  /// Negative before the first step.
  [[nodiscard]] double seconds_left() const;

 private:
  std::vector<Kind> phases_;
  std::size_t begun_ = 0;      ///< phases
  double contraction_ = -1.0;  ///< expected of one, from the filling before it [s]
  double spent_ = 0.0;         ///< in the present phase [s]
  double left_ = 0.0;          ///< of the present phase [s]
  int steps_ = 0;              ///< of the present phase
};

}  // namespace lv::heartbeat
