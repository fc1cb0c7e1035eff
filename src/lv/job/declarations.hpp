#pragma once

#include "lv/base/nearest.hpp"
#include "lv/base/units.hpp"
#include "lv/job/parameters.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <optional>

/// How parameters.cpp declares parameters.
namespace lv::job {

/// Allowed values of a number, in the parameter's own unit.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_included = true;
  bool high_included = true;

  [[nodiscard]] bool contains(double x) const {
    return (low_included ? x >= low : x > low) && (high_included ? x <= high : x < high);
  }
  [[nodiscard]] std::string words(const std::string& unit) const {
    const std::string tail = unit.empty() ? "" : " " + unit;
    const bool bounded_below = std::isfinite(low);
    const bool bounded_above = std::isfinite(high);
    if (bounded_below && bounded_above)
      return fmt::format("{} {:g}{} and {} {:g}{}", low_included ? "at least" : "above", low, tail,
                         high_included ? "at most" : "below", high, tail);
    if (bounded_below)
      return fmt::format("{} {:g}{}", low_included ? "at least" : "above", low,
                         low == 0.0 ? "" : tail);
    if (bounded_above)
      return fmt::format("{} {:g}{}", high_included ? "at most" : "below", high, tail);
    return "any";
  }
};

inline constexpr Range any{};
inline constexpr Range positive{.low = 0.0, .low_included = false};
inline constexpr Range not_negative{.low = 0.0};
constexpr Range between(double low, double high) {
  return {.low = low, .high = high};
}

inline double number_of(const toml::node& node) {
  const auto value = node.value<double>();
  if (!value || node.is_boolean() || node.is_string())
    throw std::invalid_argument("is not a number");
  if (!std::isfinite(*value))
    throw std::invalid_argument("is not a finite number");
  return *value;
}

inline void check_range(double in_unit, const Range& range, const std::string& unit) {
  if (!range.contains(in_unit))
    throw std::invalid_argument(fmt::format("is {:g}{}{}; it must be {}", in_unit,
                                            unit.empty() ? "" : " ", unit, range.words(unit)));
}

/// A number with a unit of the same dimension as `unit`, as inner units. `shown` is an example for
/// messages.
inline double quantity_of(const toml::node& node, const std::string& unit,
                          const std::string& shown) {
  const units::Unit expected = units::parse_unit(unit);
  const std::string kind = units::kind_of(expected);
  if (!node.is_string()) {
    number_of(node);
    throw std::invalid_argument(fmt::format("has no unit; write a {} such as \"{}\"", kind, shown));
  }
  const units::Quantity quantity = units::parse_quantity(*node.value<std::string>());
  if (!quantity.has_unit)
    throw std::invalid_argument(fmt::format("has no unit; write a {} such as \"{}\"", kind, shown));
  if (quantity.unit.dimension != expected.dimension)
    throw std::invalid_argument(fmt::format("is a {}; it must be a {} such as \"{}\"",
                                            units::kind_of(quantity.unit), kind, shown));
  return quantity.value;
}

inline const toml::array& triple_of(const toml::node& node) {
  const toml::array* array = node.as_array();
  if (array == nullptr || array->size() != 3)
    throw std::invalid_argument("must be a list of three values, [x, y, z]");
  return *array;
}

/// Collects the declarations.
class Declarations {
 public:
  std::vector<Parameter> list;
  Stage stage = Stage::beat;
  std::string table;

  template <class Member>
  void quantity(const std::string& key, const Member& member, const std::string& unit,
                const Range& range, const std::string& help, const std::string& equation = "") {
    const auto get = [=](const Case& c) {
      return units::format(member(const_cast<Case&>(c)), unit);
    };
    const std::string shown = get(Case{});
    add(
        key, "quantity", unit, range.words(unit), help, equation,
        [=](const Case& c) { return fmt::format("\"{}\"", get(c)); },
        [=](Case& c, const toml::node& node) {
          const double value = quantity_of(node, unit, shown);
          check_range(value / units::parse_unit(unit).factor, range, unit);
          member(c) = value;
        });
  }

  template <class Member>
  void number(const std::string& key, const Member& member, const Range& range,
              const std::string& help, const std::string& equation = "") {
    add(
        key, "number", "", range.words(""), help, equation,
        [=](const Case& c) { return units::format(member(const_cast<Case&>(c)), ""); },
        [=](Case& c, const toml::node& node) {
          const double value = number_of(node);
          check_range(value, range, "");
          member(c) = value;
        });
  }

  template <class Member>
  void whole(const std::string& key, const Member& member, const Range& range,
             const std::string& help, const std::string& equation = "") {
    add(
        key, "whole number", "", range.words(""), help, equation,
        [=](const Case& c) { return std::to_string(member(const_cast<Case&>(c))); },
        [=](Case& c, const toml::node& node) {
          if (!node.is_integer())
            throw std::invalid_argument("is not a whole number");
          check_range(number_of(node), range, "");
          member(c) = static_cast<int>(*node.value<std::int64_t>());
        });
  }

  template <class Member>
  void flag(const std::string& key, const Member& member, const std::string& help) {
    add(
        key, "true or false", "", "true or false", help, "",
        [=](const Case& c) { return member(const_cast<Case&>(c)) ? "true" : "false"; },
        [=](Case& c, const toml::node& node) {
          if (!node.is_boolean())
            throw std::invalid_argument("must be true or false (without quotation marks)");
          member(c) = *node.value<bool>();
        });
  }

  template <class Member>
  void text(const std::string& key, const Member& member, const std::string& help) {
    add(
        key, "text", "", "any", help, "",
        [=](const Case& c) { return fmt::format("\"{}\"", member(const_cast<Case&>(c))); },
        [=](Case& c, const toml::node& node) {
          if (!node.is_string())
            throw std::invalid_argument("must be text in quotation marks");
          member(c) = *node.value<std::string>();
        });
  }

  /// One of several words; word i stands for the enumerator with value i.
  template <class Member>
  void choice(const std::string& key, const Member& member, const std::vector<std::string>& words,
              const std::string& help, const std::string& equation = "") {
    using Enum = std::decay_t<decltype(member(std::declval<Case&>()))>;
    const std::string rule = fmt::format("one of {}", fmt::join(words, ", "));
    add(
        key, "choice", "", rule, help, equation,
        [=](const Case& c) {
          return fmt::format("\"{}\"",
                             words.at(static_cast<std::size_t>(member(const_cast<Case&>(c)))));
        },
        [=](Case& c, const toml::node& node) {
          const auto word = node.value<std::string>();
          if (!word)
            throw std::invalid_argument(fmt::format("must be {}", rule));
          const auto found = std::find(words.begin(), words.end(), *word);
          if (found == words.end()) {
            const std::string nearest = nearest_name(*word, words);
            throw std::invalid_argument(fmt::format(
                "is \"{}\"; it must be {}{}", *word, rule,
                nearest.empty() ? "" : fmt::format(" (did you mean \"{}\"?)", nearest)));
          }
          member(c) = static_cast<Enum>(found - words.begin());
        });
  }

  template <class Member>
  void quantity_triple(const std::string& key, const Member& member, const std::string& unit,
                       const Range& range, const std::string& help,
                       const std::string& equation = "") {
    add(
        key, "three quantities", unit, range.words(unit), help, equation,
        [=](const Case& c) {
          const auto& v = member(const_cast<Case&>(c));
          return fmt::format("[\"{}\", \"{}\", \"{}\"]", units::format(v[0], unit),
                             units::format(v[1], unit), units::format(v[2], unit));
        },
        [=](Case& c, const toml::node& node) {
          const toml::array& values = triple_of(node);
          for (std::size_t d = 0; d < 3; ++d) {
            const double value = quantity_of(values[d], unit, "1 " + unit);
            check_range(value / units::parse_unit(unit).factor, range, unit);
            member(c)[d] = value;
          }
        });
  }

  /// A point that may be left out; an empty list stands for none.
  template <class Member>
  void optional_point(const std::string& key, const Member& member, const std::string& unit,
                      const std::string& help) {
    add(
        key, "three quantities", unit, "any; [] for none", help, "",
        [=](const Case& c) {
          const auto& v = member(const_cast<Case&>(c));
          return v ? fmt::format("[\"{}\", \"{}\", \"{}\"]", units::format((*v)[0], unit),
                                 units::format((*v)[1], unit), units::format((*v)[2], unit))
                   : std::string("[]");
        },
        [=](Case& c, const toml::node& node) {
          if (const auto* given = node.as_array(); given != nullptr && given->empty()) {
            member(c) = std::nullopt;
            return;
          }
          const toml::array& values = triple_of(node);
          std::array<double, 3> point{};
          for (std::size_t d = 0; d < 3; ++d)
            point[d] = quantity_of(values[d], unit, "1 " + unit);
          member(c) = point;
        });
  }

  template <class Member>
  void whole_triple(const std::string& key, const Member& member, const Range& range,
                    const std::string& help, const std::string& equation = "") {
    add(
        key, "three whole numbers", "", range.words(""), help, equation,
        [=](const Case& c) {
          return fmt::format("[{}]", fmt::join(member(const_cast<Case&>(c)), ", "));
        },
        [=](Case& c, const toml::node& node) {
          const toml::array& values = triple_of(node);
          for (std::size_t d = 0; d < 3; ++d) {
            if (!values[d].is_integer())
              throw std::invalid_argument("must hold whole numbers");
            check_range(number_of(values[d]), range, "");
            member(c)[d] = static_cast<int>(*values[d].value<std::int64_t>());
          }
        });
  }

  /// Words in quotation marks; an empty list stands for none.
  template <class Member>
  void text_list(const std::string& key, const Member& member, const std::string& help) {
    const std::string rule = "a list of texts; [] for none";
    add(
        key, "list of texts", "", rule, help, "",
        [=](const Case& c) {
          std::string text;
          for (const std::string& word : member(const_cast<Case&>(c)))
            text += fmt::format("{}\"{}\"", text.empty() ? "" : ", ", word);
          return fmt::format("[{}]", text);
        },
        [=](Case& c, const toml::node& node) {
          const toml::array* array = node.as_array();
          if (array == nullptr || (!array->empty() && !array->is_homogeneous<std::string>()))
            throw std::invalid_argument(fmt::format("must be {}", rule));
          member(c).clear();
          for (const toml::node& value : *array)
            member(c).push_back(*value.value<std::string>());
        });
  }

  template <class Member>
  void whole_list(const std::string& key, const Member& member, const std::string& help,
                  bool may_be_empty = false) {
    const std::string rule = may_be_empty ? "a list of whole numbers; [] for none"
                                          : "a list of whole numbers, at least one";
    add(
        key, "list of whole numbers", "", rule, help, "",
        [=](const Case& c) {
          return fmt::format("[{}]", fmt::join(member(const_cast<Case&>(c)), ", "));
        },
        [=](Case& c, const toml::node& node) {
          const toml::array* array = node.as_array();
          if (array == nullptr || (array->empty() && !may_be_empty) ||
              (!array->empty() && !array->is_homogeneous<std::int64_t>()))
            throw std::invalid_argument(fmt::format("must be {}", rule));
          member(c).clear();
          for (const toml::node& value : *array) {
            check_range(number_of(value), between(-2e9, 2e9), "");
            member(c).push_back(static_cast<int>(*value.value<std::int64_t>()));
          }
        });
  }

 private:
  // NOLINTNEXTLINE(readability-function-size): all that a declaration holds
  void add(const std::string& key, const std::string& type, const std::string& unit,
           const std::string& rule, const std::string& help, const std::string& equation,
           std::function<std::string(const Case&)> get,
           std::function<void(Case&, const toml::node&)> set) {
    const std::string name = table.empty() ? key : table + "." + key;
    list.push_back({name, type, unit, rule, help, equation, stage, std::move(get), std::move(set)});
  }
};

}  // namespace lv::job
