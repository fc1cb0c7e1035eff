#include "lv/base/check.hpp"
#include "lv/base/parallel.hpp"
#include "lv/base/table.hpp"
#include "lv/heartbeat/immersed_beat.hpp"
#include "lv/job/read_case.hpp"
#include "lv/job/run.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <mpi.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <thread>

namespace {

/// What the command line asks for.
struct Command {
  std::string case_file;
  std::string new_file = "case.toml";
  std::string until;
  lv::job::RunOptions run;
  int ranks = 0;
  bool markdown = false;
};

/// Cores that this process may use, at most eight.
int default_ranks() {
  return std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, 8);
}

bool under_mpirun() {
  return std::getenv("OMPI_COMM_WORLD_SIZE") != nullptr;
}

/// Replaces this process by mpirun with as many copies of it.
void start_ranks(int ranks, char** argv) {
  setenv("OMPI_ALLOW_RUN_AS_ROOT", "1", 0);
  setenv("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1", 0);
  // shared memory without ptrace rights, which containers withhold
  setenv("OMPI_MCA_btl_vader_single_copy_mechanism", "none", 0);
  const std::string self = std::filesystem::read_symlink("/proc/self/exe");
  const std::string count = std::to_string(ranks);
  std::vector<const char*> args{"mpirun", "-q",          "--oversubscribe",
                                "-n",     count.c_str(), self.c_str()};
  for (char** arg = argv + 1; *arg != nullptr; ++arg)
    args.push_back(*arg);
  args.push_back(nullptr);
  execvp("mpirun", const_cast<char* const*>(args.data()));
  throw lv::RunError("mpirun cannot be started", "Install openmpi-bin, or use --ranks 1");
}

void write_new_case(const std::string& file) {
  if (std::filesystem::exists(file))
    throw lv::InputError(file, "exists already", "Choose another name");
  lv::write_file(file, lv::job::starter_case(std::filesystem::path(file).stem()));
  fmt::print("wrote {}; next: ventricle validate {}\n", file, file);
}

int run_parallel(Command& command, int argc, char** argv) {
  const lv::job::Case c =
      lv::job::read_case(command.case_file);  // mistakes are told before ranks start
  const int ranks = command.ranks > 0 ? command.ranks : default_ranks();
  if (!under_mpirun() && ranks > 1)
    start_ranks(ranks, argv);
  const lv::parallel::Session session(&argc, &argv);
  if (!command.until.empty())
    command.run.until = command.until;
  lv::job::run(c, command.run);
  return 0;
}

int validate(const Command& command, int argc, char** argv) {
  const lv::parallel::Session session(&argc, &argv);
  fmt::print("{}", lv::job::validate(lv::job::read_case(command.case_file)));
  return 0;
}

int dispatch(int argc, char** argv) {
  Command command;
  CLI::App app{"ventricle: left-ventricular mechanics from cardiac magnetic resonance"};
  app.require_subcommand(1);
  app.set_version_flag("--version", "ventricle " + lv::job::version());

  auto* start = app.add_subcommand("new", "write a commented starter case");
  start->add_option("FILE", command.new_file, "the case file to write")->capture_default_str();

  auto* check =
      app.add_subcommand("validate", "check a case, its anatomy and its mesh without running it");
  check->add_option("CASE", command.case_file, "the case file")->required();

  auto* run =
      app.add_subcommand("run", "run all stages of a case, skipping those that are up to date");
  run->add_option("CASE", command.case_file, "the case file")->required();
  run->add_option("--work", command.run.work,
                  "work folder (default: the case file's name with .work)");
  run->add_option("--until", command.until, "last stage: anatomy, mesh, beat or results");
  run->add_flag("--explain", command.run.explain, "say why each stage runs or does not");
  run->add_option("--ranks", command.ranks, "MPI ranks (default: the number of cores, at most 8)");

  auto* list = app.add_subcommand("parameters",
                                  "list every parameter: default, range, meaning, paper equation");
  list->add_flag("--markdown", command.markdown, "as the manual page");

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error);
  }
  if (*start)
    write_new_case(command.new_file);
  if (*check)
    return validate(command, argc, argv);
  if (*run)
    return run_parallel(command, argc, argv);
  if (*list)
    fmt::print("{}", lv::job::manual(command.markdown));
  return 0;
}

/// Reports a failure once, ends all ranks.
int fail(const std::string& message, int code) {
  int running = 0;
  int finished = 0;
  int rank = 0;
  MPI_Initialized(&running);
  MPI_Finalized(&finished);
  const bool parallel = running != 0 && finished == 0;
  if (parallel)
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  if (rank != 0)
    sleep(2);  // the root says it, unless the trouble is this rank's alone
  fmt::print(stderr, "ventricle: {}\n", message);
  std::fflush(nullptr);
  if (parallel)
    MPI_Abort(MPI_COMM_WORLD, code);
  return code;
}

}  // namespace

/// Exit codes: 0 done, 1 wrong input or a failed verification, 2 a run that could not go on, 3 a
/// defect of the program, 130 interrupted with a checkpoint.
int main(int argc, char** argv) {
  try {
    return dispatch(argc, argv);
  } catch (const lv::InputError& error) {
    return fail(error.what(), 1);
  } catch (const lv::heartbeat::Interrupted& stop) {
    return fail(stop.what(), 130);
  } catch (const lv::RunError& error) {
    return fail(error.what(), 2);
  } catch (const std::exception& error) {
    return fail(error.what(), 3);
  }
}
