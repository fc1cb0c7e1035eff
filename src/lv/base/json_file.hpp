#pragma once

#include "lv/base/check.hpp"
#include "lv/base/printable.hpp"
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

/// JSON as text, the texts in it made safe to show: they may quote files and names. `indent` is -1
/// for all in one line.
template <class Json>
[[nodiscard]] std::string json_text(Json json, int indent = 2) {
  const auto make_safe = [](auto& self, Json& value) -> void {
    if (value.is_string())
      value = printable_lines(value.template get_ref<const std::string&>());
    if (value.is_structured())
      for (Json& part : value)
        self(self, part);
  };
  make_safe(make_safe, json);
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

}  // namespace lv
