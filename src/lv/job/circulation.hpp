#pragma once

#include "lv/job/case.hpp"

#include <filesystem>

namespace lv::job {

/// Runs the circulation of a case by itself, with an elastance for the left ventricle, and writes
///
///   cycle.csv            volumes, pressures and flows of every step
///   beats.csv            what a clinic says of every beat
///   pressure_volume.svg, wiggers.svg
///   circulation.txt      the last beat, in words
void make_circulation(const Case& c, const std::filesystem::path& folder);

}  // namespace lv::job
