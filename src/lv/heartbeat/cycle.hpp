#pragma once

#include "lv/base/outcome.hpp"
#include "lv/heartbeat/base_motion.hpp"
#include "lv/heartbeat/cycle_record.hpp"
#include "lv/implicit/time_engine.hpp"

#include <filesystem>

namespace lv::heartbeat {

/// Where a beat begins.
struct BeatBegin {
  implicit::TimeEngine::Moment wall;
  std::vector<double> circuit;  ///< its states, the ventricle's volume first
};

struct CycleSetup {
  const mesh::Mesh& mesh;
  implicit::StaticModel model;
  implicit::SolverParameters solver;
  material::Calcium calcium;  ///< its transient begins anew in every beat, whatever its mode
  circulation::CircuitParameters circuit;
  CycleParameters cycle;
  double frame_interval = 0.1;  ///< between frames of a beat [s]; the valves' events have one each
  /// When each node is activated after the calcium of a beat begins [s]; empty: all at once.
  std::vector<double> activation_times = {};
  /// Where beats of the same wall have ended (end_of_beats), to begin there; empty: a filled wall.
  std::filesystem::path begin = {};
  BaseMotion base_motion = {};
};

/// Where the next beat of a run would begin, beside its checkpoints.
inline constexpr const char* end_of_beats = "end_of_beats.bin";

/// What another run left there, for a wall with so many nodes in such a circuit. Throws InputError
/// where it is of others, or no such file.
[[nodiscard]] Archive read_end_of_beats(const std::filesystem::path& file, std::size_t nodes,
                                        const circulation::CircuitParameters& circuit);

/// Heartbeats of the wall joined to a circulation: the pressure in the cavity is the multiplier of
/// V_wall = V_circuit in every step. The wall starts filled to the pressure
/// before the mitral valve. Beats end when the last has changed no state of the circuit, nor
/// end-diastolic or end-systolic volume, by more than the tolerance, or with their largest number.
///
/// Calcium rises at the beginning of a beat, in a closed loop at left_ventricle.t_C, since its
/// other chambers have their own times, and at each point of the wall when activation reaches it;
/// a transient that a beat begins may end in the next. Curves, frames and moments are those of the
/// last beat: end-diastole is the closing of the mitral valve, end-systole that of the aortic
/// valve.
///
/// Resumes from `folder`/checkpoint when there is one, and leaves `folder`/end_of_beats unless the
/// last beat was broken off. Throws Interrupted after SIGINT or SIGTERM; InputError when
/// setup.begin is of another wall or circuit; RunError when a step of the first beat has no
/// solution at the smallest step, or when the aortic valve does not open and close in the last.
/// Collective.
[[nodiscard]] Beat run_cycle(const CycleSetup& setup, const std::filesystem::path& folder,
                             const Observers& observers);

/// Heartbeats for their measures alone.
struct MeasuredBeats {
  circulation::Cycle cycle;
  BeatBegin end;  ///< where the next beat would begin
};

/// The same beats without curves and fields, from `begin` on instead of a filled wall if it is
/// there. Beats before `begin` were like those that follow. Unsolved where a step has no solution
/// at the smallest step. Collective.
[[nodiscard]] Outcome<MeasuredBeats> measure_beats(const CycleSetup& setup, const BeatBegin* begin,
                                                   const std::filesystem::path& folder);

/// Adds where a beat begins to an archive, and takes it out again.
void store(const BeatBegin& begin, Archive& archive);
[[nodiscard]] BeatBegin load_begin(Archive archive);

}  // namespace lv::heartbeat
