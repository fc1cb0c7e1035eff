#pragma once

#include <string>

namespace lv::work {

/// What stands for the sources that the program was built from: results of other sources are not up
/// to date.
[[nodiscard]] std::string source_hash();

/// The program's version for people: "0.1.0+" and the beginning of that hash.
[[nodiscard]] std::string version();

}  // namespace lv::work
