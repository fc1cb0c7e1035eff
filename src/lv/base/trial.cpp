#include "lv/base/trial.hpp"

#include "lv/base/check.hpp"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>

namespace lv {
namespace {

constexpr unsigned longest = 60;  // [s]

void limit_memory([[maybe_unused]] std::uintmax_t most) {
#ifndef __SANITIZE_ADDRESS__  // whose shadow memory is larger than any limit
  rlim_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  const rlim_t limit = pages * static_cast<rlim_t>(sysconf(_SC_PAGESIZE)) + most;
  const rlimit bound{limit, limit};
  setrlimit(RLIMIT_AS, &bound);
#endif
}

/// What the child does; it never comes back.
[[noreturn]] void try_out(const std::function<void()>& work, std::uintmax_t memory) {
  for (const int signal : {SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL})
    std::signal(signal, SIG_DFL);
  const rlimit no_core{0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
#ifndef __SANITIZE_ADDRESS__  // whose findings are to be seen
  if (std::freopen("/dev/null", "w", stderr) == nullptr)
    _exit(1);
#endif
  alarm(longest);
  limit_memory(memory);
  try {
    work();
  } catch (...) {
    _exit(1);
  }
  _exit(0);
}

}  // namespace

bool survives(const std::function<void()>& work, std::uintmax_t memory) {
  const pid_t child = fork();
  if (child < 0)
    return true;  // no process to spare: no trial
  if (child == 0)
    try_out(work, memory);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

void check_survives(const std::string& file, const std::function<void()>& work) {
  constexpr std::uintmax_t always = std::uintmax_t{1} << 30U;
  constexpr std::uintmax_t per_byte = 64;
  std::error_code failed;
  const std::uintmax_t size = std::filesystem::file_size(file, failed);
  const auto tried = [&] {
    try {
      work();
    } catch (const InputError&) {  // the work itself says it
    }
  };
  if (!survives(tried, always + per_byte * (failed ? 0 : size)))
    throw InputError(file, "cannot be read: what it says of its contents contradicts itself",
                     "The file seems to be truncated or damaged");
}

}  // namespace lv
