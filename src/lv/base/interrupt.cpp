#include "lv/base/interrupt.hpp"

#include <csignal>

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
}

}  // namespace

void install() {
  std::signal(SIGINT, note);
  std::signal(SIGTERM, note);
  std::signal(SIGUSR1, note);  // how mpirun passes a request on (launch.hpp)
}

bool requested() {
  return asked != 0;
}

}  // namespace lv::interrupt
