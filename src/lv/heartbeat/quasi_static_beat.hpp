#pragma once

#include "lv/heartbeat/observers.hpp"
#include "lv/quasi_static/engine.hpp"

namespace lv::heartbeat {

struct QuasiStaticSetup {
  const mesh::Mesh& mesh;
  mesh::FibreRule fibres;
  quasi_static::Muscle muscle;
  quasi_static::Parameters parameters;
  Protocol protocol;  ///< its pressures and calcium; times and tolerances mean nothing here
};

/// The same beat without inertia and time: equilibrium at end-diastole and, with calcium held until
/// the muscle is steady, at end-systole (the paper's static model, section 3.1). Filling leads from
/// the undeformed wall to ed_pressure; contraction raises pressure and tension together.
///
/// The curves hold every equilibrium on the way; their time counts the phases: 0 to 1 is filling, 1
/// to 2 contraction, in shares of the way of the loads. Throws RunError when no equilibrium is
/// found, and Interrupted after SIGINT or SIGTERM. Collective.
[[nodiscard]] Beat run_quasi_static_beat(const QuasiStaticSetup& setup, const Observers& observers);

}  // namespace lv::heartbeat
