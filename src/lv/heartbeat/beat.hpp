#pragma once

#include "lv/base/tensor.hpp"
#include "lv/heartbeat/protocol.hpp"
#include "lv/solid/cell_stress.hpp"

#include <vector>

namespace lv::heartbeat {

/// One row of the curves of a beat.
struct CurveRow {
  double time = 0.0;  ///< [s]
  Phase phase = Phase::filling;
  double pressure = 0.0;          ///< on the endocardium [kPa]
  double volume = 0.0;            ///< of the cavity [mm^3]
  double calcium = 0.0;           ///< [uM]
  double mean_tension = 0.0;      ///< [kPa]
  double kinetic_energy = 0.0;    ///< of blood and wall in the box [mN mm]
  double largest_velocity = 0.0;  ///< [mm/s]
  double min_J = 1.0;
  double max_J = 1.0;
  double step = 0.0;  ///< [s]
};

/// The wall at one time: all that stresses and strains follow from.
struct Snapshot {
  double time = 0.0;
  Phase phase = Phase::filling;
  double pressure = 0.0;        ///< on the endocardium [kPa]
  double volume = 0.0;          ///< [mm^3]
  std::vector<Vec3> positions;  ///< of the nodes [mm]
  std::vector<double> tension;  ///< per node, of the immersed engine; else empty [kPa]
  /// Per element, of the quasi-static engine, which knows p; else empty.
  std::vector<solid::CellStress> stress;
};

/// What a beat comes to, whichever engine ran it.
struct Beat {
  std::vector<CurveRow> curves;
  Snapshot end_diastole;
  Snapshot end_systole;
  bool filling_was_steady = false;  ///< the criterion ended the phase, not its longest duration
  bool contraction_was_steady = false;
  int steps = 0;
  int retries = 0;          ///< steps taken back and repeated smaller
  double wall_clock = 0.0;  ///< of the computation, interruptions left out [s]
};

}  // namespace lv::heartbeat
