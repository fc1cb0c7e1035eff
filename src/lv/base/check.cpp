#include "lv/base/check.hpp"

#include <utility>

namespace lv {

InputError::InputError(std::string where, const std::string& what, const std::string& what_to_do)
    : std::runtime_error(where + ": " + what + (what_to_do.empty() ? "" : ". " + what_to_do)),
      where_(std::move(where)) {}

RunError::RunError(const std::string& what, const std::string& what_to_do)
    : std::runtime_error(what + (what_to_do.empty() ? "" : ". " + what_to_do)) {}

void fail_check(const char* condition, const char* file, int line) {
  throw LogicError(std::string("ventricle has a defect: ") + condition + " does not hold at " +
                   file + ":" + std::to_string(line) + ". Please report it with the case file.");
}

}  // namespace lv
