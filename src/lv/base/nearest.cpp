#include "lv/base/nearest.hpp"

#include <algorithm>
#include <cctype>
#include <numeric>
#include <utility>
#include <vector>

namespace lv {
namespace {

char lower(char c) {
  return static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
}

/// The Levenshtein distance, row by row.
std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), 0);
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t change = diagonal + (lower(a[i]) == lower(b[j]) ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({change, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

bool contains(const std::string& text, const std::string& part) {
  const auto alike = [](char a, char b) { return lower(a) == lower(b); };
  return std::search(text.begin(), text.end(), part.begin(), part.end(), alike) != text.end();
}

/// A name within the other counts as one change.
std::size_t distance_between(const std::string& a, const std::string& b) {
  const std::size_t distance = edit_distance(a, b);
  const bool within = !a.empty() && !b.empty() && (contains(a, b) || contains(b, a));
  return within ? std::min<std::size_t>(distance, 1) : distance;
}

}  // namespace

std::string nearest_name(const std::string& wanted, std::span<const std::string> names) {
  const auto distance = [&](const std::string& name) {
    return std::pair(distance_between(wanted, name), edit_distance(wanted, name));
  };
  const auto nearest =
      std::min_element(names.begin(), names.end(),
                       [&](const auto& a, const auto& b) { return distance(a) < distance(b); });
  const bool alike = nearest != names.end() && distance(*nearest).first <= wanted.size() / 2;
  return alike ? *nearest : "";
}

}  // namespace lv
