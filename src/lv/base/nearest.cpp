#include "lv/base/nearest.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
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

/// Changes from one name to the other, where a name within the other counts as one; then all
/// changes, between names that are equally far so.
std::pair<std::size_t, std::size_t> distance_between(const std::string& a, const std::string& b) {
  const std::size_t changes = edit_distance(a, b);
  const bool within = !a.empty() && !b.empty() && (contains(a, b) || contains(b, a));
  return {within ? std::min<std::size_t>(changes, 1) : changes, changes};
}

}  // namespace

std::string nearest_name(const std::string& wanted, std::span<const std::string> names) {
  std::string nearest;
  std::pair least(wanted.size() / 2, std::numeric_limits<std::size_t>::max());
  for (const std::string& name : names)
    if (const auto d = distance_between(wanted, name); d < least) {
      least = d;
      nearest = name;
    }
  return nearest;
}

std::size_t nearest_number(double wanted, std::span<const double> numbers) {
  const auto is_nearer = [wanted](double a, double b) {
    return std::abs(a - wanted) < std::abs(b - wanted);
  };
  const auto nearest = std::min_element(numbers.begin(), numbers.end(), is_nearer);
  return static_cast<std::size_t>(nearest - numbers.begin());
}

}  // namespace lv
