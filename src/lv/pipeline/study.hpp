#pragma once

#include "lv/pipeline/run.hpp"

namespace lv::pipeline {

/// Throws InputError where a factor of a case's study makes it one that cannot be run. The number
/// of cases that the study asks for, the case itself included; 0 without a study.
[[nodiscard]] int check_study(const case_file::Case& c);

/// Runs the family of heartbeats that [study] asks for: the case itself in its work folder, with
/// the fits that it asks for, and every other member, with what was fitted, in study/NAME of that
/// folder as `run` would; walls are made once. Members that are up to date are not run again.
/// After each, study/ holds of all that are there
///
///   study.csv   factors, measures of the last beat, lines through the loads
///   study.svg   loops, end-systolic relations, preload-recruitable stroke work
///   study.txt   the lines
///
/// Collective. Throws InputError before anything runs where the case asks for no study or a factor
/// makes it one that cannot be run, and what `run` throws.
void run_study(const case_file::Case& c, const RunOptions& options);

}  // namespace lv::pipeline
