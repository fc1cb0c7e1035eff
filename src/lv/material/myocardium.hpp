#pragma once

#include "lv/material/active_law.hpp"
#include "lv/material/law.hpp"
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
  InfarctScaling infarct;
  ActiveForm active_form = ActiveForm::niederer;  ///< what the tension means
};

/// The sum of stresses at one point of the wall, with M of the infarct and the tension T_MI that is
/// left there (2.13), (2.21)-(2.24):
///
///   P = (1 + stiffening M) P_passive(F) + g T_MI f (x) f0 + P_volumetric(F)       [kPa]
///
/// The second index of F and P is in the fibre frame; J = det F.
template <PassiveLaw Law>
struct PointLaw {
  const Law& law;
  InfarctScaling infarct;
  ActiveForm active_form;
  Volumetric volumetric;  ///< none where beta_s = 0

  template <class T>
  [[nodiscard]] Tensor<T> passive(const Tensor<T>& F, const T& M) const {
    return law.stress(F) * infarct.passive(M);
  }

  /// The first column of the active part, the only one that is not zero.
  template <class T>
  [[nodiscard]] Vector<T> active(const Tensor<T>& F, const T& J, const T& tension) const {
    return active_stress_column(F, J, tension, active_form);
  }

  template <class T>
  [[nodiscard]] Tensor<T> stress(const Tensor<T>& F, const T& J, const T& tension,
                                 const T& M) const {
    Tensor<T> P = passive(F, M);
    P.col(0) += active(F, J, tension);
    if (volumetric.beta_s > 0.0)
      P += volumetric.stress(F);
    return P;
  }

  /// dP/dF [kPa], with the slope dT_MI/dlambda of the tension [kPa].
  [[nodiscard]] Tangent<double> tangent(const Mat3& F, double tension, double slope,
                                        double M) const {
    return volumetric.tangent(F) + infarct.passive(M) * law.tangent(F) +
           active_tangent(F, tension, slope, active_form);
  }
};

/// Calls f(point_law) for the law of a myocardium, with this volumetric term at every point.
template <class F>
decltype(auto) with_point_law(const Myocardium& m, const Volumetric& volumetric, const F& f) {
  return std::visit(
      [&](const auto& law) -> decltype(auto) {
        return f(PointLaw<std::decay_t<decltype(law)>>{law, m.infarct, m.active_form, volumetric});
      },
      m.passive);
}

}  // namespace lv::material
