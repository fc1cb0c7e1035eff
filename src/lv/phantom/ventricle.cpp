#include "lv/phantom/ventricle.hpp"

#include <algorithm>
#include <cmath>

namespace lv::phantom {
namespace {

using geometry::Side;
using std::numbers::pi;

/// An angle brought into (-pi, pi].
double wrapped(double angle) {
  return std::remainder(angle, 2.0 * pi);
}

/// From a to b along half a wave of a cosine as x goes from 0 to 1.
double wave(double a, double b, double x) {
  return a + (b - a) * 0.5 * (1.0 - std::cos(pi * std::clamp(x, 0.0, 1.0)));
}

/// A smooth function and its derivative.
struct Smooth {
  double value, slope;
};

/// 1 in the middle of the scar's sector, 1/2 at its sides, then towards 0.
Smooth around(const Scar& scar, double Theta) {
  const double d = Theta - scar.angle;
  const double scale = 1.0 / (1.0 - std::cos(0.5 * scar.width));
  const double x = scale * (1.0 - std::cos(d));
  const double f = 1.0 / (1.0 + x * x * x);
  return {f, -3.0 * x * x * f * f * scale * std::sin(d)};
}

/// 1 between the scar's heights, 1/2 at them, then towards 0 over some millimetres.
Smooth along(const Scar& scar, double Z) {
  constexpr double width = 8.0;
  const double low = std::tanh((Z - scar.bottom) / width);
  const double high = std::tanh((Z - scar.top) / width);
  return {0.5 * (low - high), 0.5 * (high * high - low * low) / width};
}

/// Integral of f over [a, b] by Simpson's rule.
template <class Function>
double integral(double a, double b, int intervals, const Function& f) {
  const double h = (b - a) / intervals;
  double sum = 0.0;
  for (int i = 0; i < intervals; ++i)
    sum += f(a + i * h) + 4.0 * f(a + (i + 0.5) * h) + f(a + (i + 1) * h);
  return sum * h / 6.0;
}

double radius(const Ventricle& v, Side side, double Z) {
  return std::sqrt(std::max(0.0, v.radius_squared(side, Z)));
}

/// Radius to which the scar reaches at a height.
double scar_radius(const Ventricle& v, double Z) {
  const double endo = radius(v, Side::endo, Z);
  return endo + v.scar.transmurality * (radius(v, Side::epi, Z) - endo);
}

}  // namespace

double Ventricle::radius_squared(Side side, double Z) const {
  const double a = side == Side::endo ? shape.endo_radius : shape.epi_radius;
  const double b = side == Side::endo ? shape.endo_length : shape.epi_length;
  const double x = (Z + shape.base_height) / b;
  return a * a * (1.0 - x * x);
}

bool Ventricle::in_scar(const Vec3& X) const {
  if (scar.transmurality <= 0.0 || X.z() < scar.bottom || X.z() > scar.top)
    return false;
  const double R = std::hypot(X.x(), X.y());
  return std::abs(wrapped(std::atan2(X.y(), X.x()) - scar.angle)) <= 0.5 * scar.width &&
         R >= radius(*this, Side::endo, X.z()) && R <= scar_radius(*this, X.z());
}

double contraction(double time) {
  constexpr double early_filling = 0.58;  // ends
  constexpr double kick = 0.82;           // begins
  constexpr double rest = 0.22;           // contraction left before the kick
  const double t = time - std::floor(time);
  if (t < end_systole)
    return wave(0.0, 1.0, t / end_systole);
  if (t < kick)
    return wave(1.0, rest, (t - end_systole) / (early_filling - end_systole));
  return wave(rest, 0.0, (t - kick) / (1.0 - kick));
}

Motion::Motion(const Ventricle& ventricle, double s)
    : v_(ventricle), s_(s), stretch_(1.0 - s * ventricle.shortening), apex_(ventricle.apex()) {}

Motion::Squeeze Motion::squeeze(double Theta, double Z) const {
  const double inner = v_.radius_squared(Side::endo, Z);
  if (inner <= 0.0)
    return {0.0, 0.0, 0.0};
  const double b = v_.shape.endo_length;
  const double slope =
      -2.0 * v_.shape.endo_radius * v_.shape.endo_radius * (Z + v_.shape.base_height) / (b * b);
  const double amount = s_ * v_.squeeze;
  const double lost = v_.scar.transmurality > 0.0 ? v_.akinesia : 0.0;
  const Smooth turn = around(v_.scar, Theta);
  const Smooth height = along(v_.scar, Z);
  const double w = 1.0 - lost * turn.value * height.value;
  return {amount * w * inner, -amount * lost * turn.slope * height.value * inner,
          amount * (w * slope - lost * turn.value * height.slope * inner)};
}

double Motion::rotation(double Z) const {
  return s_ * (v_.rotation_base + (v_.rotation_apex - v_.rotation_base) * Z / apex_);
}

Vec3 Motion::forward(const Vec3& X) const {
  const double Theta = std::atan2(X.y(), X.x());
  const double c = squeeze(Theta, X.z()).value;
  const double r = std::sqrt(std::max(0.0, X.x() * X.x() + X.y() * X.y() - c) / stretch_);
  const double theta = Theta - rotation(X.z());
  return {r * std::cos(theta), r * std::sin(theta), z(X.z())};
}

Vec3 Motion::inverse(const Vec3& x) const {
  const double height = Z(x.z());
  const double Theta = std::atan2(x.y(), x.x()) + rotation(height);
  const double R =
      std::sqrt(stretch_ * (x.x() * x.x() + x.y() * x.y()) + squeeze(Theta, height).value);
  return {R * std::cos(Theta), R * std::sin(Theta), height};
}

Mat3 Motion::gradient(const Vec3& X) const {
  const double R = std::hypot(X.x(), X.y());
  const double Theta = std::atan2(X.y(), X.x());
  const Squeeze c = squeeze(Theta, X.z());
  const double r = std::sqrt((R * R - c.value) / stretch_);
  const double theta_Z = -s_ * (v_.rotation_apex - v_.rotation_base) / apex_;
  const bool on_axis = R < 1e-9 || r < 1e-9;
  const double hoop = on_axis ? 1.0 / std::sqrt(stretch_) : r / R;
  Mat3 F;  // rows: along r, theta, z now; columns: along R, Theta, Z then
  F << (on_axis ? hoop : R / (stretch_ * r)),
      (on_axis ? 0.0 : -0.5 * c.by_theta / (stretch_ * r * R)),
      (on_axis ? 0.0 : -0.5 * c.by_Z / (stretch_ * r)),  //
      0.0, hoop, r * theta_Z,                            //
      0.0, 0.0, stretch_;
  const double theta = Theta - rotation(X.z());
  Mat3 now, then;
  now << std::cos(theta), -std::sin(theta), 0.0, std::sin(theta), std::cos(theta), 0.0, 0.0, 0.0,
      1.0;
  then << std::cos(Theta), -std::sin(Theta), 0.0, std::sin(Theta), std::cos(Theta), 0.0, 0.0, 0.0,
      1.0;
  return now * F * then.transpose();
}

double Motion::radius(Side side, double z, double theta) const {
  const double height = Z(z);
  const double squared = v_.radius_squared(side, height);
  if (squared <= 0.0)
    return 0.0;
  const double c = squeeze(theta + rotation(height), height).value;
  return std::sqrt((squared - c) / stretch_);
}

double Motion::cavity_volume() const {
  constexpr int turns = 360;  // the trapezoidal rule of a smooth periodic function is exact enough
  return integral(v_.cavity_apex(), 0.0, 400, [&](double height) {
    double sum = 0.0;
    for (int k = 0; k < turns; ++k)
      sum += std::max(0.0, v_.radius_squared(Side::endo, height)) -
             squeeze(2.0 * pi * k / turns, height).value;
    return pi * sum / turns;
  });
}

double wall_volume(const Ventricle& v) {
  return v.shape.enclosed_volume(1.0) - v.shape.enclosed_volume(0.0);
}

double scar_volume(const Ventricle& v) {
  const double bottom = std::max(v.scar.bottom, v.apex());
  const double top = std::min(v.scar.top, 0.0);
  if (v.scar.transmurality <= 0.0 || bottom >= top)
    return 0.0;
  return integral(bottom, top, 2000, [&](double Z) {
    const double outer = scar_radius(v, Z);
    return 0.5 * v.scar.width * (outer * outer - std::max(0.0, v.radius_squared(Side::endo, Z)));
  });
}

}  // namespace lv::phantom
