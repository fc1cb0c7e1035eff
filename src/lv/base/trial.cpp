#include "lv/base/trial.hpp"

#include "lv/base/check.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <system_error>

namespace lv {
namespace {

constexpr unsigned longest = 60;  // [s]
constexpr int died = 1;           // exit codes of the child
constexpr int refused = 2;

void limit_memory([[maybe_unused]] std::uintmax_t most) {
#ifndef __SANITIZE_ADDRESS__  // whose shadow memory is larger than any limit
  rlim_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  const rlim_t limit = pages * static_cast<rlim_t>(sysconf(_SC_PAGESIZE)) + most;
  const rlimit bound{limit, limit};
  setrlimit(RLIMIT_AS, &bound);
#endif
}

/// Says how the work was refused, in two parts.
void report(int pipe, const InputError& error) {
  const std::string text = error.where() + '\0' + error.what();
  for (std::size_t sent = 0; sent < text.size();) {
    const ssize_t n = write(pipe, text.data() + sent, text.size() - sent);
    if (n < 0 && errno != EINTR)
      return;
    sent += static_cast<std::size_t>(std::max<ssize_t>(n, 0));
  }
}

/// What the child does; it never comes back.
[[noreturn]] void try_out(const std::function<void()>& work, std::uintmax_t memory, int pipe) {
  for (const int signal : {SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL})
    std::signal(signal, SIG_DFL);
  const rlimit no_core{0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
#ifndef __SANITIZE_ADDRESS__  // whose findings are to be seen
  if (std::freopen("/dev/null", "w", stderr) == nullptr)
    _exit(died);
#endif
  alarm(longest);
  limit_memory(memory);
  try {
    work();
  } catch (const InputError& error) {
    report(pipe, error);
    _exit(refused);
  } catch (...) {
    _exit(died);
  }
  _exit(0);
}

/// All that comes through a pipe until its other end is closed.
std::string read_all(int pipe) {
  std::string text;
  std::array<char, 4096> block{};
  for (;;) {
    const ssize_t n = read(pipe, block.data(), block.size());
    if (n == 0 || (n < 0 && errno != EINTR))
      return text;
    text.append(block.data(), static_cast<std::size_t>(std::max<ssize_t>(n, 0)));
  }
}

[[noreturn]] void fail_to_fork(int reason) {
  throw RunError(fmt::format("no process can be started to try a file in: {}",
                             std::generic_category().message(reason)),
                 "Allow more processes (ulimit -u)");
}

}  // namespace

Trial tried(const std::function<void()>& work, std::uintmax_t memory) {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0)
    fail_to_fork(errno);
  const pid_t child = fork();
  const int reason = errno;
  if (child == 0) {
    close(ends[0]);
    try_out(work, memory, ends[1]);
  }
  close(ends[1]);
  const std::string said = child < 0 ? "" : read_all(ends[0]);
  close(ends[0]);
  if (child < 0)
    fail_to_fork(reason);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0)
    return {};
  const auto split = said.find('\0');
  if (!WIFEXITED(status) || WEXITSTATUS(status) != refused || split == std::string::npos)
    return {Trial::Ending::died, {}, {}};
  constexpr std::size_t colon = 2;  // between the parts of the message
  return {Trial::Ending::refused, said.substr(0, split), said.substr(2 * split + 1 + colon)};
}

void check_survives(const std::string& file, const std::function<void()>& work) {
  constexpr std::uintmax_t always = std::uintmax_t{1} << 30U;
  constexpr std::uintmax_t per_byte = 64;
  std::error_code failed;
  const std::uintmax_t size = std::filesystem::file_size(file, failed);
  const Trial trial = tried(work, always + per_byte * (failed ? 0 : size));
  if (trial.ending == Trial::Ending::refused)
    throw InputError(trial.where, trial.what, "");
  if (trial.ending == Trial::Ending::died)
    throw InputError(file, "cannot be read: what it says of its contents contradicts itself",
                     "The file seems to be truncated or damaged");
}

}  // namespace lv
