#pragma once

#include "lv/base/table.hpp"
#include "lv/case_file/case.hpp"
#include "lv/heartbeat/observers.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace lv::pipeline {

/// Runs the circulation of a case by itself, with an elastance for the left ventricle, and writes
///
///   cycle.csv            volumes, pressures and flows of every step
///   beats.csv            what a clinic says of every beat
///   pressure_volume.svg, wiggers.svg
///   circulation.txt      the last beat, in words
void make_circulation(const case_file::Case& c, const std::filesystem::path& folder);

/// Runs heartbeats of the case's wall joined to its circulation in `folder`, each node activated
/// when `activation_times` say; collective.
[[nodiscard]] heartbeat::Beat make_cycle(const case_file::Case& c, const mesh::Mesh& mesh,
                                         const std::vector<double>& activation_times,
                                         const std::filesystem::path& folder,
                                         const heartbeat::Observers& observers);

/// Throws InputError unless heartbeats of this mesh can begin where those of cycle.begin have
/// ended.
void check_begin(const case_file::Case& c, const mesh::Mesh& mesh);

/// cycle.csv and beats.csv of heartbeats, and their figures pressure_volume.svg and wiggers.svg,
/// with calcium and tension from curves.csv where there is a wall.
void write_cycle_tables(const circulation::Cycle& cycle, const std::filesystem::path& folder);
void write_cycle(const circulation::Cycle& cycle, const std::optional<Table>& curves,
                 const std::filesystem::path& folder);

/// How the heartbeats of a case ended, in words.
[[nodiscard]] std::string cycle_end(const circulation::Cycle& cycle);

/// What is to be known of heartbeats before their numbers are taken for a person's.
[[nodiscard]] std::vector<std::string> cycle_warnings(const case_file::Case& c,
                                                      const circulation::Cycle& cycle);

/// Of Niederer's law in a cycle; empty of other laws and protocols.
[[nodiscard]] std::string slow_relaxation(const case_file::Case& c);

/// Of heartbeats in which healthy systole lasts a tenth shorter or longer than at the usual rate,
/// where a wall's calcium stays what the case says; empty of others.
[[nodiscard]] std::string calcium_beside_rate(const case_file::Case& c);

/// Of chambers of a closed loop whose contraction is said to begin after the beat's end, and so
/// begins as much earlier in every beat; empty: there is none.
[[nodiscard]] std::string chamber_beyond_beat(const case_file::Case& c);

}  // namespace lv::pipeline
