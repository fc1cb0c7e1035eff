#pragma once

#include "lv/analysis/results.hpp"
#include "lv/base/table.hpp"
#include "lv/geometry/fit_report.hpp"
#include "lv/mesh/folds.hpp"
#include "lv/report/marks.hpp"

#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace lv::report {

/// A measured volume to which parameters were fitted, and what the engines make of them.
struct FittedVolume {
  std::string name;           ///< EDV or ESV
  double measured = 0.0;      ///< [mm^3]
  double quasi_static = 0.0;  ///< of the fit [mm^3]
  double beat = 0.0;          ///< of this beat [mm^3]
  bool within_tolerance = false;
};

/// A datum that heartbeats were fitted to, in its own unit.
struct FittedOfBeat {
  std::string name;  ///< EDV, ESV, systolic or diastolic
  std::string unit;
  double measured = 0.0;
  double fit = 0.0;   ///< of the fit
  double beat = 0.0;  ///< of the last heartbeat
  bool within_tolerance = false;
};

/// A volume that Klotz's curve gives a shape of end-diastole, and that of the model fitted to it.
struct KlotzVolume {
  std::string name;
  double pressure = 0.0;  ///< [kPa]
  double target = 0.0;    ///< [mm^3]
  double model = 0.0;     ///< [mm^3]
};

/// By how much end-systolic surfaces lie outside of the drawn ones that they were fitted to, by the
/// means of their parts; and where they were fitted to volumes alone [mm].
struct FittedShape {
  double rms = 0.0, bias = 0.0;
  double rms_before = 0.0, bias_before = 0.0;
};

/// The wall without load that was found from a loaded one, and how well.
struct UnloadedShape {
  double pressure = 0.0;         ///< under which the wall was seen [kPa]
  double seen_volume = 0.0;      ///< of the cavity [mm^3]
  double unloaded_volume = 0.0;  ///< [mm^3]
  double loaded_volume = 0.0;    ///< of the wall without load, loaded again [mm^3]
  double largest = 0.0;          ///< distance of its nodes from where they were seen [mm]
  double rms = 0.0;              ///< [mm]
  double klotz_volume = 0.0;     ///< V0 of Klotz et al. from volume and pressure [mm^3]
  double smoothing = 0.0;        ///< alpha of implicit::unload; 0: none was needed
  mesh::Folds folds;             ///< against the shape that was seen
  std::vector<std::string> warnings = {};
};

/// The infarct in one AHA segment that it touches.
struct SegmentScar {
  std::string name;
  double volume = 0.0;         ///< [mm^3]
  double mass = 0.0;           ///< [kg]
  double part = 0.0;           ///< of the segment
  double transmurality = 0.0;  ///< see mesh::infarct_by_segment
};

/// What stands at the head of a summary besides the results.
struct RunFacts {
  std::string case_name;
  std::string version;
  std::string engine;
  int ranks = 1;
  int nodes = 0;
  int elements = 0;  ///< finite elements of `order`; a quadratic one is drawn as eight parts
  int order = 1;
  std::string grid;  ///< "96 x 96 x 128"; empty without blood
  double mesh_width = std::numeric_limits<double>::quiet_NaN();  ///< of the grid [mm]
  double wall_clock = 0.0;                                       ///< of the beat [s]
  std::vector<std::pair<std::string, std::string>> parameters;   ///< name and value, all of them
  std::vector<std::pair<std::string, std::string>>
      origins;  ///< of those that are set: line of the case file, or file
  std::vector<std::string> warnings;
  std::vector<geometry::Assumption> assumed;  ///< about the anatomy
  double muscle_density = 1.05e-6;            ///< [kg/mm^3]
  Mark shape = Mark::assumed;                 ///< of the wall that was seen
  Mark pressure = Mark::assumed;              ///< in the cavity at the moments of the beat
  bool scar_is_measured = false;
  bool base_is_held = true;  ///< in its plane and from turning
  std::vector<std::string> fitted_parameters, measured_parameters;  ///< names
  std::vector<FittedVolume> fitted;                                 ///< of a calibrated case
  std::vector<KlotzVolume> klotz;                                   ///< of a fit to that curve
  std::optional<Table> contractility;       ///< contractility.csv of a fit to strain
  std::optional<FittedShape> fitted_shape;  ///< of a fit to one
  std::vector<FittedOfBeat> fitted_beats;   ///< of a case whose heartbeats were fitted
  std::optional<UnloadedShape> unloaded;
  std::vector<SegmentScar> scar;  ///< empty without infarct
};

/// summary.json as text.
[[nodiscard]] std::string summary_json(const RunFacts& facts, const heartbeat::Beat& beat,
                                       const analysis::Results& results);

/// The same for a terminal: the numbers one looks at first.
[[nodiscard]] std::string summary_text(const RunFacts& facts, const heartbeat::Beat& beat,
                                       const analysis::Results& results);

}  // namespace lv::report
