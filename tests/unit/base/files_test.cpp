#include "lv/base/files.hpp"

#include "lv/base/check.hpp"
#include "lv/base/memory.hpp"

#include "support/temporary_folder.hpp"
#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

namespace {

using namespace lv;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

std::string all(const std::vector<std::string>& sentences) {
  return fmt::format("{}", fmt::join(sentences, "|"));
}

}  // namespace

TEST_CASE("files of a folder are found through links, each once", "[unit][base]") {
  const test::TemporaryFolder folder;
  fs::create_directories(folder / "z/sub");
  test::write_bytes(folder / "z/sub/a", "a");
  fs::create_symlink("z/sub", folder / "linked");
  fs::create_symlink("z/sub/a", folder / "b");
  fs::create_symlink("../..", folder / "z/sub/up");
  const FolderFiles found = files_in(folder / "", true);
  REQUIRE(found.files.size() == 2);
  CHECK(found.files[0].filename() == "b");
  CHECK(found.files[1] == folder / "z/sub/a");
  CHECK_THAT(all(summary(found.left_out)),
             Contains("2 files are left out") && Contains("linked: it is a link to a folder that"));
  CHECK(files_in(folder / "", false).files.size() == 1);
}

TEST_CASE("what is no file is left out with its reason, and nothing waits for it", "[unit][base]") {
  const test::TemporaryFolder folder;
  fs::create_symlink("self", folder / "self");
  fs::create_symlink("gone/x", folder / "dead1");
  fs::create_symlink("gone/y", folder / "dead2");
  REQUIRE(mkfifo((folder / "pipe").c_str(), 0600) == 0);
  fs::create_symlink("/dev/zero", folder / "zero");
  const FolderFiles found = files_in(folder / "", true);
  CHECK(found.files.empty());
  const std::string said = all(summary(found.left_out));
  CHECK_THAT(said, Contains("self is left out: the link leads to itself"));
  CHECK_THAT(said, Contains("2 files are left out, the first") &&
                       Contains("dead1: the link leads nowhere: fetch"));
  CHECK_THAT(said, Contains("pipe is left out: it is a pipe"));
  CHECK_THAT(said, Contains("zero is left out: it is a device"));
  CHECK(unreadable(folder / "none") == "there is no such file");
  CHECK(unreadable(folder / "") == "it is a folder");
  CHECK_THROWS_WITH(files_in(folder / "self", true), Contains("the link leads to itself"));
  CHECK_THROWS_WITH(files_in(folder / "none", true), Contains("there is no such folder"));
}

TEST_CASE("files and folders without the right to be read are named", "[unit][base]") {
  if (geteuid() == 0) {
    WARN("skipped: the superuser may read everything");
    return;
  }
  const test::TemporaryFolder folder;
  test::write_bytes(folder / "file", "x");
  fs::create_directory(folder / "sub");
  fs::permissions(folder / "file", fs::perms::none);
  fs::permissions(folder / "sub", fs::perms::none);
  CHECK_THAT(all(summary(files_in(folder / "", true).left_out)),
             Contains("2 files are left out") && Contains("permission denied"));
  CHECK_THROWS_AS(files_in(folder / "sub", true), InputError);
  fs::permissions(folder / "sub", fs::perms::owner_all);
}

TEST_CASE("more memory than is free is refused in words", "[unit][base]") {
  CHECK_NOTHROW(require_memory("x.nii", 1.0));
  CHECK_THROWS_AS(require_memory("x.nii", 1e18), RunError);
  CHECK_THROWS_WITH(require_memory("x.nii", 1e18),
                    Contains("x.nii: reading it takes 1e+09 GB of memory"));
}
