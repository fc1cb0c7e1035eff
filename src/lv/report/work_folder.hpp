#pragma once

#include "lv/base/table.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace lv::report {

/// The folder of a stage ("beat") in a case's work folder, or what there is of it before it is
/// finished; empty if neither.
[[nodiscard]] std::filesystem::path folder_of(const std::filesystem::path& work,
                                              const std::string& stage);

/// A file of a stage; empty if it is not there.
[[nodiscard]] std::filesystem::path file_of(const std::filesystem::path& work,
                                            const std::string& stage, const std::string& file);

/// A table of a stage; nothing where it is missing or has no row.
[[nodiscard]] std::optional<Table> table_of(const std::filesystem::path& work,
                                            const std::string& stage, const std::string& file);

/// Leaves a case's name in its work folder, as `case.txt`: before there are results no other file
/// has it. Throws RunError naming a file that cannot be written.
void write_case_name(const std::filesystem::path& work, const std::string& name);

/// The name that a run left in its work folder; empty where none did.
[[nodiscard]] std::string case_name(const std::filesystem::path& work);

/// The moments of the beat, with their times, by its moments.csv [s].
[[nodiscard]] std::vector<std::pair<std::string, double>> moments_of(
    const std::filesystem::path& work);

/// When the beat was at a moment of that name, by its moments.csv; nothing when it has not been
/// there [s].
[[nodiscard]] std::optional<double> time_of(const std::filesystem::path& work,
                                            const std::string& moment);

}  // namespace lv::report
