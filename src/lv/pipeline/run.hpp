#pragma once

#include "lv/case_file/case.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace lv::pipeline {

struct RunOptions {
  std::filesystem::path work;        ///< work folder; empty: the case file's name with .work
  std::optional<std::string> until;  ///< last stage to run, by its name
  bool explain = false;              ///< say why each stage runs or does not
  bool dry_run = false;              ///< say what would run, and run nothing
  bool quiet = false;                ///< print no results
};

/// The work folder of a case.
[[nodiscard]] std::filesystem::path work_folder(const case_file::Case& c,
                                                const RunOptions& options);

/// Runs all stages of a case, skipping those whose inputs, parameters and program version are
/// unchanged:
///
///   circulation by itself                                 00_circulation/, of cases that have one
///   strain    of the muscle, from cine images             00_strain/, for cases that have them
///   anatomy   the surfaces of the wall                    01_anatomy/
///   mesh      elements, fibres, regions, quality          02_mesh/
///   calibrate parameters from measured volumes            02b_calibrate/, for cases that ask for it
///   unload    the wall without load                       02c_unload/, where it was seen under load
///   beat      filling and contraction                     03_beat/
///   results   tables, summary, pictures                   04_results/
///   report    the page, a script for ParaView             05_report/
///
/// Collective: every rank calls it.
void run(const case_file::Case& c, const RunOptions& options);

/// What a page may take the place of: where nobody chose its name, of that of the same runs alone.
enum class Replaces { any_page, page_of_same_runs };

/// Writes one self-contained page about what one work folder holds, or two side by side; a run that
/// is unfinished may be among them. Throws InputError when a folder holds no results of a run.
void write_page(const std::vector<std::filesystem::path>& works, const std::filesystem::path& file,
                Replaces replaces);

/// The most ranks that a box of these cells can be shared by.
[[nodiscard]] int most_ranks(const std::array<int, 3>& cells);

/// Times the kernels of a step on the idealised ventricle (see lv/bench); collective. Text for a
/// terminal, or one JSON object, on the root.
struct BenchOptions {
  std::vector<int> cells{96, 96, 128};
  double edge_length = 1.4;  ///< [mm]
  bool quadrature = false;   ///< the paper's coupling
  bool json = false;
};
[[nodiscard]] std::string bench(const BenchOptions& options);

}  // namespace lv::pipeline
