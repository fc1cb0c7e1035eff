#pragma once

#include "lv/anatomy/mesh_result.hpp"
#include "lv/beating_wall/heartbeat_record.hpp"
#include "lv/case_file/beat_fit.hpp"

#include <filesystem>
#include <optional>

namespace lv::beating_wall {

/// Fits the heartbeats of a case's wall in its circulation to what was measured of them.
/// case_file::beat_fit says by which parameters; calibrate::search_root looks for their logarithms.
/// Every evaluation is beats of the wall up to their limit cycle, from where the beats of the
/// nearest evaluation before it had come to, with the arteries' pressure and the slopes that a
/// circulation::StandIn for the wall foretells. Sensitivities are differences of the wall's own
/// beats, with each parameter 5% larger. Where there is a coarse wall, both are found on it first;
/// the search on the case's own then begins where that has ended, with those sensitivities.
///
/// What was evaluated is kept in `folder`; a fit that was stopped goes on from there. Writes
/// heartbeats.json, heartbeats.txt and heartbeats.csv (every evaluation). Throws InputError for
/// data out of reach, with what the model comes to; RunError where there are no heartbeats to begin
/// with, or the search comes to no end. Collective.
HeartbeatFit fit_heartbeats(const case_file::Case& asked, const anatomy::MeshResult& wall,
                            const anatomy::MeshResult* coarse, const std::filesystem::path& folder);

/// The case with large elements, on which its heartbeats are to be fitted first; nothing where its
/// own are not much smaller, or the wall is none that is meshed anew as it is.
[[nodiscard]] std::optional<case_file::Case> with_coarse_wall(const case_file::Case& c);
inline constexpr const char* coarse_wall_name = "coarse_beats";  ///< folder of that wall's mesh

}  // namespace lv::beating_wall
