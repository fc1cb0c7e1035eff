#pragma once

#include <cstddef>

namespace lv::heartbeat {

/// How long a beat of load steps will still take: of the present phase the steps that are left,
/// each as long as those of this phase were in the mean; of later phases the usual number, each as
/// long as all steps were so far.
class StepForecast {
 public:
  explicit StepForecast(std::size_t phases) : later_(static_cast<double>(phases)) {}

  /// A phase begins.
  void begin();

  /// A step took so many seconds, with attempts that failed; `progress` of the phase is reached,
  /// and the step was `length` of it.
  void record(double seconds, double progress, double length);

  /// Of the present phase what is left of the usual number, or steps that grow from the last one if
  /// those are more; and those of later phases.
  [[nodiscard]] double steps_left() const { return left_of_phase_ + later_ * usual_steps; }

  /// Negative before the first step.
  [[nodiscard]] double seconds_left() const;

  static constexpr double usual_steps = 21.0;  ///< of a phase; 19 to 23 were counted

 private:
  struct Steps {
    double number = 0.0;
    double seconds = 0.0;
  };
  double later_;  ///< phases
  double left_of_phase_ = 0.0;
  Steps all_, phase_;
};

}  // namespace lv::heartbeat
