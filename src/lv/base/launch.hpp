#pragma once

#include <string>
#include <vector>

/// Copies of this program as processes of their own, alone or on several MPI ranks.
namespace lv::launch {

/// Whether mpirun has started this process.
[[nodiscard]] bool under_mpirun();

/// How many processes a launcher has started together with this one, and which of them it is, as
/// the environment says before MPI is there: 1 and 0 where it says nothing.
[[nodiscard]] int ranks();
[[nodiscard]] int rank();

/// Runs `ranks` copies of this program under mpirun with these arguments, waits for them and
/// returns their exit code. SIGINT and SIGTERM reach the ranks as SIGUSR1 (see interrupt.hpp):
/// mpirun itself would kill them before a checkpoint is written. Throws RunError when mpirun is
/// missing.
[[nodiscard]] int run_in_front(int ranks, const std::vector<std::string>& arguments);

/// Runs `ranks` copies of this program with these arguments, waits for them and returns their exit
/// code (128 + signal when they were killed). What they print goes to stderr. The caller must not
/// hold MPI itself.
[[nodiscard]] int run(int ranks, const std::vector<std::string>& arguments);

}  // namespace lv::launch
