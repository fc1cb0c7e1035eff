#include "lv/case_file/case_lines.hpp"

#include "lv/base/check.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <utility>

namespace lv::case_file {
namespace {

using Tables = std::vector<std::pair<std::string, std::vector<CaseLine>>>;

Tables by_table(const std::vector<CaseLine>& lines) {
  Tables tables;
  for (const CaseLine& line : lines) {
    const std::string name = table_of(line.parameter);
    auto table = std::find_if(tables.begin(), tables.end(),
                              [&](const auto& entry) { return entry.first == name; });
    if (table == tables.end())
      table = tables.insert(tables.end(), {name, {}});
    table->second.push_back(line);
  }
  return tables;
}

std::string text_of(const std::vector<CaseLine>& lines) {
  std::string text;
  for (const CaseLine& line : lines)
    text += fmt::format("{}{} = {}{}\n", line.active ? "" : "# ", key_of(line.parameter),
                        line.value, line.comment.empty() ? "" : "  # " + line.comment);
  return text;
}

std::string heading(const std::string& table, const std::vector<CaseLine>& lines) {
  const bool active =
      std::any_of(lines.begin(), lines.end(), [](const CaseLine& line) { return line.active; });
  return table.empty() ? "" : fmt::format("{}[{}]\n", active ? "" : "# ", table);
}

/// "a, b and c"
std::string enumerated(const std::vector<std::string>& names) {
  std::string text = names.front();
  for (std::size_t i = 1; i < names.size(); ++i)
    text += (i + 1 < names.size() ? ", " : " and ") + names[i];
  return text;
}

}  // namespace

std::string table_of(const std::string& parameter) {
  const auto dot = parameter.rfind('.');
  return dot == std::string::npos ? "" : parameter.substr(0, dot);
}

std::string key_of(const std::string& parameter) {
  const auto dot = parameter.rfind('.');
  return dot == std::string::npos ? parameter : parameter.substr(dot + 1);
}

std::string quoted(const std::string& text) {
  try {
    return nlohmann::json(text).dump();  // JSON's escapes are TOML's
  } catch (const nlohmann::json::type_error&) {
    throw InputError(text, "this name is not in UTF-8 and cannot stand in a case file",
                     "Rename it");
  }
}

std::string listed(const std::vector<int>& numbers) {
  return fmt::format("[{}]", fmt::join(numbers, ", "));
}

std::string first_lines(const std::string& name) {
  return fmt::format(
      "name = {}\n\n"
      "# The engine that runs the beat; `ventricle validate` says what each takes for this case:\n"
      "#   \"immersed\"      the dynamic model with its blood: about 25 min on two cores\n"
      "#   \"quasi_static\"  equilibrium without inertia and blood: about a minute\n"
      "engine = \"immersed\"\n",
      quoted(name));
}

std::string case_lines(const std::vector<CaseLine>& lines) {
  std::string text;
  for (const auto& [table, of_table] : by_table(lines))
    text += fmt::format("{}{}{}", text.empty() ? "" : "\n", heading(table, of_table),
                        text_of(of_table));
  return text;
}

std::string lines_to_add(const Case& c, const std::vector<CaseLine>& lines) {
  std::string text;
  for (const auto& [table, of_table] : by_table(lines)) {
    const bool is_there =
        std::any_of(c.origin.begin(), c.origin.end(),
                    [&name = table](const auto& entry) { return table_of(entry.first) == name; });
    text += is_there ? fmt::format("\nAdd under [{}]:\n", table)
                     : fmt::format("\nAdd:\n{}", heading(table, of_table));
    text += text_of(of_table);
  }
  return text;
}

void Missing::raise(const Case& c, const std::string& where, const std::string& found) const {
  if (lines_.empty())
    return;
  std::vector<std::string> names;
  for (const CaseLine& line : lines_)
    names.push_back(line.parameter);
  throw InputError(where,
                   fmt::format("{} {} not set{}{}", enumerated(names),
                               names.size() == 1 ? "is" : "are", found.empty() ? "" : "; ", found),
                   lines_to_add(c, lines_));
}

}  // namespace lv::case_file
