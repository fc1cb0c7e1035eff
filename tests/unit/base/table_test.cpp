#include "lv/base/table.hpp"

#include "lv/base/check.hpp"
#include "lv/base/files.hpp"
#include "lv/base/lines.hpp"

#include "support/temporary_folder.hpp"
#include <catch2/catch.hpp>
#include <sys/stat.h>

#include <cmath>
#include <limits>

using namespace lv;
using Catch::Matchers::Contains;

TEST_CASE("a table is written as CSV with its header", "[unit][base]") {
  const test::TemporaryFolder folder;
  Table table({"time_s", "phase", "volume_ml"});
  table.add_row({Table::number(0.1), "filling", Table::number(70.79)});
  table.add_row({Table::number(0.2), "", Table::number(std::numeric_limits<double>::quiet_NaN())});
  table.write_csv(folder / "curves.csv");
  CHECK(test::bytes_of(folder / "curves.csv") ==
        "time_s,phase,volume_ml\n0.1,filling,70.79\n0.2,,\n");
}

TEST_CASE("numbers keep as many digits as asked for, and NaN is an empty field", "[unit][base]") {
  CHECK(Table::number(3.14159265358979) == "3.141593");
  CHECK(Table::number(3.14159265358979, 3) == "3.14");
  CHECK(Table::number(-1.5e-9) == "-1.5e-09");
  CHECK(Table::number(0.0) == "0");
  CHECK(Table::number(std::numeric_limits<double>::quiet_NaN()).empty());
}

TEST_CASE("a row that does not fit the columns is our own mistake", "[unit][base]") {
  Table table({"a", "b"});
  CHECK_THROWS_AS(table.add_row({"1"}), LogicError);
  CHECK_THROWS_AS(table.add_row({"1", "2", "3"}), LogicError);
  CHECK(table.rows().empty());
}

TEST_CASE("files are replaced whole and leave nothing else behind", "[unit][base]") {
  const test::TemporaryFolder folder;
  write_file(folder / "a.txt", "a long first version\n");
  write_file(folder / "a.txt", "second\n");
  CHECK(read_file(folder / "a.txt") == "second\n");
  CHECK(folder.file_count() == 1);
  const std::string binary("\0\r\n\xff", 4);
  write_file(folder / "b.bin", binary);
  CHECK(read_file(folder / "b.bin") == binary);
}

TEST_CASE("a file that cannot be written is named", "[unit][base]") {
  const test::TemporaryFolder folder;
  CHECK_THROWS_AS(write_file(folder / "absent/a.txt", "a"), RunError);
  CHECK_THROWS_WITH(write_file(folder / "absent/a.txt", "a"),
                    Contains("absent/a.txt") && Contains("There is no folder"));
}

TEST_CASE("a file that cannot take its final name is named", "[unit][base]") {
  const test::TemporaryFolder folder;
  std::filesystem::create_directories(folder / "taken/by_a_folder");
  CHECK_THROWS_AS(write_file(folder / "taken", "a"), RunError);
  CHECK_THROWS_WITH(write_file(folder / "taken", "a"),
                    Contains("taken") && Contains("It is a folder"));
  CHECK_FALSE(std::filesystem::exists(folder / "taken.part"));
}

TEST_CASE("a file that cannot be read is named", "[unit][base]") {
  const test::TemporaryFolder folder;
  CHECK_THROWS_AS(read_file(folder / "absent.txt"), InputError);
  CHECK_THROWS_WITH(read_file(folder / "absent.txt"), Contains("absent.txt"));
  CHECK_THROWS_AS(read_file(folder / "."), InputError);
}

TEST_CASE("a table is read as it was written; a missing number is no number", "[unit][base]") {
  const test::TemporaryFolder folder;
  write_file(folder / "a.csv", "name,value_ml\nEDV,142.6\nESV,\nhalf a li");
  const Table table = Table::read_csv(folder / "a.csv");
  CHECK(table.words("name") == std::vector<std::string>{"EDV", "ESV"});
  CHECK(table.numbers("value_ml").at(0) == 142.6);
  CHECK(std::isnan(table.numbers("value_ml").at(1)));
  CHECK(std::isnan(table.numbers("absent").at(0)));
  CHECK_THROWS_AS(Table::read_csv(folder / "absent.csv"), InputError);
}

TEST_CASE("fields that hold commas, quotation marks, blanks or lines come back", "[unit][base]") {
  const test::TemporaryFolder folder;
  const std::vector<std::string> odd{"a, b", "\"quoted\"", " blanks ", "two\nlines", "", "\"", ","};
  Table table({"plain", "with, comma"});
  for (const std::string& word : odd)
    table.add_row({"1", word});
  table.write_csv(folder / "a.csv");
  CHECK(test::bytes_of(folder / "a.csv").starts_with("plain,\"with, comma\"\n1,\"a, b\"\n"));
  const Table read = Table::read_csv(folder / "a.csv");
  CHECK(read.columns() == table.columns());
  CHECK(read.words("with, comma") == odd);
}

TEST_CASE("a column of numbers that holds words is refused", "[unit][base]") {
  const test::TemporaryFolder folder;
  write_file(folder / "a.csv", "volume_ml,slice\n1e2,3\n12 ml,\n,2.5\n");
  const Table table = Table::read_csv(folder / "a.csv");
  CHECK_THROWS_AS(table.numbers("volume_ml"), InputError);
  CHECK_THROWS_WITH(table.numbers("volume_ml"), Contains("volume_ml") && Contains("12 ml"));
  CHECK_THROWS_AS(table.whole_numbers("slice"), InputError);
}

TEST_CASE("only files are read: no folder, pipe, device, or link that leads nowhere or round",
          "[unit][base]") {
  const test::TemporaryFolder folder;
  REQUIRE(mkfifo((folder / "pipe").c_str(), 0600) == 0);
  std::filesystem::create_symlink("/dev/zero", folder / "device");
  std::filesystem::create_symlink("absent", folder / "nowhere");
  std::filesystem::create_symlink("round", folder / "round");
  std::filesystem::create_directory(folder / "folder");
  for (const char* name : {"pipe", "device", "nowhere", "round", "folder"}) {
    INFO(name);
    CHECK_FALSE(unreadable(folder / name).empty());
    CHECK_THROWS_AS(read_file(folder / name), InputError);
    CHECK_THROWS_WITH(read_file(folder / name),
                      Contains(name) && Contains(unreadable(folder / name)));
    CHECK_FALSE(LineReader(folder / name).is_open());
  }
  test::write_bytes(folder / "file", "text");
  std::filesystem::create_symlink("file", folder / "link");
  CHECK(read_file(folder / "link") == "text");
}

TEST_CASE("a file larger than the memory is refused unread", "[unit][base]") {
  const test::TemporaryFolder folder;
  test::write_bytes(folder / "huge", "");
  std::error_code failed;
  std::filesystem::resize_file(folder / "huge", std::uintmax_t{1} << 43U, failed);
  if (failed)
    return;  // the disk has no files with holes
  CHECK_THROWS_WITH(read_file(folder / "huge"), Contains("memory"));
}

TEST_CASE("a pipe in the place of an unfinished file does not stop a file from being written",
          "[unit][base]") {
  const test::TemporaryFolder folder;
  REQUIRE(mkfifo((folder / "a.csv.part").c_str(), 0600) == 0);
  write_file(folder / "a.csv", "text");
  CHECK(read_file(folder / "a.csv") == "text");
}

TEST_CASE("files of megabytes are read whole", "[unit][base]") {
  const test::TemporaryFolder folder;
  const std::string text(5'000'001, 'x');
  write_file(folder / "long", text);
  CHECK(read_file(folder / "long") == text);
}
