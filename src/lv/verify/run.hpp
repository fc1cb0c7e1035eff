#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace lv::verify {

struct Options {
  std::vector<std::string> names;  ///< empty: all short problems
  bool nightly = false;            ///< without names: the long problems too
  bool json = false;               ///< one JSON object a line instead of a table
  int ranks = 0;  ///< on which problems of several ranks are solved; 0: as each of them asks
  std::string constants;  ///< a table of other constants for the problems that have some; or empty
  std::string tables;     ///< the folder that gets the problems' tables (CSV); or empty
};

/// The name of the table of constants in a problem's scratch folder.
inline constexpr const char* constants_file = "constants.csv";

/// Solves problems, each in a process of its own on as many ranks as it asks for, and prints what
/// they found. Returns whether all quantities pass. Throws Interrupted when asked to stop. The
/// caller must not hold MPI.
[[nodiscard]] bool run(const Options& options);

/// The problems and what each proves.
[[nodiscard]] std::string list();

/// Solves one problem on the ranks of this process and leaves its quantities in `folder`;
/// collective.
void solve(const std::string& name, const std::filesystem::path& folder);

/// Argument that makes a copy of the program call `solve` with this folder.
inline constexpr const char* solve_option = "--solve-in";

}  // namespace lv::verify
