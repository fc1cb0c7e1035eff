#include "lv/base/time_left.hpp"

#include "lv/base/log.hpp"

#include <catch2/catch.hpp>

#include <chrono>

namespace {

double now() {
  const auto time = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration<double>(time).count();
}

}  // namespace

TEST_CASE("the time left of steady work is right at 25, 50 and 75%", "[unit][base]") {
  lv::TimeLeft left;
  CHECK(left.seconds(1.0) < 0.0);
  CHECK(left.words(1.0).empty());
  const double start = now();
  for (int second = 1; second < 400; ++second) {
    left.record(second, start + second);
    if (second % 100 == 0)
      CHECK(left.seconds(400.0 - second) == Approx(400.0 - second).epsilon(0.01));
  }
}

TEST_CASE("the time left follows work that becomes slower", "[unit][base]") {
  lv::TimeLeft left;
  const double start = now();
  double at = start;
  for (int step = 1; step <= 100; ++step) {
    at += step <= 50 ? 1.0 : 4.0;
    left.record(step, at);
    if (step == 75)
      CHECK(left.seconds(25.0) == Approx(100.0).epsilon(0.3));
  }
  CHECK(left.seconds(0.0) == 0.0);
}

TEST_CASE("a duration is told no more exactly than it is known", "[unit][base]") {
  CHECK(lv::log::duration(59.4) == "59 s");
  CHECK(lv::log::duration(200.0) == "3 min 20 s");
  CHECK(lv::log::duration(1608.0) == "27 min");
  CHECK(lv::log::duration(3900.0) == "1 h 5 min");
}
