#pragma once

#include "lv/quasi_static/equations.hpp"

namespace lv::quasi_static {

/// The sum of stresses at one point under an activation, without the pressure's part.
struct Constitution {
  const StaticModel& model;
  double activation;

  /// Calls f with the point's material::PointLaw.
  template <class F>
  [[nodiscard]] auto with_law(const F& f) const {
    return material::with_point_law(model.heart.myocardium, model.stabilisation, f);
  }

  /// With the infarct's factor.
  [[nodiscard]] Tension tension(const Mat3& F, double M) const {
    Tension T = model.contractility.at(F.col(0).norm(), activation);
    T.value *= model.heart.myocardium.infarct.active(M);
    T.derivative *= model.heart.myocardium.infarct.active(M);
    return T;
  }

  [[nodiscard]] Mat3 stress(const Mat3& F, double J, double M) const {
    const double T = tension(F, M).value;
    return with_law([&](const auto& law) { return law.stress(F, J, T, M); });
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

}  // namespace lv::quasi_static
