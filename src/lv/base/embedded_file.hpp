#pragma once

#include <string_view>

/// Puts a file into the program as it is, by the assembler, between the labels `symbol` and
/// `symbol_end`, which it declares. `path` is a string literal. Stands outside of all namespaces.
// NOLINTBEGIN(readability-identifier-naming,bugprone-macro-parentheses): the assembler's labels
#define LV_EMBED_FILE(symbol, path)                                            \
  __asm__(".section .rodata\n" #symbol ": .incbin \"" path "\"\n" #symbol      \
          "_end: .byte 0\n.global " #symbol ", " #symbol "_end\n.previous\n"); \
  extern "C" const char symbol[], symbol##_end[]
// NOLINTEND(readability-identifier-naming,bugprone-macro-parentheses)

namespace lv {

/// What lies between two labels.
inline std::string_view embedded(const char* begin, const char* end) {
  return {begin, static_cast<std::size_t>(end - begin)};
}

}  // namespace lv
