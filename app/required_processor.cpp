#include <unistd.h>

#include <cstdlib>
#include <string_view>

/// The program is compiled for LV_ARCH, this file for any processor. Before anything else runs, an
/// older processor is refused in words.
[[gnu::constructor(101)]] static void require_processor() {
  __builtin_cpu_init();
  if (__builtin_cpu_supports(LV_ARCH) != 0)
    return;
  constexpr std::string_view words = "ventricle: this processor lacks instructions of " LV_ARCH
                                     ", for which it was built. Build it from its sources here\n";
  [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, words.data(), words.size());
  _exit(EXIT_FAILURE);
}
