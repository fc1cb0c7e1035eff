#include "lv/base/printable.hpp"

#include "lv/base/check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>

namespace lv {
namespace {

/// A character and the bytes it takes; `code` is negative for a byte that is not UTF-8.
struct Character {
  long code = -1;
  std::size_t length = 1;
};

unsigned byte_at(std::string_view text, std::size_t i) {
  return static_cast<unsigned char>(text[i]);
}

/// The first character of a text (RFC 3629): the shortest form alone counts, halves of pairs do
/// not.
Character first_of(std::string_view text) {
  constexpr std::array<long, 5> least{0, 0, 0x80, 0x800, 0x10000};
  const unsigned lead = byte_at(text, 0);
  if (lead < 0x80)
    return {static_cast<long>(lead), 1};
  const std::size_t length = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
  if (lead < 0xC0 || lead >= 0xF8 || length > text.size())
    return {};
  long code = static_cast<long>(lead & (0x7FU >> length));
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte_at(text, i) & 0xC0U) != 0x80)
      return {};
    code = 64 * code + static_cast<long>(byte_at(text, i) & 0x3FU);
  }
  const bool half = code >= 0xD800 && code <= 0xDFFF;
  return code < least.at(length) || half || code > 0x10FFFF ? Character{} : Character{code, length};
}

/// Whether a character acts on others or shows as nothing.
bool acts(long code) {
  constexpr std::array<std::array<long, 2>, 10> ranges{{{0x00, 0x1F},
                                                        {0x7F, 0x9F},
                                                        {0x61C, 0x61C},        // Arabic letter mark
                                                        {0x200B, 0x200B},      // zero width space
                                                        {0x200E, 0x200F},      // marks of direction
                                                        {0x2028, 0x202E},      // ends, embeddings
                                                        {0x2060, 0x206F},      // isolates, joiners
                                                        {0xFEFF, 0xFEFF},      // mark of byte order
                                                        {0xFFF9, 0xFFFB},      // annotations
                                                        {0xE0000, 0xE007F}}};  // tags
  return std::any_of(ranges.begin(), ranges.end(),
                     [&](const auto& range) { return code >= range[0] && code <= range[1]; });
}

std::string escape(long code) {
  switch (code) {
    case '\n':
      return "\\n";
    case '\r':
      return "\\r";
    case '\t':
      return "\\t";
    default:
      return code < 0x80      ? fmt::format("\\x{:02x}", code)
             : code < 0x10000 ? fmt::format("\\u{:04x}", code)
                              : fmt::format("\\U{:08x}", code);
  }
}

std::string made_safe(std::string_view text, std::string_view kept) {
  std::string safe;
  while (!text.empty()) {
    const Character character = first_of(text);
    if (character.code < 0)
      safe += fmt::format("\\x{:02x}", byte_at(text, 0));
    else if (acts(character.code) && kept.find(text.front()) == std::string_view::npos)
      safe += escape(character.code);
    else
      safe += text.substr(0, character.length);
    text.remove_prefix(character.length);
  }
  return safe;
}

}  // namespace

bool is_utf8(std::string_view text) {
  while (!text.empty()) {
    const Character character = first_of(text);
    if (character.code < 0)
      return false;
    text.remove_prefix(character.length);
  }
  return true;
}

std::string printable(std::string_view text) {
  return made_safe(text, "");
}

std::string printable_lines(std::string_view text) {
  return made_safe(text, "\n\t");
}

void print(std::string_view text) {
  const std::string safe = printable_lines(text);
  if (std::fwrite(safe.data(), 1, safe.size(), stdout) != safe.size() || std::fflush(stdout) != 0)
    throw RunError(fmt::format("what is printed cannot be written: {}", std::strerror(errno)),
                   "Check the space left on the disk, or the program that reads it");
}

}  // namespace lv
