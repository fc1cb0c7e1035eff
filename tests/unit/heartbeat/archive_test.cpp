#include "lv/heartbeat/archive.hpp"

#include "lv/base/check.hpp"

#include "support/temporary_folder.hpp"
#include <catch2/catch.hpp>
#include <sys/stat.h>

#include <cstring>
#include <limits>

namespace {

using namespace lv;
using Catch::Matchers::Contains;
using heartbeat::Archive;

Archive example() {
  Archive archive;
  archive.set("positions", {1.0 / 3.0, -2.5e-308, 1e300});
  archive.set("empty", {});
  archive.set("a name with spaces", {7.0});
  return archive;
}

/// Whether reading refuses these bytes as it should: as a run's failure that names the file.
bool refused(const std::filesystem::path& file, const std::string& bytes) {
  test::write_bytes(file, bytes);
  try {
    static_cast<void>(Archive::read(file));
    return false;
  } catch (const RunError& error) {
    return std::string(error.what()).find(file.string()) != std::string::npos;
  }
}

}  // namespace

TEST_CASE("an archive gives back what was put in, bit for bit", "[unit][heartbeat]") {
  const test::TemporaryFolder folder;
  Archive archive = example();
  const double special[] = {std::numeric_limits<double>::quiet_NaN(), -0.0,
                            std::numeric_limits<double>::infinity()};
  archive.set("special", {std::begin(special), std::end(special)});
  archive.write(folder / "state.bin");
  const Archive read = Archive::read(folder / "state.bin");
  CHECK(read.get("positions") == archive.get("positions"));
  CHECK(read.get("empty").empty());
  CHECK(read.number("a name with spaces") == 7.0);
  REQUIRE(read.get("special").size() == 3);
  CHECK(std::memcmp(read.get("special").data(), special, sizeof special) == 0);
}

TEST_CASE("an archive knows what it has, and names what it has not", "[unit][heartbeat]") {
  const Archive archive = example();
  CHECK(archive.has("positions"));
  CHECK_FALSE(archive.has("velocities"));
  CHECK_THROWS_AS(archive.get("velocities"), RunError);
  CHECK_THROWS_WITH(archive.get("velocities"), Contains("'velocities'"));
  CHECK_THROWS_AS(archive.number("velocities"), RunError);
}

TEST_CASE("words come back with all their letters", "[unit][heartbeat]") {
  Archive archive;
  const std::vector<std::string> words{"filling", "", "37 µm, 5° and a Größe"};
  archive.set_words("words", words);
  CHECK(archive.get_words("words") == words);
}

TEST_CASE("setting an array again replaces it", "[unit][heartbeat]") {
  Archive archive = example();
  archive.set("positions", {4.0});
  CHECK(archive.get("positions") == std::vector<double>{4.0});
}

TEST_CASE("an archive cut short anywhere is refused", "[unit][heartbeat]") {
  const test::TemporaryFolder folder;
  example().write(folder / "state.bin");
  const std::string bytes = test::bytes_of(folder / "state.bin");
  for (std::size_t length = 0; length < bytes.size(); ++length) {
    INFO(length << " of " << bytes.size() << " bytes");
    CHECK(refused(folder / "cut.bin", bytes.substr(0, length)));
  }
  CHECK(refused(folder / "longer.bin", bytes + '\0'));
}

TEST_CASE("an archive with any bit changed is refused", "[unit][heartbeat]") {
  const test::TemporaryFolder folder;
  example().write(folder / "state.bin");
  const std::string bytes = test::bytes_of(folder / "state.bin");
  for (std::size_t i = 0; i < 8 * bytes.size(); i += 3) {
    std::string damaged = bytes;
    damaged[i / 8] = static_cast<char>(damaged[i / 8] ^ (1 << (i % 8)));
    INFO("bit " << i % 8 << " of byte " << i / 8);
    CHECK(refused(folder / "damaged.bin", damaged));
  }
}

TEST_CASE("an absent archive is refused by name", "[unit][heartbeat]") {
  const test::TemporaryFolder folder;
  CHECK_THROWS_AS(Archive::read(folder / "absent.bin"), RunError);
  CHECK_THROWS_WITH(Archive::read(folder / "absent.bin"), Contains("absent.bin"));
}

TEST_CASE("writing replaces the archive whole and leaves nothing else", "[unit][heartbeat]") {
  const test::TemporaryFolder folder;
  example().write(folder / "state.bin");
  Archive second;
  second.set("time", {0.5});
  second.write(folder / "state.bin");
  CHECK_FALSE(Archive::read(folder / "state.bin").has("positions"));
  CHECK(Archive::read(folder / "state.bin").number("time") == 0.5);
  CHECK(folder.file_count() == 1);
}

TEST_CASE("when writing fails the previous archive stays", "[unit][heartbeat]") {
  const test::TemporaryFolder folder;
  example().write(folder / "state.bin");
  std::filesystem::create_directory(folder / "state.bin.part");  // where the new one would begin
  Archive second;
  second.set("time", {0.5});
  CHECK_THROWS_AS(second.write(folder / "state.bin"), RunError);
  CHECK(Archive::read(folder / "state.bin").has("positions"));
  CHECK_THROWS_AS(second.write(folder / "absent/state.bin"), RunError);
}

TEST_CASE("an archive that cannot take its final name is a run's failure", "[unit][heartbeat]") {
  const test::TemporaryFolder folder;
  std::filesystem::create_directories(folder / "taken/by_a_folder");
  CHECK_THROWS_AS(example().write(folder / "taken"), RunError);
  CHECK_THROWS_WITH(example().write(folder / "taken"), Contains("taken"));
}

TEST_CASE("an array of another length, or with numbers out of range, is refused by name",
          "[unit][heartbeat]") {
  Archive archive;
  const double infinite = std::numeric_limits<double>::infinity();
  const double missing = std::numeric_limits<double>::quiet_NaN();
  archive.set("three", {1.0, 2.0, 3.0});
  archive.set("infinite", {infinite});
  archive.set("missing", {missing});
  CHECK(archive.get_rows("three", 3, 1).size() == 3);
  CHECK_THROWS_WITH(archive.get_rows("three", 2), Contains("'three'"));
  CHECK_THROWS_WITH(archive.get_rows("three", 3, 2), Contains("'three'"));
  CHECK_THROWS_WITH(archive.get_rows("three", 3, 1, {0.0, 2.5}), Contains("'three'"));
  CHECK_THROWS_WITH(archive.get_rows("infinite", 1), Contains("'infinite'"));
  CHECK_THROWS_AS(archive.get_rows("missing", 1), RunError);
  CHECK(archive.get_rows("missing", 1, {}, {.missing = true}).size() == 1);
  CHECK_THROWS_AS(archive.get_rows("infinite", 1, {}, {.missing = true}), RunError);
}

TEST_CASE("whole numbers are whole and in their range", "[unit][heartbeat]") {
  Archive archive;
  archive.set("whole", {0.0, 7.0});
  archive.set("half", {0.5});
  archive.set("large", {1e10});
  CHECK(archive.get_whole("whole") == std::vector<int>{0, 7});
  CHECK_THROWS_AS(archive.get_whole("whole", 3), RunError);
  CHECK_THROWS_AS(archive.get_whole("whole", 2, {0.0, 6.0}), RunError);
  CHECK_THROWS_AS(archive.get_whole("half"), RunError);
  CHECK_THROWS_AS(archive.get_whole("large"), RunError);
}

TEST_CASE("an archive inside another comes out as it went in", "[unit][heartbeat]") {
  Archive outer;
  outer.set("a", {1.0});
  outer.add("part", example());
  Archive part = outer.take("part");
  CHECK(part.get("positions") == example().get("positions"));
  CHECK(outer.has("a"));
  CHECK_FALSE(outer.has("part.positions"));
}

TEST_CASE("what does not fit is told with the file's name", "[unit][heartbeat]") {
  const test::TemporaryFolder folder;
  Archive outer;
  outer.add("part", example());
  outer.write(folder / "state.bin");
  Archive read = Archive::read(folder / "state.bin");
  const Archive part = read.take("part");
  CHECK_THROWS_WITH(part.get_rows("positions", 2), Contains("state.bin"));
}

TEST_CASE("an archive that is no file is refused", "[unit][heartbeat]") {
  const test::TemporaryFolder folder;
  REQUIRE(mkfifo((folder / "pipe").c_str(), 0600) == 0);
  CHECK_THROWS_AS(Archive::read(folder / "pipe"), RunError);
  CHECK_THROWS_AS(Archive::read(folder / ""), RunError);
}
