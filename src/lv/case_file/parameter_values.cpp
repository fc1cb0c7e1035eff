#include "lv/case_file/parameter_values.hpp"

#include "lv/base/nearest.hpp"
#include "lv/base/units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>
#include <string_view>

namespace lv::case_file {
namespace {

using Point = std::array<double, 3>;

template <class... F>
struct Overloaded : F... {
  using F::operator()...;
};
template <class... F>
Overloaded(F...) -> Overloaded<F...>;

Slot slot_of(const Parameter& p, const Case& c) {
  return p.slot(const_cast<Case&>(c));  // to be read alone
}

std::vector<std::string> words_of(const Parameter& p) {
  std::istringstream in(p.words);
  std::vector<std::string> words;
  for (std::string word; in >> word;)
    words.push_back(word);
  return words;
}

std::string in_quotes(const std::string& text) {
  return fmt::format("\"{}\"", text);
}

/// A number as it stands in a case file: a quantity in quotation marks.
std::string written(double value, const Parameter& p) {
  const std::string text = units::format(value, p.unit);
  return *p.unit == '\0' ? text : in_quotes(text);
}

std::string written(const Point& x, const Parameter& p) {
  return fmt::format("[{}, {}, {}]", written(x[0], p), written(x[1], p), written(x[2], p));
}

template <class Numbers>
std::string whole_numbers(const Numbers& numbers) {
  return fmt::format("[{}]", fmt::join(numbers, ", "));
}

std::string written(const std::vector<std::string>& words) {
  std::vector<std::string> texts;
  std::transform(words.begin(), words.end(), std::back_inserter(texts), in_quotes);
  return fmt::format("[{}]", fmt::join(texts, ", "));
}

// What a case file may say. All throw std::invalid_argument.

double number_of(const toml::node& node) {
  const auto value = node.value<double>();
  if (!value || node.is_boolean() || node.is_string())
    throw std::invalid_argument("is not a number");
  if (!std::isfinite(*value))
    throw std::invalid_argument("is not a finite number");
  return *value;
}

void check_range(double in_unit, const Parameter& p) {
  if (!p.range.contains(in_unit))
    throw std::invalid_argument(fmt::format("is {:g}{}{}; it must be {}", in_unit,
                                            *p.unit == '\0' ? "" : " ", p.unit,
                                            p.range.words(p.unit)));
}

/// "an angle", "a pressure"
std::string with_article(const std::string& noun) {
  const bool vowel = std::string_view("aeiou").find(noun.front()) != std::string_view::npos;
  return fmt::format("{} {}", vowel ? "an" : "a", noun);
}

/// A number with a unit of the right dimension, as inner units. `shown` is an example for messages.
double quantity_of(const toml::node& node, const Parameter& p, const std::string& shown) {
  const units::Unit expected = units::parse_unit(p.unit);
  const std::string kind = units::kind_of(expected);
  const auto without_unit = [&] {
    return std::invalid_argument(
        fmt::format("has no unit; write {} such as {}", with_article(kind), shown));
  };
  if (!node.is_string()) {
    number_of(node);
    throw without_unit();
  }
  const units::Quantity quantity = units::parse_quantity(*node.value<std::string>());
  if (!quantity.has_unit)
    throw without_unit();
  if (quantity.unit.dimension != expected.dimension)
    throw std::invalid_argument(fmt::format("is {}; it must be {} such as {}",
                                            with_article(units::kind_of(quantity.unit)),
                                            with_article(kind), shown));
  check_range(quantity.value / expected.factor, p);
  return quantity.value;
}

double one_of_three(const toml::node& node, const Parameter& p) {
  return quantity_of(node, p, fmt::format("\"1 {}\"", p.unit));
}

int whole_of(const toml::node& node, const Parameter& p, const char* mistake) {
  if (!node.is_integer())
    throw std::invalid_argument(mistake);
  const double value = number_of(node);
  check_range(value, p);
  if (std::abs(value) > 2e9)
    throw std::invalid_argument(fmt::format("is {:g}; it must be at most 2e+09", value));
  return static_cast<int>(value);
}

const toml::array& triple_of(const toml::node& node) {
  const toml::array* array = node.as_array();
  if (array == nullptr || array->size() != 3)
    throw std::invalid_argument("must be a list of three values, [x, y, z]");
  return *array;
}

Point point_of(const toml::node& node, const Parameter& p) {
  const toml::array& values = triple_of(node);
  return {one_of_three(values[0], p), one_of_three(values[1], p), one_of_three(values[2], p)};
}

/// A list whose values are all of one kind.
template <class T>
const toml::array& list_of(const toml::node& node, const Parameter& p) {
  const toml::array* array = node.as_array();
  if (array == nullptr || (array->empty() ? !p.may_be_empty : !array->is_homogeneous<T>()))
    throw std::invalid_argument("must be " + p.rule());
  return *array;
}

int word_of(const toml::node& node, const Parameter& p) {
  const auto word = node.value<std::string>();
  if (!word)
    throw std::invalid_argument("must be " + p.rule());
  const std::vector<std::string> words = words_of(p);
  const auto found = std::find(words.begin(), words.end(), *word);
  if (found == words.end()) {
    const std::string nearest = nearest_name(*word, words);
    throw std::invalid_argument(
        fmt::format("is \"{}\"; it must be {}{}", *word, p.rule(),
                    nearest.empty() ? "" : fmt::format(" (did you mean \"{}\"?)", nearest)));
  }
  return static_cast<int>(found - words.begin());
}

/// Sets the member that it is called with.
struct Setter {
  const Parameter& p;
  const toml::node& node;

  void operator()(double* x) const {
    if (*p.unit != '\0') {
      *x = quantity_of(node, p, p.get(Case{}));
      return;
    }
    const double value = number_of(node);
    check_range(value, p);
    *x = value;
  }
  void operator()(int* x) const { *x = whole_of(node, p, "is not a whole number"); }
  void operator()(bool* x) const {
    if (!node.is_boolean())
      throw std::invalid_argument("must be true or false (without quotation marks)");
    *x = *node.value<bool>();
  }
  void operator()(std::string* x) const {
    if (!node.is_string())
      throw std::invalid_argument("must be text in quotation marks");
    *x = *node.value<std::string>();
  }
  void operator()(const Choice& x) const { x.set(x.at, word_of(node, p)); }
  void operator()(Point* x) const { *x = point_of(node, p); }
  void operator()(std::array<int, 3>* x) const {
    const toml::array& values = triple_of(node);
    for (std::size_t d = 0; d < 3; ++d)
      (*x)[d] = whole_of(values[d], p, "must hold whole numbers");
  }
  void operator()(std::optional<Point>* x) const {
    const toml::array* array = node.as_array();
    if (array != nullptr && array->empty())
      x->reset();
    else
      *x = point_of(node, p);
  }
  void operator()(std::vector<int>* x) const {
    x->clear();
    for (const toml::node& value : list_of<std::int64_t>(node, p))
      x->push_back(whole_of(value, p, "must hold whole numbers"));
  }
  void operator()(std::vector<double>* x) const {
    x->clear();
    const toml::array* array = node.as_array();
    if (array == nullptr)
      throw std::invalid_argument("must be " + p.rule());
    for (const toml::node& value : *array) {
      x->push_back(number_of(value));
      check_range(x->back(), p);
    }
  }
  void operator()(std::vector<std::string>* x) const {
    x->clear();
    for (const toml::node& value : list_of<std::string>(node, p))
      x->push_back(*value.value<std::string>());
  }
};

std::string name_alone(const Parameter& p, const Case& c, const std::string& path) {
  std::error_code failed;
  if (path.empty() || !names_file(p, c, path))
    return path;
  return std::filesystem::is_directory(beside(c, path), failed)
             ? "a folder"
             : std::filesystem::path(path).filename().string();
}

}  // namespace

bool Range::contains(double x) const {
  return (low_included ? x >= low : x > low) && (high_included ? x <= high : x < high);
}

std::string Range::words(const std::string& unit) const {
  const std::string tail = unit.empty() ? "" : " " + unit;
  const bool bounded_below = std::isfinite(low);
  const bool bounded_above = std::isfinite(high);
  const char* least = low_included ? "at least" : "above";
  const char* most = high_included ? "at most" : "below";
  if (bounded_below && bounded_above)
    return fmt::format("{} {:g}{} and {} {:g}{}", least, low, tail, most, high, tail);
  if (bounded_below)
    return fmt::format("{} {:g}{}", least, low, low == 0.0 ? "" : tail);
  if (bounded_above)
    return fmt::format("{} {:g}{}", most, high, tail);
  return "any";
}

std::string Parameter::rule() const {
  const Parameter& p = *this;
  const auto range_words = [&](const auto&) { return p.range.words(p.unit); };
  const auto list = [&](const char* of) {
    return fmt::format("a list of {}{}", of, p.may_be_empty ? "; [] for none" : ", at least one");
  };
  return std::visit(
      Overloaded{
          range_words, [](bool*) { return std::string("true or false"); },
          [](std::string*) { return std::string("any"); },
          [&](const Choice&) { return fmt::format("one of {}", fmt::join(words_of(p), ", ")); },
          [](std::optional<Point>*) { return std::string("any; [] for none"); },
          [&](std::vector<int>*) { return list("whole numbers"); },
          [&](std::vector<double>*) {
            return fmt::format("a list of numbers, each {}; [] for none", p.range.words(p.unit));
          },
          [&](std::vector<std::string>*) { return list("texts"); }},
      slot_of(p, Case{}));
}

std::string Parameter::get(const Case& c) const {
  const Parameter& p = *this;
  return std::visit(
      Overloaded{[&](double* x) { return written(*x, p); },
                 [](int* x) { return std::to_string(*x); },
                 [](bool* x) { return std::string(*x ? "true" : "false"); },
                 [](std::string* x) { return in_quotes(*x); },
                 [&](const Choice& x) {
                   return in_quotes(words_of(p).at(static_cast<std::size_t>(x.get(x.at))));
                 },
                 [&](Point* x) { return written(*x, p); },
                 [](std::array<int, 3>* x) { return whole_numbers(*x); },
                 [&](std::optional<Point>* x) { return *x ? written(**x, p) : std::string("[]"); },
                 [](std::vector<int>* x) { return whole_numbers(*x); },
                 [](std::vector<double>* x) { return fmt::format("[{}]", fmt::join(*x, ", ")); },
                 [](std::vector<std::string>* x) { return written(*x); }},
      slot_of(p, c));
}

std::string Parameter::shown(const Case& c) const {
  if (text == Text::words)
    return get(c);
  return std::visit(Overloaded{[&](const auto&) { return get(c); },
                               [&](std::string* x) { return in_quotes(name_alone(*this, c, *x)); },
                               [&](std::vector<std::string>* x) {
                                 std::vector<std::string> names;
                                 for (const std::string& file : *x)
                                   names.push_back(name_alone(*this, c, file));
                                 return written(names);
                               }},
                    slot_of(*this, c));
}

bool names_file(const Parameter& p, const Case& c, const std::string& text) {
  std::error_code failed;
  return p.text == Text::file || p.text == Text::path ||
         (p.text == Text::perhaps_path &&
          std::filesystem::is_regular_file(beside(c, text), failed));
}

std::vector<std::string> paths(const Parameter& p, const Case& c) {
  std::vector<std::string> names;
  const Slot slot = slot_of(p, c);
  if (p.text == Text::words)
    return names;
  if (const auto* one = std::get_if<std::string*>(&slot))
    names.push_back(**one);
  else
    names = *std::get<std::vector<std::string>*>(slot);
  std::erase(names, "");
  return names;
}

NamesAlone names_alone(const Case& c, const std::filesystem::path& work) {
  std::vector<std::filesystem::path> folders{c.file.parent_path(), work, work.parent_path()};
  for (const Parameter& p : parameters())
    for (const std::string& name : paths(p, c)) {
      if (!names_file(p, c, name))
        continue;
      const std::filesystem::path path = beside(c, name);
      std::error_code failed;
      if (std::filesystem::is_directory(path, failed))
        folders.push_back(path);
      folders.push_back(path.parent_path());
      folders.push_back(std::filesystem::path(name).parent_path());
    }
  return NamesAlone(folders);
}

void set(const Parameter& p, Case& c, const toml::node& node) {
  std::visit(Setter{p, node}, p.slot(c));
}

void multiply(const Parameter& p, Case& c, double factor) {
  double& value = *std::get<double*>(p.slot(c));
  const double changed = factor * value;
  check_range(changed / units::parse_unit(p.unit).factor, p);
  value = changed;
}

void copy(const Parameter& p, const Case& from, Case& to) {
  const Slot place = p.slot(to);
  const auto give = [&](const auto& value) {
    const auto& there = std::get<std::decay_t<decltype(value)>>(place);
    if constexpr (std::is_same_v<std::decay_t<decltype(value)>, Choice>)
      there.set(there.at, value.get(value.at));
    else
      *there = *value;
  };
  std::visit(give, slot_of(p, from));
}

void forget(const Parameter& p, Case& c) {
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  std::visit(Overloaded{[](double* x) { *x = unknown; }, [](Point* x) { x->fill(unknown); },
                        [](const auto&) {}},
             p.slot(c));
}

}  // namespace lv::case_file
