#pragma once

#include "lv/implicit/equations.hpp"

namespace lv::implicit {

/// The sum of stresses at one point, without the pressure's part. The active tension at the point
/// is a function of its stretch.
struct Constitution {
  const StaticModel& model;
  const TensionAt& tension_at;
  std::size_t element = 0, point = 0;  ///< see TensionAt

  /// Calls f with the point's material::PointLaw.
  template <class F>
  [[nodiscard]] auto with_law(const F& f) const {
    return material::with_point_law(model.heart.myocardium, model.stabilisation, f);
  }

  /// With the infarct's factor.
  [[nodiscard]] Tension tension(const Mat3& F, double M) const {
    Tension T = tension_at(element, point, F.col(0).norm());
    T.value *= model.heart.myocardium.infarct.active(M);
    T.derivative *= model.heart.myocardium.infarct.active(M);
    return T;
  }

  [[nodiscard]] Mat3 stress(const Mat3& F, double J, double M) const {
    const double T = tension(F, M).value;
    return with_law([&](const auto& law) { return law.stress(F, J, T, M); });
  }

  /// The first column of the active stress, the only one that is not zero.
  [[nodiscard]] Vec3 active(const Mat3& F, double M) const {
    const double T = tension(F, M).value;
    return with_law([&](const auto& law) -> Vec3 { return law.active(F, determinant(F), T); });
  }

  [[nodiscard]] material::Tangent<double> tangent(const Mat3& F, double M) const {
    const Tension T = tension(F, M);
    return with_law([&](const auto& law) { return law.tangent(F, T.value, T.derivative, M); });
  }

  [[nodiscard]] solid::CellStress cauchy(const Mat3& F, double M) const {
    const double T = tension(F, M).value;
    return with_law([&](const auto& law) { return solid::point_stress(law, F, T, M); });
  }
};

}  // namespace lv::implicit
