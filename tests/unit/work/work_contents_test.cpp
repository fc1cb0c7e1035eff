#include "lv/base/check.hpp"
#include "lv/work/workspace.hpp"

#include "support/temporary_folder.hpp"
#include <catch2/catch.hpp>
#include <sys/stat.h>

using namespace lv;
using Catch::Matchers::Contains;

TEST_CASE("a work folder holds files and folders alone", "[unit][work]") {
  const test::TemporaryFolder work;
  std::filesystem::create_directories(work / "03_beat.part/fields");
  test::write_bytes(work / "03_beat.part/checkpoint.bin", "anything");
  std::filesystem::create_symlink("checkpoint.bin", work / "03_beat.part/link.bin");
  CHECK_NOTHROW(work::WorkLock(work / ""));
}

TEST_CASE("a pipe or a link that leads nowhere in a work folder is refused by name",
          "[unit][work]") {
  const test::TemporaryFolder work;
  std::filesystem::create_directories(work / "03_beat.part");
  REQUIRE(mkfifo((work / "03_beat.part/checkpoint.bin").c_str(), 0600) == 0);
  CHECK_THROWS_AS(work::WorkLock(work / ""), RunError);
  CHECK_THROWS_WITH(work::state_of(work / ""), Contains("03_beat.part/checkpoint.bin"));
  std::filesystem::remove(work / "03_beat.part/checkpoint.bin");
  std::filesystem::create_symlink("round.csv", work / "round.csv");
  CHECK_THROWS_WITH(work::check_contents(work / ""), Contains("round.csv"));
  std::filesystem::remove(work / "round.csv");
  std::filesystem::create_directories(work / "devices");
  REQUIRE(mkfifo((work / "devices/pipe").c_str(), 0600) == 0);
  CHECK_NOTHROW(work::check_contents(work / ""));
}

TEST_CASE("folders of a stage's name that another program made are no work folder",
          "[unit][work]") {
  const test::TemporaryFolder work;
  std::filesystem::create_directories(work / "03_beat");
  test::write_bytes(work / "03_beat/stage.json", "hello");
  CHECK_THROWS_WITH(work::state_of(work / ""), Contains("is no work folder of this program"));
}
