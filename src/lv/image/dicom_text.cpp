#include "lv/image/dicom_text.hpp"

#include "lv/base/lines.hpp"
#include "lv/base/printable.hpp"

#include <algorithm>

namespace lv::image {
namespace {

bool is_ascii(char c) {
  return static_cast<unsigned char>(c) < 0x80;
}

/// ISO 8859-1 holds the first 256 characters of Unicode.
std::string from_latin_1(std::string_view stored) {
  std::string text;
  for (const char c : stored) {
    const auto code = static_cast<unsigned char>(c);
    if (is_ascii(c))
      text += c;
    else
      text.append(
          {static_cast<char>(0xC0U | (code >> 6U)), static_cast<char>(0x80U | (code & 0x3FU))});
  }
  return text;
}

/// "?" for what is not ASCII, once for a run; sequences of ISO 2022 lead away from it and back.
std::string ascii_of(std::string_view stored) {
  constexpr char escape = '\x1b';
  constexpr std::size_t sequence = 3;  // bytes; of a longer one the rest counts as text of its set
  std::string text;
  bool away = false;
  while (!stored.empty()) {
    std::size_t read = 1;
    if (stored.front() == escape) {
      away = !stored.substr(1).starts_with("(B");
      read = std::min(stored.size(), sequence);
    } else if (!away && is_ascii(stored.front())) {
      text += stored.front();
    } else if (!text.ends_with('?')) {
      text += '?';
    }
    stored.remove_prefix(read);
  }
  return text;
}

}  // namespace

std::string dicom_text(std::string_view stored, std::string_view character_set) {
  const std::string_view set = trimmed(character_set);
  if (set == "ISO_IR 192")
    return std::string(stored);
  if (set == "ISO_IR 100")
    return from_latin_1(stored);
  if (set.empty() || set == "ISO_IR 6")
    return is_utf8(stored) ? std::string(stored) : from_latin_1(stored);
  return ascii_of(stored);
}

}  // namespace lv::image
