#pragma once

#include "lv/implicit/damped_newton.hpp"
#include "lv/implicit/inverse_equations.hpp"

#include <optional>

namespace lv::implicit {

/// Newton's method (DampedNewton) for the inverse problem.
class InverseNewton {
 public:
  /// The equations must outlive this object.
  InverseNewton(const InverseEquations& equations, const NewtonParameters& parameters);

  /// Brings X and the pressures to R = 0 under a pressure in the cavity [kPa], or leaves them as
  /// they were; `tolerance`: rms of the last correction of X [mm]. Begins with the last tangent, if
  /// there is one. Collective.
  NewtonReport solve(Reference& reference, double pressure, double tolerance);

  void forget_tangent() { has_tangent_ = false; }

 private:
  class Problem;

  const InverseEquations& equations_;
  NewtonParameters parameters_;
  SparseMatrix tangent_;
  bool has_tangent_ = false;
};

/// The wall without load that the seen shape under a pressure [kPa] comes from, from a guess near
/// it, where there is one and it leads there, else along the pressure: steps of equal factors from
/// a 32nd of it, for the stretch of muscle grows with the pressure's logarithm, each begun on the
/// straight line through the last two. Where directions are held (InverseEquations::hold_frames)
/// they are held anew, a few times, and the wall whose own directions move it least is taken.
///
/// Nothing where Newton's method finds no way. Says the time that is left, with what the caller
/// does after the search [s]. Throws Interrupted. Collective.
[[nodiscard]] std::optional<Reference> find_reference(const mesh::Mesh& seen,
                                                      const StaticModel& model, double pressure,
                                                      const NewtonParameters& parameters,
                                                      const Reference* guess = nullptr,
                                                      double afterwards = 0.0);

/// The share of a pressure [kPa] under which the wall that the seen shape comes from holds `volume`
/// without load [mm^3], along the same path, interpolated in the pressure's logarithm. Muscle that
/// is stiffer by 1/share holds it under the whole pressure, but for springs around the wall, for
/// the inverse problem knows the ratio of pressure and stiffness alone. The wall may be folded.
///
/// Nothing where the path ends before, or the whole pressure leaves more. Throws Interrupted.
/// Collective.
[[nodiscard]] std::optional<double> share_that_leaves(double volume, const mesh::Mesh& seen,
                                                      const StaticModel& model, double pressure,
                                                      const NewtonParameters& parameters);

}  // namespace lv::implicit
