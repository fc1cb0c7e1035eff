#pragma once

#include "lv/heartbeat/observers.hpp"
#include "lv/implicit/engine.hpp"

namespace lv::heartbeat {

struct QuasiStaticSetup {
  const mesh::Mesh& mesh;
  implicit::StaticModel model;
  implicit::SolverParameters parameters;
  Protocol protocol;  ///< its tolerances, drags and longest times mean nothing here
  /// Between frames [s]; the ends of the phases always have one, and so has every moment whose
  /// volume is off by a tenth from that of the last frame.
  double frame_interval = 0.0;
};

/// The same beat without inertia and time: equilibrium at end-diastole and, with calcium held until
/// the muscle is steady, at end-systole (the paper's static model, section 3.1). Filling leads from
/// the undeformed wall to ed_pressure; contraction raises pressure and tension together.
///
/// The curves hold every equilibrium on the way, about 5% of the cavity's volume apart; their time
/// is that of loads which rise evenly over filling_ramp, then over contraction_ramp. Throws
/// RunError when no equilibrium is found, and Interrupted after SIGINT or SIGTERM. Collective.
[[nodiscard]] Beat run_quasi_static_beat(const QuasiStaticSetup& setup, const Observers& observers);

}  // namespace lv::heartbeat
