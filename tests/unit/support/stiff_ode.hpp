#pragma once

#include <functional>
#include <span>
#include <vector>

namespace lv::test {

/// dy/dt at time t.
using OdeRate = std::function<void(double t, std::span<const double> y, std::span<double> rate)>;

/// y at the given times (ascending, after 0) of the stiff system dy/dt = rate(t, y), y(0) = start,
/// by CVODE's backward differentiation formulas. `tolerance` is relative, and absolute for values
/// below one.
[[nodiscard]] std::vector<std::vector<double>> solve_stiff_ode(const OdeRate& rate,
                                                               std::vector<double> start,
                                                               std::span<const double> times,
                                                               double tolerance);

}  // namespace lv::test
