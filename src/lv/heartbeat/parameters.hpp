#pragma once

#include "lv/base/units.hpp"
#include "lv/material/calcium.hpp"

#include <string>

namespace lv::heartbeat {

/// What a run takes the ventricle through: the paper's filling and contraction, or heartbeats of a
/// circulation.
enum class ProtocolKind { paper, cycle };

/// Where the motion of the base over a beat comes from: there is none, a table, or the long-axis
/// cine.
enum class BaseMotionSource { none, table, cine };

struct BaseMotionParameters {
  BaseMotionSource source = BaseMotionSource::none;
  std::string file;   ///< the table, as the case file names it
  double zero = 0.0;  ///< when the base is where the undeformed wall has it, after the beat's
                      ///< calcium begins [s]
};

/// Heartbeats of a wall joined to a circulation.
struct CycleParameters {
  int beats = 10;                ///< at most
  double tolerance = 1e-3;       ///< of the limit cycle: largest relative change from beat to beat
  bool leap = true;              ///< whether a closed loop leaps towards it between beats
  std::string begin = {};        ///< file of where other beats ended, as the case file names it
  double step = 2e-3;            ///< of time, at most [s]
  double step_error = 0.0;       ///< of a step, at most; 0: all are as long as they may be [-]
  bool inertia = false;          ///< whether the wall has a mass
  double spectral_radius = 0.5;  ///< of the generalised alpha rule, with inertia [-]
};

/// Pressures, calcium and the ends of the phases (section 2.4): the endocardial pressure rises from
/// zero to its end-diastolic value and stays until filling ends; then it rises to its end-systolic
/// value while calcium rises to its peak, until the ventricle is steady.
struct Protocol {
  ProtocolKind kind = ProtocolKind::paper;
  double ed_pressure = 8.0 * units::mmHg;    ///< [kPa]
  double es_pressure = 150.0 * units::mmHg;  ///< [kPa]
  double filling_ramp = 0.3;                 ///< duration of the rise to ed_pressure [s]
  double contraction_ramp = 0.2;             ///< duration of the rise to es_pressure [s]
  material::Calcium calcium;

  /// Filling ends when the cavity volume has stayed within this fraction of itself for a window.
  double filling_tolerance = 0.002;
  double filling_window = 0.1;   ///< [s]
  double filling_longest = 2.0;  ///< gives up waiting after this long [s]
  double filling_drag = 40.0;    ///< resistance to the velocity once the pressure is constant [1/s]

  /// The end-systolic steady state, in the same terms. The window is longer than half a swing of
  /// tension and volume.
  double contraction_tolerance = 0.006;
  double contraction_window = 0.3;   ///< [s]
  double contraction_longest = 1.5;  ///< [s]
  double contraction_drag = 0.0;     ///< [1/s]

  CycleParameters cycle;
};

/// How often a case may ask for the step to be halved.
inline constexpr int most_halvings = 12;

/// Time steps and what to do when one fails.
struct StepControl {
  double longest = 1.0e-4;        ///< the step, unless stability asks for less [s]
  double courant = 0.3;           ///< largest velocity x step / mesh width [-]
  double velocity_limit = 2.0e4;  ///< a faster wall or blood means that the step is unstable [mm/s]
  int halvings = 6;               ///< how often the step may be halved before the run gives up
};

/// What is kept of a run, and how often.
struct OutputSchedule {
  double frame_interval =
      0.1;  ///< between fields of wall and blood [s]; end-diastole and end-systole always
  double curve_interval = 1.0e-3;      ///< between rows of the curves [s]
  double checkpoint_interval = 300.0;  ///< between checkpoints, of wall-clock time [s]
  bool blood = true;                   ///< whether frames contain the blood
};

}  // namespace lv::heartbeat
