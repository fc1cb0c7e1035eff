#pragma once

#include "lv/heartbeat/archive.hpp"
#include "lv/heartbeat/beat.hpp"
#include "lv/heartbeat/protocol.hpp"

#include <optional>

namespace lv::heartbeat {

/// Everything that a run carries besides the model itself; the same on all ranks.
struct RunState {
  double time = 0.0;
  std::size_t phase = 0;  ///< which of the protocol's
  double phase_start = 0.0;
  double next_frame = 0.0;
  double next_curve = 0.0;
  int frames = 0;  ///< written so far
  std::vector<double> frame_times;
  double largest_velocity = 0.0;  ///< of the blood when last looked at [mm/s]
  int halvings = 0;               ///< of the longest step, in force
  int good_steps = 0;             ///< since the last halving
  int patience = 500;  ///< good steps before a halving is undone; doubles with every failure
  int flips = 0;  ///< steps in a row in which the wall's velocity changed its direction of change
  SteadyVolume steady{0.0, 0.0};
  bool volume_was_falling = false;  ///< in the last step
  Snapshot least;  ///< at the smallest volume of the phase so far, if it looks for that
  Beat beat;
};

/// Adds a snapshot's arrays to an archive, and takes them out again.
void store(const Snapshot& snapshot, const std::string& name, Archive& archive);
/// A snapshot that was not taken has no positions; one that was has those of `nodes` nodes, where
/// that is known.
[[nodiscard]] Snapshot load_snapshot(const Archive& archive, const std::string& name,
                                     std::optional<std::size_t> nodes = {});

/// Adds named moments to an archive, and takes them out again.
void store(const std::vector<NamedMoment>& moments, Archive& archive);
[[nodiscard]] std::vector<NamedMoment> load_moments(const Archive& archive,
                                                    std::optional<std::size_t> nodes = {});

/// Adds curves to an archive, and takes them out again.
void store(const std::vector<CurveRow>& curves, Archive& archive);
[[nodiscard]] std::vector<CurveRow> load_curves(const Archive& archive);

/// Adds the run's state (without the model's) to an archive, and takes it out again; the steadiness
/// criterion of the phase is made anew and fed the recorded volumes. Throws RunError when the
/// archive says what no run of a wall of that many nodes can come to.
void store(const RunState& run, Archive& archive);
[[nodiscard]] RunState load_run_state(const Archive& archive, const std::vector<Phase>& phases,
                                      std::optional<std::size_t> nodes = {});

/// The steadiness criterion of a phase.
[[nodiscard]] SteadyVolume criterion(const Phase& phase);

}  // namespace lv::heartbeat
