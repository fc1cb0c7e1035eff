#include "lv/verify/run.hpp"

#include "lv/base/check.hpp"
#include "lv/base/interrupt.hpp"
#include "lv/base/launch.hpp"
#include "lv/base/log.hpp"
#include "lv/base/parallel.hpp"
#include "lv/base/table.hpp"
#include "lv/verify/problem.hpp"

#include <fmt/format.h>
#include <stdlib.h>  // mkdtemp

#include <algorithm>
#include <chrono>

namespace lv::verify {
namespace {

/// A new folder that vanishes with this object.
class ScratchFolder {
 public:
  ScratchFolder() {
    std::string name = std::filesystem::temp_directory_path() / "ventricle_verify_XXXXXX";
    if (mkdtemp(name.data()) == nullptr)
      throw RunError("no temporary folder can be made", "Set TMPDIR to a folder with space");
    path_ = name;
  }
  ~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

std::filesystem::path findings_file(const std::filesystem::path& folder, int ranks) {
  return folder / fmt::format("found_on_{}", ranks);
}

/// The quantities of one problem, and one that fails when the problem did not end well.
std::vector<Quantity> solve_apart(const Problem& problem, int ranks,
                                  const std::filesystem::path& folder) {
  const int code = launch::run(ranks, {"verify", problem.name, solve_option, folder.string()});
  interrupt::check();
  std::vector<Quantity> found = read(findings_file(folder, ranks));
  if (code != 0 || found.empty())
    found.push_back({problem.name, fmt::format("exit code on {} ranks", ranks),
                     static_cast<double>(code == 0 ? -1 : code), 0.0, 0.0, ""});
  return found;
}

/// On how many ranks a problem is solved, one after the other; `several` replaces those that are
/// more than one, if it is not 0.
std::vector<int> rank_counts(const Problem& problem, int several) {
  std::vector<int> counts = problem.ranks;
  if (several > 0)
    for (int& count : counts)
      count = count > 1 ? several : count;
  counts.erase(std::unique(counts.begin(), counts.end()), counts.end());
  return counts;
}

/// Leaves the tables that a problem made.
void keep_tables(const std::filesystem::path& scratch, const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  for (const auto& entry : std::filesystem::directory_iterator(scratch))
    if (entry.path().extension() == ".csv" && entry.path().filename() != constants_file)
      std::filesystem::copy_file(entry.path(), folder / entry.path().filename(),
                                 std::filesystem::copy_options::overwrite_existing);
}

std::vector<Quantity> solve_all(const Problem& problem, const Options& options) {
  const int several = options.ranks;
  const ScratchFolder scratch;
  if (!options.constants.empty())
    write_file(scratch.path() / constants_file, read_file(options.constants));
  std::vector<Quantity> all;
  for (const int ranks : rank_counts(problem, several)) {
    const auto start = std::chrono::steady_clock::now();
    const std::vector<Quantity> found = solve_apart(problem, ranks, scratch.path());
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    const auto failed =
        std::count_if(found.begin(), found.end(), [](const Quantity& q) { return !q.pass(); });
    fmt::print(stderr, "{:<28} {} rank{}  {:>7.1f} s  {}\n", problem.name, ranks,
               ranks == 1 ? " " : "s", elapsed.count(),
               failed == 0 ? "pass" : fmt::format("{} of {} FAIL", failed, found.size()));
    all.insert(all.end(), found.begin(), found.end());
  }
  if (!options.tables.empty())
    keep_tables(scratch.path(), options.tables);
  return all;
}

/// Throws InputError where the table of constants is for none of them.
void check_constants(const std::vector<const Problem*>& problems, const Options& options) {
  for (const Problem* p : problems)
    if (!options.constants.empty() && !p->has_constants)
      throw InputError("--constants", fmt::format("is given, but {} has none to choose", p->name),
                       "Name the problems that the table is for: arostica_0a, arostica_0b, "
                       "arostica_1");
}

std::vector<const Problem*> chosen(const Options& options) {
  std::vector<const Problem*> result;
  for (const std::string& name : options.names)
    result.push_back(&problem(name));
  if (options.names.empty())
    for (const Problem& p : problems())
      if (p.length == Length::brief || options.nightly)
        result.push_back(&p);
  return result;
}

}  // namespace

bool run(const Options& options) {
  std::vector<Quantity> all;
  const std::vector<const Problem*> problems = chosen(options);
  check_constants(problems, options);
  for (const Problem* p : problems) {
    const std::vector<Quantity> found = solve_all(*p, options);
    if (options.json)
      for (const Quantity& q : found)
        fmt::print("{}\n", json_line(q));
    std::fflush(stdout);
    all.insert(all.end(), found.begin(), found.end());
  }
  if (!options.json)
    fmt::print("{}", text_table(all));
  return std::all_of(all.begin(), all.end(), [](const Quantity& q) { return q.pass(); });
}

std::string list() {
  std::string text;
  for (const Problem& p : problems())
    text += fmt::format(
        "{:<28} {:<8} {:<12} {}\n", p.name, p.length == Length::nightly ? "nightly" : "brief",
        fmt::format("{} rank{}", fmt::join(p.ranks, ","), p.ranks.back() == 1 ? "" : "s"),
        p.proves);
  return text;
}

void solve(const std::string& name, const std::filesystem::path& folder) {
  Findings found(name, folder);
  problem(name).solve(found);
  if (parallel::is_root())
    write(findings_file(folder, parallel::size()), found.quantities());
}

}  // namespace lv::verify
