#pragma once

#include "lv/job/case.hpp"

#include <string>
#include <vector>

namespace lv::job {

/// Builds anatomy and mesh in memory and says what a run would compute; its last line says what the
/// beat would take on each engine, which warnings matter and what to do next. Throws InputError
/// with all that is missing or wrong, as far as it can be told without the rest.
[[nodiscard]] std::string validate(const Case& c);

/// Of a case file without parameters.
inline constexpr const char* no_parameters =
    "the case file sets no parameter: this is the default case, the idealised healthy ventricle";

/// Throws InputError where no stiffness can fill the wall to calibrate.edv, since the shape that
/// is taken as free of stress holds as much already. `cavity`: of that shape [mm^3].
void check_measured_volumes(const Case& c, double cavity);

/// The parameters that the case file sets and nothing reads.
[[nodiscard]] std::vector<std::string> without_effect(const Case& c);

/// Whether a parameter changes what the engines of the case compute.
[[nodiscard]] bool is_used(const Case& c, const std::string& parameter);

}  // namespace lv::job
