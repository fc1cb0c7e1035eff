#pragma once

#include "lv/case_file/parameters.hpp"

// toml++ asserts in headings such as "[ = ]" what it then refuses in words
#define TOML_ASSERT(expression) static_assert(true)
#include <toml++/toml.h>

namespace lv::case_file {

/// Sets a parameter to what a case file says. Throws std::invalid_argument with the rule that is
/// broken.
void set(const Parameter& p, Case& c, const toml::node& node);

/// Multiplies the number that a parameter is. Throws std::invalid_argument with the rule that is
/// broken.
void multiply(const Parameter& p, Case& c, double factor);

}  // namespace lv::case_file
