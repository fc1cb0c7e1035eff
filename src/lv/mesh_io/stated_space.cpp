#include "lv/mesh_io/stated_space.hpp"

#include "lv/base/check.hpp"
#include "lv/base/files.hpp"
#include "lv/base/lines.hpp"

#include <fmt/format.h>
#include <vtkDataObject.h>
#include <vtkFieldData.h>
#include <vtkStringArray.h>

#include <algorithm>

namespace lv::mesh_io {
namespace {

constexpr std::string_view key = "SPACE";

constexpr std::size_t longest_header = 16384;  // of any format [bytes]

bool is_letter(char c) {
  return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
}

/// Three letters, one for each direction of the body.
bool is_space(std::string_view word) {
  const auto one_of = [&](std::string_view directions) {
    return std::count_if(word.begin(), word.end(),
                         [&](char c) { return directions.find(c) != std::string_view::npos; }) == 1;
  };
  return word.size() == 3 && one_of("LR") && one_of("AP") && one_of("SI");
}

/// The space in "... SPACE=RAS ..."; empty if there is none.
std::string space_in(std::string_view text) {
  for (auto at = text.find(key); at != std::string_view::npos; at = text.find(key, at + 1)) {
    const std::string_view rest = trimmed(text.substr(at + key.size()));
    if (!rest.starts_with('='))
      continue;
    const std::string_view value = trimmed(rest.substr(1));
    const auto end = std::find_if_not(value.begin(), value.end(), is_letter);
    const std::string_view word = value.substr(0, static_cast<std::size_t>(end - value.begin()));
    if (is_space(word))
      return std::string(word);
  }
  return {};
}

std::string known(const std::string& file, const std::string& space) {
  if (!space.empty() && space != "RAS" && space != "LPS")
    throw InputError(file, fmt::format("says SPACE={}", space),
                     "Coordinates are read in LPS, the scanner's, and in RAS: export it again");
  return space;
}

}  // namespace

bool says_ras(const std::string& file) {
  return known(file, space_in(first_bytes(file, longest_header))) == "RAS";
}

std::string space_of(const std::string& file, vtkDataObject& data) {
  vtkStringArray* array = vtkStringArray::SafeDownCast(
      data.GetFieldData() == nullptr ? nullptr : data.GetFieldData()->GetAbstractArray(key.data()));
  if (array == nullptr || array->GetNumberOfValues() == 0)
    return known(file, space_in(first_bytes(file, longest_header)));
  const std::string said = array->GetValue(0);
  return known(file, space_in(fmt::format("{}={}", key, said)));
}

bool says_ras(const std::string& file, vtkDataObject& data) {
  return space_of(file, data) == "RAS";
}

}  // namespace lv::mesh_io
