#include "lv/base/printable.hpp"

#include "lv/base/json_file.hpp"

#include <catch2/catch.hpp>

#include <string>

using namespace lv;
using namespace std::string_literals;

TEST_CASE("characters that act on a terminal are written out", "[unit][base]") {
  CHECK(printable("\x1B[31mred\x1B[0m") == "\\x1b[31mred\\x1b[0m");
  CHECK(printable("a\0b\x07\x7F"s) == "a\\x00b\\x07\\x7f");
  CHECK(printable("\xC2\x9B"
                  "31m") == "\\u009b31m");  // the one-character form of ESC [
  CHECK(printable("line\nnext\r\tcell") == "line\\nnext\\r\\tcell");
}

TEST_CASE("marks that turn or hide text are written out, letters of any script stay",
          "[unit][base]") {
  CHECK(printable("a\u202Eb\u2066c\u200Fd\u200Be\uFEFFf\u2028") ==
        "a\\u202eb\\u2066c\\u200fd\\u200be\\ufefff\\u2028");
  CHECK(printable("\U000E0041") == "\\U000e0041");
  for (const std::string kept :
       {"Grün, mm³, 心臓, שלום, سلام, 🫀", "a\\x1b is text", ""})
    CHECK(printable(kept) == kept);
}

TEST_CASE("bytes that are not UTF-8 are written out", "[unit][base]") {
  CHECK(printable("Gr\xFC\xDF") == "Gr\\xfc\\xdf");                // Latin-1
  CHECK(printable("\xC0\xAF") == "\\xc0\\xaf");                    // longer than need be
  CHECK(printable("\xED\xA0\x80") == "\\xed\\xa0\\x80");           // half of a pair
  CHECK(printable("\xF4\x90\x80\x80") == "\\xf4\\x90\\x80\\x80");  // beyond the last character
  CHECK(printable("cut \xE5\xBF") == "cut \\xe5\\xbf");
  CHECK(printable("\xFF\xFEs\0"s) == "\\xff\\xfes\\x00");
}

TEST_CASE("text that is made safe twice is the same, and lines keep their ends", "[unit][base]") {
  const std::string text = "\x1B[1m \xFF \u202E\n\tb\r\n";
  CHECK(printable(printable(text)) == printable(text));
  CHECK(printable_lines(printable_lines(text)) == printable_lines(text));
  CHECK(printable_lines(text) == "\\x1b[1m \\xff \\u202e\n\tb\\r\n");
}

TEST_CASE("texts in JSON are made safe at any depth, and bytes that are not UTF-8 do not stop it",
          "[unit][base]") {
  const nlohmann::ordered_json json{
      {"name", "\x1B[2J"}, {"notes", {"a\u202Eb", {{"deep", "\xFF"}}}}, {"number", 1.5}};
  CHECK(json_text(json, -1) ==
        R"({"name":"\\x1b[2J","notes":["a\\u202eb",{"deep":"\\xff"}],"number":1.5})");
}
