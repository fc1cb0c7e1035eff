#include "lv/strain/warp.hpp"

#include "lv/base/check.hpp"
#include "lv/base/dense.hpp"
#include "lv/base/interrupt.hpp"
#include "lv/geometry/polygon.hpp"
#include "lv/strain/grey_image.hpp"

#include <fmt/format.h>
#include <itkBSplineTransform.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace lv::strain {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using Spline = itk::BSplineTransform<double, 2, 3>;

/// Whether a point lies in a polygon or not farther than `margin` from it.
bool near(const geometry::Polygon& polygon, const Vec2& x, double margin) {
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++)
    if (geometry::distance_to_segment(x, polygon[i], polygon[j]) <= margin)
      return true;
  return geometry::encloses(polygon, x);
}

/// The part of an image around the outline, with room for it to move.
Window window(const image::Plane& plane, const std::vector<Vec2>& outline, double room) {
  Vec2 low = outline.front();
  Vec2 high = outline.front();
  for (const Vec2& x : outline) {
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  const auto pixel = [](double x, double spacing, int count) {
    return std::clamp(static_cast<int>(std::lround(x / spacing)), 0, count - 1);
  };
  const int left = pixel(low.x() - room, plane.spacing_i, plane.columns);
  const int right = pixel(high.x() + room, plane.spacing_i, plane.columns);
  const int top = pixel(low.y() - room, plane.spacing_j, plane.rows);
  const int bottom = pixel(high.y() + room, plane.spacing_j, plane.rows);
  return {left, top, right - left + 1, bottom - top + 1};
}

/// Value and derivatives of the four cubic B-splines on one interval, at x in [0, 1].
std::array<std::array<double, 4>, 3> cubics(double x) {
  const double y = 1.0 - x;
  return {{{y * y * y / 6.0, (3.0 * x * x * x - 6.0 * x * x + 4.0) / 6.0,
            (3.0 * y * y * y - 6.0 * y * y + 4.0) / 6.0, x * x * x / 6.0},
           {-0.5 * y * y, 1.5 * x * x - 2.0 * x, -1.5 * y * y + 2.0 * y, 0.5 * x * x},
           {y, 3.0 * x - 2.0, 3.0 * y - 2.0, x}}};
}

/// Mean over the grid's extent of products of d-th derivatives of the B-splines, h their spacing.
MatrixXd gram(int intervals, int d, double h) {
  constexpr std::array<double, 4> at{0.0694318442029737, 0.3300094782075719, 0.6699905217924281,
                                     0.9305681557970263};
  constexpr std::array<double, 4> weight{0.1739274225687269, 0.3260725774312731, 0.3260725774312731,
                                         0.1739274225687269};
  MatrixXd G = MatrixXd::Zero(intervals + 3, intervals + 3);
  for (int e = 0; e < intervals; ++e)
    for (std::size_t q = 0; q < at.size(); ++q) {
      const auto B = cubics(at[q])[d];
      for (int a = 0; a < 4; ++a)
        for (int b = 0; b < 4; ++b)
          G(e + a, e + b) += weight[q] * B[a] * B[b];
    }
  return G / (intervals * std::pow(h, 2 * d));
}

/// The bending energy mean |D^2 u|^2 of one component as a quadratic form of its coefficients.
MatrixXd bending_energy(const std::array<int, 2>& intervals, const std::array<double, 2>& h) {
  std::array<std::array<MatrixXd, 3>, 2> G;
  for (int axis = 0; axis < 2; ++axis)
    for (int d = 0; d < 3; ++d)
      G[axis][d] = gram(intervals[axis], d, h[axis]);
  const auto nx = G[0][0].rows();
  const auto ny = G[1][0].rows();
  MatrixXd K(nx * ny, nx * ny);
  for (Eigen::Index b = 0; b < ny; ++b)
    for (Eigen::Index d = 0; d < ny; ++d)
      K.block(b * nx, d * nx, nx, nx) =
          G[1][0](b, d) * G[0][2] + 2.0 * G[1][1](b, d) * G[0][1] + G[1][2](b, d) * G[0][0];
  return K;
}

/// One pixel of the heart on the first image, with what does not change as it is followed.
struct Sample {
  itk::Point<double, 2> X;
  Spline::WeightsType weights;
  Spline::ParameterIndexArrayType indices;
};

/// Quadratic model of the sum of squares around some coefficients.
struct Normal {
  double value = 0.0;  ///< mean of the squared differences
  MatrixXd A;          ///< Gauss and Newton's approximation of half the second derivatives
  VectorXd b;          ///< half the first derivatives
};

}  // namespace

class Tracker::Implementation {
 public:
  Implementation(const image::Picture& first, const std::vector<Vec2>& outline,
                 const RegistrationParameters& p)
      : parameters_(p), plane_(first.plane) {
    constexpr double room = 8.0;  // for the outline to move, and for the splines that end there
    window_ = window(first.plane, outline, p.margin + room);
    first_ = cropped(first, window_);
    make_spline();
    choose_samples(outline);
    previous_ = first_;
  }

  Match follow(const image::Picture& next) {
    if (next.plane.columns != plane_.columns || next.plane.rows != plane_.rows)
      throw InputError(
          "cine",
          fmt::format("an image of {} x {} pixels follows one of {} x {}", next.plane.columns,
                      next.plane.rows, plane_.columns, plane_.rows),
          "Give images of one size for every slice");
    const GreyImage::Pointer image = cropped(next, window_);
    const VectorXd start = coefficients_;
    Match match;
    // smooth images and stiff maps first, lest texture be matched with its neighbour
    for (const auto& [blur, stiffness] : {std::pair{4.0, 100.0}, {2.0, 10.0}, {0.0, 1.0}}) {
      const double sigma = std::hypot(parameters_.smoothing, blur);
      const std::vector<double> values = template_values(sigma, start);
      stiffness_ = stiffness;
      const Match level = minimise(*interpolated(image, sigma), values);
      match = {level.residual, match.iterations + level.iterations};
    }
    previous_ = image;
    return match;
  }

  [[nodiscard]] Moved at(const Vec2& X) const {
    // ITK 5.2 has no derivative of this transform; of a piecewise cubic, differences are good to
    // the square of their step
    constexpr double step = 1e-3;  // [mm]
    Moved m{mapped(X), {}};
    for (int d = 0; d < 2; ++d)
      m.F.col(d) =
          (mapped(X + step * Vec2::Unit(d)) - mapped(X - step * Vec2::Unit(d))) / (2.0 * step);
    return m;
  }

 private:
  [[nodiscard]] Vec2 mapped(const Vec2& X) const {
    const auto x = spline_->TransformPoint(itk::Point<double, 2>(X.data()));
    return {x[0], x[1]};
  }

  void make_spline() {
    const std::array<double, 2> extent{(window_.columns - 1) * plane_.spacing_i,
                                       (window_.rows - 1) * plane_.spacing_j};
    std::array<int, 2> intervals{};
    std::array<double, 2> h{};
    Spline::MeshSizeType mesh;
    Spline::PhysicalDimensionsType dimensions;
    for (int d = 0; d < 2; ++d) {
      intervals[d] =
          std::max(1, static_cast<int>(std::lround(extent[d] / parameters_.knot_spacing)));
      // a sample on the grid's far edge would lie outside it
      dimensions[d] = extent[d] * (1.0 + 1e-9);
      h[d] = dimensions[d] / intervals[d];
      mesh[d] = intervals[d];
    }
    spline_ = Spline::New();
    spline_->SetTransformDomainOrigin(first_->GetOrigin());
    spline_->SetTransformDomainDirection(first_->GetDirection());
    spline_->SetTransformDomainPhysicalDimensions(dimensions);
    spline_->SetTransformDomainMeshSize(mesh);
    per_component_ = static_cast<int>(spline_->GetNumberOfParametersPerDimension());
    bending_ = parameters_.bending * bending_energy(intervals, h);
    set(VectorXd::Zero(2 * per_component_));
  }

  void choose_samples(const std::vector<Vec2>& outline) {
    for (int j = 0; j < window_.rows; ++j)
      for (int i = 0; i < window_.columns; ++i) {
        const Vec2 X((window_.left + i) * plane_.spacing_i, (window_.top + j) * plane_.spacing_j);
        if (!near(outline, X, parameters_.margin))
          continue;
        Sample s;
        s.X = itk::Point<double, 2>(X.data());
        s.weights.SetSize(spline_->GetNumberOfWeights());
        s.indices.SetSize(spline_->GetNumberOfWeights());
        spline_->ComputeJacobianFromBSplineWeightsWithRespectToPosition(s.X, s.weights, s.indices);
        samples_.push_back(s);
      }
  }

  void set(const VectorXd& coefficients) {
    coefficients_ = coefficients;
    Spline::ParametersType p(coefficients.size());
    std::copy(coefficients.begin(), coefficients.end(), p.begin());
    spline_->SetParametersByValue(p);
  }

  [[nodiscard]] itk::Point<double, 2> moved(const Sample& s, const VectorXd& p) const {
    auto x = s.X;
    for (unsigned a = 0; a < s.weights.Size(); ++a) {
      x[0] += s.weights[a] * p[s.indices[a]];
      x[1] += s.weights[a] * p[per_component_ + s.indices[a]];
    }
    return x;
  }

  /// Grey values that the samples had, with mean and deviation taken away by `scale_`.
  [[nodiscard]] std::vector<double> template_values(double sigma, const VectorXd& before) {
    const bool direct = parameters_.scheme == Template::direct;
    const auto image = interpolated(direct ? first_ : previous_, sigma);
    const VectorXd p = direct ? VectorXd::Zero(before.size()) : before;
    std::vector<double> values;
    double sum = 0.0;
    double squares = 0.0;
    for (const Sample& s : samples_) {
      const auto x = moved(s, p);
      const double value =
          image->IsInsideBuffer(x) ? image->Evaluate(x) : std::numeric_limits<double>::quiet_NaN();
      values.push_back(value);
      if (std::isnan(value))
        continue;
      sum += value;
      squares += value * value;
    }
    const double n = static_cast<double>(values.size());
    scale_ = 1.0 / std::sqrt(std::max(squares / n - sum * sum / (n * n), 1e-12));
    return values;
  }

  [[nodiscard]] Normal linearised(const Interpolator& image, const std::vector<double>& values,
                                  const VectorXd& p, bool derivatives) const {
    const int n = per_component_;
    Normal normal;
    if (derivatives) {
      normal.A = MatrixXd::Zero(2 * n, 2 * n);
      normal.b = VectorXd::Zero(2 * n);
    }
    for (std::size_t i = 0; i < samples_.size(); ++i) {
      const Sample& s = samples_[i];
      const auto x = moved(s, p);
      if (std::isnan(values[i]) || !image.IsInsideBuffer(x))
        continue;
      if (!derivatives) {
        const double r = scale_ * (image.Evaluate(x) - values[i]);
        normal.value += r * r;
        continue;
      }
      double value = 0.0;
      Interpolator::CovariantVectorType slope;
      image.EvaluateValueAndDerivative(x, value, slope);
      const double r = scale_ * (value - values[i]);
      normal.value += r * r;
      add(s, scale_ * slope[0], scale_ * slope[1], r, normal);
    }
    const double count = static_cast<double>(samples_.size());
    normal.value /= count;
    if (derivatives) {
      normal.A /= count;
      normal.b /= count;
      const MatrixXd A = normal.A.selfadjointView<Eigen::Lower>();
      normal.A = A;
    }
    return normal;
  }

  /// Adds one sample's residual r with its image slope (gx, gy); A's lower triangle alone.
  void add(const Sample& s, double gx, double gy, double r, Normal& normal) const {
    const int n = per_component_;
    for (unsigned a = 0; a < s.weights.Size(); ++a) {
      const double wa = s.weights[a];
      const auto ia = static_cast<Eigen::Index>(s.indices[a]);
      normal.b[ia] += wa * gx * r;
      normal.b[n + ia] += wa * gy * r;
      for (unsigned c = 0; c < s.weights.Size(); ++c) {
        const double w = wa * s.weights[c];
        const auto ic = static_cast<Eigen::Index>(s.indices[c]);
        normal.A(n + ic, ia) += w * gx * gy;
        if (ic < ia)
          continue;
        normal.A(ic, ia) += w * gx * gx;
        normal.A(n + ic, n + ia) += w * gy * gy;
      }
    }
  }

  [[nodiscard]] VectorXd bent(const VectorXd& p) const {
    VectorXd f(p.size());
    f.head(per_component_) = stiffness_ * (bending_ * p.head(per_component_));
    f.tail(per_component_) = stiffness_ * (bending_ * p.tail(per_component_));
    return f;
  }

  Match minimise(const Interpolator& image, const std::vector<double>& values) {
    constexpr int most = 15;
    constexpr double enough = 0.01;  // [mm]
    const int n = per_component_;
    VectorXd p = coefficients_;
    double damping = 1e-4;
    Normal normal = linearised(image, values, p, true);
    double energy = normal.value + p.dot(bent(p));
    Match match;
    while (match.iterations < most && damping < 1e6) {
      interrupt::check();
      ++match.iterations;
      MatrixXd A = normal.A;
      A.topLeftCorner(n, n) += stiffness_ * bending_;
      A.bottomRightCorner(n, n) += stiffness_ * bending_;
      A.diagonal().array() *= 1.0 + damping;
      A.diagonal().array() += 1e-9;  // splines that no sample touches
      const VectorXd step = dense::solve_symmetric(A, -(normal.b + bent(p)));
      const VectorXd q = p + step;
      const double value = linearised(image, values, q, false).value;
      const double next = value + q.dot(bent(q));
      if (next > energy) {
        damping = std::max(10.0 * damping, 1e-3);
        continue;
      }
      p = q;
      damping = std::max(0.1 * damping, 1e-8);
      const bool still = step.lpNorm<Eigen::Infinity>() < enough || energy - next < 1e-5 * energy;
      energy = next;
      if (still)
        break;
      normal = linearised(image, values, p, true);
    }
    set(p);
    match.residual = std::sqrt(linearised(image, values, p, false).value);
    return match;
  }

  RegistrationParameters parameters_;
  image::Plane plane_;
  Window window_{};
  GreyImage::Pointer first_, previous_;
  Spline::Pointer spline_;
  MatrixXd bending_;
  VectorXd coefficients_;
  std::vector<Sample> samples_;
  int per_component_ = 0;
  double scale_ = 1.0;
  double stiffness_ = 1.0;  ///< factor of the bending energy on the present level
};

Tracker::Tracker(const image::Picture& first, const std::vector<Vec2>& outline,
                 const RegistrationParameters& parameters)
    : implementation_(std::make_unique<Implementation>(first, outline, parameters)) {}
Tracker::~Tracker() = default;
Tracker::Tracker(Tracker&&) noexcept = default;
Tracker& Tracker::operator=(Tracker&&) noexcept = default;

Match Tracker::follow(const image::Picture& next) {
  return implementation_->follow(next);
}

Moved Tracker::operator()(const Vec2& X) const {
  return implementation_->at(X);
}

}  // namespace lv::strain
