#include "lv/base/launch.hpp"

#include <catch2/catch.hpp>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <utility>
#include <vector>

namespace {

using Variables = std::vector<std::pair<const char*, const char*>>;

/// The size of the world in a process with these variables alone.
int size_with(const Variables& variables) {
  const pid_t child = fork();
  if (child == 0) {
    clearenv();
    for (const auto& [name, value] : variables)
      setenv(name, value, 1);
    _exit(lv::launch::world_size());
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WEXITSTATUS(status);
}

}  // namespace

TEST_CASE("a process that nobody launched is alone", "[unit][base]") {
  CHECK(size_with({}) == 1);
}

TEST_CASE("mpirun's number of ranks is the size of the world", "[unit][base]") {
  CHECK(size_with({{"OMPI_COMM_WORLD_SIZE", "3"}, {"PMIX_RANK", "0"}}) == 3);
  CHECK(size_with({{"OMPI_COMM_WORLD_SIZE", "1"}, {"PMIX_RANK", "0"}}) == 1);
}

TEST_CASE("a shell of Slurm, with the variables of one rank, is alone", "[unit][base]") {
  CHECK(size_with({{"PMI_RANK", "0"}, {"PMI_SIZE", "1"}}) == 1);
  CHECK(size_with({{"PMIX_RANK", "0"}, {"SLURM_STEP_NUM_TASKS", "1"}, {"SLURM_NTASKS", "8"}}) == 1);
  CHECK(size_with({{"PMIX_RANK", "0"}}) == 1);
}

TEST_CASE("srun's number of tasks is the size of the world", "[unit][base]") {
  CHECK(size_with({{"PMI_RANK", "0"}, {"PMI_SIZE", "4"}}) == 4);
  CHECK(size_with({{"PMIX_RANK", "2"}, {"SLURM_STEP_NUM_TASKS", "4"}}) == 4);
  CHECK(size_with({{"SLURM_NTASKS", "4"}}) == 1);
}

TEST_CASE("variables that hold no number say nothing", "[unit][base]") {
  CHECK(size_with({{"OMPI_COMM_WORLD_SIZE", "many"}, {"PMI_SIZE", "-3"}}) == 1);
}
