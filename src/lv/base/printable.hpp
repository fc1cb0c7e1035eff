#pragma once

#include <string>
#include <string_view>

/// Text that files and names bring, made safe to show: on a terminal an escape character could
/// change what stands there, and a mark of direction could show words in another order.
namespace lv {

/// Whether a text is UTF-8 throughout (RFC 3629).
[[nodiscard]] bool is_utf8(std::string_view text);

/// One line of text: control characters (C0, C1, DEL), marks of direction, invisible marks, ends of
/// lines, and bytes that are not UTF-8 are written as \n, \t, \x1b, \u202e. Everything else stays
/// as it is, so that text which is made safe twice is the same.
[[nodiscard]] std::string printable(std::string_view text);

/// The same of several lines: their ends and tabs stay.
[[nodiscard]] std::string printable_lines(std::string_view text);

/// Writes lines to the terminal, made safe. Throws RunError when they cannot be written.
void print(std::string_view text);

}  // namespace lv
