#pragma once

#include "lv/case_file/case.hpp"
#include "lv/heartbeat/base_motion.hpp"

#include <filesystem>
#include <string>

namespace lv::beating_wall {

/// The case with the motion that its strain stage has left in the folder `strain` named as a table.
[[nodiscard]] case_file::Case with_base_of_cine(case_file::Case c,
                                                const std::filesystem::path& strain);

/// The table base.motion_file of a case that has one. Throws InputError for one that does not hold
/// a beat of the case (heartbeat::read_motion).
[[nodiscard]] heartbeat::MeasuredMotion measured_base_motion(const case_file::Case& c);

/// How the base of a case moves over a beat, as the table base.motion_file says; one that stays
/// without it. Throws InputError as measured_base_motion.
[[nodiscard]] heartbeat::BaseMotion base_motion(const case_file::Case& c, const mesh::Mesh& mesh);

/// What is odd about that table, in words: a base that goes away from the apex instead of towards
/// it. Throws InputError as measured_base_motion.
[[nodiscard]] std::string base_away_from_apex(const case_file::Case& c);

}  // namespace lv::beating_wall
