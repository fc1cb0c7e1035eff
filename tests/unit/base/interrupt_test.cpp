#include "lv/base/interrupt.hpp"

#include "lv/base/processors.hpp"

#include <catch2/catch.hpp>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <functional>

namespace {

using namespace lv;

/// The exit code of a process of its own that does something; 200 where it throws Interrupted.
int code_of(const std::function<void()>& work) {
  const pid_t child = fork();
  if (child == 0) {
    interrupt::install();
    try {
      work();
    } catch (const Interrupted&) {
      _exit(200);
    }
    _exit(0);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace

TEST_CASE("a loop that looks is stopped by a signal", "[unit][base]") {
  CHECK(code_of([] { interrupt::check(); }) == 0);
  for (const int signal : {SIGINT, SIGTERM, SIGUSR1})
    CHECK(code_of([&] {
            std::raise(signal);
            interrupt::check();
          }) == 200);
}

TEST_CASE("threads that share work are stopped by a signal", "[unit][base]") {
  const auto raise_once = [](std::size_t i) {
    if (i == 5)
      std::raise(SIGTERM);
  };
  CHECK(code_of([&] { in_threads(1000000000, raise_once); }) == 200);
}

TEST_CASE("a second signal ends what does not look", "[unit][base]") {
  CHECK(code_of([] {
          std::raise(SIGTERM);
          std::raise(SIGTERM);
        }) == 128 + SIGTERM);
  CHECK(code_of([] {
          std::raise(SIGUSR1);  // which mpirun may pass on twice
          std::raise(SIGUSR1);
        }) == 0);
}

TEST_CASE("what does not look at a signal in time is ended", "[unit][base]") {
  CHECK(code_of([] {
          std::raise(SIGTERM);
          std::raise(SIGALRM);
        }) == interrupt::exit_code);
}
