#pragma once

#include "lv/heartbeat/run_state.hpp"
#include "lv/immersed/model.hpp"

#include <functional>
#include <optional>

namespace lv::heartbeat {

/// The blood of a frame.
struct Blood {
  const immersed::Model& model;  ///< for its velocity
  const fluid::Component& pressure;
};

/// One frame of a run, for whoever writes fields.
struct Frame {
  int number = 0;
  Snapshot wall;
  const RunState& run;         ///< up to now; knows end-diastole once it is reached
  std::optional<Blood> blood;  ///< of the immersed engine
};

/// Told what happens; all are called on every rank (what they gather is collective) and may be
/// empty.
struct Observers {
  std::function<void(const Frame&)> frame;
  std::function<void(const RunState&)>
      curves;  ///< every few seconds and at the end: the curves and moments so far
};

}  // namespace lv::heartbeat
