#pragma once

#include "lv/base/table.hpp"
#include "lv/calibrate/fit.hpp"

namespace lv::calibrate {

/// What was fitted and how sure it is, for a terminal.
[[nodiscard]] std::string text(const Plan& plan, const Fit& fit);

/// All of it as a JSON object.
[[nodiscard]] std::string json(const Plan& plan, const Fit& fit);

/// contractility.csv: segment, name, factor of the active tension, standard error of its logarithm,
/// 95% interval and resolution (posterior.hpp).
[[nodiscard]] Table contractility_table(const std::vector<FittedSegment>& segments);

/// Every equilibrium of the search in its order: the history of the brackets.
[[nodiscard]] Table history_table(const Fit& fit);

}  // namespace lv::calibrate
