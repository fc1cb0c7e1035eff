#pragma once

#include "lv/material/tangent.hpp"

namespace lv::material {

/// A viscous stress in proportion to the rate of the Green-Lagrange strain,
///
///   S = eta dE/dt,  P = F S,  dE/dt = (F^T F' + F'^T F)/2                                [kPa]
///
/// of the potential eta/2 tr((dE/dt)^2). The second index of F, of its rate F' [1/s] and of P is in
/// the fibre frame.
struct Viscosity {
  double eta = 0.0;  ///< [kPa s]

  [[nodiscard]] Mat3 stress(const Mat3& F, const Mat3& rate) const {
    return F * (0.5 * eta * (F.transpose() * rate + rate.transpose() * F));
  }

  /// dP/dF where the rate follows F, dF' = slope dF with the slope of a rule of time stepping
  /// [1/s].
  [[nodiscard]] Tangent<double> tangent(const Mat3& F, const Mat3& rate, double slope) const;
};

}  // namespace lv::material
