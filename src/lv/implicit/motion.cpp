#include "lv/implicit/motion.hpp"

#include "lv/base/check.hpp"

#include <fmt/format.h>

namespace lv::implicit {
namespace {

std::vector<Vec3> line(const std::vector<Vec3>& at_start, double slope, std::span<const Vec3> from,
                       std::span<const Vec3> positions) {
  std::vector<Vec3> result = at_start;
  for (std::size_t a = 0; a < result.size(); ++a)
    result[a] += slope * (positions[a] - from[a]);
  return result;
}

/// a_1 of Newmark's first equation where x_1 = x_0 [mm/s^2].
Vec3 newmark_acceleration(const GeneralisedAlpha& rule, double dt, const Vec3& v_0,
                          const Vec3& a_0) {
  return -v_0 / (rule.beta * dt) - (0.5 / rule.beta - 1.0) * a_0;
}

}  // namespace

std::vector<Vec3> Motion::velocities(std::span<const Vec3> positions) const {
  return line(velocity, velocity_slope, from, positions);
}

std::vector<Vec3> Motion::accelerations(std::span<const Vec3> positions) const {
  return line(acceleration, acceleration_slope, from, positions);
}

GeneralisedAlpha GeneralisedAlpha::of_radius(double rho) {
  if (!(rho >= 0.0 && rho <= 1.0))
    throw InputError("spectral radius", fmt::format("is {}", rho),
                     "Choose one from 0 (fast waves vanish at once) to 1 (they stay)");
  GeneralisedAlpha rule;
  rule.alpha_m = (2.0 * rho - 1.0) / (rho + 1.0);
  rule.alpha_f = rho / (rho + 1.0);
  rule.gamma = 0.5 - rule.alpha_m + rule.alpha_f;
  rule.beta = 0.25 * (0.5 + rule.gamma) * (0.5 + rule.gamma);
  return rule;
}

Motion motion_in_step(const GeneralisedAlpha& rule, double dt, std::span<const Vec3> from,
                      const Rates& rates) {
  Motion motion;
  motion.from.assign(from.begin(), from.end());
  if (rates.acceleration.empty()) {
    motion.velocity.assign(from.size(), Vec3::Zero());
    motion.velocity_slope = 1.0 / dt;
    return motion;
  }
  const double f = 1.0 - rule.alpha_f;
  const double m = 1.0 - rule.alpha_m;
  motion.velocity_slope = rule.gamma / (rule.beta * dt);
  motion.acceleration_slope = m / (f * rule.beta * dt * dt);
  for (std::size_t a = 0; a < from.size(); ++a) {
    const Vec3& v_0 = rates.velocity[a];
    const Vec3& a_0 = rates.acceleration[a];
    const Vec3 a_1 = newmark_acceleration(rule, dt, v_0, a_0);
    motion.velocity.emplace_back(v_0 + f * dt * ((1.0 - rule.gamma) * a_0 + rule.gamma * a_1));
    motion.acceleration.emplace_back(m * a_1 + rule.alpha_m * a_0);
  }
  return motion;
}

Rates rates_after(const GeneralisedAlpha& rule, double dt, std::span<const Vec3> from,
                  const Rates& rates, std::span<const Vec3> positions) {
  Rates after;
  for (std::size_t a = 0; a < from.size(); ++a) {
    const Vec3 u = positions[a] - from[a];
    if (rates.acceleration.empty()) {
      after.velocity.emplace_back(u / dt);
      continue;
    }
    const Vec3& v_0 = rates.velocity[a];
    const Vec3& a_0 = rates.acceleration[a];
    const Vec3 a_1 = u / (rule.beta * dt * dt) + newmark_acceleration(rule, dt, v_0, a_0);
    after.velocity.emplace_back(v_0 + dt * ((1.0 - rule.gamma) * a_0 + rule.gamma * a_1));
    after.acceleration.push_back(a_1);
  }
  return after;
}

}  // namespace lv::implicit
