#pragma once

#include "lv/heartbeat/run_state.hpp"
#include "lv/immersed/model.hpp"

#include <filesystem>
#include <functional>

namespace lv::heartbeat {

/// One frame of a run, for whoever writes fields.
struct Frame {
  int number = 0;
  Snapshot wall;
  const RunState& run;           ///< up to now; knows end-diastole once it is reached
  const immersed::Model& model;  ///< for the blood's velocity
  const fluid::Component& pressure;
};

/// Told what happens; all are called on every rank (what they gather is collective) and may be
/// empty.
struct Observers {
  std::function<void(const Frame&)> frame;
  std::function<void(const RunState&)>
      curves;  ///< every few seconds and at the end: the curves so far
};

struct BeatSetup {
  const mesh::Mesh& mesh;
  mesh::FibreRule fibres;
  solid::WallMaterial material;
  material::NiedererHunterSmith active;
  immersed::ModelParameters model;
  Protocol protocol;
  StepControl control;
  OutputSchedule output;
};

/// The run was asked to stop and left a valid checkpoint.
class Interrupted : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
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
