#pragma once

#include "lv/heartbeat/beat.hpp"
#include "lv/heartbeat/protocol.hpp"

#include <vector>

namespace lv::heartbeat {

/// Simulated time that a phase will probably still last, `time` after its start, with the volumes
/// recorded so far [s]: until its usual duration that, then as long as the variation of the volume,
/// which falls about exponentially, takes to its tolerance. Not less than the last volume that is
/// out of tolerance beside the present one takes to leave the window, nor more than the phase may
/// last.
[[nodiscard]] double settling_time_left(const Phase& phase, double time,
                                        const SteadyVolume& volume);

/// The phases with the time that this wall, of which `beat` has the curves so far, will probably
/// take in each: ramp, window, and a share of the usual time to come to rest. A wall whose volume
/// swings back while it is filled is stiff for the blood that it moves; until it is filled the
/// share is a third. Afterwards a filling that took a third of its usual time to come to rest
/// foretells as much of contraction, two thirds or more all of it, and what lies between in
/// proportion (docs/verification.md, Time left).
[[nodiscard]] std::vector<Phase> phases_of_wall(std::vector<Phase> phases, const Beat& beat);

}  // namespace lv::heartbeat
