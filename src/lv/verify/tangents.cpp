#include "lv/material/law.hpp"
#include "lv/material/steady_tension.hpp"
#include "lv/material/volumetric.hpp"
#include "lv/verify/problems.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <random>

namespace lv::verify {
namespace {

using material::ActiveForm;
using material::HolzapfelOgden;
using material::Tangent;

constexpr double h = 1e-4;  ///< the shorter step of the differences

/// The differences' own error: of order four, 2e-10 for the stiffest law and 1e-12 for the others,
/// and rounding, 1e-16/h.
constexpr double tolerance = 1e-9;

/// True where no step of the differences meets a switch: fibres and sheets at their rest length,
/// and fibres at the limits of the steady tension.
bool smooth(const Mat3& F) {
  const double lambda = F.col(0).norm();
  const auto apart = [](double x, double y) { return std::abs(x - y) > 10.0 * h; };
  return apart(lambda, 1.0) && apart(F.col(1).norm(), 1.0) && apart(lambda, 0.8) &&
         apart(lambda, 1.15);
}

/// Turned and stretched at random, with principal stretches from 0.6 to 1.4.
std::vector<Mat3> deformations() {
  std::mt19937 generator(1);
  std::uniform_real_distribution<double> strain(-0.4, 0.4);
  std::normal_distribution<double> normal;
  const auto rotation = [&] {
    const Eigen::Vector4d q = Eigen::Vector4d::NullaryExpr([&] { return normal(generator); });
    return Eigen::Quaterniond(q.normalized()).toRotationMatrix();
  };
  std::vector<Mat3> all;
  while (all.size() < 1000) {
    const Vec3 stretch = Vec3::NullaryExpr([&] { return 1.0 + strain(generator); });
    const Mat3 F = rotation() * stretch.asDiagonal() * rotation();
    if (smooth(F))
      all.push_back(F);
  }
  return all;
}

/// dP/dF by central differences of two steps, extrapolated.
template <class Stress>
Tangent<double> differences(const Stress& stress, const Mat3& F) {
  Tangent<double> A;
  for (int c = 0; c < 9; ++c) {
    const auto difference = [&](double step) {
      Mat3 before = F;
      Mat3 after = F;
      before(c) -= step;
      after(c) += step;
      return Mat3((stress(after) - stress(before)) / (2.0 * step));
    };
    A.col(c) = ((4.0 * difference(h) - difference(2.0 * h)) / 3.0).reshaped();
  }
  return A;
}

/// The largest of |A - dP/dF| / |dP/dF|.
template <class Stress, class TangentOf>
double largest_error(const Stress& stress, const TangentOf& tangent) {
  double error = 0.0;
  for (const Mat3& F : deformations()) {
    const Tangent<double> expected = differences(stress, F);
    error = std::max(error, (tangent(F) - expected).norm() / expected.norm());
  }
  return error;
}

template <class Law>
void check_law(Findings& found, const std::string& name, const Law& law) {
  found.add_error(name,
                  largest_error([&](const Mat3& F) { return law.stress(F); },
                                [&](const Mat3& F) { return law.tangent(F); }),
                  tolerance);
}

/// With the steady tension at full calcium, which depends on the stretch.
void check_active(Findings& found, const std::string& name, ActiveForm form) {
  const material::SteadyTension steady({}, 1.0);
  const auto stress = [&](const Mat3& F) {
    Mat3 P = Mat3::Zero();
    P.col(0) =
        material::active_stress_column(F, determinant(F), steady.tension(F.col(0).norm()), form);
    return P;
  };
  const auto tangent = [&](const Mat3& F) {
    const double lambda = F.col(0).norm();
    return material::active_tangent(F, steady.tension(lambda), steady.derivative(lambda), form);
  };
  found.add_error(name, largest_error(stress, tangent), tolerance);
}

}  // namespace

void tangent_is_derivative(Findings& found) {
  check_law(found, "Holzapfel-Ogden, healthy", HolzapfelOgden{});
  check_law(found, "Holzapfel-Ogden, HO 2009",
            HolzapfelOgden{0.059, 8.023, 18.472, 16.026, 2.481, 11.12, 0.216, 11.436});
  check_law(found, "Guccione", material::Guccione{});
  check_law(found, "neo-Hookean", material::NeoHookean{});
  check_law(found, "volumetric penalty", material::Volumetric{});
  check_active(found, "active, T f (x) f", ActiveForm::niederer);
  check_active(found, "active, second Piola-Kirchhoff", ActiveForm::second_piola);
  check_active(found, "active, Cauchy", ActiveForm::cauchy);
}

}  // namespace lv::verify
