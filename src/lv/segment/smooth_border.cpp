#include "lv/segment/smooth_border.hpp"

#include "lv/base/dense.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace lv::segment {
namespace {

/// Columns 1, cos theta, sin theta, cos 2 theta, ...
Eigen::MatrixXd basis(Eigen::Index rays, int harmonics) {
  Eigen::MatrixXd A(rays, 2 * harmonics + 1);
  for (Eigen::Index i = 0; i < rays; ++i) {
    A(i, 0) = 1.0;
    for (int n = 1; n <= harmonics; ++n) {
      A(i, 2 * n - 1) = std::cos(n * ray_angle(i, rays));
      A(i, 2 * n) = std::sin(n * ray_angle(i, rays));
    }
  }
  return A;
}

/// Of the harmonics' squared amplitudes, (n^2 - 1)^2: the square of what each adds to the curvature
/// of a circle. Circles, wherever they lie, cost nothing.
Eigen::VectorXd bending(int harmonics) {
  Eigen::VectorXd cost = Eigen::VectorXd::Zero(2 * harmonics + 1);
  for (int n = 1; n <= harmonics; ++n)
    cost.segment(2 * n - 1, 2).setConstant(std::pow(n * n - 1.0, 2));
  return cost;
}

}  // namespace

Radii fit_border(const BorderFit& fit) {
  // of weights that follow the fit, if they do; it hardly moves after four
  const int rounds = fit.within == 1.0 ? 1 : 6;
  const Eigen::MatrixXd A = basis(fit.seen.size(), fit.harmonics);
  Radii weight = fit.weight;
  Radii r;
  for (int round = 0; round < rounds; ++round) {
    Eigen::MatrixXd M = A.transpose() * (weight + fit.trust).matrix().asDiagonal() * A;
    M.diagonal() += fit.stiffness * bending(fit.harmonics);
    const Eigen::VectorXd v =
        A.transpose() * (weight * fit.seen + fit.trust * fit.expected).matrix();
    r = (A * dense::solve_symmetric(M, v)).array();
    weight = (fit.seen < r).select(fit.within * fit.weight, fit.weight);
  }
  return r;
}

Radii harmonics_of(const Radii& radii, int harmonics) {
  const Radii one = Radii::Ones(radii.size());
  return fit_border({radii, one, radii, Radii::Zero(radii.size()), harmonics, 1.0, 0.0});
}

double chord(double r1, double r2, double angle, double whole) {
  return r1 * r2 * std::sin(whole) / (r1 * std::sin(angle) + r2 * std::sin(whole - angle));
}

Radii closed_straight(const Radii& line, const Radii& seen, const Radii& sees) {
  const Eigen::Index n = line.size();
  Radii closed = line;
  for (Eigen::Index a = 0; a < n; ++a) {
    Eigen::Index span = 1;
    while (span < n && sees((a + span) % n) < 0.5)
      ++span;
    if (sees(a) < 0.5 || 2 * span >= n)
      continue;
    for (Eigen::Index k = 1; k < span; ++k) {
      double& r = closed((a + k) % n);
      r = std::min(r, chord(seen(a), seen((a + span) % n), ray_angle(k, n), ray_angle(span, n)));
    }
  }
  return closed;
}

Radii convex(const Radii& radii) {
  const Eigen::Index n = radii.size();
  Radii hull = radii;
  Radii sine(n);  // of the angle over so many rays
  for (Eigen::Index k = 0; k < n; ++k)
    sine(k) = std::sin(ray_angle(k, n));
  // a chord between two rays less than half a turn apart lies at r on the rays between them
  for (Eigen::Index a = 0; a < n; ++a)
    for (Eigen::Index span = 2; 2 * span < n; ++span)
      for (Eigen::Index k = 1; k < span; ++k) {
        const double r1 = radii(a);
        const double r2 = radii((a + span) % n);
        const double chord = r1 * r2 * sine(span) / (r1 * sine(k) + r2 * sine(span - k));
        double& r = hull((a + k) % n);
        r = std::max(r, chord);
      }
  return hull;
}

}  // namespace lv::segment
