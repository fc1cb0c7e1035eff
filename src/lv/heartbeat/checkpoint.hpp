#pragma once

#include "lv/heartbeat/run_state.hpp"
#include "lv/immersed/model.hpp"

namespace lv::heartbeat {

/// One moment of a run of the immersed engine: all that its further course depends on.
struct Moment {
  immersed::ModelState model;
  RunState run;
};

/// What a run is resumed from: the moment that it had come to, and the earlier one that it goes
/// back to when a step fails.
struct Checkpoint {
  Moment now, kept;
};

/// A model's state as named arrays, on the root; collective.
[[nodiscard]] Archive archived(const immersed::ModelState& state,
                               const fluid::BoxTransform& transform);

/// The state of a model out of its archive; collective. Throws RunError as read_checkpoint.
[[nodiscard]] immersed::ModelState load_model_state(const Archive& archive, immersed::Model& model);

/// A moment as named arrays, on the root; collective.
[[nodiscard]] Archive archived(const immersed::ModelState& state, const RunState& run,
                               const fluid::BoxTransform& transform);

/// The checkpoint in a file, for a run of this model; collective. Throws RunError when the file
/// cannot be read, is damaged, is of another wall or box, or says what no run can come to.
[[nodiscard]] Checkpoint read_checkpoint(const std::filesystem::path& file, immersed::Model& model,
                                         const std::vector<Phase>& phases);

}  // namespace lv::heartbeat
