#pragma once

/// Ctrl-C and `kill` ask a long run to stop at the next step with a valid checkpoint.
namespace lv::interrupt {

/// Catches SIGINT and SIGTERM from now on.
void install();

/// Whether this process has been asked to stop.
[[nodiscard]] bool requested();

}  // namespace lv::interrupt
