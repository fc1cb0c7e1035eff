#pragma once

#include "lv/base/tensor.hpp"

#include <span>
#include <vector>

/// How velocities and accelerations follow the positions in a step of time.
namespace lv::implicit {

/// In a step of an implicit rule velocities and accelerations are linear in the positions of the
/// nodes at the moment of balance:
///
///   v = v_0 + c_v (x - x_0),   a = a_0 + c_a (x - x_0)
struct Motion {
  std::vector<Vec3> from;           ///< x_0 [mm]
  std::vector<Vec3> velocity;       ///< v_0 [mm/s]
  std::vector<Vec3> acceleration;   ///< a_0 [mm/s^2]; empty: without inertia
  double velocity_slope = 0.0;      ///< c_v [1/s]
  double acceleration_slope = 0.0;  ///< c_a [1/s^2]

  [[nodiscard]] std::vector<Vec3> velocities(std::span<const Vec3> positions) const;
  [[nodiscard]] std::vector<Vec3> accelerations(std::span<const Vec3> positions) const;
};

/// The rule of a step. The wall is balanced between the step's ends, at
/// x = (1 - alpha_f) x_1 + alpha_f x_0 and a = (1 - alpha_m) a_1 + alpha_m a_0 (J. Chung & G.M.
/// Hulbert, J. Appl. Mech. 60:371, 1993), where x_1, v_1 and a_1 satisfy Newmark's
///
///   x_1 = x_0 + dt v_0 + dt^2 [(1/2 - beta) a_0 + beta a_1]
///   v_1 = v_0 + dt [(1 - gamma) a_0 + gamma a_1]
struct GeneralisedAlpha {
  double alpha_m = 0.0, alpha_f = 0.0, beta = 0.25, gamma = 0.5;

  /// Second order, without a change of the slow waves' size for any radius rho in [0, 1]: that by
  /// which the fastest waves shrink in each step. Throws InputError for another.
  [[nodiscard]] static GeneralisedAlpha of_radius(double rho);
};

/// Velocities [mm/s] and accelerations [mm/s^2] of the nodes at the end of a step.
struct Rates {
  std::vector<Vec3> velocity, acceleration;
};

/// The motion in a step from positions x_0 with their rates. Without inertia (no accelerations)
/// the rule is backward Euler's, v_1 = (x_1 - x_0)/dt.
[[nodiscard]] Motion motion_in_step(const GeneralisedAlpha& rule, double dt,
                                    std::span<const Vec3> from, const Rates& rates);

/// The rates at the step's end, where the nodes are at `positions`.
[[nodiscard]] Rates rates_after(const GeneralisedAlpha& rule, double dt, std::span<const Vec3> from,
                                const Rates& rates, std::span<const Vec3> positions);

}  // namespace lv::implicit
