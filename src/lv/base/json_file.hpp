#pragma once

#include "lv/base/check.hpp"
#include "lv/base/table.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <filesystem>

namespace lv {

/// What `use` makes of a JSON file of a work folder. Throws RunError naming the file when it is no
/// JSON, or does not hold what `use` looks for.
template <class Use>
auto from_json_file(const std::filesystem::path& file, const Use& use) {
  try {
    return use(nlohmann::ordered_json::parse(read_file(file)));
  } catch (const nlohmann::json::exception& error) {
    throw RunError(fmt::format("{} is damaged: {}", file.string(), error.what()),
                   "Delete its folder to make it again");
  }
}

}  // namespace lv
