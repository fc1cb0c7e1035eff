#pragma once

#include "lv/base/tensor.hpp"

#include "support/packs.hpp"
#include "support/random_values.hpp"
#include <catch2/catch.hpp>

#include <cmath>

/// What every law must do, whatever it is made of: energy(F) and stress(F) with F's second index in
/// the fibre frame.
namespace lv::test {

/// Deformations of moderate size with positive volume, of all kinds: stretched and compressed
/// fibres and sheets, sheared, rotated.
inline std::vector<Mat3> deformations() {
  RandomValues random(7);
  std::vector<Mat3> result;
  while (result.size() < 20) {
    const Mat3 F = random.rotation() * (Mat3::Identity() + 0.25 * random.tensor());
    if (determinant(F) > 0.5)
      result.push_back(F);
  }
  return result;
}

/// Derivative of a function of F by central differences, extrapolated to order four. With steps of
/// 1e-3 what remains is the rounding of the energy over the step, 1e-16/1e-3 of its size, and
/// 1e-12 times its fifth derivative.
template <class Energy>
Mat3 derivative(const Energy& energy, const Mat3& F) {
  constexpr double h = 1e-3;
  Mat3 P;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const auto difference = [&](double step) {
        Mat3 plus = F;
        Mat3 minus = F;
        plus(i, j) += step;
        minus(i, j) -= step;
        return (energy(plus) - energy(minus)) / (2.0 * step);
      };
      P(i, j) = (4.0 * difference(h) - difference(2.0 * h)) / 3.0;
    }
  }
  return P;
}

/// Rest is free of stress, also after a rotation.
template <class Law>
void check_no_stress_at_rest(const Law& law) {
  RandomValues random(3);
  CHECK(law.stress(Mat3::Identity().eval()).norm() < 1e-14);  // exact but for rounding
  for (int i = 0; i < 5; ++i)
    CHECK(law.stress(random.rotation()).norm() < 1e-12);  // rounding of |F - F^-T|, moduli of 100
}

/// P = dW/dF, where `potential` is the energy that the stress derives from.
template <class Stress, class Potential>
void check_stress_is_derivative(const Stress& stress, const Potential& potential,
                                double tolerance = 1e-8) {
  for (const Mat3& F : deformations()) {
    const Mat3 P = stress(F);
    CHECK((P - derivative(potential, F)).norm() <= tolerance * (1.0 + P.norm()));
  }
}

/// W(QF) = W(F), P(QF) = Q P(F), and so P F^T is symmetric.
template <class Law>
void check_objective(const Law& law) {
  RandomValues random(4);
  for (const Mat3& F : deformations()) {
    const Mat3 Q = random.rotation();
    const Mat3 P = law.stress(F);
    const double rounding = 1e-12 * (1.0 + P.norm());  // exponents of size 10 amplify 1e-16
    CHECK(law.energy(Mat3(Q * F)) == Approx(law.energy(F)).epsilon(1e-12).margin(1e-12));
    CHECK((law.stress(Mat3(Q * F)) - Q * P).norm() < rounding);
    CHECK((P * F.transpose() - F * P.transpose()).norm() < rounding);
  }
}

/// The kernels of the wall use packs of doubles: every lane has its own stress.
template <class Law>
void check_packs_agree(const Law& law) {
  const auto all = deformations();
  std::array<Mat3, pack_size> F;
  std::copy_n(all.begin(), pack_size, F.begin());
  const Tensor<Pack> P = law.stress(packed(F));
  for (int i = 0; i < pack_size; ++i) {
    const Mat3 expected = law.stress(F[i]);
    // exp and log of packs differ by an ulp or two from those of the C library
    CHECK((lane(P, i) - expected).norm() < 1e-13 * (1.0 + expected.norm()));
  }
}

/// All of the above for a law whose stress is the derivative of its own energy.
template <class Law>
void check_law(const Law& law) {
  check_no_stress_at_rest(law);
  check_stress_is_derivative([&](const Mat3& F) { return law.stress(F); },
                             [&](const Mat3& F) { return law.energy(F); });
  check_objective(law);
  check_packs_agree(law);
}

}  // namespace lv::test
