#pragma once

#include "lv/anatomy/anatomy.hpp"
#include "lv/case_file/case.hpp"

#include <string>

namespace lv::pipeline {

/// Builds anatomy and mesh in memory and says what a run would compute; its last line says what the
/// beat would take on each engine, which warnings matter and what to do next. Throws InputError
/// with all that is missing or wrong, as far as it can be told without the rest.
[[nodiscard]] std::string validate(const case_file::Case& c);

/// Of a case file without parameters.
inline constexpr const char* no_parameters =
    "the case file sets no parameter: this is the default case, the idealised healthy ventricle";

/// Throws InputError where no stiffness can fill the wall to calibrate.edv, since the shape that
/// is taken as free of stress holds as much already.
void check_measured_volumes(const case_file::Case& c, const anatomy::Shape& shape);

}  // namespace lv::pipeline
