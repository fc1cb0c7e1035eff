#pragma once

#include "lv/base/printable.hpp"
#include "lv/base/table.hpp"

#include <nlohmann/json.hpp>

#include <string>

namespace lv {

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
