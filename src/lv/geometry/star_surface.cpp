#include "lv/geometry/star_surface.hpp"

#include "lv/base/check.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace lv::geometry {
namespace {

using std::numbers::pi;
constexpr int meridians = 256;  // for checks and integrals over theta

/// Gauss-Legendre quadrature on [-1, 1], exact up to degree 9.
constexpr std::array<double, 5> gauss_points{-0.9061798459386640, -0.5384693101056831, 0.0,
                                             0.5384693101056831, 0.9061798459386640};
constexpr std::array<double, 5> gauss_weights{0.2369268850561891, 0.4786286704993665,
                                              0.5688888888888889, 0.4786286704993665,
                                              0.2369268850561891};

}  // namespace

Polar polar(const Spheroid& spheroid, const Vec3& x) {
  const double r = std::hypot(x.x(), x.y()) / spheroid.a;
  const double z = (x.z() - spheroid.z0) / spheroid.c;
  return {std::hypot(r, z), std::atan2(r, -z), std::atan2(x.y(), x.x())};
}

Vec3 cartesian(const Spheroid& spheroid, const Polar& p) {
  const double r = spheroid.a * p.s * std::sin(p.mu);
  return {r * std::cos(p.theta), r * std::sin(p.theta),
          spheroid.z0 - spheroid.c * p.s * std::cos(p.mu)};
}

StarSurface::StarSurface(const Spheroid& spheroid, CubicBasis along, CubicBasis around,
                         Eigen::MatrixXd coefficients)
    : spheroid_(spheroid),
      along_(std::move(along)),
      around_(std::move(around)),
      coefficients_(std::move(coefficients)) {}

StarSurface::Scale StarSurface::scale(double mu, double theta) const {
  const auto N = along_.at(mu);
  const auto M = around_.at(theta);
  Scale scale{0.0, 0.0, 0.0};
  for (int i = 0; i < 4; ++i) {
    double value = 0.0;
    double slope = 0.0;
    for (int j = 0; j < 4; ++j) {
      const double c = coefficients_(N.index[i], M.index[j]);
      value += c * M.value[j];
      slope += c * M.slope[j];
    }
    scale.s += N.value[i] * value;
    scale.s_mu += N.slope[i] * value;
    scale.s_theta += N.value[i] * slope;
  }
  return scale;
}

Vec3 StarSurface::point(double mu, double theta) const {
  return cartesian(spheroid_, {scale(mu, theta).s, mu, theta});
}

StarSurface::Level StarSurface::level(const Vec3& x) const {
  const double a = spheroid_.a;
  const double c = spheroid_.c;
  // the angle theta is not defined on the axis: step off it by a nanometre or so
  const Vec3 beside = std::hypot(x.x(), x.y()) > 1e-6 * a ? x : Vec3(1e-6 * a, 0.0, x.z());
  const Polar p = polar(spheroid_, beside);
  const Scale f = scale(p.mu, p.theta);
  const double r = std::hypot(beside.x(), beside.y());
  const double z = beside.z() - spheroid_.z0;
  const Vec3 outward(beside.x() / r, beside.y() / r, 0.0);
  const Vec3 around(-outward.y(), outward.x(), 0.0);
  const Vec3 up = Vec3::UnitZ();
  const Vec3 grad_s = (r / (a * a) * outward + z / (c * c) * up) / p.s;
  const Vec3 grad_mu = (-z * outward + r * up) / (a * c * p.s * p.s);
  return {p.s - f.s, grad_s - f.s_mu * grad_mu - f.s_theta / r * around};
}

Vec3 StarSurface::normal(double mu, double theta) const {
  return level(point(mu, theta)).gradient.normalized();
}

Vec3 StarSurface::closest(const Vec3& x) const {
  constexpr int iterations = 50;
  constexpr double tolerance = 1e-9;  // [mm]
  Vec3 foot = x;
  for (int i = 0; i < iterations; ++i) {
    const Level F = level(foot);
    const Vec3 n = F.gradient.normalized();
    const Vec3 offset = x - foot;
    const Vec3 step = offset - n * n.dot(offset) - F.value * F.gradient / F.gradient.squaredNorm();
    foot += step;
    if (step.norm() < tolerance)
      break;
  }
  return foot;
}

double StarSurface::distance(const Vec3& x) const {
  return std::copysign((x - closest(x)).norm(), level(x).value);
}

double StarSurface::height(double mu, double theta) const {
  return spheroid_.z0 - spheroid_.c * scale(mu, theta).s * std::cos(mu);
}

bool StarSurface::is_sound() const {
  for (int j = 0; j < meridians; ++j) {
    const double theta = 2.0 * pi * j / meridians;
    const auto base = base_bracket(theta);
    if (!base)
      return false;
    for (double mu = 0.0; mu < base->second; mu += 0.25 * along_.step())
      if (scale(mu, theta).s <= 0.0)
        return false;
  }
  return true;
}

/// Angles just below and just above the base, found by walking up from the centre's height.
std::optional<std::pair<double, double>> StarSurface::base_bracket(double theta) const {
  const double step = 0.5 * along_.step();
  for (double mu = 0.5 * pi; mu < std::min(along_.end() + step, pi); mu += step)
    if (height(mu + step, theta) > 0.0)
      return std::pair{mu, mu + step};
  return std::nullopt;
}

double StarSurface::base_angle(double theta) const {
  const auto bracket = base_bracket(theta);
  LV_CHECK(bracket.has_value());  // is_sound() says so
  auto [low, high] = *bracket;
  double mu = 0.5 * (low + high);
  constexpr int most = 100;
  for (int i = 0; i < most; ++i) {
    const Scale f = scale(mu, theta);
    const double z = spheroid_.z0 - spheroid_.c * f.s * std::cos(mu);
    const double slope = spheroid_.c * (f.s * std::sin(mu) - f.s_mu * std::cos(mu));
    (z < 0.0 ? low : high) = mu;
    double next = mu - z / slope;
    if (!(next > low && next < high))
      next = 0.5 * (low + high);
    if (std::abs(next - mu) < 1e-14)
      break;
    mu = next;
  }
  return mu;
}

double StarSurface::enclosed_volume() const {
  // The rays below the base's edge sweep a^2 c / 3 integral of s^3 sin(mu) d(mu) d(theta); the cone
  // between the centre and the base plane is the rest.
  double volume = 0.0;
  const double step = along_.step();
  for (int j = 0; j < meridians; ++j) {
    const double theta = 2.0 * pi * j / meridians;
    const double end = base_angle(theta);
    double sector = 0.0;
    for (int k = 0; k < along_.intervals() && k * step < end; ++k) {
      const double half = 0.5 * (std::min((k + 1) * step, end) - k * step);
      for (int g = 0; g < 5; ++g) {
        const double mu = k * step + half * (1.0 + gauss_points[g]);
        const double s = scale(mu, theta).s;
        sector += gauss_weights[g] * half * s * s * s * std::sin(mu);
      }
    }
    const double r = spheroid_.a * scale(end, theta).s * std::sin(end);
    volume += spheroid_.a * spheroid_.a * spheroid_.c * sector / 3.0;
    volume += 0.5 * r * r * -spheroid_.z0 / 3.0;
  }
  return volume * 2.0 * pi / meridians;
}

}  // namespace lv::geometry
