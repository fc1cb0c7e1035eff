#include "lv/base/trial.hpp"

#include "lv/base/check.hpp"

#include <catch2/catch.hpp>

#include <csignal>
#include <cstdlib>
#include <new>
#include <string>
#include <vector>

namespace {

using namespace lv;
using Catch::Matchers::Equals;

}  // namespace

TEST_CASE("a file that a child refuses is refused in its words, and not tried again",
          "[unit][base]") {
  int times = 0;
  const auto work = [&] {
    ++times;
    throw InputError("x.vtk:3", "is: odd", "Mend it");
  };
  CHECK_THROWS_WITH(check_survives("x.vtk", work), Equals("x.vtk:3: is: odd. Mend it"));
  CHECK(times == 0);  // in this process
}

#ifndef __SANITIZE_ADDRESS__  // whose memory is not limited
TEST_CASE("a child's want of memory is its verdict, though the work hides it", "[unit][base]") {
  bool here = false;
  const auto work = [&] {
    here = true;
    try {
      const std::vector<char> much(std::size_t{1} << 36U, 'x');
      here = much.back() == 'x';
    } catch (const std::bad_alloc&) {
      throw InputError("x", "is damaged", "");
    }
  };
  const Trial trial = tried(work);
  CHECK(trial.ending == Trial::Ending::refused);
  CHECK(trial.what == "is damaged");
  CHECK_FALSE(here);
}
#endif

TEST_CASE("a child that dies is told from one that refuses", "[unit][base]") {
  CHECK(tried([] {}).ending == Trial::Ending::well);
  CHECK(tried([] { std::raise(SIGSEGV); }).ending == Trial::Ending::died);
  CHECK(tried([] { throw std::bad_alloc(); }).ending == Trial::Ending::died);
  CHECK_THROWS_AS(check_survives("x", [] { std::abort(); }), InputError);
  const std::string text(300000, 'x');  // more than a pipe holds
  CHECK(tried([&] { throw InputError("x", text, ""); }).what == text);
}

TEST_CASE("a child that somebody ends says nothing of the file", "[unit][base]") {
  for (const int signal : {SIGKILL, SIGTERM}) {
    const auto end = [&] {
      std::signal(SIGTERM, SIG_DFL);  // not Catch's own, which writes a report
      std::raise(signal);
    };
    CHECK_THROWS_AS(tried(end), RunError);
    CHECK_THROWS_AS(check_survives("x", end), RunError);
  }
}
