#include "lv/geometry/surface_fit.hpp"

#include "lv/base/dense.hpp"

#include <Eigen/Cholesky>
#include <Eigen/SparseCore>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>

namespace lv::geometry {
namespace {

using std::numbers::pi;

/// One row of a least-squares system with few entries.
struct SparseRow {
  std::vector<int> index;
  std::vector<double> value;

  void add(int i, double v) {
    index.push_back(i);
    value.push_back(v);
  }
};

/// K x = f, the normal equations of sum w (row . x - right)^2.
struct NormalEquations {
  Eigen::MatrixXd K;
  Eigen::VectorXd f;

  explicit NormalEquations(int size)
      : K(Eigen::MatrixXd::Zero(size, size)), f(Eigen::VectorXd::Zero(size)) {}

  void add(const SparseRow& row, double right, double weight) {
    for (std::size_t i = 0; i < row.index.size(); ++i) {
      for (std::size_t j = 0; j < row.index.size(); ++j)
        K(row.index[i], row.index[j]) += weight * row.value[i] * row.value[j];
      f(row.index[i]) += weight * row.value[i] * right;
    }
  }
};

/// The family of surfaces on one spheroid and its place among the unknowns of the whole fit.
class SplineSpace {
 public:
  SplineSpace(const std::vector<Sample>& samples, const SplineFitParameters& p)
      : spheroid_(reference_spheroid(samples)),
        along_(CubicBasis::Ends::clamped, p.along, farthest_angle(samples)),
        around_(CubicBasis::Ends::periodic, p.around, 2.0 * pi) {}

  [[nodiscard]] const Spheroid& spheroid() const { return spheroid_; }
  [[nodiscard]] double last_angle() const { return along_.end(); }
  [[nodiscard]] int size() const { return along_.size() * around_.size(); }
  [[nodiscard]] int index(int k, int j) const { return k * around_.size() + j; }
  /// Coefficients that remain free at a smooth pole.
  [[nodiscard]] int free_size() const { return 3 + (along_.size() - 2) * around_.size(); }

  [[nodiscard]] StarSurface surface(const Eigen::Ref<const Eigen::VectorXd>& c) const {
    Eigen::MatrixXd table(along_.size(), around_.size());
    for (int k = 0; k < along_.size(); ++k)
      for (int j = 0; j < around_.size(); ++j)
        table(k, j) = c(index(k, j));
    return {spheroid_, along_, around_, table};
  }

  [[nodiscard]] StarSurface sphere() const { return surface(Eigen::VectorXd::Ones(size())); }

  /// The coefficients' part in s(mu, theta), times `factor`.
  void add_value(double mu, double theta, double factor, int first, SparseRow& row) const {
    const auto N = along_.at(mu);
    const auto M = around_.at(theta);
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j)
        row.add(first + index(N.index[i], M.index[j]), factor * N.value[i] * M.value[j]);
  }

  void add_bending(double weight, int first, NormalEquations& equations) const;
  void add_pole(int first, int first_free, std::vector<Eigen::Triplet<double>>& map) const;

 private:
  struct Ring;
  [[nodiscard]] double farthest_angle(const std::vector<Sample>& samples) const;
  [[nodiscard]] Ring ring(double mu) const;
  void add_bending_at(const Ring& at, double theta, double weight, int first,
                      NormalEquations& equations) const;

  Spheroid spheroid_;
  CubicBasis along_, around_;
};

/// The angle up to which the points tell the surface: that of every point, and of the base below or
/// above the points near it.
double SplineSpace::farthest_angle(const std::vector<Sample>& samples) const {
  double angle = 0.0;
  for (const Sample& p : samples) {
    angle = std::max(angle, polar(spheroid_, p.x).mu);
    if (p.x.z() > 0.5 * spheroid_.z0)
      angle = std::max(angle, polar(spheroid_, {p.x.x(), p.x.y(), 0.0}).mu);
  }
  return angle;
}

/// The spheroid's geometry on one parallel.
struct SplineSpace::Ring {
  double mu;
  double h;           ///< distance of the tangent plane from the centre [mm]
  double r, r_sigma;  ///< radius, and its change with the arc length sigma
  double g, g_mu;     ///< d(sigma)/d(mu), and its derivative
};

SplineSpace::Ring SplineSpace::ring(double mu) const {
  const double a = spheroid_.a;
  const double c = spheroid_.c;
  const double sine = std::sin(mu);
  const double cosine = std::cos(mu);
  Ring ring{};
  ring.mu = mu;
  ring.h = 1.0 / std::hypot(sine / a, cosine / c);
  ring.g = std::hypot(a * cosine, c * sine);
  ring.g_mu = (c * c - a * a) * sine * cosine / ring.g;
  ring.r = a * sine;
  ring.r_sigma = a * cosine / ring.g;
  return ring;
}

/// The three components of grad grad s on a surface of revolution:
///   s_,sigma sigma,  (s_,sigma theta - r'/r s_,theta)/r,  s_,theta theta/r^2 + r'/r s_,sigma.
void SplineSpace::add_bending_at(const Ring& at, double theta, double weight, int first,
                                 NormalEquations& equations) const {
  const auto N = along_.at(at.mu);
  const auto M = around_.at(theta);
  SparseRow along, twist, around;
  for (int i = 0; i < 4; ++i) {
    const double N_sigma = N.slope[i] / at.g;
    const double N_sigma_sigma = (N.curvature[i] - at.g_mu * N_sigma) / (at.g * at.g);
    for (int j = 0; j < 4; ++j) {
      const int at_ij = first + index(N.index[i], M.index[j]);
      along.add(at_ij, at.h * N_sigma_sigma * M.value[j]);
      twist.add(at_ij, at.h * (N_sigma - at.r_sigma / at.r * N.value[i]) * M.slope[j] / at.r);
      around.add(at_ij, at.h * (N.value[i] * M.curvature[j] / (at.r * at.r) +
                                at.r_sigma / at.r * N_sigma * M.value[j]));
    }
  }
  equations.add(along, 0.0, weight);
  equations.add(twist, 0.0, 2.0 * weight);
  equations.add(around, 0.0, weight);
}

/// weight/A integral of |h grad grad s|^2 dA, by Gauss points in each interval of mu and two points
/// in each of theta.
void SplineSpace::add_bending(double weight, int first, NormalEquations& equations) const {
  constexpr std::array<double, 3> at{0.1127016653792583, 0.5, 0.8872983346207417};
  constexpr std::array<double, 3> share{5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};
  const int angles = 2 * around_.intervals();
  NormalEquations sum(static_cast<int>(equations.f.size()));
  double area = 0.0;
  for (int k = 0; k < along_.intervals(); ++k)
    for (int q = 0; q < 3; ++q) {
      const Ring parallel = ring(along_.step() * (k + at[q]));
      const double dA = share[q] * along_.step() * parallel.g * 2.0 * pi * parallel.r / angles;
      for (int j = 0; j < angles; ++j)
        add_bending_at(parallel, 2.0 * pi * (j + 0.5) / angles, dA, first, sum);
      area += dA * angles;
    }
  equations.K += weight / area * sum.K;
}

/// Writes all coefficients by the free ones. One value at the pole: c_0j = q_0. One tangent plane:
/// the slope there, which is proportional to c_1j - c_0j, is a multiple of cos and sin theta; the
/// periodic spline that equals cos theta at its knots has the coefficients
/// 3 cos(theta_j)/(2 + cos(step)).
void SplineSpace::add_pole(int first, int first_free,
                           std::vector<Eigen::Triplet<double>>& map) const {
  const int m = around_.size();
  const double gain = 3.0 / (2.0 + std::cos(around_.step()));
  for (int j = 0; j < m; ++j) {
    const double theta = j * around_.step();
    map.emplace_back(first + index(0, j), first_free, 1.0);
    map.emplace_back(first + index(1, j), first_free, 1.0);
    map.emplace_back(first + index(1, j), first_free + 1, gain * std::cos(theta));
    map.emplace_back(first + index(1, j), first_free + 2, gain * std::sin(theta));
  }
  for (int k = 2; k < along_.size(); ++k)
    for (int j = 0; j < m; ++j)
      map.emplace_back(first + index(k, j), first_free + 3 + (k - 2) * m + j, 1.0);
}

/// The area of the spheroid, up to the last angle, that lies nearer to each sample than to any
/// other [mm^2], the samples projected on the spheroid from its centre.
std::vector<double> represented_areas(const SplineSpace& space,
                                      const std::vector<Sample>& samples) {
  constexpr int rows = 96;
  constexpr int angles = 192;
  const Spheroid& spheroid = space.spheroid();
  std::vector<Vec3> feet;
  for (const Sample& p : samples) {
    const Polar at = polar(spheroid, p.x);
    feet.push_back(cartesian(spheroid, {1.0, at.mu, at.theta}));
  }
  std::vector<double> areas(samples.size(), 0.0);
  for (int i = 0; i < rows; ++i) {
    const double mu = space.last_angle() * (i + 0.5) / rows;
    const double meridian = std::hypot(spheroid.a * std::cos(mu), spheroid.c * std::sin(mu));
    const double dA =
        meridian * space.last_angle() / rows * spheroid.a * std::sin(mu) * 2.0 * pi / angles;
    for (int j = 0; j < angles; ++j) {
      const Vec3 x = cartesian(spheroid, {1.0, mu, 2.0 * pi * (j + 0.5) / angles});
      const auto nearest =
          std::min_element(feet.begin(), feet.end(), [&](const Vec3& p, const Vec3& q) {
            return (p - x).squaredNorm() < (q - x).squaredNorm();
          });
      areas[nearest - feet.begin()] += dA;
    }
  }
  return areas;
}

/// The mean square of the samples' distances from a surface, by weight [mm^2]; none if no sample of
/// the source has a weight.
std::optional<double> mean_square_distance(const StarSurface& surface,
                                           const std::vector<Sample>& samples,
                                           const std::vector<double>& weights, Source source) {
  double sum = 0.0;
  double total = 0.0;
  for (std::size_t i = 0; i < samples.size(); ++i)
    if (samples[i].source == source) {
      const double d = surface.distance(samples[i].x);
      sum += weights[i] * d * d;
      total += weights[i];
    }
  return total > 0.0 ? std::optional(sum / total) : std::nullopt;
}

/// The Gauss-Newton iteration for both surfaces and the slices' positions.
class Fit {
 public:
  Fit(const FitData& data, const SplineFitParameters& p)
      : data_(data),
        spaces_{SplineSpace(data.samples[0], p), SplineSpace(data.samples[1], p)},
        first_{0, spaces_[0].size()},
        first_shift_(spaces_[0].size() + spaces_[1].size()),
        fixed_(first_shift_ + 2 * slices()),
        surfaces_{spaces_[0].sphere(), spaces_[1].sphere()},
        weights_{represented_areas(spaces_[0], data.samples[0]),
                 represented_areas(spaces_[1], data.samples[1])},
        shifts_(data.planes.size(), Vec3::Zero()) {
    const double l2 = p.smoothing_length * p.smoothing_length;
    for (const int side : {0, 1})
      spaces_[side].add_bending(l2 * l2, first_[side], fixed_);
    add_prior();
    make_map();
  }

  FittedSurfaces run() {
    iterate();
    if (slices() == 0) {
      weigh_sources();
      iterate();
    }
    return {surfaces_[0], surfaces_[1], shifts_};
  }

 private:
  [[nodiscard]] int slices() const { return static_cast<int>(data_.planes.size()); }

  void iterate() {
    constexpr int most = 60;
    constexpr int least = 4;
    constexpr double tolerance = 1e-3;  // change of shifts [mm]
    for (int i = 0; i < most; ++i)
      if (step() < tolerance && i + 1 >= least)
        break;
  }

  [[nodiscard]] double total_weight(int side) const {
    return std::accumulate(weights_[side].begin(), weights_[side].end(), 0.0);
  }

  [[nodiscard]] bool moves(const Sample& p) const { return p.slice >= 0 && slices() > 0; }

  /// Divides the weights of long-axis points by the ratio of the two sources' variances.
  void weigh_sources() {
    constexpr double finest = 0.1;  // no contour is drawn more finely [mm]
    for (const int side : {0, 1}) {
      const auto variance = [&](Source source) {
        return mean_square_distance(surfaces_[side], data_.samples[side], weights_[side], source);
      };
      const auto short_axis = variance(Source::short_axis);
      const auto long_axis = variance(Source::long_axis);
      if (!short_axis || !long_axis)
        continue;
      const double ratio = (*short_axis + finest * finest) / (*long_axis + finest * finest);
      for (std::size_t i = 0; i < weights_[side].size(); ++i)
        if (data_.samples[side][i].source == Source::long_axis)
          weights_[side][i] *= ratio;
    }
  }

  void add_prior() {
    constexpr double share = 0.01;
    for (const int side : {0, 1})
      for (std::size_t n = 0; n < weights_[side].size(); ++n) {
        const Sample& p = data_.samples[side][n];
        if (!moves(p))
          continue;
        for (const int i : {0, 1})
          fixed_.K(first_shift_ + 2 * p.slice + i, first_shift_ + 2 * p.slice + i) +=
              share * weights_[side][n] / total_weight(side);
      }
  }

  void make_map() {
    std::vector<Eigen::Triplet<double>> entries;
    int unknown = 0;
    for (const int side : {0, 1}) {
      spaces_[side].add_pole(first_[side], unknown, entries);
      unknown += spaces_[side].free_size();
    }
    for (int i = 0; i < 2 * slices(); ++i)
      entries.emplace_back(first_shift_ + i, unknown++, 1.0);
    map_.resize(fixed_.f.size(), unknown);
    map_.setFromTriplets(entries.begin(), entries.end());
  }

  /// The distance of a point, linear in all coefficients and in the shift of its slice.
  void add_sample(int side, const Sample& p, double weight, NormalEquations& equations) const {
    const Vec3 shift = moves(p) ? shifts_[p.slice] : Vec3::Zero();
    const Vec3 x = p.x + shift;
    const auto F = surfaces_[side].level(x);
    const double scale = 1.0 / F.gradient.norm();
    const Polar at = polar(spaces_[side].spheroid(), x);
    SparseRow row;
    spaces_[side].add_value(at.mu, at.theta, -scale, first_[side], row);
    double right = -scale * at.s;
    if (moves(p))
      for (const int i : {0, 1}) {
        const Vec3 e = data_.planes[p.slice].axes.col(i);
        const double slope = scale * F.gradient.dot(e);
        row.add(first_shift_ + 2 * p.slice + i, slope);
        right += slope * e.dot(shift);
      }
    equations.add(row, right, weight);
  }

  /// One iteration; returns the largest change of a shift [mm].
  double step() {
    NormalEquations equations = fixed_;
    for (const int side : {0, 1}) {
      const double total = total_weight(side);
      for (std::size_t i = 0; i < weights_[side].size(); ++i)
        add_sample(side, data_.samples[side][i], weights_[side][i] / total, equations);
    }
    const Eigen::MatrixXd K = map_.transpose() * (equations.K * map_);
    const Eigen::VectorXd x = map_ * dense::solve_symmetric(K, map_.transpose() * equations.f);
    for (const int side : {0, 1})
      surfaces_[side] = spaces_[side].surface(x.segment(first_[side], spaces_[side].size()));
    double change = 0.0;
    for (int k = 0; k < slices(); ++k) {
      const Vec3 shift = data_.planes[k].axes.leftCols<2>() * x.segment<2>(first_shift_ + 2 * k);
      change = std::max(change, (shift - shifts_[k]).norm());
      shifts_[k] = shift;
    }
    return change;
  }

  const FitData& data_;
  std::array<SplineSpace, 2> spaces_;
  std::array<int, 2> first_;  ///< coefficient of each side
  int first_shift_;
  NormalEquations fixed_;  ///< bending and prior
  Eigen::SparseMatrix<double> map_;
  std::array<StarSurface, 2> surfaces_;
  std::array<std::vector<double>, 2> weights_;  ///< of the samples of each side
  std::vector<Vec3> shifts_;
};

}  // namespace

Spheroid reference_spheroid(const std::vector<Sample>& samples) {
  double lowest = 0.0;
  for (const Sample& p : samples)
    lowest = std::min(lowest, p.x.z());
  const double depth = -lowest;
  Eigen::Matrix2d K = Eigen::Matrix2d::Zero();
  Eigen::Vector2d f = Eigen::Vector2d::Zero();
  for (const Sample& p : samples) {
    const double h = p.x.z() - lowest;
    const Eigen::Vector2d row(h, -h * h);
    K += p.length * row * row.transpose();
    f += p.length * row * p.x.head<2>().squaredNorm();
  }
  const Eigen::Vector2d pq = K.ldlt().solve(f);
  const double most = 0.85 * depth;
  const double c = pq[1] > 0.0 ? std::clamp(0.5 * pq[0] / pq[1], 0.55 * depth, most) : most;
  const Eigen::Vector2d section(1.0, 0.5 / c);  // q = p/(2 c)
  const double p = section.dot(f) / section.dot(K * section);
  return {std::sqrt(0.5 * p * c), c, lowest + c};
}

FittedSurfaces fit_surfaces(const FitData& data, const SplineFitParameters& parameters) {
  return Fit(data, parameters).run();
}

}  // namespace lv::geometry
