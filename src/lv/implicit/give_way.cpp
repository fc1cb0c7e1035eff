#include "lv/implicit/give_way.hpp"

#include "lv/base/log.hpp"
#include "lv/base/units.hpp"
#include "lv/mesh/distance.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace lv::implicit {
namespace {

constexpr double density = 1e-6;        // of the mass [kg/mm^3]
constexpr double first_pull = 1e6;      // mu: about an element's stiffness by its mass [1/s^2]
constexpr double strongest_pull = 1e9;  // before it gives up
constexpr double weakest_pull = 10.0;   // far below the square of the slowest mode
constexpr double weaker = 0.2;          // after a stride, as a fraction
constexpr double stronger = 10.0;       // after one that failed
constexpr int most_strides = 40;
constexpr double farthest = 0.2;  // change of the cavity, as a fraction

/// A motion whose inertia is mu M (x - x_k).
Motion pull_to(const std::vector<Vec3>& positions, double strength) {
  Motion motion;
  motion.from = positions;
  motion.velocity.assign(positions.size(), Vec3::Zero());
  motion.acceleration = motion.velocity;
  motion.acceleration_slope = strength;
  return motion;
}

/// Of equations with a density.
std::optional<State> descend(const Equations& equations, Newton& newton, State state,
                             Equilibrium equilibrium) {
  const double volume = equations.endocardium().volume(state.positions);
  double pull = first_pull;
  for (int n = 0; n < most_strides && pull <= strongest_pull; ++n) {
    const Motion motion = pull_to(state.positions, pull);
    newton.forget_tangent();
    equilibrium.motion = &motion;
    if (!newton.solve(state, equilibrium).converged) {
      pull *= stronger;
      continue;
    }
    if (std::abs(equations.endocardium().volume(state.positions) / volume - 1.0) > farthest)
      return {};
    pull = std::max(weaker * pull, weakest_pull);
    newton.forget_tangent();
    equilibrium.motion = nullptr;
    if (pull == weakest_pull && newton.solve(state, equilibrium).converged)
      return state;
  }
  return {};
}

}  // namespace

bool give_way(Equations& equations, Newton& newton, State& state, const Equilibrium& equilibrium) {
  const StaticModel model = equations.model();
  StaticModel heavy = model;
  heavy.density = density;
  equations.set_model(heavy);
  const std::optional<State> found = descend(equations, newton, state, equilibrium);
  equations.set_model(model);
  newton.forget_tangent();
  if (!found)
    return false;
  const double pressure = equilibrium.volume ? found->cavity_pressure : equilibrium.pressure;
  log::info("the wall gave way under {:.2f} mmHg, by up to {:.2f} mm", pressure / units::mmHg,
            mesh::largest_distance(found->positions, state.positions));
  state = *found;
  return true;
}

}  // namespace lv::implicit
