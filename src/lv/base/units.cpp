#include "lv/base/units.hpp"

#include "lv/base/lines.hpp"
#include "lv/base/nearest.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <map>
#include <stdexcept>

namespace lv::units {
namespace {

constexpr int largest_power = 9;  // of a unit in a product
constexpr int deepest = 9;        // of parentheses

constexpr Dimension none{};
constexpr Dimension length{1, 0, 0, 0, 0};
constexpr Dimension mass{0, 1, 0, 0, 0};
constexpr Dimension duration{0, 0, 1, 0, 0};
constexpr Dimension concentration{0, 0, 0, 1, 0};
constexpr Dimension angle{0, 0, 0, 0, 1};
constexpr Dimension volume{3, 0, 0, 0, 0};
constexpr Dimension force{1, 1, -2, 0, 0};
constexpr Dimension pressure{-1, 1, -2, 0, 0};
constexpr Dimension viscosity{-1, 1, -1, 0, 0};

const std::map<std::string, Unit, std::less<>>& table() {
  static const std::map<std::string, Unit, std::less<>> units{{"m", {1e3, length}},
                                                              {"cm", {10.0, length}},
                                                              {"mm", {1.0, length}},
                                                              {"um", {1e-3, length}},
                                                              {"\u00b5m", {1e-3, length}},
                                                              {"\u03bcm", {1e-3, length}},
                                                              {"kg", {1.0, mass}},
                                                              {"g", {1e-3, mass}},
                                                              {"mg", {1e-6, mass}},
                                                              {"s", {1.0, duration}},
                                                              {"ms", {1e-3, duration}},
                                                              {"min", {60.0, duration}},
                                                              {"l", {1e6, volume}},
                                                              {"ml", {1e3, volume}},
                                                              {"N", {1e3, force}},
                                                              {"mN", {1.0, force}},
                                                              {"dyn", {1e-2, force}},
                                                              {"Pa", {1e-3, pressure}},
                                                              {"kPa", {1.0, pressure}},
                                                              {"MPa", {1e3, pressure}},
                                                              {"bar", {100.0, pressure}},
                                                              {"mmHg", {mmHg, pressure}},
                                                              {"cmH2O", {cmH2O, pressure}},
                                                              {"P", {1e-4, viscosity}},
                                                              {"cP", {1e-6, viscosity}},
                                                              {"uM", {1.0, concentration}},
                                                              {"\u00b5M", {1.0, concentration}},
                                                              {"\u03bcM", {1.0, concentration}},
                                                              {"mM", {1e3, concentration}},
                                                              {"nM", {1e-3, concentration}},
                                                              {"rad", {1.0, angle}},
                                                              {"deg", {degree, angle}},
                                                              {"\u00b0", {degree, angle}},
                                                              {"Hz", {1.0, {0, 0, -1, 0, 0}}},
                                                              {"%", {0.01, none}}};
  return units;
}

Unit raised(Unit unit, int power) {
  unit.factor = std::pow(unit.factor, power);
  for (int& exponent : unit.dimension)
    exponent *= power;
  return unit;
}

Unit product(Unit a, const Unit& b) {
  a.factor *= b.factor;
  for (std::size_t i = 0; i < a.dimension.size(); ++i)
    a.dimension[i] += b.dimension[i];
  return a;
}

/// The unit that is perhaps meant by a name that is none: a power written without ^, else the name
/// nearest to it.
std::string meant_by(std::string_view name) {
  const std::string_view letters = name.substr(0, name.find_last_not_of("0123456789") + 1);
  if (letters != name && table().count(letters) > 0)
    return fmt::format("{}^{}", letters, name.substr(letters.size()));
  std::vector<std::string> known;
  for (const auto& entry : table())
    if (static_cast<unsigned char>(entry.first.front()) < 0x80)  // as one types it
      known.push_back(entry.first);
  return nearest_name(std::string(name), known);
}

/// Recursive descent over  product := factor (('*' | '/' | ' ') factor)*,
/// factor := name ['^' whole] | '1' | '(' product ')',
/// name := a letter, '%' or a character beyond ASCII, and any of these and digits.
class UnitParser {
 public:
  explicit UnitParser(std::string_view text) : text_(text) {}

  Unit parse() {
    const Unit unit = parse_product();
    if (at_ != text_.size())
      fail();
    return unit;
  }

 private:
  [[noreturn]] void fail() const {
    throw std::invalid_argument(fmt::format("'{}' is not a unit", text_));
  }
  void skip_spaces() {
    while (at_ < text_.size() && text_[at_] == ' ')
      ++at_;
  }
  [[nodiscard]] bool ahead(char c) const { return at_ < text_.size() && text_[at_] == c; }

  Unit parse_product() {
    Unit result = parse_factor();
    for (skip_spaces(); at_ < text_.size() && !ahead(')'); skip_spaces()) {
      const bool divide = ahead('/');
      if (divide || ahead('*'))
        ++at_;
      result = product(result, raised(parse_factor(), divide ? -1 : 1));
    }
    return result;
  }

  Unit parse_factor() {
    skip_spaces();
    if (ahead('(')) {
      ++at_;
      if (++depth_ > deepest)
        fail();
      const Unit inside = parse_product();
      if (!ahead(')'))
        fail();
      ++at_;
      --depth_;
      return inside;
    }
    if (ahead('1')) {
      ++at_;
      return {};
    }
    return parse_named();
  }

  Unit parse_named() {
    const std::size_t begin = at_;
    const auto in_name = [&] {
      const auto c = static_cast<unsigned char>(text_[at_]);
      return std::isalpha(c) != 0 || c == '%' || c >= 0x80 || (at_ > begin && std::isdigit(c) != 0);
    };
    while (at_ < text_.size() && in_name())
      ++at_;
    const std::string_view name = text_.substr(begin, at_ - begin);
    if (name.empty())
      fail();
    const auto found = table().find(name);
    if (found == table().end()) {
      const std::string meant = meant_by(name);
      throw std::invalid_argument(
          fmt::format("'{}' is not a unit{}", name,
                      meant.empty() ? "" : fmt::format(" (did you mean '{}'?)", meant)));
    }
    if (!ahead('^'))
      return found->second;
    ++at_;
    int power = 0;
    const char* rest = text_.data() + at_;
    const auto [end, error] = std::from_chars(rest, text_.data() + text_.size(), power);
    if (error != std::errc() || std::abs(power) > largest_power)
      fail();
    at_ += static_cast<std::size_t>(end - rest);
    return raised(found->second, power);
  }

  std::string_view text_;
  std::size_t at_ = 0;
  int depth_ = 0;  ///< of parentheses
};

}  // namespace

Unit parse_unit(std::string_view text) {
  text = trimmed(text);
  return text.empty() ? Unit{} : UnitParser(text).parse();
}

Quantity parse_quantity(std::string_view text) {
  const std::string whole(trimmed(text));
  const std::size_t first = std::min(whole.find_first_not_of("+-"), whole.size());
  if (whole.compare(first, 2, "0x") == 0 || whole.compare(first, 2, "0X") == 0)
    throw std::invalid_argument(fmt::format("'{}' does not begin with a decimal number", text));
  char* end = nullptr;
  const double number = std::strtod(whole.c_str(), &end);
  if (end == whole.c_str())
    throw std::invalid_argument(fmt::format("'{}' does not begin with a number", text));
  if (!std::isfinite(number))
    throw std::invalid_argument(fmt::format("'{}' is not a finite number", text));
  const std::string_view unit_text = trimmed(std::string_view(whole).substr(end - whole.c_str()));
  if (unit_text.size() > 1 && unit_text[0] == ',' &&
      std::isdigit(static_cast<unsigned char>(unit_text[1])) != 0)
    throw std::invalid_argument(
        fmt::format("'{}' has a decimal comma; write a decimal point", text));
  const Unit unit = parse_unit(unit_text);
  return {number * unit.factor, unit, !unit_text.empty()};
}

std::string format(double value, std::string_view unit) {
  const double number = value / parse_unit(unit).factor;
  // the shortest text that gives the number back to 12 digits: hides the rounding of the conversion
  std::string text = fmt::format("{:.12g}", number);
  for (int digits = 11; digits > 0; --digits) {
    const std::string other = fmt::format("{:.{}g}", number, digits);
    const double error = std::abs(std::strtod(other.c_str(), nullptr) - number);
    if (error <= 1e-12 * std::abs(number) && other.size() <= text.size())
      text = other;
  }
  return unit.empty() ? text : fmt::format("{} {}", text, unit);
}

std::string kind_of(const Unit& unit) {
  static const std::map<Dimension, std::string> kinds{{none, "pure number"},
                                                      {length, "length"},
                                                      {mass, "mass"},
                                                      {duration, "time"},
                                                      {concentration, "concentration"},
                                                      {angle, "angle"},
                                                      {volume, "volume"},
                                                      {force, "force"},
                                                      {pressure, "pressure"},
                                                      {viscosity, "viscosity"},
                                                      {{1, 0, -1, 0, 0}, "velocity"},
                                                      {{-3, 1, 0, 0, 0}, "density"},
                                                      {{0, 0, -1, 0, 0}, "rate"},
                                                      {{0, 0, -1, -1, 0}, "binding rate"},
                                                      {{-2, 1, -2, 0, 0}, "stiffness per area"},
                                                      {{2, 0, 0, 0, 0}, "area"},
                                                      {{3, 0, -1, 0, 0}, "flow"},
                                                      {{-4, 1, -1, 0, 0}, "resistance"},
                                                      {{-4, 1, 0, 0, 0}, "inertance"},
                                                      {{-4, 1, -2, 0, 0}, "elastance"},
                                                      {{4, -1, 2, 0, 0}, "compliance"}};
  const auto found = kinds.find(unit.dimension);
  return found == kinds.end() ? "quantity of another kind" : found->second;
}

}  // namespace lv::units
