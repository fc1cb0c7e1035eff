#include "lv/base/lines.hpp"

#include "lv/base/check.hpp"

#include "support/temporary_folder.hpp"
#include <catch2/catch.hpp>

#include <cstdint>
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
  CHECK(lines("x,y\r\r1,2\r \t\r3,4\r") == expected);  // an old Mac's
  CHECK(lines("\tb\t") == std::vector<Line>{{1, "\tb\t"}});
  CHECK(lines("").empty());
}

TEST_CASE("a file that is not there and a folder cannot be opened", "[unit][base]") {
  const test::TemporaryFolder folder;
  CHECK_FALSE(LineReader(folder / "absent.txt").is_open());
  CHECK_FALSE(LineReader(folder / "").is_open());
}

TEST_CASE("text in another encoding is refused in words, not read as garbage", "[unit][base]") {
  using Catch::Matchers::Contains;
  const test::TemporaryFolder folder;
  const auto refusal = [&](const std::string& bytes) -> std::string {
    test::write_bytes(folder / "list.txt", bytes);
    try {
      LineReader reader(folder / "list.txt");
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  };
  const auto remedy = Contains("Save it as UTF-8");
  CHECK_THAT(refusal("\xFF\xFEx\0,\0y\0"s),
             Contains("list.txt: is not UTF-8 text but UTF-16") && remedy);
  CHECK_THAT(refusal("\xFE\xFF\0x\0,"s), Contains("UTF-16") && remedy);
  CHECK_THAT(refusal("\xFF\xFE\0\0x\0\0\0"s), Contains("UTF-32") && remedy && !Contains("CSV"));
  test::write_bytes(folder / "table.csv", "\xFF\xFEx\0"s);
  CHECK_THROWS_WITH(read_text(folder / "table.csv"), Contains("(a spreadsheet calls this"));
  CHECK_THAT(refusal("x\0,\0y\0\n\0"s), Contains("list.txt:1: is not UTF-8 text") && remedy);
  CHECK_THAT(refusal("x,y\r\n1,2\r\n\0\0"s), Contains("list.txt:3: is not UTF-8 text"));
  CHECK(refusal("Gr\xFC\xDF,y\n") == "no error");  // Latin-1 has all of ASCII
}

TEST_CASE("a table with other separators or decimal commas is refused with the cause",
          "[unit][base]") {
  using Catch::Matchers::Contains;
  const test::TemporaryFolder folder;
  const auto refusal = [&](const std::string& text, Columns columns = Columns::by_ending) {
    test::write_bytes(folder / "table.csv", text);
    try {
      LineReader reader(folder / "table.csv", columns);
      while (reader.next())
        continue;
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return "no error"s;
  };
  CHECK_THAT(refusal("a;b\n1;2\n"), Contains("table.csv:1: columns are separated by ';'. Save it"));
  CHECK_THAT(refusal("a\tb\n"), Contains("table.csv:1: columns are separated by tabs"));
  CHECK_THAT(refusal("a,b\n1,2\n3;4\n"), Contains("table.csv:3: columns are separated by ';'"));
  CHECK_THAT(refusal("a,b\n1,\"-11,36\"\n"),
             Contains("table.csv:2: \"-11,36\" has a decimal comma; write a decimal point"));
  CHECK_THAT(refusal("a,b\nx,1.5\nx,1,5\n"),
             Contains("table.csv:3: 3 values in a table of 2 columns, perhaps because numbers "
                      "have decimal commas"));
  CHECK(refusal("a,b\n1,endo,3\n1.5,2.5,3\n") == "no error");  // for who reads it to refuse
  CHECK(refusal("a,b\n\"x; y\",\"p, q\"\n") == "no error");
  CHECK(refusal("# of the left; ventricle\n12.5\n") == "no error");
  CHECK(refusal("a\tb\n1,5\t2\n", Columns::any) == "no error");
}

TEST_CASE("numbers with decimal commas are known", "[unit][base]") {
  for (const char* text : {"1,5", "-11,36", "+0,000", "1,5e-3"})
    CHECK(has_decimal_comma(text));
  for (const char* text : {"", ",", "1,", ",5", "1.5", "1,5,2", "a,5", "1,5 mm", "1,5e", "1,-5"})
    CHECK_FALSE(has_decimal_comma(text));
  CHECK(why_no_number("1,5", "is no number") ==
        "\"1,5\" has a decimal comma; write a decimal point");
  CHECK(why_no_number("x", "is no number") == "\"x\" is no number");
}

TEST_CASE("numbers may have exponents of Fortran", "[unit][base]") {
  for (const char* text : {"15", "+15", "1.5e1", "1.5E+01", "1.5D+01", "1.5d1", "150.D-1"})
    CHECK(number_of<double>(text) == 15.0);
  CHECK(number_of<double>("-0.0D+00") == 0.0);
  CHECK(number_of<double>("1.5-101") == 1.5e-101);
  CHECK(number_of<double>("1.5+101") == 1.5e+101);
  for (const char* text : {"", "D", "1D", "D1", "1.5 D1", "12-5", "1.5-1", "15-101", "1,5", "1.5mm",
                           "1D1D1", "+", "--1", "1.5-101-101"})
    CHECK_FALSE(number_of<double>(text));
  CHECK(number_of<int>("+7") == 7);
  CHECK(number_of<std::int64_t>("5000000000") == 5000000000);
  for (const char* text : {"7.0", "7D0", "5000000000", ""})
    CHECK_FALSE(number_of<int>(text));
}
