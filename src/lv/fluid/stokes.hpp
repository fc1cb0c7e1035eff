#pragma once

#include "lv/fluid/box_transform.hpp"

namespace lv::fluid {

/// Properties of the blood, shared by the muscle (section 2.1: equal density and viscosity).
struct Blood {
  double density = 1.0e-6;    ///< rho [kg/mm^3]; the paper: 1.0 g/ml
  double viscosity = 4.0e-6;  ///< mu [kPa s]; 4 cP. The paper prints 0.04 cP, a slip for 0.04 P
};

/// The unsteady Stokes equations (2.1)-(2.2) without convection, solved exactly on the grid:
///
///   rho (u+ - u-)/dt = -grad p + mu lap (u+ + u-)/2 - rho c (u+ + u-)/2 + f,      div u+ = 0
///
/// On every side of the box the normal traction and the tangential velocity vanish, hence p = 0,
/// u_t = 0 and d(u_n)/dn = 0. With these the staggered gradient, divergence and Laplacian are
/// diagonal in sine and cosine modes, with the discrete wave number k_d = (2/h_d) sin(pi m_d / 2
/// N_d) along axis d: each mode is a division and a projection.
class Stokes {
 public:
  Stokes(const Grid& grid, const BoxTransform& transform, Blood blood);

  /// Replaces the modes of u- by those of u+. `force` are the modes of f [mN/mm^3] before the
  /// division by 8 Nx Ny Nz; `drag` is c [1/s], a uniform resistance that vanishes with the
  /// velocity and so leaves every equilibrium in place.
  void advance(ModeField& velocity, const ModeField& force, double dt, double drag) const;

  /// The pressure that balances `force` (as above): lap p = div f. Modes of a cell-centred field
  /// with `layout`.
  [[nodiscard]] AlignedValues pressure(const ModeField& force, const ModeLayout& layout) const;

 private:
  Blood blood_;
  std::array<ModeLayout, 3> layout_;
  std::array<std::vector<double>, 3> wave_;  ///< k_d for m_d = 0..N_d
  double normalisation_;                     ///< 1 / (8 Nx Ny Nz)
};

}  // namespace lv::fluid
