#pragma once

#include "lv/heartbeat/cycle_record.hpp"
#include "lv/heartbeat/immersed_beat.hpp"

#include <filesystem>

namespace lv::heartbeat {

/// Heartbeats of the wall in its box of blood, joined to a circulation: the pressure on the
/// endocardium is in every step the one under which the cavity's volume at its end is that of the
/// circuit, which takes an implicit step beside it. A step is linear in the pressure
/// (immersed::Model::step), so that one more unknown is found without iterating wall and blood. The
/// wall feels at the beginning of a step the pressure that the circuit has at its end.
///
/// The wall starts at rest in its blood, filled without any tension to the pressure before the
/// mitral valve as the protocol fills (phases()); then its muscle is brought to a balance with
/// resting calcium. Calcium, moments and the end of the beats are those of run_cycle. The cavity is
/// open to the box; what flows there is the blood between the valves and the circuit.
///
/// A base that moves (setup.base_motion) is taken to where a beat begins while the wall is filled.
/// The cavity's volume in the circuit is what its endocardium sweeps against the lid on its opening
/// (immersed::StepVolume).
///
/// Resumes from `folder`/checkpoint when there is one, bit for bit on as many ranks as wrote it.
/// Throws Interrupted after SIGINT or SIGTERM; RunError when filling or the first beat stays
/// unstable at the smallest step, or when the aortic valve does not open and close in the last.
/// Collective.
[[nodiscard]] Beat run_immersed_cycle(const BeatSetup& setup,
                                      const circulation::CircuitParameters& circuit,
                                      const std::filesystem::path& folder,
                                      const Observers& observers);

/// The pressure under which wall and circuit have the same volume after a step [kPa]: Newton's
/// method, since the wall's grows with it and the circuit's falls. Not a number if there is none.
[[nodiscard]] double matching_pressure(
    const immersed::StepVolume& wall,
    const std::function<circulation::VolumeAfter(double)>& circuit);

}  // namespace lv::heartbeat
