#include "lv/verify/quantity.hpp"

#include "lv/base/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

namespace lv::verify {
namespace {

constexpr std::size_t columns = 7;
using Row = std::array<std::string, columns>;

Row row(const Quantity& q) {
  return {q.problem,
          q.quantity,
          fmt::format("{:.7g}", q.value),
          fmt::format("{:.7g}", q.reference),
          fmt::format("{:.2g}", q.tolerance),
          q.unit,
          q.pass() ? "pass" : "FAIL"};
}

std::string json_number(double value) {
  return std::isfinite(value) ? fmt::format("{}", value) : "null";
}

std::string json_text(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\')
      quoted += '\\';
    quoted += c;
  }
  return quoted + '"';
}

}  // namespace

bool Quantity::pass() const {
  return std::abs(value - reference) <= tolerance;
}

std::string text_table(const std::vector<Quantity>& quantities) {
  std::vector<Row> rows{{"problem", "quantity", "value", "reference", "+-", "unit", ""}};
  for (const Quantity& q : quantities)
    rows.push_back(row(q));
  std::array<std::size_t, columns> width{};
  for (const Row& r : rows)
    for (std::size_t i = 0; i < columns; ++i)
      width[i] = std::max(width[i], r[i].size());
  std::string text;
  for (const Row& r : rows) {
    for (std::size_t i = 0; i < columns; ++i) {
      const bool number = i >= 2 && i <= 4;
      text += number ? fmt::format("{:>{}}  ", r[i], width[i])
                     : fmt::format("{:<{}}  ", r[i], width[i]);
    }
    text.erase(text.find_last_not_of(' ') + 1);
    text += '\n';
  }
  return text;
}

std::string json_line(const Quantity& q) {
  return fmt::format(
      "{{\"problem\":{},\"quantity\":{},\"value\":{},\"reference\":{},\"tolerance\":{},\"unit\":{},"
      "\"pass\":{}}}",
      json_text(q.problem), json_text(q.quantity), json_number(q.value), json_number(q.reference),
      json_number(q.tolerance), json_text(q.unit), q.pass());
}

void write(const std::filesystem::path& file, const std::vector<Quantity>& quantities) {
  std::string text;
  for (const Quantity& q : quantities)
    text += fmt::format("{}\t{}\t{}\t{}\t{}\t{}\n", q.problem, q.quantity, q.value, q.reference,
                        q.tolerance, q.unit);
  write_file(file, text);
}

std::vector<Quantity> read(const std::filesystem::path& file) {
  std::vector<Quantity> quantities;
  if (!std::filesystem::exists(file))
    return quantities;
  std::istringstream lines(read_file(file));
  for (std::string line; std::getline(lines, line);) {
    std::istringstream fields(line);
    std::array<std::string, 6> f;
    for (std::string& field : f)
      std::getline(fields, field, '\t');
    quantities.push_back({f[0], f[1], std::stod(f[2]), std::stod(f[3]), std::stod(f[4]), f[5]});
  }
  return quantities;
}

}  // namespace lv::verify
