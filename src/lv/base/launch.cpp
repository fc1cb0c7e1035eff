#include "lv/base/launch.hpp"

#include "lv/base/check.hpp"

#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <initializer_list>

namespace lv::launch {
namespace {

/// `sharing`: the cores belong to others too, so ranks are not tied to them.
std::vector<std::string> command_line(int ranks, bool sharing,
                                      const std::vector<std::string>& arguments) {
  const std::string self = std::filesystem::read_symlink("/proc/self/exe");
  std::vector<std::string> command;
  if (ranks > 1) {
    command = {"mpirun", "-q", "--oversubscribe", "-n", std::to_string(ranks)};
    if (sharing)
      command.insert(command.end(), {"--bind-to", "none"});
  }
  command.push_back(self);
  command.insert(command.end(), arguments.begin(), arguments.end());
  return command;
}

void allow_mpirun() {
  setenv("OMPI_ALLOW_RUN_AS_ROOT", "1", 0);
  setenv("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1", 0);
  // shared memory without ptrace rights, which containers withhold
  setenv("OPENBLAS_NUM_THREADS", "1", 0);  // one rank per core is the model
  setenv("OMPI_MCA_btl_vader_single_copy_mechanism", "none", 0);
}

volatile std::sig_atomic_t ranks_process = 0;

/// mpirun passes SIGUSR1 on to its ranks.
void ask_ranks_to_stop(int /*signal*/) {
  kill(ranks_process, SIGUSR1);
}

/// The exit code of a child once it has ended, 128 + signal when it was killed.
int wait_for(pid_t child) {
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

constexpr int cannot_start = 127;

/// Returns only when the program cannot be started.
void execute(std::vector<std::string> command) {
  std::vector<char*> args;
  for (std::string& argument : command)
    args.push_back(argument.data());
  args.push_back(nullptr);
  execvp(args[0], args.data());
}

/// The number in the first of these variables that is set.
int number_in(std::initializer_list<const char*> names, int otherwise) {
  for (const char* name : names)
    if (const char* text = std::getenv(name); text != nullptr)
      return std::atoi(text);
  return otherwise;
}

}  // namespace

int ranks() {
  return number_in({"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"}, 1);
}

int rank() {
  return number_in({"OMPI_COMM_WORLD_RANK", "PMI_RANK"}, 0);
}

bool under_mpirun() {
  // set by OpenMPI's mpirun, and by other launchers such as Slurm's srun
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_RANK"})
    if (std::getenv(name) != nullptr)
      return true;
  return false;
}

int run_in_front(int ranks, const std::vector<std::string>& arguments) {
  const std::vector<std::string> command = command_line(ranks, false, arguments);
  ranks_process = fork();
  if (ranks_process < 0)
    throw RunError("a process cannot be started", "Is the machine out of memory?");
  if (ranks_process == 0) {
    setpgid(0, 0);                     // the terminal's Ctrl-C is for the process in front
    prctl(PR_SET_PDEATHSIG, SIGTERM);  // and this one ends with it
    allow_mpirun();
    if (freopen("/dev/null", "r", stdin) != nullptr)
      execute(command);
    _exit(cannot_start);
  }
  std::signal(SIGINT, ask_ranks_to_stop);
  std::signal(SIGTERM, ask_ranks_to_stop);
  const int code = wait_for(ranks_process);
  if (code == cannot_start)
    throw RunError("mpirun cannot be started", "Install openmpi-bin, or use --ranks 1");
  return code;
}

int run(int ranks, const std::vector<std::string>& arguments) {
  const std::vector<std::string> command = command_line(ranks, true, arguments);
  const pid_t child = fork();
  if (child < 0)
    throw RunError("a process cannot be started", "Is the machine out of memory?");
  if (child == 0) {
    allow_mpirun();
    dup2(STDERR_FILENO, STDOUT_FILENO);
    execute(command);
    _exit(cannot_start);
  }
  return wait_for(child);
}

}  // namespace lv::launch
