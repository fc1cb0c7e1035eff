#include "lv/base/processors.hpp"

#include "support/temporary_folder.hpp"
#include <catch2/catch.hpp>
#include <sched.h>

#include <algorithm>
#include <atomic>
#include <stdexcept>
#include <thread>
#include <vector>

namespace {

using namespace lv;

void write_limit(const std::filesystem::path& group, const std::string& text) {
  std::filesystem::create_directories(group);
  test::write_bytes(group / "cpu.max", text);
}

}  // namespace

TEST_CASE("a process on one processor counts one", "[unit][base]") {
  int counted = 0;
  std::thread([&] {
    cpu_set_t one;
    CPU_ZERO(&one);
    CPU_SET(sched_getcpu(), &one);
    REQUIRE(sched_setaffinity(0, sizeof one, &one) == 0);
    counted = processors();
  }).join();
  CHECK(counted == 1);
}

TEST_CASE("the smallest quota of a control group and those around it counts", "[unit][base]") {
  const test::TemporaryFolder root;
  CHECK(quota(root / "", "") == 0);
  write_limit(root / "", "max 100000\n");
  CHECK(quota(root / "", "a/b") == 0);
  write_limit(root / "a", "150000 100000\n");
  write_limit(root / "a/b", "700000 100000\n");
  CHECK(quota(root / "", "a/b") == 2);
  write_limit(root / "a/b", "50000 100000\n");
  CHECK(quota(root / "", "a/b") == 1);
}

TEST_CASE("quotas of older control groups count too", "[unit][base]") {
  const test::TemporaryFolder root;
  test::write_bytes(root / "cpu.cfs_period_us", "100000\n");
  test::write_bytes(root / "cpu.cfs_quota_us", "-1\n");
  CHECK(quota(root / "", "") == 0);
  test::write_bytes(root / "cpu.cfs_quota_us", "300000\n");
  CHECK(quota(root / "", "") == 3);
}

TEST_CASE("threads share the work, each piece once", "[unit][base]") {
  std::vector<std::atomic<int>> done(1000);
  in_threads(done.size(), [&](std::size_t i) { ++done[i]; });
  CHECK(std::all_of(done.begin(), done.end(), [](const auto& n) { return n == 1; }));
}

TEST_CASE("what one thread throws is thrown on, and the rest is left", "[unit][base]") {
  std::atomic<int> calls = 0;
  const auto work = [&](std::size_t) {
    ++calls;
    throw std::runtime_error("no");
  };
  CHECK_THROWS_AS(in_threads(100000, work), std::runtime_error);
  CHECK(calls < 1000);
}
