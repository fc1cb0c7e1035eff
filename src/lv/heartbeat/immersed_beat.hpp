#pragma once

#include "lv/heartbeat/base_motion.hpp"
#include "lv/heartbeat/observers.hpp"

#include <filesystem>

namespace lv::heartbeat {

struct BeatSetup {
  const mesh::Mesh& mesh;
  solid::CardiacModel heart;
  immersed::ModelParameters model;
  Protocol protocol;
  StepControl control;
  OutputSchedule output;
  /// Of heartbeats: when each node is activated after the calcium of a beat begins [s]; empty: all
  /// at once.
  std::vector<double> activation_times = {};
  BaseMotion base_motion = {};  ///< of heartbeats
};

/// Fills the ventricle to end-diastole and contracts it to end-systole with the immersed engine
/// (section 2.4).
///
/// Resumes from `folder`/checkpoint when there is one: bit for bit on as many ranks as wrote it, to
/// rounding on others. Throws Interrupted after SIGINT or SIGTERM, and RunError when the run stays
/// unstable at its smallest step; both leave a checkpoint.
[[nodiscard]] Beat run_immersed_beat(const BeatSetup& setup, const std::filesystem::path& folder,
                                     const Observers& observers);

/// Name of the checkpoint inside a run's folder.
inline constexpr const char* checkpoint_name = "checkpoint.bin";

}  // namespace lv::heartbeat
