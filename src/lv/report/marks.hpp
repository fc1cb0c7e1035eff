#pragma once

#include <string>
#include <utility>
#include <vector>

namespace lv::report {

struct RunFacts;

/// What stands behind a number: it was measured, fitted so that something else agrees with a
/// measurement, taken for granted, or computed from the others.
enum class Mark { measured, fitted, assumed, computed };

[[nodiscard]] std::string name(Mark mark);

/// The marks of summary.json with these named moments: path of keys ("end_diastole.pressure_mmHg")
/// and mark. The longest path that a figure's own begins with holds for it.
[[nodiscard]] std::vector<std::pair<std::string, Mark>> marks(
    const RunFacts& facts, const std::vector<std::string>& moments);

}  // namespace lv::report
