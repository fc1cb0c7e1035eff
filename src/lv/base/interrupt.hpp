#pragma once

#include <stdexcept>

/// Ctrl-C and `kill` ask a long computation to stop, with what it has reached kept.
namespace lv {

/// The computation was asked to stop.
class Interrupted : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

namespace interrupt {

/// The program's exit code once it has been stopped.
inline constexpr int exit_code = 130;

/// Catches SIGINT and SIGTERM from now on. Once asked, a computation that does not look for so many
/// seconds is ended without having been told; a second signal ends it at once.
inline constexpr unsigned patience = 20;  // [s]
void install();

/// Whether this process has been asked to stop.
[[nodiscard]] bool requested();

/// Throws Interrupted if this process has been asked to stop. For loops of one process alone, or of
/// the root while the others wait (parallel::on_root).
void check();

/// Throws Interrupted on all ranks if any has been asked to stop; collective.
void check_together();

}  // namespace interrupt
}  // namespace lv
