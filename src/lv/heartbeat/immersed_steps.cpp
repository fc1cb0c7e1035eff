#include "lv/heartbeat/immersed_steps.hpp"

#include "lv/base/log.hpp"

#include <algorithm>
#include <cmath>

namespace lv::heartbeat {

double ImmersedSteps::size(const RunState& run) const {
  const double h = model_.grid().spacing.minCoeff();
  const double courant = run.largest_velocity * control_.longest / (control_.courant * h);
  const double times_too_long = std::max(courant, control_.longest / model_.longest_step());
  const int needed =
      times_too_long > 1.0 ? static_cast<int>(std::ceil(std::log2(times_too_long))) : 0;
  return std::ldexp(control_.longest, -std::max(run.halvings, needed));
}

std::string ImmersedSteps::failure(const immersed::StepReport& report, RunState& run) const {
  ++run.beat.steps;
  if (run.beat.steps % 10 == 0)
    run.largest_velocity =
        fluid::motion(model_.velocity(), model_.grid(), density_).largest_velocity;
  std::string trouble = what_is_wrong(report, run);
  if (!trouble.empty())
    return trouble;
  if (run.halvings > 0 && ++run.good_steps >= run.patience) {
    --run.halvings;
    run.good_steps = 0;
    log::info("the step may grow again, to {:.3g} s", size(run));
  }
  return "";
}

std::string ImmersedSteps::what_is_wrong(const immersed::StepReport& report, RunState& run) const {
  if (!std::isfinite(report.pressure))
    return "no pressure leaves the cavity the volume that its circuit has";
  if (!report.inside_box)
    return "the wall reached the side of the box";
  if (report.J.min_J <= 0.0)
    return fmt::format("an element turned inside out (J = {:.3g})", report.J.min_J);
  if (report.largest_node_speed > control_.velocity_limit)
    return fmt::format("the wall moved at {:.3g} m/s", 1e-3 * report.largest_node_speed);
  if (run.largest_velocity > control_.velocity_limit)
    return fmt::format("the blood moved at {:.3g} m/s", 1e-3 * run.largest_velocity);
  constexpr double visible = 5.0;  // [mm/s]
  constexpr int patience = 20;     // steps
  run.flips = report.smoothness < -0.5 && report.velocity_change > visible ? run.flips + 1 : 0;
  return run.flips >= patience ? "the wall's velocity flips from step to step" : "";
}

void ImmersedSteps::go_back(const RunState& failed, RunState& run) {
  constexpr int longest_patience = 100'000;  // steps
  run.halvings = failed.halvings + 1;
  run.patience = std::min(2 * failed.patience, longest_patience);
  run.good_steps = 0;
  run.beat.retries = failed.beat.retries + 1;
  run.beat.wall_clock = failed.beat.wall_clock;
  run.flips = 0;
}

bool ImmersedSteps::gives_up(RunState& run) const {
  if (run.halvings <= control_.halvings)
    return false;
  run.halvings = 0;
  return true;
}

NoSolution ImmersedSteps::unstable(const std::string& where, const std::string& why) const {
  return {fmt::format("The run became unstable at {}: {}, even with steps of {:.2g} s", where, why,
                      std::ldexp(control_.longest, -control_.halvings)),
          "Look at the last frame: a wall at the side of the box needs a larger box.size, one that "
          "folds a finer mesh or lower pressures; otherwise lower time.longest_step in the case "
          "file. The checkpoint holds the last good state"};
}

}  // namespace lv::heartbeat
