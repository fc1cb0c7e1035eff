#include "lv/base/check.hpp"
#include "lv/implicit/time_engine.hpp"
#include "lv/verify/half_sphere.hpp"
#include "lv/verify/problems.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <vector>

/// A shell of incompressible neo-Hookean rubber that a pressure sets swinging. All of its motion is
/// that of its inner radius a: the radial balance, integrated through the wall, is
///
///   rho [a a'' (1 - a/b) + a'^2 (3/2 - 2 a/b + (a/b)^4/2)] = p(t) - p_static(a),  b^3 = a^3 + B^3 - A^3
namespace lv::verify {
namespace {

constexpr double rubber_density = 1e-6;   // [kg/mm^3]
constexpr double end_of_swing = 0.024;    // [s]
constexpr double compared_every = 0.004;  // between the times that are compared [s]

/// Rises and falls smoothly, once [kPa].
double swinging_pressure(double t) {
  const double s = std::sin(std::numbers::pi * t / 0.016);
  return t < 0.016 ? 0.6 * s * s : 0.0;
}

struct Radius {
  double a, rate;  ///< [mm], [mm/s]
};

Radius slope(const HalfSphere& sphere, double t, const Radius& now) {
  const HalfSphere there{sphere.A, sphere.B, now.a, sphere.mu};
  const double ratio = now.a / there.outer_radius();
  const double rest = now.rate * now.rate * (1.5 - 2.0 * ratio + 0.5 * std::pow(ratio, 4));
  return {now.rate, ((swinging_pressure(t) - there.pressure()) / rubber_density - rest) /
                        (now.a * (1.0 - ratio))};
}

/// The volumes of the half sphere's cavity at the times that are compared, by the classical
/// Runge-Kutta method [mm^3].
std::vector<double> exact_volumes(const HalfSphere& sphere) {
  constexpr double dt = 1e-6;
  const auto moved = [](const Radius& y, double by, const Radius& k) {
    return Radius{y.a + by * k.a, y.rate + by * k.rate};
  };
  Radius y{sphere.A, 0.0};
  std::vector<double> volumes;
  const auto per_interval = static_cast<int>(std::lround(compared_every / dt));
  for (int i = 1; i * dt < end_of_swing + 0.5 * dt; ++i) {
    const double t = (i - 1) * dt;
    const Radius k1 = slope(sphere, t, y);
    const Radius k2 = slope(sphere, t + 0.5 * dt, moved(y, 0.5 * dt, k1));
    const Radius k3 = slope(sphere, t + 0.5 * dt, moved(y, 0.5 * dt, k2));
    const Radius k4 = slope(sphere, t + dt, moved(y, dt, k3));
    y = moved(moved(moved(moved(y, dt / 6.0, k1), dt / 3.0, k2), dt / 3.0, k3), dt / 6.0, k4);
    if (i % per_interval == 0)
      volumes.push_back(2.0 / 3.0 * std::numbers::pi * std::pow(y.a, 3));
  }
  return volumes;
}

implicit::StaticModel swinging_rubber(const HalfSphere& sphere) {
  solid::CardiacModel heart{.base = {.stiffness = implicit::rigid_base}};
  heart.myocardium.passive = material::NeoHookean{sphere.mu};
  heart.myocardium.active = material::PrescribedTension{0.0};
  implicit::StaticModel model(heart);
  model.density = rubber_density;
  return model;
}

std::vector<double> volumes_with(const HalfSphere& sphere, const mesh::Mesh& mesh, double dt) {
  implicit::TimeEngine engine(mesh, swinging_rubber(sphere), {});
  const implicit::TensionAt none = [](std::size_t, std::size_t, double) {
    return material::Tension{};
  };
  std::vector<double> volumes;
  const auto per_interval = static_cast<int>(std::lround(compared_every / dt));
  for (int i = 1; i * dt < end_of_swing + 0.5 * dt; ++i) {
    const double t = (i - 1 + engine.balance()) * dt;
    const auto report = engine.move(dt, {none, swinging_pressure(t)});
    LV_CHECK(report.converged);
    if (i % per_interval == 0)
      volumes.push_back(engine.cavity_volume());
  }
  return volumes;
}

double rms(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i)
    sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum / static_cast<double>(a.size()));
}

}  // namespace

void generalised_alpha(Findings& found) {
  const HalfSphere sphere;
  const mesh::Mesh mesh = sphere.mesh(2.5, 2);
  const std::vector<double> exact = exact_volumes(sphere);
  std::vector<std::vector<double>> all;
  for (const double dt : {5e-4, 2.5e-4, 1.25e-4})
    all.push_back(volumes_with(sphere, mesh, dt));
  double largest_change = 0.0;
  for (const double volume : exact)
    largest_change = std::max(
        largest_change, std::abs(volume - 2.0 / 3.0 * std::numbers::pi * std::pow(sphere.A, 3)));
  found.add("order in time, steps of 0.5, 0.25 and 0.125 ms",
            std::log2(rms(all[0], all[1]) / rms(all[1], all[2])), 2.0, 0.1);
  found.add_error("cavity volume, rms error over its largest change, steps of 0.125 ms",
                  rms(all[2], exact) / largest_change, 0.01);
}

}  // namespace lv::verify
