#pragma once

#include "lv/base/tensor.hpp"
#include "lv/material/active_stress.hpp"
#include "lv/material/guccione.hpp"
#include "lv/material/holzapfel_ogden.hpp"
#include "lv/material/neo_hookean.hpp"
#include "lv/material/smooth_holzapfel_ogden.hpp"

#include <concepts>
#include <variant>

namespace lv::material {

/// The shape of a passive law: strain energy, first Piola-Kirchhoff stress and its derivative by F
/// [kPa] as pure functions of the deformation gradient F with its second index in the fibre frame
/// (columns F f0, F s0, F n0).
template <class L>
concept PassiveLaw = requires(const L& law, const Tensor<double>& F, const Tensor<Pack>& F_pack) {
  { law.energy(F) } -> std::same_as<double>;
  { law.stress(F) } -> std::same_as<Tensor<double>>;
  { law.stress(F_pack) } -> std::same_as<Tensor<Pack>>;
  { law.tangent(F) } -> std::same_as<Tangent<double>>;
};

static_assert(PassiveLaw<HolzapfelOgden> && PassiveLaw<Guccione> && PassiveLaw<NeoHookean> &&
              PassiveLaw<SmoothHolzapfelOgden>);

/// The passive law of a wall.
using AnyPassiveLaw = std::variant<HolzapfelOgden, Guccione, NeoHookean, SmoothHolzapfelOgden>;

/// How an infarct changes the muscle, with M(X) the local extent (2.11): 1 in the scar, 0 in
/// healthy muscle.
struct InfarctScaling {
  double stiffening = 49.0;  ///< W_MI = (1 + stiffening M) W (2.23) [-]

  template <class T>
  [[nodiscard]] T passive(const T& M) const {
    return 1.0 + stiffening * M;
  }

  /// T_MI = (1 - M) T (2.24).
  template <class T>
  [[nodiscard]] T active(const T& M) const {
    return 1.0 - M;
  }
};

}  // namespace lv::material
