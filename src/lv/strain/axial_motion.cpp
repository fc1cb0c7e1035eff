#include "lv/strain/axial_motion.hpp"

#include "lv/base/dense.hpp"

#include <algorithm>
#include <cmath>

namespace lv::strain {
namespace {

constexpr int terms = 4;

Eigen::Matrix<double, 1, terms> terms_at(const geometry::Frame& frame, const Vec3& X) {
  const Vec3 x = frame.to_model(X);
  return {1.0, x.z(), x.z() * x.x(), x.z() * x.y()};
}

/// A point at a part of a curve's length.
Vec3 along(const std::vector<Vec3>& curve, double part) {
  double length = 0.0;
  for (std::size_t i = 1; i < curve.size(); ++i)
    length += (curve[i] - curve[i - 1]).norm();
  double left = part * length;
  for (std::size_t i = 1; i < curve.size(); ++i) {
    const double step = (curve[i] - curve[i - 1]).norm();
    if (left <= step)
      return curve[i - 1] + left / step * (curve[i] - curve[i - 1]);
    left -= step;
  }
  return curve.back();
}

/// Points spread over the wall between the two curves.
std::vector<Vec3> wall_points(const LongAxisTask& view) {
  constexpr int lengthwise = 80;
  constexpr int layers = 4;
  const std::vector<Vec3>& epi = view.epi.points;
  std::vector<Vec3> endo = view.endo.points;
  if ((endo.front() - epi.front()).norm() > (endo.back() - epi.front()).norm())
    std::reverse(endo.begin(), endo.end());
  std::vector<Vec3> points;
  for (int i = 0; i < lengthwise; ++i)
    for (int l = 0; l < layers; ++l) {
      const double part = (i + 0.5) / lengthwise;
      const double depth = (l + 0.5) / layers;
      points.push_back((1.0 - depth) * along(endo, part) + depth * along(epi, part));
    }
  return points;
}

/// Points of the wall on one view and how far along `up` they go: a row per point, a column per
/// image from the one with the curves on [mm].
struct Seen {
  std::vector<Vec3> X;
  Eigen::MatrixXd u;
};

Seen follow(const LongAxisTask& view, const Vec3& up, const RegistrationParameters& parameters) {
  const auto& frames = view.cine->frames;
  const image::Plane& plane = frames.at(view.drawn).plane;
  const auto flat = [&](const Vec3& x) {
    const Vec3 d = x - plane.origin;
    return Vec2(d.dot(plane.along_row), d.dot(plane.along_column));
  };
  std::vector<Vec2> outline;
  for (const Vec3& x : view.epi.points)
    outline.push_back(flat(x));
  const Vec2 up_flat(up.dot(plane.along_row), up.dot(plane.along_column));
  Tracker tracker(frames[view.drawn], outline, parameters);
  Seen seen{wall_points(view), {}};
  seen.u = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(seen.X.size()),
                                 static_cast<Eigen::Index>(frames.size()));
  for (std::size_t k = 1; k < frames.size(); ++k) {
    tracker.follow(frames[(view.drawn + k) % frames.size()]);
    for (std::size_t i = 0; i < seen.X.size(); ++i) {
      const Vec2 X = flat(seen.X[i]);
      seen.u(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) =
          up_flat.dot(tracker(X).x - X);
    }
  }
  return seen;
}

/// Columns of one cycle interpolated linearly to another number of steps.
Eigen::MatrixXd resampled(const Eigen::MatrixXd& u, int steps) {
  Eigen::MatrixXd result(u.rows(), steps);
  for (int k = 0; k < steps; ++k) {
    const double at = static_cast<double>(k * u.cols()) / steps;
    const auto before = static_cast<Eigen::Index>(at);
    const double w = at - std::floor(at);
    result.col(k) = (1.0 - w) * u.col(before) + w * u.col((before + 1) % u.cols());
  }
  return result;
}

}  // namespace

AxialMotion::AxialMotion(const std::vector<LongAxisTask>& views, const geometry::Frame& frame,
                         int images, const RegistrationParameters& parameters)
    : frame_(frame) {
  std::vector<Seen> seen;
  Eigen::Index rows = 0;
  for (const LongAxisTask& view : views) {
    seen.push_back(follow(view, frame.axes.col(2), parameters));
    rows += seen.back().u.rows();
  }
  Eigen::MatrixXd A(rows, terms);
  Eigen::MatrixXd u(rows, images);
  Eigen::Index row = 0;
  for (const Seen& view : seen) {
    u.middleRows(row, view.u.rows()) = resampled(view.u, images);
    for (const Vec3& X : view.X)
      A.row(row++) = terms_at(frame, X);
  }
  coefficients_ = dense::least_squares(A, u);
  const Eigen::MatrixXd left = A * coefficients_ - u;
  for (Eigen::Index k = 0; k < images; ++k)
    residuals_.push_back(std::sqrt(left.col(k).squaredNorm() / static_cast<double>(rows)));
}

double AxialMotion::operator()(const Vec3& X, int step) const {
  return terms_at(frame_, X).dot(coefficients_.col(step));
}

}  // namespace lv::strain
