#pragma once

#include "lv/heartbeat/protocol.hpp"

namespace lv::heartbeat {

/// Simulated time that a phase will probably still last, `time` after its start, with the volumes
/// recorded so far [s]: until its usual duration that, then as long as the variation of the volume,
/// which falls about exponentially, takes to its tolerance. Not less than the last volume that is
/// out of tolerance beside the present one takes to leave the window, nor more than the phase may
/// last.
[[nodiscard]] double settling_time_left(const Phase& phase, double time,
                                        const SteadyVolume& volume);

/// How long a phase usually takes after the filling of the same wall took so long [s]: muscle that
/// came to rest sooner than usual under a pressure does so under tension, since it is stiffer. One
/// that came later says nothing.
[[nodiscard]] double usual_after_filling(const Phase& phase, const Phase& filling, double took);

}  // namespace lv::heartbeat
