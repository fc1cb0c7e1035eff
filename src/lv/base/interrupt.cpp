#include "lv/base/interrupt.hpp"

#include <csignal>

namespace lv::interrupt {
namespace {

volatile std::sig_atomic_t asked = 0;

void note(int /*signal*/) {
  asked = 1;
}

}  // namespace

void install() {
  std::signal(SIGINT, note);
  std::signal(SIGTERM, note);
}

bool requested() {
  return asked != 0;
}

}  // namespace lv::interrupt
