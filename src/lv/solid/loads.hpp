#pragma once

#include <vector>

namespace lv::solid {

/// What acts on the ventricle at one time.
struct Loads {
  double pressure = 0.0;  ///< in the cavity, a follower load on the endocardium [kPa]
  /// Share of the full activation [-]. Muscle without time goes by it: that of the implicit engine
  /// under loads, whatever its law, and under the immersed engine that of laws without kinetics.
  double activation = 0.0;
  /// [uM]. Muscle in time goes by it: under the immersed engine that of laws with kinetics. The
  /// implicit engine in time is given calcium step by step (TimeStep), where it may differ from
  /// point to point.
  double calcium = 0.0;
  /// The same of each node, where muscle is activated at different times; empty: `calcium` is that
  /// of all [uM].
  std::vector<double> calcium_at_nodes = {};

  [[nodiscard]] bool operator==(const Loads&) const = default;
};

}  // namespace lv::solid
