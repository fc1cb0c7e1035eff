#include "lv/verify/manufactured.hpp"

#include <cmath>
#include <numbers>

namespace lv::verify {
namespace {

/// A function of one coordinate with its first three derivatives.
using Line = std::array<double, 4>;

Line even(double x, double L) {
  const double k = std::numbers::pi / L;
  const double s = std::sin(k * x);
  const double c = std::cos(k * x);
  const double e = std::exp(c);
  return {e, -k * s * e, k * k * (s * s - c) * e, k * k * k * s * (3.0 * c + 1.0 - s * s) * e};
}

Line odd(double x, double L) {
  const double k = std::numbers::pi / L;
  const double s = std::sin(k * x);
  const double c = std::cos(k * x);
  return {s, k * c, -k * k * s, -k * k * k * c};
}

/// A product of functions of x, y and z, differentiated (a, b, c) times along them.
struct Product {
  double factor;
  std::array<Line, 3> line;

  [[nodiscard]] double d(const std::array<int, 3>& times) const {
    return factor * line[0][times[0]] * line[1][times[1]] * line[2][times[2]];
  }
};

std::array<int, 3> plus(std::array<int, 3> times, int axis, int more) {
  times[axis] += more;
  return times;
}

}  // namespace

/// The flow's shape (g = 1) at a point.
struct ManufacturedFlow::Derivatives {
  Vec3 u;
  Mat3 gradient;  ///< du_i/dx_j
  Vec3 laplacian;
  Vec3 pressure_gradient;
};

double ManufacturedFlow::g(double t) const {
  return 1.0 + 0.5 * std::sin(omega * t);
}
double ManufacturedFlow::g_rate(double t) const {
  return 0.5 * omega * std::cos(omega * t);
}

ManufacturedFlow::Derivatives ManufacturedFlow::shape(const Vec3& x) const {
  const double pi = std::numbers::pi;
  const std::array<Line, 3> e{even(x[0], box[0]), even(x[1], box[1]), even(x[2], box[2])};
  const std::array<Line, 3> s{odd(x[0], box[0]), odd(x[1], box[1]), odd(x[2], box[2])};
  const Product psi_x{U * box[0] / pi, {s[0], e[1], e[2]}};
  const Product psi_z{U * box[2] / pi, {e[0], e[1], s[2]}};
  const Product p{p_0, s};
  // u = (d_y psi_z, d_z psi_x - d_x psi_z, -d_y psi_x), each differentiated further `times`
  const auto u = [&](const std::array<int, 3>& times) {
    return Vec3(psi_z.d(plus(times, 1, 1)), psi_x.d(plus(times, 2, 1)) - psi_z.d(plus(times, 0, 1)),
                -psi_x.d(plus(times, 1, 1)));
  };
  Derivatives result;
  result.u = u({0, 0, 0});
  result.laplacian = Vec3::Zero();
  for (int d = 0; d < 3; ++d) {
    result.gradient.col(d) = u(plus({0, 0, 0}, d, 1));
    result.laplacian += u(plus({0, 0, 0}, d, 2));
    result.pressure_gradient[d] = p.d(plus({0, 0, 0}, d, 1));
  }
  return result;
}

Vec3 ManufacturedFlow::velocity(const Vec3& x, double t) const {
  return g(t) * shape(x).u;
}

Vec3 ManufacturedFlow::force(const Vec3& x, double t, bool convection) const {
  const Derivatives s = shape(x);
  Vec3 f = blood.density * (g_rate(t) + drag * g(t)) * s.u + g(t) * s.pressure_gradient -
           blood.viscosity * g(t) * s.laplacian;
  if (convection)
    f += blood.density * g(t) * g(t) * (s.gradient * s.u);
  return f;
}

}  // namespace lv::verify
