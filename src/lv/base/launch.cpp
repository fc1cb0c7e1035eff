#include "lv/base/launch.hpp"

#include "lv/base/check.hpp"
#include "lv/base/interrupt.hpp"
#include "lv/base/processors.hpp"

#include <fmt/format.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string_view>

namespace lv::launch {
namespace {

/// The first of these variables that is set to a number.
std::optional<int> number_in(std::initializer_list<const char*> variables) {
  for (const char* name : variables)
    if (const char* text = std::getenv(name)) {
      char* end = nullptr;
      const long value = std::strtol(text, &end, 10);
      if (end != text && *end == '\0' && value >= 0 && value < 1'000'000)
        return static_cast<int>(value);
    }
  return {};
}

bool is_set(const char* variable) {
  return std::getenv(variable) != nullptr;
}

/// Whether the ranks may each have a core of their own: no others use the machine's cores, and
/// this process may use all of them.
bool cores_are_ours(int ranks, bool sharing) {
  return !sharing && ranks <= processors() && processors() >= sysconf(_SC_NPROCESSORS_ONLN);
}

/// `sharing`: the cores belong to others too, so ranks are not tied to them.
std::vector<std::string> command_line(int ranks, bool sharing,
                                      const std::vector<std::string>& arguments) {
  const std::string self = std::filesystem::read_symlink("/proc/self/exe");
  std::vector<std::string> command;
  if (ranks > 1) {
    command = {"mpirun", "-q", "--oversubscribe", "-n", std::to_string(ranks)};
    if (!cores_are_ours(ranks, sharing))
      command.insert(command.end(), {"--bind-to", "none"});
  }
  command.push_back(self);
  command.insert(command.end(), arguments.begin(), arguments.end());
  return command;
}

/// Takes away what a launcher has told this process of its place among ranks: mpirun refuses to
/// start under another, and a process that is alone has no place.
void forget_launcher() {
  constexpr std::array<std::string_view, 7> prefixes{
      "PMIX_",          "PMI_",         "OMPI_COMM_WORLD_", "OMPI_UNIVERSE_SIZE",
      "OMPI_MCA_orte_", "OMPI_MCA_ess", "OMPI_MCA_pmix"};
  std::vector<std::string> names;
  for (char** variable = environ; variable != nullptr && *variable != nullptr; ++variable) {
    const std::string_view text(*variable);
    if (std::any_of(prefixes.begin(), prefixes.end(),
                    [&](std::string_view prefix) { return text.starts_with(prefix); }))
      names.emplace_back(text.substr(0, text.find('=')));
  }
  for (const std::string& name : names)
    unsetenv(name.c_str());
}

void allow_mpirun(int ranks) {
  forget_launcher();
  setenv("OMPI_ALLOW_RUN_AS_ROOT", "1", 0);
  setenv("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1", 0);
  // shared memory without ptrace rights, which containers withhold
  setenv("OMPI_MCA_btl_vader_single_copy_mechanism", "none", 0);
  if (ranks > processors())
    setenv("OMPI_MCA_mpi_yield_when_idle", "1", 0);
  if (isatty(STDOUT_FILENO) == 0)
    setenv("NO_COLOR", "1", 0);  // ranks write to a terminal that mpirun makes, whoever reads it
}

volatile std::sig_atomic_t times_asked = 0;

void note(int /*signal*/) {
  times_asked = times_asked + 1;
}

/// Tells a child to stop: at first by SIGUSR1, which mpirun passes on to its ranks, again and
/// again, since what is just starting does not hear it. A child that was told twice, or does not
/// end for long after its ranks should have, is ended. `n` counts pauses since the first request.
void pass_on(pid_t child, int times, int n) {
  constexpr int second = 50;  // pauses
  constexpr int long_after = static_cast<int>(interrupt::patience) + 10;
  if (n % second != 0)
    return;
  if (n > (long_after + 5) * second)
    kill(child, SIGKILL);
  else if (times > 1 || n > long_after * second)
    kill(child, SIGTERM);
  else
    kill(child, SIGUSR1);
}

/// The exit code of a child once it has ended, 128 + signal when it was killed. `asked` says how
/// often this process was asked to stop.
template <class Asked>
int wait_for(pid_t child, const Asked& asked) {
  constexpr useconds_t pause = 20'000;  // [us]
  int status = 0;
  for (int since_asked = 0;;) {
    const pid_t ended = waitpid(child, &status, WNOHANG);
    if (ended == child || (ended < 0 && errno != EINTR))
      break;
    if (asked() > 0)
      pass_on(child, asked(), since_asked++);
    usleep(pause);
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

constexpr int cannot_start = 127;

/// Becomes another program, deaf to SIGUSR1 until that listens; ends this process if it cannot.
[[noreturn]] void become(std::vector<std::string> command) {
  std::vector<char*> args;
  for (std::string& argument : command)
    args.push_back(argument.data());
  args.push_back(nullptr);
  std::signal(SIGUSR1, SIG_IGN);
  for (const int signal : {SIGINT, SIGTERM})
    std::signal(signal, SIG_DFL);
  execvp(args[0], args.data());
  _exit(cannot_start);
}

/// Starts a child that `prepare`s itself and then becomes a command.
template <class Prepare>
pid_t start(const std::vector<std::string>& command, const Prepare& prepare) {
  std::signal(SIGCHLD, SIG_DFL);  // whoever started this process may have ignored it
  const pid_t child = fork();
  if (child < 0)
    throw RunError(fmt::format("a process cannot be started: {}", std::strerror(errno)),
                   "Is the machine out of memory, or is the number of processes limited?");
  if (child == 0) {
    prctl(PR_SET_PDEATHSIG, SIGTERM);  // it ends with this process
    prepare();
    become(command);
  }
  return child;
}

/// Whether mpirun manages to start anything at all; says nothing.
bool mpirun_works() {
  const pid_t child = start({"mpirun", "-q", "-n", "1", "true"}, [] {
    allow_mpirun(1);
    for (FILE* stream : {stdout, stderr})
      if (freopen("/dev/null", "w", stream) == nullptr)
        _exit(cannot_start);
  });
  return wait_for(child, [] { return 0; }) == 0;
}

bool has_network() {
  ifaddrs* all = nullptr;
  if (getifaddrs(&all) != 0)
    return true;  // not known
  bool found = false;
  for (const ifaddrs* one = all; one != nullptr; one = one->ifa_next)
    found = found || (one->ifa_addr != nullptr && one->ifa_addr->sa_family == AF_INET &&
                      (one->ifa_flags & IFF_UP) != 0U);
  freeifaddrs(all);
  return found;
}

/// What a user should know of ranks that did not end by themselves.
void explain(int code) {
  if (code == cannot_start)
    throw RunError("mpirun cannot be started", "Install openmpi-bin, or use --ranks 1");
  if (code > 128 && code != interrupt::exit_code)
    throw RunError(
        fmt::format("the ranks were ended by signal {} ({})", code - 128, strsignal(code - 128)),
        "Was the memory exhausted? Run the same command again to go on where they were");
  if (code == 1 && !mpirun_works())
    throw RunError("mpirun cannot start ranks on this machine; what it says stands above",
                   "Use --ranks 1");
}

}  // namespace

int world_size() {
  if (const auto size = number_in({"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"}))
    return std::max(*size, 1);
  if (is_set("PMIX_RANK") || is_set("PMI_RANK"))
    return std::max(number_in({"SLURM_STEP_NUM_TASKS", "SLURM_NTASKS"}).value_or(1), 1);
  return 1;
}

int world_rank() {
  return number_in({"OMPI_COMM_WORLD_RANK", "PMIX_RANK", "PMI_RANK"}).value_or(0);
}

std::string hindrance() {
  if (!has_network())
    return "ranks talk over the network at first, and this machine has none, not even to itself";
  return "";
}

void prepare() {
  if (world_size() > 1) {
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    return;
  }
  forget_launcher();
  for (const auto& [name, value] :
       {std::pair{"ess_singleton_isolated", "1"},
        {"orte_create_session_dirs", "0"},
        {"btl", "self"},
        {"if", "linux_ipv6"}})  // which alone does not complain where there is no network
    setenv((std::string("OMPI_MCA_") + name).c_str(), value, 1);
}

int run_in_front(int ranks, const std::vector<std::string>& arguments) {
  if (const std::string why = hindrance(); !why.empty())
    throw RunError(fmt::format("{} ranks cannot be started: {}", ranks, why), "Use --ranks 1");
  const std::vector<std::string> command = command_line(ranks, false, arguments);
  std::signal(SIGINT, note);
  std::signal(SIGTERM, note);
  const pid_t child = start(command, [&] {
    setpgid(0, 0);  // the terminal's Ctrl-C is for the process in front
    allow_mpirun(ranks);
    if (freopen("/dev/null", "r", stdin) == nullptr)
      _exit(cannot_start);
  });
  const int code = wait_for(child, [] { return static_cast<int>(times_asked); });
  if (times_asked > 0 && code > 3 && code != interrupt::exit_code)
    throw Interrupted("stopped; run the same command again to go on");
  explain(code);
  return code;
}

int run(int ranks, const std::vector<std::string>& arguments) {
  const pid_t child = start(command_line(ranks, true, arguments), [&] {
    setpgid(0, 0);
    allow_mpirun(ranks);
    dup2(STDERR_FILENO, STDOUT_FILENO);
  });
  return wait_for(child, [] { return interrupt::requested() ? 1 : 0; });
}

}  // namespace lv::launch
