#pragma once

#include <cstdint>
#include <functional>
#include <string>

namespace lv {

/// How some work ended in a child of this process.
struct Trial {
  enum class Ending {
    well,
    refused,  ///< by an InputError
    died      ///< by a signal, another exception, or for want of time or memory
  };
  Ending ending = Ending::well;
  std::string where, what;  ///< of the InputError
};

/// Tries some work in a child of this process, within a minute and with no more than `memory` bytes
/// besides what is in use. Libraries that read files of other programs end by a signal on files
/// that are damaged in certain ways. What the child says is final: the limits may be what kept it
/// from worse, so work that it did not do well must not be tried again. Throws RunError if there is
/// no process to spare.
[[nodiscard]] Trial tried(const std::function<void()>& work,
                          std::uintmax_t memory = std::uintmax_t{1} << 30U);

/// Throws InputError unless some work on a file ends well in a child: that of the work, or one that
/// names the file.
void check_survives(const std::string& file, const std::function<void()>& work);

}  // namespace lv
