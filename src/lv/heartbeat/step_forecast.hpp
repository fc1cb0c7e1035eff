#pragma once

#include <cstddef>
#include <deque>
#include <utility>
#include <vector>

namespace lv::heartbeat {

/// How long a beat of load steps will still take: the steps that are left of the present phase and
/// of later ones, each as long as the last ten were in the mean; the first of a beat take longer.
class StepForecast {
 public:
  /// Usual numbers of steps of all phases.
  explicit StepForecast(std::vector<double> usual) : usual_(std::move(usual)) {}

  /// A phase begins.
  void begin();

  /// A step took so many seconds, with attempts that failed; `progress` of the phase is reached,
  /// and the step was `length` of it.
  void record(double seconds, double progress, double length);

  /// Of the present phase what is left of the usual number, or steps that grow from the last one if
  /// those are more; and those of later phases.
  [[nodiscard]] double steps_left() const;

  /// Negative before the first step.
  [[nodiscard]] double seconds_left() const;

  // of phases whose steps are short enough for curves
  static constexpr double of_filling = 26.0;      ///< 25 and 28 were counted
  static constexpr double of_contraction = 33.0;  ///< 29 and 37 were counted

 private:
  std::vector<double> usual_;
  std::size_t begun_ = 0;         ///< phases
  double done_ = 0.0;             ///< steps of the present one
  double left_of_phase_ = 0.0;    ///< steps
  std::deque<double> durations_;  ///< of the last steps [s]
};

}  // namespace lv::heartbeat
