#include "lv/base/interrupt.hpp"

#include "lv/base/parallel.hpp"

#include <unistd.h>

#include <csignal>
#include <string_view>

namespace lv::interrupt {
namespace {

volatile std::sig_atomic_t asked = 0;

/// The first signal asks; a second one ends the program at once.
void note(int signal) {
  if (asked != 0) {
    std::signal(signal, SIG_DFL);
    std::raise(signal);
  }
  asked = 1;
  alarm(patience);
}

/// How mpirun passes a request on (launch.hpp), more than once.
void note_from_launcher(int /*signal*/) {
  if (asked == 0)
    alarm(patience);
  asked = 1;
}

/// Nothing has looked in time. What is on the disk is whole at any moment.
void give_up(int /*signal*/) {
  constexpr std::string_view words = "ventricle: stopped\n";
  [[maybe_unused]] const auto written = write(STDERR_FILENO, words.data(), words.size());
  _exit(exit_code);
}

[[noreturn]] void stop() {
  throw Interrupted("stopped; run the same command again to go on");
}

}  // namespace

void install() {
  std::signal(SIGINT, note);
  std::signal(SIGTERM, note);
  std::signal(SIGUSR1, note_from_launcher);
  std::signal(SIGALRM, give_up);
}

bool requested() {
  if (asked != 0)
    alarm(0);
  return asked != 0;
}

void check() {
  if (requested())
    stop();
}

void check_together() {
  if (parallel::any(requested()))
    stop();
}

}  // namespace lv::interrupt
