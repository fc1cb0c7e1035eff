#pragma once

#include "lv/material/active_law.hpp"
#include "lv/material/law.hpp"
#include "lv/material/tension.hpp"
#include "lv/material/viscosity.hpp"
#include "lv/material/volumetric.hpp"

namespace lv::material {

/// Where the volumetric penalty (2.20) is integrated: at the points of the rest of the energy, or
/// from mean dilatations, which do not lock: a hexahedron's own, from its mean deformation
/// gradient; of tetrahedra, which are too stiff one by one, that of all around a node.
enum class VolumetricPoints { full, mean };

/// What the wall is made of.
struct Myocardium {
  AnyPassiveLaw passive = HolzapfelOgden{};
  ActiveLaw active = NiedererHunterSmith{};
  Volumetric volumetric;  ///< of the immersed engine
  VolumetricPoints volumetric_points = VolumetricPoints::mean;
  /// Besides the means, at every point of a hexahedron, which bends without changing them, and what
  /// a tetrahedron keeps to itself at least; zero at J = 1.
  Volumetric stabilisation{.beta_s = 0.0};
  static constexpr Volumetric stabilisation_of_heartbeats{.beta_s = 100.0};
  InfarctScaling infarct;
  ActiveForm active_form = ActiveForm::niederer;  ///< what the tension means
  Viscosity viscosity;  ///< of motions of the implicit engine; the immersed engine's is the blood's
};

/// The sum of stresses at one point of the wall, with M of the infarct and the tension T of muscle
/// without one, of which T_MI = (1 - M) T is left (2.13), (2.21)-(2.24):
///
///   P = (1 + stiffening M) P_passive(F) + g T_MI f (x) f0 + P_volumetric(F) + P_viscous(F, F')     [kPa]
///   W = (1 + stiffening M) W_passive(F) + U_volumetric(F)                                        [kPa]
///
/// The second index of F, F' and P is in the fibre frame; J = det F. The immersed engine's loops
/// take the sum for a pack of points, and without rates.
template <PassiveLaw Law>
struct PointLaw {
  const Law& law;
  InfarctScaling infarct;
  ActiveForm active_form;
  Volumetric volumetric;  ///< none where beta_s = 0
  Viscosity viscosity;    ///< none where eta = 0

  template <class T>
  [[nodiscard]] Tensor<T> passive(const Tensor<T>& F, const T& M) const {
    return law.stress(F) * infarct.passive(M);
  }

  /// T_MI.
  template <class T>
  [[nodiscard]] T tension_left(const T& tension, const T& M) const {
    return tension * infarct.active(M);
  }

  /// The first column of the active part, the only one that is not zero.
  template <class T>
  [[nodiscard]] Vector<T> active(const Tensor<T>& F, const T& J, const T& tension,
                                 const T& M) const {
    return active_stress_column(F, J, tension_left(tension, M), active_form);
  }

  /// What does not go by the rate.
  template <class T>
  [[nodiscard]] Tensor<T> stress(const Tensor<T>& F, const T& J, const T& tension,
                                 const T& M) const {
    Tensor<T> P = passive(F, M);
    P.col(0) += active(F, J, tension, M);
    if (volumetric.beta_s > 0.0)
      P += volumetric.stress(F);
    return P;
  }

  /// All of it, at a rate of F [1/s].
  [[nodiscard]] Mat3 stress(const Mat3& F, double J, double tension, double M,
                            const Mat3& rate) const {
    return stress(F, J, tension, M) + viscous(F, rate);
  }

  /// P_viscous.
  [[nodiscard]] Mat3 viscous(const Mat3& F, const Mat3& rate) const {
    return viscosity.stress(F, rate);
  }

  /// dP/dF of what does not go by the rate [kPa], with the tension's slope dT/dlambda.
  [[nodiscard]] Tangent<double> tangent(const Mat3& F, const Tension& tension, double M) const {
    return volumetric.tangent(F) + infarct.passive(M) * law.tangent(F) +
           active_tangent(F, tension_left(tension.value, M), tension_left(tension.derivative, M),
                          active_form);
  }

  /// dP/dF of all of it [kPa], where the rate follows F, dF' = slope dF [1/s].
  [[nodiscard]] Tangent<double> tangent(const Mat3& F, const Tension& tension, double M,
                                        const Mat3& rate, double slope) const {
    return tangent(F, tension, M) + viscosity.tangent(F, rate, slope);
  }

  /// W.
  [[nodiscard]] double energy(const Mat3& F, double M) const {
    return infarct.passive(M) * law.energy(F) + volumetric.energy(F);
  }
};

/// Calls f(point_law) for the law of a myocardium, with this volumetric term at every point.
template <class F>
decltype(auto) with_point_law(const Myocardium& m, const Volumetric& volumetric, const F& f) {
  return std::visit(
      [&](const auto& law) -> decltype(auto) {
        return f(PointLaw<std::decay_t<decltype(law)>>{law, m.infarct, m.active_form, volumetric,
                                                       m.viscosity});
      },
      m.passive);
}

}  // namespace lv::material
