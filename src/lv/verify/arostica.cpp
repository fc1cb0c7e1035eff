#include "lv/verify/arostica.hpp"

#include "lv/base/check.hpp"
#include "lv/base/dense.hpp"
#include "lv/base/log.hpp"
#include "lv/mesh/fibres.hpp"
#include "lv/mesh/shapes.hpp"
#include "lv/mesh/wall_mesh.hpp"

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCore>
#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <optional>

namespace lv::verify {
namespace {

double mix(double a, double b, double t) {
  return (1.0 - t) * a + t * b;
}

double base_angle(const ArosticaWall& wall, double t) {
  return mix(std::acos(wall.endo_cosine), std::acos(wall.epi_cosine), t);
}

/// The angle mu of a place on an ellipsoid, r = across sin mu and z = along cos mu, whatever its
/// size.
double polar_angle(const Vec3& place, double across, double along) {
  return std::atan2(std::hypot(place.x(), place.y()) / across, place.z() / along);
}

/// Of the ellipsoid's meridian between two angles, by the midpoint rule [mm].
double meridian_length(double across, double along, double from, double to) {
  constexpr int parts = 200;
  const double step = (to - from) / parts;
  double length = 0.0;
  for (int i = 0; i < parts; ++i) {
    const double mu = from + (i + 0.5) * step;
    length += std::hypot(across * std::cos(mu), along * std::sin(mu)) * step;
  }
  return length;
}

/// A point of the wall that is watched.
struct Probe {
  std::vector<int> nodes;
  Eigen::VectorXd phi;

  [[nodiscard]] Vec3 displacement(std::span<const Vec3> from, std::span<const Vec3> to) const {
    Vec3 u = Vec3::Zero();
    for (std::size_t a = 0; a < nodes.size(); ++a)
      u += phi[static_cast<Eigen::Index>(a)] * (to[nodes[a]] - from[nodes[a]]);
    return {u.z(), u.x(), u.y()};
  }
};

/// The point of an element with this place, if it has one: by Newton's method.
std::optional<Probe> probe_in(const mesh::Mesh& mesh, std::span<const int> nodes, const Vec3& X) {
  constexpr double rounding = 1e-9;
  Vec3 xi = Vec3::Constant(0.5);
  for (int i = 0; i < 30; ++i) {
    const mesh::Shapes shapes = mesh::shapes<3>(mesh.kind, mesh.order, {xi[0], xi[1], xi[2]});
    Vec3 error = X;
    Mat3 slope = Mat3::Zero();
    for (std::size_t a = 0; a < nodes.size(); ++a) {
      const auto k = static_cast<Eigen::Index>(a);
      error -= shapes.value[k] * mesh.nodes[nodes[a]];
      slope += mesh.nodes[nodes[a]] * shapes.gradient.col(k).transpose();
    }
    if (error.norm() < 1e-8 && xi.minCoeff() > -rounding && xi.maxCoeff() < 1.0 + rounding)
      return Probe{{nodes.begin(), nodes.end()}, shapes.value};
    xi += dense::solve(slope, error);
    if ((xi - Vec3::Constant(0.5)).norm() > 5.0)
      return {};
  }
  return {};
}

/// `place` in the benchmark's axes [mm].
Probe probe_at(const mesh::Mesh& mesh, const Vec3& place) {
  const mesh::ElementNodes elements = mesh::elements(mesh);
  for (int e = 0; e < elements.size(); ++e)
    if (auto probe = probe_in(mesh, elements.element(e), {place.y(), place.z(), place.x()}))
      return *probe;
  throw LogicError("a watched point is outside the wall");
}

/// int grad phi_a . grad phi_b dX of an element.
Eigen::MatrixXd laplacian(const mesh::Mesh& mesh, std::span<const int> nodes,
                          const solid::ShapeTable& shapes) {
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(shapes.nodes(), shapes.nodes());
  for (int q = 0; q < shapes.points(); ++q) {
    Mat3 dX_dxi = Mat3::Zero();
    for (std::size_t a = 0; a < nodes.size(); ++a)
      dX_dxi +=
          mesh.nodes[nodes[a]] * shapes.gradient[q].col(static_cast<Eigen::Index>(a)).transpose();
    const Eigen::MatrixXd gradient = dX_dxi.inverse().transpose() * shapes.gradient[q];
    K += shapes.weight[q] * dX_dxi.determinant() * gradient.transpose() * gradient;
  }
  return K;
}

/// The transmural coordinate of the benchmark: harmonic, 0 on the endocardium and 1 on the
/// epicardium, whose normal derivative vanishes on the base.
std::vector<double> harmonic_transmural(const mesh::Mesh& mesh) {
  const mesh::ElementNodes elements = mesh::elements(mesh);
  const solid::ShapeTable shapes = solid::element_shapes(mesh.kind, mesh.order);
  const auto n = static_cast<Eigen::Index>(mesh.nodes.size());
  Eigen::VectorXd t = Eigen::VectorXd::Zero(n);
  std::vector<bool> is_given(mesh.nodes.size(), false);
  for (const int node : mesh.endo.nodes)
    is_given[node] = true;
  for (const int node : mesh.epi.nodes) {
    is_given[node] = true;
    t[node] = 1.0;
  }
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::VectorXd right = t;
  for (int e = 0; e < elements.size(); ++e) {
    const auto nodes = elements.element(e);
    const Eigen::MatrixXd K = laplacian(mesh, nodes, shapes);
    for (Eigen::Index a = 0; a < K.rows(); ++a)
      for (Eigen::Index b = 0; b < K.cols() && !is_given[nodes[a]]; ++b)
        if (is_given[nodes[b]])
          right[nodes[a]] -= K(a, b) * t[nodes[b]];
        else
          entries.emplace_back(nodes[a], nodes[b], K(a, b));
  }
  for (int node = 0; node < n; ++node)
    if (is_given[node])
      entries.emplace_back(node, node, 1.0);
  Eigen::SparseMatrix<double> A(n, n);
  A.setFromTriplets(entries.begin(), entries.end());
  Eigen::ConjugateGradient<Eigen::SparseMatrix<double>, Eigen::Lower | Eigen::Upper> solver(A);
  solver.setTolerance(1e-10);
  const Eigen::VectorXd solution = solver.solve(right);
  LV_CHECK(solver.info() == Eigen::Success);
  return {solution.data(), solution.data() + n};
}

/// A share of the bulk modulus acts at every quadrature point, as beta_s (ln J)^2 with kappa = 2
/// beta_s, the rest through the elements' pressures. Without the share the muscle, of 0.06 kPa
/// across its fibres, gives way inside elements in ways that leave their mean volume alone. The two
/// energies differ in the third order of J - 1.
implicit::StaticModel model_of(const ArosticaConstants& c) {
  solid::CardiacModel heart;
  heart.base.stiffness = 0.0;
  heart.myocardium.passive = c.muscle;
  heart.myocardium.active = material::PrescribedTension{0.0};
  heart.myocardium.active_form = material::ActiveForm::second_piola;
  implicit::StaticModel model(heart, {}, {.beta_s = 0.5 * c.share_at_points * c.kappa});
  model.compressibility.kappa = (1.0 - c.share_at_points) * c.kappa;
  model.heart.surroundings.epicardium = {.normal_stiffness = c.k_epi, .normal_viscosity = c.c_epi};
  if (c.facet_edge > 0.0)
    model.heart.surroundings.epicardium.scatter = [edge = c.facet_edge](const Vec3& X) {
      const ArosticaWall wall;
      return wall.facet_scatter(X, wall.facet_edge(X, edge), ArosticaWall::gmsh_tilt);
    };
  model.heart.surroundings.base = solid::Support::in_all_directions(c.k_base, c.c_base);
  model.heart.myocardium.viscosity.eta = c.eta;
  model.density = c.rho;
  return model;
}

/// The mesh with the benchmark's fibres, f = sin(alpha) e_u + cos(alpha) e_v, and s = f x n across
/// them in the wall, at its nodes.
mesh::Mesh with_fibres(mesh::Mesh mesh, const ArosticaWall& wall, const ArosticaConstants& c) {
  const mesh::FibreRule rule{c.helix_endo, c.helix_epi, 0.5 * std::numbers::pi,
                             0.5 * std::numbers::pi};
  mesh.fibres.given.at = mesh::GivenFibres::At::nodes;
  for (std::size_t a = 0; a < mesh.nodes.size(); ++a) {
    const double t = mesh.transmural[a];
    const Mat3 frame = mesh::fibre_frame(rule, mesh::wall_axes(wall.normal(mesh.nodes[a], t)), t);
    mesh.fibres.given.f0.push_back(frame.col(0));
    mesh.fibres.given.s0.push_back(frame.col(1));
  }
  return mesh;
}

/// The wall driven through time.
class ArosticaRun {
 public:
  ArosticaRun(const ArosticaConstants& c, const ArosticaLoads& loads)
      : constants_(c),
        loads_(loads),
        mesh_(with_fibres(ArosticaWall{}.mesh(c.edge_length, static_cast<int>(c.layers)),
                          ArosticaWall{}, c)),
        engine_(mesh_, model_of(c), {}, c.spectral_radius),
        histories_(c.drive.histories(history_step, c.end)),
        p0_(probe_at(mesh_, {25.0, 30.0, 0.0})),
        p1_(probe_at(mesh_, {0.0, 30.0, 0.0})) {
    log::info("{} elements, {} nodes", mesh_.cell_count() / 8, mesh_.nodes.size());
  }

  [[nodiscard]] ArosticaSample sample(double time) const {
    const auto& x = engine_.state().positions;
    return {time, p0_.displacement(mesh_.nodes, x), p1_.displacement(mesh_.nodes, x)};
  }

  /// A step, or where Newton's method fails two of half its length.
  void advance(double time, double dt) {
    const ArosticaDrive::Values now = at(time + engine_.balance() * dt);
    const implicit::TensionAt tension = [&](std::size_t, std::size_t, double) {
      return material::Tension{now.tension, 0.0};
    };
    const auto report = engine_.move(dt, {tension, now.pressure});
    corrections_ += report.iterations;
    if (report.converged)
      return;
    log::info("at {:.4f} s a step of {:.2g} s failed: {}", time, dt, report.why);
    if (dt < 0.05 * constants_.time_step)
      throw RunError("no motion was found: " + report.why, "Try a shorter step or a finer mesh");
    advance(time, 0.5 * dt);
    advance(time + 0.5 * dt, 0.5 * dt);
  }

  [[nodiscard]] int corrections() const { return corrections_; }

 private:
  static constexpr double history_step = 2e-5;  // [s]

  [[nodiscard]] ArosticaDrive::Values at(double time) const {
    const double place = time / history_step;
    const auto i = std::min(static_cast<std::size_t>(place), histories_.size() - 2);
    const double s = place - static_cast<double>(i);
    const auto& [before, after] = std::pair(histories_[i], histories_[i + 1]);
    return {loads_.tension ? mix(before.tension, after.tension, s) : 0.0,
            loads_.pressure ? mix(before.pressure, after.pressure, s) : 0.0};
  }

  ArosticaConstants constants_;
  ArosticaLoads loads_;
  mesh::Mesh mesh_;
  implicit::TimeEngine engine_;
  std::vector<ArosticaDrive::Values> histories_;
  Probe p0_, p1_;
  int corrections_ = 0;
};

}  // namespace

double ArosticaWall::base_height(double t) const {
  return mix(endo_length, epi_length, t) * std::cos(base_angle(*this, t));
}

Vec3 ArosticaWall::point(double u, double theta, double t) const {
  const double mu = std::numbers::pi - u * (std::numbers::pi - base_angle(*this, t));
  const double r = mix(endo_radius, epi_radius, t) * std::sin(mu);
  return {r * std::cos(theta), r * std::sin(theta), mix(endo_length, epi_length, t) * std::cos(mu)};
}

/// e_u x e_v of the ellipsoid at depth t, with the angle mu of the place on it.
Vec3 ArosticaWall::normal(const Vec3& place, double t) const {
  const double across = mix(endo_radius, epi_radius, t);
  const double along = mix(endo_length, epi_length, t);
  const double mu = polar_angle(place, across, along);
  const double theta = std::atan2(place.y(), place.x());
  const double outwards = along * std::sin(mu);
  return Vec3(outwards * std::cos(theta), outwards * std::sin(theta), across * std::cos(mu))
      .normalized();
}

Mat3 ArosticaWall::facet_scatter(const Vec3& place, double edge, double c) const {
  const Vec3 N = normal(place, 1.0);
  const double mu = polar_angle(place, epi_radius, epi_length);
  const double g = std::hypot(epi_length * std::sin(mu), epi_radius * std::cos(mu));
  const double along = epi_length * epi_radius / (g * g * g);
  const double around = epi_length / (epi_radius * g);
  const double theta = std::atan2(place.y(), place.x());
  const Vec3 e_c(-std::sin(theta), std::cos(theta), 0.0);
  const Vec3 e_m = N.cross(e_c);
  const double tilt = c * (along - around) * (along - around);
  return edge * edge *
         ((along * along / 24.0 + tilt) * e_m * e_m.transpose() +
          (around * around / 24.0 + tilt) * e_c * e_c.transpose());
}

double ArosticaWall::facet_edge(const Vec3& place, double at_base) const {
  const double mu = polar_angle(place, epi_radius, epi_length);
  const double from_apex = meridian_length(epi_radius, epi_length, mu, std::numbers::pi);
  const double whole =
      meridian_length(epi_radius, epi_length, std::acos(epi_cosine), std::numbers::pi);
  return at_base * (0.5 + 0.5 * from_apex / whole);
}

/// The mesher's base is plane, so it gets a wall whose shells are moved along the axis until theirs
/// are, and its nodes are moved back.
mesh::Mesh ArosticaWall::mesh(double edge_length, int layers) const {
  const auto shifted = [this](double u, double theta, double t) {
    return Vec3(point(u, theta, t) - base_height(t) * Vec3::UnitZ());
  };
  mesh::Mesh mesh = mesh::wall_mesh(
      shifted, {.edge_length = 0.5 * edge_length, .layers = 2 * layers, .order = 2});
  for (std::size_t a = 0; a < mesh.nodes.size(); ++a)
    mesh.nodes[a].z() += base_height(mesh.transmural[a]);
  mesh.transmural = harmonic_transmural(mesh);
  return mesh;
}

std::vector<ArosticaDrive::Values> ArosticaDrive::histories(double step, double end) const {
  const auto rise = [&](double x) { return 0.5 * (1.0 + std::tanh(x / gamma)); };
  const auto rate = [&](double t, const Values& y) {
    const double f = rise(t - t_sys) * rise(t_dias - t);
    const double a = mix(a_min, a_max, f);
    const double g = rise(t_dias_pre - t);
    const double b = mix(a_min, a_max, rise(t - t_sys_pre) * g) + alpha_pre * g + alpha_mid;
    return Values{
        -std::abs(a) * y.tension + sigma_0 * std::max(a, 0.0),
        -std::abs(b) * y.pressure + sigma_mid * std::max(b, 0.0) + sigma_pre * std::max(g, 0.0)};
  };
  const auto moved = [](const Values& y, double by, const Values& k) {
    return Values{y.tension + by * k.tension, y.pressure + by * k.pressure};
  };
  std::vector<Values> result{{}};
  const auto count = static_cast<int>(std::lround(end / step)) + 1;
  for (int i = 0; i < count; ++i) {
    const double t = i * step;
    const Values y = result.back();
    const Values k1 = rate(t, y);
    const Values k2 = rate(t + 0.5 * step, moved(y, 0.5 * step, k1));
    const Values k3 = rate(t + 0.5 * step, moved(y, 0.5 * step, k2));
    const Values k4 = rate(t + step, moved(y, step, k3));
    const Values outer = moved(moved(y, step / 6.0, k1), step / 6.0, k4);
    result.push_back(moved(moved(outer, step / 3.0, k2), step / 3.0, k3));
  }
  return result;
}

std::vector<ArosticaSample> run_arostica(const ArosticaConstants& constants,
                                         const ArosticaLoads& loads) {
  constexpr double interval = 0.01;
  ArosticaRun run(constants, loads);
  std::vector<ArosticaSample> result{run.sample(0.0)};
  const auto steps = static_cast<int>(std::ceil(interval / constants.time_step - 1e-9));
  const double dt = interval / steps;
  for (int i = 0; i * interval < constants.end - 0.5 * interval; ++i) {
    for (int k = 0; k < steps; ++k)
      run.advance(i * interval + k * dt, dt);
    result.push_back(run.sample((i + 1) * interval));
    const Vec3& u = result.back().p0;
    log::info("{:.2f} s  p0 {:.3f} {:.3f} {:.3f} mm  {} corrections", result.back().time, u.x(),
              u.y(), u.z(), run.corrections());
  }
  return result;
}

}  // namespace lv::verify
