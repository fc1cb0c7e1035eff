#pragma once

#include "lv/case_file/case.hpp"

#include <filesystem>

namespace lv::pipeline {

/// Runs the circulation of a case by itself, with an elastance for the left ventricle, and writes
///
///   cycle.csv            volumes, pressures and flows of every step
///   beats.csv            what a clinic says of every beat
///   pressure_volume.svg, wiggers.svg
///   circulation.txt      the last beat, in words
void make_circulation(const case_file::Case& c, const std::filesystem::path& folder);

}  // namespace lv::pipeline
