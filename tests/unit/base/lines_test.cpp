#include "lv/base/lines.hpp"

#include "support/temporary_folder.hpp"
#include <catch2/catch.hpp>

#include <string>
#include <vector>

using namespace lv;
using namespace std::string_literals;

namespace {

struct Line {
  int number;
  std::string text;
  bool operator==(const Line&) const = default;
};

std::vector<Line> lines(const std::string& content) {
  const test::TemporaryFolder folder;
  test::write_bytes(folder / "list.txt", content);
  LineReader reader(folder / "list.txt");
  REQUIRE(reader.is_open());
  std::vector<Line> found;
  while (reader.next()) {
    found.push_back({reader.number(), std::string(reader.text())});
    CHECK(reader.where() == (folder / "list.txt").string() + ":" + std::to_string(reader.number()));
  }
  return found;
}

}  // namespace

TEST_CASE("blanks are taken from both ends of a text alone", "[unit][base]") {
  CHECK(trimmed(" \t a b\r\n") == "a b");
  CHECK(trimmed("DICOM pads\0"s) == "DICOM pads");
  CHECK(trimmed(" \t\r").empty());
  CHECK(trimmed("").empty());
}

TEST_CASE("fields keep their places, empty ones too", "[unit][base]") {
  CHECK(fields_of("a, b ,,c\r", ',') == std::vector<std::string_view>{"a", "b", "", "c"});
  CHECK(fields_of("\tx\t", '\t') == std::vector<std::string_view>{"", "x", ""});
  CHECK(fields_of("", ',') == std::vector<std::string_view>{""});
}

TEST_CASE("fields of CSV may stand in quotation marks", "[unit][base]") {
  using Fields = std::vector<std::string>;
  CHECK(csv_fields("a, b ,,c\r") == Fields{"a", "b", "", "c"});
  CHECK(csv_fields("\"a, b\", \"say \"\"a\"\"\" ,c") == Fields{"a, b", "say \"a\"", "c"});
  CHECK(csv_fields("\"\",\" a \"") == Fields{"", " a "});
  CHECK(csv_fields("5\" wide,\"never closed, a") == Fields{"5\" wide", "never closed, a"});
  CHECK(csv_fields("") == Fields{""});
}

TEST_CASE("lines of any system are read and counted, blank ones counted alone", "[unit][base]") {
  const std::vector<Line> expected{{1, "x,y"}, {3, "1,2"}, {5, "3,4"}};
  CHECK(lines("x,y\n\n1,2\n \t\n3,4\n") == expected);
  CHECK(lines("x,y\r\n\r\n1,2\r\n\r\n3,4") == expected);
  CHECK(lines("\xEF\xBB\xBFx,y\n\n1,2\n\n3,4") == expected);
  CHECK(lines("a\n\xEF\xBB\xBFz") == std::vector<Line>{{1, "a"}, {2, "\xEF\xBB\xBFz"}});
  CHECK(lines("\tb\t") == std::vector<Line>{{1, "\tb\t"}});
  CHECK(lines("").empty());
}

TEST_CASE("a file that is not there and a folder cannot be opened", "[unit][base]") {
  const test::TemporaryFolder folder;
  CHECK_FALSE(LineReader(folder / "absent.txt").is_open());
  CHECK_FALSE(LineReader(folder / "").is_open());
}
