#include "lv/implicit/equations.hpp"

#include "lv/base/parallel.hpp"
#include "lv/implicit/constitution.hpp"
#include "lv/implicit/element_product.hpp"
#include "lv/material/tangent_algebra.hpp"
#include "lv/mesh/regions.hpp"
#include "lv/mesh/shapes.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <variant>

namespace lv::implicit {
namespace {

using material::Tangent;

/// a exp[b (I1-3)] of (2.18) in the wall at end-diastole [kPa].
double isotropic_load(const material::HolzapfelOgden& law) {
  constexpr double filled = 0.25;  // I1 - 3
  return law.a * std::exp(filled * law.b);
}

/// The mean shear modulus of a tangent dP/dF [kPa]: of its nine directions the one that changes
/// volume is left out; isotropic linear elasticity gives mu.
double shear_modulus(const Tangent<double>& C, const Mat3& F) {
  const Eigen::Matrix<double, 9, 1> volumetric =
      Eigen::Map<const Eigen::Matrix<double, 9, 1>>(cofactor(F).eval().data()).normalized();
  return 0.1 * (C.trace() - volumetric.dot(C * volumetric));
}

bool is_viscous(const StaticModel& model) {
  return model.heart.myocardium.viscosity.eta > 0.0;
}

/// What a motion adds to one element.
struct ElementMotion {
  Eigen::Matrix3Xd v;            ///< of its nodes [mm/s]
  double slope = 0.0;            ///< dv/dx [1/s]
  Eigen::MatrixXd inertia = {};  ///< c_a int rho phi phi^T dX [mN/mm]; may be empty
};

/// The element's tangent, displacements (node by node) before pressures.
class ElementTangent {
 public:
  ElementTangent(Eigen::Index nodes, Eigen::Index pressures, std::size_t points)
      : n_(nodes),
        m_(pressures),
        product_(nodes, points),
        K_(3 * nodes + pressures, 3 * nodes + pressures),
        pressure_mass_(pressures, pressures) {}

  const Eigen::MatrixXd& compute(const std::vector<Point>& points, const ElementState& s,
                                 Constitution law, const Eigen::MatrixXd& pressure_shapes,
                                 const std::optional<ElementMotion>& motion) {
    K_.setZero();
    pressure_mass_.setZero();
    for (law.point = 0; law.point < points.size(); ++law.point)
      add_point(points[law.point], static_cast<Eigen::Index>(law.point), s, law, pressure_shapes,
                motion);
    product_.multiply(K_);
    if (motion && motion->inertia.size() > 0)
      add_inertia(motion->inertia);
    K_.bottomLeftCorner(m_, 3 * n_) = K_.topRightCorner(3 * n_, m_).transpose();
    return K_;
  }

  /// int N N^T / mu dX of the element computed last.
  [[nodiscard]] const Eigen::MatrixXd& pressure_mass() const { return pressure_mass_; }

 private:
  using Index = Eigen::Index;

  void add_point(const Point& point, Index q, const ElementState& s, const Constitution& law,
                 const Eigen::MatrixXd& pressure_shapes,
                 const std::optional<ElementMotion>& motion) {
    const Mat3 F = s.x * point.gradient.transpose();
    const Eigen::VectorXd N = pressure_shapes.row(q);
    Rate rate;
    if (motion && is_viscous(law.model))
      rate = RateOfF{motion->v * point.gradient.transpose(), motion->slope};
    const Tangent<double> dP_dF = law.tangent(F, point.infarct, rate);
    const Tangent<double> C = point.volume * (dP_dF + N.dot(s.p) * material::cofactor_tangent(F));
    pressure_mass_ += point.volume / std::max(shear_modulus(dP_dF, F), 1e-3) * N * N.transpose();
    if (const double compliance = law.model.compressibility.slope(N.dot(s.p)); compliance > 0.0) {
      K_.bottomRightCorner(m_, m_) -= point.volume * compliance * N * N.transpose();
      pressure_mass_ += point.volume * compliance * N * N.transpose();
    }
    product_.set(q, point.gradient, C);
    const Eigen::Matrix3Xd dJ = point.volume * cofactor(F) * point.gradient;
    K_.topRightCorner(3 * n_, m_) +=
        Eigen::Map<const Eigen::VectorXd>(dJ.data(), dJ.size()) * N.transpose();
  }

  void add_inertia(const Eigen::MatrixXd& inertia) {
    for (Index b = 0; b < n_; ++b)
      for (Index a = 0; a < n_; ++a)
        K_.block<3, 3>(3 * a, 3 * b).diagonal().array() += inertia(a, b);
  }

  Index n_, m_;
  ElementProduct product_;
  Eigen::MatrixXd K_, pressure_mass_;
};

std::vector<int> unknowns(const ReferenceWall& wall, int e, int node_count) {
  std::vector<int> result;
  for (const int node : wall.elements.element(e))
    for (int i = 0; i < 3; ++i)
      result.push_back(3 * node + i);
  for (const int p : wall.pressures.element(e))
    result.push_back(3 * node_count + p);
  return result;
}

/// Each node of quadratic elements as a mean of the corners of one of them.
std::vector<std::vector<Pattern::Share>> shares_of_corners(const ReferenceWall& wall,
                                                           mesh::CellKind kind, int node_count) {
  const std::vector<Vec3> places = mesh::node_places(kind, 2);
  const std::vector<Vec3> corners = mesh::node_places(kind, 1);
  const Eigen::MatrixXd weights =
      solid::element_shapes(kind, 1, {places, std::vector<double>(places.size(), 1.0)}).value;
  std::vector<int> at;  // the corners among the nodes of an element
  for (const Vec3& corner : corners)
    at.push_back(static_cast<int>(
        std::find_if(places.begin(), places.end(),
                     [&](const Vec3& place) { return (place - corner).norm() < 1e-12; }) -
        places.begin()));
  std::vector<std::vector<Pattern::Share>> result(node_count);
  for (int e = 0; e < wall.elements.size(); ++e) {
    const auto nodes = wall.elements.element(e);
    for (std::size_t a = 0; a < nodes.size(); ++a) {
      if (!result[nodes[a]].empty())
        continue;
      for (std::size_t c = 0; c < at.size(); ++c)
        if (const double weight =
                weights(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(c));
            weight > 1e-12)
          result[nodes[a]].push_back({nodes[at[c]], weight});
    }
  }
  return result;
}

Eigen::Matrix3Xd of_nodes(std::span<const Vec3> values, std::span<const int> nodes) {
  Eigen::Matrix3Xd result(3, static_cast<Eigen::Index>(nodes.size()));
  for (std::size_t a = 0; a < nodes.size(); ++a)
    result.col(static_cast<Eigen::Index>(a)) = values[nodes[a]];
  return result;
}

/// int rho phi phi^T dX of this rank's elements [kg]; none without a density.
std::vector<Eigen::MatrixXd> masses(const mesh::Mesh& mesh, const ReferenceWall& wall,
                                    double density) {
  std::vector<Eigen::MatrixXd> result;
  if (density == 0.0)
    return result;
  const Eigen::MatrixXd phi = solid::element_shapes(mesh.kind, mesh.order).value;
  for (const std::vector<Point>& points : wall.points) {
    Eigen::VectorXd mass(phi.rows());
    for (Eigen::Index q = 0; q < phi.rows(); ++q)
      mass[q] = density * points[static_cast<std::size_t>(q)].volume;
    result.emplace_back(phi.transpose() * mass.asDiagonal() * phi);
  }
  return result;
}

/// Linear elements would lock with the stabilisation of quadratic ones.
StaticModel for_order(StaticModel model, int order) {
  if (order == 1)
    model.stabilisation.beta_s = 0.0;
  return model;
}

}  // namespace

material::Volumetric held_against_buckling(const material::AnyPassiveLaw& passive,
                                           const material::Volumetric& usual) {
  const auto* law = std::get_if<material::HolzapfelOgden>(&passive);
  if (law == nullptr)
    return usual;
  const double stiffer = isotropic_load(*law) / isotropic_load({});
  return {.beta_s = usual.beta_s * std::max(1.0, stiffer)};
}

ElementState element_state(const ReferenceWall& wall, int e, const State& state) {
  const auto nodes = wall.elements.element(e);
  const auto pressures = wall.pressures.element(e);
  ElementState s{Eigen::Matrix3Xd(3, nodes.size()), Eigen::VectorXd(pressures.size())};
  for (std::size_t a = 0; a < nodes.size(); ++a)
    s.x.col(static_cast<Eigen::Index>(a)) = state.positions[nodes[a]];
  for (std::size_t m = 0; m < pressures.size(); ++m)
    s.p[static_cast<Eigen::Index>(m)] = state.pressures[pressures[m]];
  return s;
}

Equations::Equations(const mesh::Mesh& mesh, const StaticModel& model)
    : mesh_(mesh),
      wall_(reference_wall(mesh)),
      endocardium_(mesh),
      septum_(mesh, mesh::septum(mesh)),
      model_(for_order(model, mesh.order)),
      supports_(mesh, model.heart.base, model.heart.surroundings),
      contractility_(at_points(mesh::at_nodes(mesh, model.heart.contractility))),
      masses_(masses(mesh, wall_, model.density)) {}

void Equations::set_model(const StaticModel& model) {
  model_ = for_order(model, mesh_.order);
  supports_ = {mesh_, model.heart.base, model.heart.surroundings};
  contractility_ = at_points(mesh::at_nodes(mesh_, model.heart.contractility));
  masses_ = masses(mesh_, wall_, model.density);
}

State Equations::rest() const {
  return {mesh_.nodes, std::vector<double>(wall_.pressure_count, 0.0)};
}

Pattern Equations::pattern() const {
  Pattern pattern{node_count(), wall_.pressure_count, {}, wall_.owners, {}};
  for (int e = 0; e < wall_.elements.size(); ++e)
    pattern.groups.push_back(unknowns(wall_, e, node_count()));
  if (mesh_.order == 2)
    pattern.corners = shares_of_corners(wall_, mesh_.kind, node_count());
  return pattern;
}

TensionAt Equations::steady(double activation) const {
  return [this, activation](std::size_t element, std::size_t point, double stretch) {
    const Tension T = model_.contractility.at(stretch, activation);
    return contractility_.empty() ? T : contractility_[element * points_per_element() + point] * T;
  };
}

Equations::Inside Equations::inside(const State& state, const TensionAt& tension,
                                    const Motion* motion) const {
  Inside result{std::vector<double>(size(), 0.0)};
  const std::vector<Vec3> v =
      motion != nullptr ? motion->velocities(state.positions) : std::vector<Vec3>{};
  const std::vector<Vec3> a = motion != nullptr && !motion->acceleration.empty()
                                  ? motion->accelerations(state.positions)
                                  : std::vector<Vec3>{};
  for (std::size_t i = 0; i < wall_.points.size(); ++i) {
    const int e = wall_.own[i];
    const auto nodes = wall_.elements.element(e);
    const ElementState s = element_state(wall_, e, state);
    const Eigen::Matrix3Xd rates = v.empty() ? Eigen::Matrix3Xd{} : of_nodes(v, nodes);
    Eigen::Matrix3Xd force = Eigen::Matrix3Xd::Zero(3, s.x.cols());
    Eigen::VectorXd swelling = Eigen::VectorXd::Zero(s.p.size());
    for (std::size_t q = 0; q < wall_.points[i].size(); ++q) {
      const Point& point = wall_.points[i][q];
      const Mat3 F = s.x * point.gradient.transpose();
      const double J = determinant(F);
      result.inverted = result.inverted || !(J > 0.0);
      const Eigen::VectorXd N = wall_.pressure_shapes.value.row(static_cast<Eigen::Index>(q));
      const Constitution law{model_, tension, i, q};
      Rate rate;
      if (!v.empty() && is_viscous(model_))
        rate = RateOfF{rates * point.gradient.transpose()};
      const Mat3 P = law.stress(F, J, point.infarct, rate) + N.dot(s.p) * cofactor(F);
      force.noalias() += point.volume * P * point.gradient;
      swelling += point.volume * (J - model_.compressibility.J(N.dot(s.p))) * N;
    }
    if (!a.empty())
      force += of_nodes(a, nodes) * masses_[i];
    const auto to = unknowns(wall_, e, node_count());
    for (Eigen::Index k = 0; k < force.size(); ++k)
      result.R[to[k]] += force.data()[k];
    for (Eigen::Index m = 0; m < swelling.size(); ++m)
      result.R[to[force.size() + m]] += swelling[m];
  }
  return result;
}

std::vector<double> Equations::residual(const State& state, double pressure,
                                        const TensionAt& tension, const Motion* motion,
                                        const solid::BasePlace& base) const {
  auto [R, inverted] = inside(state, tension, motion);
  if (parallel::any(inverted))
    return {};
  std::vector<Vec3> forces(state.positions.size(), Vec3::Zero());
  add_pressure(pressure, state.positions, forces);
  const std::vector<Vec3> v =
      motion != nullptr ? motion->velocities(state.positions) : std::vector<Vec3>{};
  supports_.add_forces(state.positions, v, forces, base);
  for (std::size_t a = 0; a < forces.size(); ++a)
    for (int i = 0; i < 3; ++i)
      R[3 * a + i] -= forces[a][i];
  parallel::sum(R);
  return R;
}

/// Vectors of nodes as long as R, summed over ranks.
std::vector<double> Equations::summed(std::span<const Vec3> of_nodes) const {
  std::vector<double> all(of_nodes.data()->data(), of_nodes.data()->data() + 3 * of_nodes.size());
  all.resize(size(), 0.0);
  parallel::sum(all);
  return all;
}

void Equations::add_pressure(double pressure, std::span<const Vec3> positions,
                             std::span<Vec3> forces) const {
  endocardium_.add_gradient(pressure, positions, forces);
  septum_.add_gradient(model_.heart.septal_pressure * pressure, positions, forces);
}

std::vector<double> Equations::pressure_force(const State& state) const {
  std::vector<Vec3> force(state.positions.size(), Vec3::Zero());
  add_pressure(1.0, state.positions, force);
  return summed(force);
}

std::vector<double> Equations::volume_gradient(const State& state) const {
  std::vector<Vec3> gradient(state.positions.size(), Vec3::Zero());
  endocardium_.add_volume_gradient(state.positions, gradient);
  return summed(gradient);
}

double Equations::pressure_work(const State& from, const State& to) const {
  std::vector<Vec3> force(from.positions.size(), Vec3::Zero());
  for (const State* at : {&from, &to})
    endocardium_.add_gradient(0.5 * at->cavity_pressure, at->positions, force);
  double work = 0.0;
  for (std::size_t a = 0; a < force.size(); ++a)
    work += force[a].dot(to.positions[a] - from.positions[a]);
  return parallel::sum(work);
}

std::vector<double> Equations::fibre_stretch(const State& state) const {
  std::vector<double> stretch;
  for (std::size_t i = 0; i < wall_.points.size(); ++i) {
    const ElementState s = element_state(wall_, wall_.own[i], state);
    for (const Point& point : wall_.points[i])
      stretch.push_back((s.x * point.gradient.row(0).transpose()).norm());
  }
  return stretch;
}

void Equations::tangent(const State& state, double pressure, const TensionAt& tension,
                        SparseMatrix& K, const Motion* motion) const {
  K.set_zero();
  ElementTangent element(wall_.elements.nodes_per_element, wall_.pressures.nodes_per_element,
                         wall_.points.empty() ? 0 : wall_.points.front().size());
  const std::vector<Vec3> v =
      motion != nullptr ? motion->velocities(state.positions) : std::vector<Vec3>{};
  for (std::size_t i = 0; i < wall_.points.size(); ++i) {
    const int e = wall_.own[i];
    const std::vector<int> at = unknowns(wall_, e, node_count());
    std::optional<ElementMotion> moving;
    if (motion != nullptr)
      moving = {of_nodes(v, wall_.elements.element(e)), motion->velocity_slope};
    if (motion != nullptr && !motion->acceleration.empty())
      moving->inertia = motion->acceleration_slope * masses_[i];
    K.add(at, element.compute(wall_.points[i], element_state(wall_, e, state), {model_, tension, i},
                              wall_.pressure_shapes.value, moving));
    K.add_pressure_mass(std::span(at).last(wall_.pressures.nodes_per_element),
                        element.pressure_mass());
  }
  const auto add = [&](std::span<const int> nodes, const Eigen::MatrixXd& block) {
    std::vector<int> at;
    for (const int node : nodes)
      at.insert(at.end(), {3 * node, 3 * node + 1, 3 * node + 2});
    K.add(at, block);
  };
  endocardium_.add_hessian(-pressure, state.positions, add);
  septum_.add_hessian(-model_.heart.septal_pressure * pressure, state.positions, add);
  const double slope = motion != nullptr ? motion->velocity_slope : 0.0;
  supports_.add_stiffness(slope, add);
  K.finish();
}

double Equations::mean_tension(const State& state, const TensionAt& tension) const {
  std::array<double, 2> sums{};
  for (std::size_t i = 0; i < wall_.points.size(); ++i) {
    const ElementState s = element_state(wall_, wall_.own[i], state);
    for (std::size_t q = 0; q < wall_.points[i].size(); ++q) {
      const Point& point = wall_.points[i][q];
      const Constitution law{model_, tension, i, q};
      const Mat3 F = s.x * point.gradient.transpose();
      sums[0] += point.volume * law.tension_left(F, point.infarct);
      sums[1] += point.volume;
    }
  }
  parallel::sum(sums);
  return sums[0] / sums[1];
}

std::vector<double> Equations::at_points(std::span<const double> nodal) const {
  std::vector<double> values;
  if (nodal.empty())
    return values;
  const Eigen::MatrixXd phi = solid::element_shapes(mesh_.kind, mesh_.order).value;
  for (const int e : wall_.own) {
    Eigen::VectorXd own(phi.cols());
    for (Eigen::Index a = 0; a < own.size(); ++a)
      own[a] = nodal[wall_.elements.element(e)[static_cast<std::size_t>(a)]];
    for (const double value : (phi * own).eval())
      values.push_back(std::clamp(value, own.minCoeff(), own.maxCoeff()));
  }
  return values;
}

double Equations::mean(std::span<const double> at_points) const {
  std::array<double, 2> sums{};
  const double* next = at_points.data();
  for (const std::vector<Point>& points : wall_.points)
    for (const Point& point : points) {
      sums[0] += point.volume * *next++;
      sums[1] += point.volume;
    }
  parallel::sum(sums);
  return sums[0] / sums[1];
}

double Equations::kinetic_energy(std::span<const Vec3> velocities) const {
  double energy = 0.0;
  for (std::size_t i = 0; i < masses_.size(); ++i) {
    const Eigen::Matrix3Xd v = of_nodes(velocities, wall_.elements.element(wall_.own[i]));
    energy += 0.5 * (v * masses_[i]).cwiseProduct(v).sum();
  }
  return parallel::sum(energy);
}

double Equations::support_work(const Moving& from, const Moving& to) const {
  std::vector<Vec3> forces(from.positions.size(), Vec3::Zero());
  supports_.add_forces(from.positions, from.velocities, forces, from.base);
  supports_.add_forces(to.positions, to.velocities, forces, to.base);
  double work = 0.0;
  for (std::size_t a = 0; a < forces.size(); ++a)
    work -= 0.5 * forces[a].dot(to.positions[a] - from.positions[a]);
  return parallel::sum(work);
}

double Equations::base_work(const Moving& from, const Moving& to) const {
  std::vector<Vec3> forces(from.positions.size(), Vec3::Zero());
  supports_.add_base_forces(from.positions, from.velocities, forces, from.base);
  supports_.add_base_forces(to.positions, to.velocities, forces, to.base);
  double work = 0.0;
  for (std::size_t a = 0; a < forces.size(); ++a) {
    const Vec3& X = mesh_.nodes[a];
    work += 0.5 * forces[a].dot(to.base.displacement.at(X) - from.base.displacement.at(X));
  }
  return parallel::sum(work);
}

double Equations::viscous_work(const Moving& from, const Moving& to) const {
  if (!is_viscous(model_))
    return 0.0;
  double work = 0.0;
  for (std::size_t i = 0; i < wall_.points.size(); ++i) {
    const auto nodes = wall_.elements.element(wall_.own[i]);
    const auto at_nodes = [&](std::span<const Vec3> values) -> Eigen::Matrix3Xd {
      if (values.empty())
        return Eigen::Matrix3Xd::Zero(3, static_cast<Eigen::Index>(nodes.size()));
      return of_nodes(values, nodes);
    };
    const std::array x{at_nodes(from.positions), at_nodes(to.positions)};
    const std::array v{at_nodes(from.velocities), at_nodes(to.velocities)};
    for (const Point& point : wall_.points[i]) {
      const Mat3 F = x[0] * point.gradient.transpose();
      const Mat3 dF = x[1] * point.gradient.transpose() - F;
      const Mat3 P = with_law(model_, [&](const auto& law) -> Mat3 {
        return law.viscous(F, v[0] * point.gradient.transpose()) +
               law.viscous(F + dF, v[1] * point.gradient.transpose());
      });
      work += 0.5 * point.volume * P.cwiseProduct(dF).sum();
    }
  }
  return parallel::sum(work);
}

double Equations::stored_energy(const State& state) const {
  double energy = 0.0;
  for (std::size_t i = 0; i < wall_.points.size(); ++i) {
    const ElementState s = element_state(wall_, wall_.own[i], state);
    for (std::size_t q = 0; q < wall_.points[i].size(); ++q) {
      const Point& point = wall_.points[i][q];
      const Mat3 F = s.x * point.gradient.transpose();
      const Eigen::VectorXd N = wall_.pressure_shapes.value.row(static_cast<Eigen::Index>(q));
      energy += point.volume * model_.compressibility.energy(N.dot(s.p));
      energy += point.volume *
                with_law(model_, [&](const auto& law) { return law.energy(F, point.infarct); });
    }
  }
  return parallel::sum(energy);
}

Equations::MuscleWork Equations::muscle_work(const Working& from, const Working& to) const {
  MuscleWork work{std::vector<double>(elements())};
  for (std::size_t i = 0; i < wall_.points.size(); ++i) {
    const ElementState a = element_state(wall_, wall_.own[i], from.state);
    const ElementState b = element_state(wall_, wall_.own[i], to.state);
    double here = 0.0;
    double volume = 0.0;
    for (std::size_t q = 0; q < wall_.points[i].size(); ++q) {
      const Point& point = wall_.points[i][q];
      const Mat3 F_a = a.x * point.gradient.transpose();
      const Mat3 F_b = b.x * point.gradient.transpose();
      const Vec3 stress = Constitution{model_, from.tension, i, q}.active(F_a, point.infarct) +
                          Constitution{model_, to.tension, i, q}.active(F_b, point.infarct);
      here -= 0.5 * point.volume * stress.dot(F_b.col(0) - F_a.col(0));
      volume += point.volume;
    }
    work.density[wall_.own[i]] = here / volume;
    work.whole += here;
  }
  parallel::sum(work.density);
  work.whole = parallel::sum(work.whole);
  return work;
}

}  // namespace lv::implicit
