#pragma once

#include "lv/material/tangent.hpp"

#include "support/random_values.hpp"
#include <catch2/catch.hpp>

#include <cmath>
#include <vector>

/// What the tangent of every law must do, whatever it is made of.
namespace lv::test {

/// Turned and stretched at random, principal stretches from 0.6 to 1.4, so that fibres and sheets
/// are longer and shorter than at rest in every combination. The switches at I4f = 1 and I4s = 1,
/// where a stress has no derivative, are farther away than the steps of the differences below.
inline std::vector<Mat3> strained(std::size_t count) {
  RandomValues random(11);
  std::vector<Mat3> result;
  while (result.size() < count) {
    const Mat3 Q = random.rotation();
    const Vec3 stretch = Vec3::Ones() + 0.4 * random.vector();
    const Mat3 F = random.rotation() * Q * stretch.asDiagonal() * Q.transpose();
    if (std::abs(F.col(0).squaredNorm() - 1.0) > 0.02 &&
        std::abs(F.col(1).squaredNorm() - 1.0) > 0.02)
      result.push_back(F);
  }
  return result;
}

/// Derivative of a stress by central differences with two steps, extrapolated to order four.
template <class Stress>
material::Tangent<double> tangent_of(const Stress& stress, const Mat3& F) {
  constexpr double h = 1e-4;
  material::Tangent<double> A;
  for (int c = 0; c < 9; ++c) {
    const auto difference = [&](double step) {
      Mat3 plus = F;
      Mat3 minus = F;
      plus(c) += step;
      minus(c) -= step;
      return Mat3((stress(plus) - stress(minus)) / (2.0 * step));
    };
    A.col(c) = ((4.0 * difference(h) - difference(2.0 * h)) / 3.0).reshaped();
  }
  return A;
}

/// Tangent = dP/dF, where stress(F) and tangent(F) are functions.
template <class Stress, class TangentOf>
void check_tangent_is_derivative(const Stress& stress, const TangentOf& tangent) {
  for (const Mat3& F : strained(200)) {
    const material::Tangent<double> expected = tangent_of(stress, F);
    CHECK((tangent(F) - expected).norm() < 1e-9 * expected.norm());
  }
}

/// The same for a law with members of those names.
template <class Law>
void check_tangent(const Law& law) {
  check_tangent_is_derivative([&](const Mat3& F) { return law.stress(F); },
                              [&](const Mat3& F) { return law.tangent(F); });
}

/// The tangent of a stress that has a potential is symmetric.
template <class TangentOf>
void check_symmetric(const TangentOf& tangent) {
  for (const Mat3& F : strained(50)) {
    const material::Tangent<double> A = tangent(F);
    CHECK((A - A.transpose()).norm() < 1e-14 * A.norm());
  }
}

}  // namespace lv::test
