#pragma once

#include "lv/base/check.hpp"
#include "lv/heartbeat/run_state.hpp"
#include "lv/immersed/model.hpp"

#include <string>

namespace lv::heartbeat {

/// The step control of the immersed engine, which keeps its numbers in the run's state: how long a
/// step may be, what is wrong with one that was taken, and how a run that went back goes on.
class ImmersedSteps {
 public:
  /// The model must outlive the control. `density` of blood and muscle [kg/mm^3].
  ImmersedSteps(const StepControl& control, const immersed::Model& model, double density)
      : control_(control), model_(model), density_(density) {}

  /// The longest step [s] divided by two as often as past failures, the Courant number and the
  /// supports ask. Powers of two, so that the step changes rarely.
  [[nodiscard]] double size(const RunState& run) const;

  /// Counts a step that was taken. Why it failed; empty when it did not.
  [[nodiscard]] std::string failure(const immersed::StepReport& report, RunState& run) const;

  /// Lets `run`, gone back to before a failure, go on with smaller steps than `failed` had.
  static void go_back(const RunState& failed, RunState& run);

  /// Whether a run that went back has halved its steps too often; its steps are then long again,
  /// for whoever resumes.
  [[nodiscard]] bool gives_up(RunState& run) const;

  /// What to tell of that: `where` and why the last step failed.
  [[nodiscard]] NoSolution unstable(const std::string& where, const std::string& why) const;

 private:
  [[nodiscard]] std::string what_is_wrong(const immersed::StepReport& report, RunState& run) const;

  StepControl control_;
  const immersed::Model& model_;
  double density_;
};

}  // namespace lv::heartbeat
