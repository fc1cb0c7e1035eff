#pragma once

#include <string>
#include <vector>

/// Copies of this program as processes of their own, alone or on several MPI ranks.
namespace lv::launch {

/// How many ranks whoever started this process has started together: mpirun, or another launcher
/// such as Slurm's srun. 1 without one, as in an interactive shell of Slurm, whose variables tell
/// of a rank too.
[[nodiscard]] int world_size();

/// The number of this process among them, from 0.
[[nodiscard]] int world_rank();

/// Why this machine cannot start several ranks, in words; empty when nothing speaks against it.
[[nodiscard]] std::string hindrance();

/// To be called before MPI is started. In a process that is alone it then starts without a network,
/// a folder for temporary files, or a program to be found by PATH; one of several ranks is asked to
/// stop when its launcher dies.
void prepare();

/// Runs `ranks` copies of this program under mpirun with these arguments, waits for them and
/// returns their exit code. SIGINT and SIGTERM reach the ranks as SIGUSR1 (see interrupt.hpp):
/// mpirun itself would kill them before a checkpoint is written. Ranks beyond the processors of
/// this process give way to each other while they wait. Throws RunError when mpirun cannot start
/// them, or something has killed them.
[[nodiscard]] int run_in_front(int ranks, const std::vector<std::string>& arguments);

/// Runs `ranks` copies of this program with these arguments, waits for them and returns their exit
/// code (128 + signal when they were killed). What they print goes to stderr. A request to stop
/// (interrupt.hpp) is passed on to them. The caller must not hold MPI itself.
[[nodiscard]] int run(int ranks, const std::vector<std::string>& arguments);

}  // namespace lv::launch
