#pragma once

#include "lv/implicit/equations.hpp"

#include <optional>

namespace lv::implicit {

/// Calls f with the material::PointLaw of a model's points.
template <class F>
[[nodiscard]] auto with_law(const StaticModel& model, const F& f) {
  return material::with_point_law(model.heart.myocardium, model.stabilisation, f);
}

/// How fast F changes at a point of viscous muscle in motion, and how that follows F.
struct RateOfF {
  Mat3 of_F;           ///< F' [1/s]
  double slope = 0.0;  ///< dF'/dF [1/s]
};
using Rate = std::optional<RateOfF>;

/// The sum of stresses at one point, without the pressure's part. The active tension at the point
/// is a function of its stretch.
struct Constitution {
  const StaticModel& model;
  const TensionAt& tension_at;
  std::size_t element = 0, point = 0;  ///< see TensionAt

  /// Calls f with the point's material::PointLaw.
  template <class F>
  [[nodiscard]] auto with_law(const F& f) const {
    return implicit::with_law(model, f);
  }

  /// Without the infarct's factor.
  [[nodiscard]] Tension tension(const Mat3& F) const {
    return tension_at(element, point, F.col(0).norm());
  }

  /// What an infarct leaves of it [kPa].
  [[nodiscard]] double tension_left(const Mat3& F, double M) const {
    return with_law([&](const auto& law) { return law.tension_left(tension(F).value, M); });
  }

  /// In a motion also of what the rate of F gives [1/s].
  [[nodiscard]] Mat3 stress(const Mat3& F, double J, double M, const Rate& rate) const {
    const double T = tension(F).value;
    return with_law([&](const auto& law) -> Mat3 {
      return rate ? law.stress(F, J, T, M, rate->of_F) : law.stress(F, J, T, M);
    });
  }

  /// The first column of the active stress, the only one that is not zero.
  [[nodiscard]] Vec3 active(const Mat3& F, double M) const {
    const double T = tension(F).value;
    return with_law([&](const auto& law) -> Vec3 { return law.active(F, determinant(F), T, M); });
  }

  [[nodiscard]] material::Tangent<double> tangent(const Mat3& F, double M, const Rate& rate) const {
    const Tension T = tension(F);
    return with_law([&](const auto& law) -> material::Tangent<double> {
      return rate ? law.tangent(F, T, M, rate->of_F, rate->slope) : law.tangent(F, T, M);
    });
  }

  [[nodiscard]] solid::CellStress cauchy(const Mat3& F, double M) const {
    const double T = tension(F).value;
    return with_law([&](const auto& law) { return solid::point_stress(law, F, T, M); });
  }
};

}  // namespace lv::implicit
