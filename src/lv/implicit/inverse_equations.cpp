#include "lv/implicit/inverse_equations.hpp"

#include "lv/base/parallel.hpp"
#include "lv/implicit/element_product.hpp"
#include "lv/material/tangent_algebra.hpp"
#include "lv/mesh/regions.hpp"
#include "lv/mesh/undeformed_wall.hpp"

#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>

namespace lv::implicit {
namespace {

/// Sine of the angle between wall and axis below which the rule's directions turn too abruptly.
constexpr double steepest = 0.1;

/// How the fibre frame turns with the radial direction r: Q^T dQ/dr_k.
using TurnOfFrame = std::array<Mat3, 3>;

/// By differences: the frame is a smooth function of r but where r is along the axis.
TurnOfFrame turn_of_frame(const mesh::FibreRule& rule, const Mat3& Q, const Vec3& r, double t) {
  constexpr double h = 1e-6;
  const auto frame = [&](const Vec3& radial) {
    return mesh::fibre_frame(rule, mesh::wall_axes(radial), t);
  };
  TurnOfFrame turn;
  for (int k = 0; k < 3; ++k) {
    const Vec3 dr = h * Vec3::Unit(k);
    turn[static_cast<std::size_t>(k)] = Q.transpose() * (frame(r + dr) - frame(r - dr)) / (2.0 * h);
  }
  return turn;
}

bool frames_follow_rule(const mesh::Mesh& mesh) {
  return mesh.fibres.given.f0.empty() && mesh.kind == mesh::CellKind::hexahedron;
}

/// Stresses at a point that its derivative needs, in the fibre frame.
struct Stresses {
  Mat3 F, P;
  material::Tangent<double> dP_dF;
};

/// The change of P dV grad phi_a over dV by dX_b: A(i + 3 j, n + 3 l) with the gradients of a and b
/// in the fibre frame.
material::Tangent<double> flux_tangent(const Stresses& at, const Mat3& Q, const Vec3& r,
                                       const std::optional<TurnOfFrame>& turn_by_r) {
  material::Tangent<double> A;
  for (int n = 0; n < 3; ++n) {
    for (int l = 0; l < 3; ++l) {
      const Mat3 H = Q.row(n).transpose() * Vec3::Unit(l).transpose();
      Mat3 turn = Mat3::Zero();
      if (turn_by_r)
        for (int k = 0; k < 3; ++k)
          turn -= (*turn_by_r)[static_cast<std::size_t>(k)] * Q(k, l) * r[n];
      const Mat3 dF = at.F * (turn - H);
      Eigen::Matrix<double, 9, 1> dP = at.dP_dF * dF.reshaped();
      const Mat3 rest = H.trace() * at.P - at.P * (H - turn).transpose();
      A.col(n + 3 * l) = dP + rest.reshaped();
    }
  }
  return A;
}

}  // namespace

InverseEquations::InverseEquations(const mesh::Mesh& seen, const StaticModel& model)
    : seen_(seen),
      model_(model),
      elements_(reference_wall(seen)),
      shapes_(solid::element_shapes(seen.kind, seen.order)) {
  const Equations forward(seen, model);
  model_ = forward.model();  // as it is for the elements' order
  pattern_ = forward.pattern();
  contractility_.assign(forward.contractility().begin(), forward.contractility().end());
  elements_.points.clear();
  hold_frames(this->seen());
}

Reference InverseEquations::seen() const {
  return {seen_.nodes,
          std::vector<double>(static_cast<std::size_t>(elements_.pressure_count), 0.0)};
}

/// All are free while the wall's own are asked for.
void InverseEquations::hold_frames(const Reference& reference) {
  const mesh::Mesh wall = mesh::with_nodes(seen_, reference.nodes);
  held_.assign(elements_.own.size() * static_cast<std::size_t>(shapes_.points()), std::nullopt);
  if (!frames_follow_rule(wall))
    return;
  for_points(wall, [&](const Place& place, const Geometry& at) {
    if (std::hypot(at.radial.x(), at.radial.y()) < steepest)
      held_[place.number] = at.frame;
  });
}

bool InverseEquations::holds_frames() const {
  return parallel::any(
      std::any_of(held_.begin(), held_.end(), [](const auto& frame) { return frame.has_value(); }));
}

template <class Visit>
void InverseEquations::for_points(const mesh::Mesh& wall, const Visit& visit) const {
  const mesh::UndeformedWall undeformed(wall);
  const int parts = mesh::cells_per_element(wall.order);
  std::size_t number = 0;
  for (std::size_t i = 0; i < elements_.own.size(); ++i) {
    const int e = elements_.own[i];
    const auto nodes = elements_.elements.element(e);
    for (int q = 0; q < shapes_.points(); ++q, ++number) {
      const Eigen::MatrixXd& to_xi = shapes_.gradient[static_cast<std::size_t>(q)];
      const Eigen::VectorXd phi = shapes_.value.row(q);
      const mesh::UndeformedPoint X = undeformed.at(
          {parts * e, nodes, {phi.data(), nodes.size()}, {to_xi.data(), 3 * nodes.size()}});
      visit(Place{i, q, number},
            Geometry{X.dX_dxi.inverse().transpose() * to_xi, X.det * shapes_.weight[q], X.M, X.t,
                     X.axes.radial, held_[number].value_or(X.frame)});
    }
  }
}

std::vector<double> InverseEquations::residual(const Reference& reference, double pressure) const {
  const mesh::Mesh wall = mesh::with_nodes(seen_, reference.nodes);
  if (!is_sound(wall))
    return {};
  std::vector<double> R(static_cast<std::size_t>(size()), 0.0);
  const State state{seen_.nodes, reference.pressures};
  for_points(wall, [&](const Place& place, const Geometry& at) {
    const auto [G, F, N, p] = strained_at(place, at, state);
    const double J = determinant(F);
    const Mat3 P = law_at(place).stress(F, J, at.M, {}) + p * cofactor(F);
    const Eigen::Matrix3Xd force = at.dV * P * G;
    const Eigen::VectorXd swelling = at.dV * (J - model_.compressibility.J(p)) * N;
    const std::vector<int>& to = group_of(place);
    for (Eigen::Index k = 0; k < force.size(); ++k)
      R[to[k]] += force.data()[k];
    for (Eigen::Index m = 0; m < swelling.size(); ++m)
      R[to[force.size() + m]] += swelling[m];
  });
  std::vector<Vec3> forces(seen_.nodes.size(), Vec3::Zero());
  solid::EndocardialSurface(seen_).add_gradient(pressure, seen_.nodes, forces);
  solid::EndocardialSurface(seen_, mesh::septum(seen_))
      .add_gradient(model_.heart.septal_pressure * pressure, seen_.nodes, forces);
  solid::Supports(wall, model_.heart.base, model_.heart.surroundings)
      .add_forces(seen_.nodes, {}, forces);
  for (std::size_t a = 0; a < forces.size(); ++a)
    for (int i = 0; i < 3; ++i)
      R[3 * a + i] -= forces[a][i];
  parallel::sum(R);
  return R;
}

InverseEquations::Strained InverseEquations::strained_at(const Place& place, const Geometry& at,
                                                         const State& state) const {
  const ElementState s = element_state(elements_, elements_.own[place.element], state);
  Eigen::Matrix3Xd G = at.frame.transpose() * at.gradient;
  const Mat3 F = s.x * G.transpose();
  Eigen::VectorXd N = elements_.pressure_shapes.value.row(place.point);
  const double p = N.dot(s.p);
  return {std::move(G), F, std::move(N), p};
}

const std::vector<int>& InverseEquations::group_of(const Place& place) const {
  return pattern_.groups[static_cast<std::size_t>(elements_.own[place.element])];
}

Constitution InverseEquations::law_at(const Place& place) const {
  return {model_, tension_, place.element, static_cast<std::size_t>(place.point)};
}

void InverseEquations::tangent(const Reference& reference, SparseMatrix& K) const {
  const mesh::Mesh wall = mesh::with_nodes(seen_, reference.nodes);
  K.set_zero();
  add_elements(wall, reference, K);
  add_supports(wall, K);
  K.finish();
}

void InverseEquations::add_elements(const mesh::Mesh& wall, const Reference& reference,
                                    SparseMatrix& K) const {
  const Eigen::Index n = elements_.elements.nodes_per_element;
  const Eigen::Index m = elements_.pressures.nodes_per_element;
  const bool turns = frames_follow_rule(wall);
  ElementProduct product(n, static_cast<std::size_t>(shapes_.points()));
  Eigen::MatrixXd block = Eigen::MatrixXd::Zero(3 * n + m, 3 * n + m);
  const State state{seen_.nodes, reference.pressures};
  for_points(wall, [&](const Place& place, const Geometry& at) {
    const auto [G, F, N, p] = strained_at(place, at, state);
    const Constitution law = law_at(place);
    const Stresses stresses{F, law.stress(F, determinant(F), at.M, {}) + p * cofactor(F),
                            law.tangent(F, at.M, {}) + p * material::cofactor_tangent(F)};
    std::optional<TurnOfFrame> turn;
    if (turns && !held_[place.number])
      turn = turn_of_frame(wall.fibres.rule, at.frame, at.radial, at.t);
    product.set(place.point, G, at.dV * flux_tangent(stresses, at.frame, at.radial, turn));
    const Eigen::Matrix3Xd by_p = at.dV * cofactor(F) * G;
    block.topRightCorner(3 * n, m) +=
        Eigen::Map<const Eigen::VectorXd>(by_p.data(), by_p.size()) * N.transpose();
    block.bottomLeftCorner(m, 3 * n) -=
        at.dV * model_.compressibility.J(p) * N *
        Eigen::Map<const Eigen::VectorXd>(at.gradient.data(), at.gradient.size()).transpose();
    if (const double slope = model_.compressibility.slope(p); slope > 0.0)
      block.bottomRightCorner(m, m) -= at.dV * slope * N * N.transpose();
    if (place.point + 1 < shapes_.points())
      return;
    product.multiply(block);
    K.add(group_of(place), block);
    block.setZero();
  });
}

/// Their forces are -S (x - X), S the stiffness in the wall without load; what sliding springs feel
/// of X turning about the axis is added.
void InverseEquations::add_supports(const mesh::Mesh& wall, SparseMatrix& K) const {
  const auto add = [&](std::span<const int> nodes, const Eigen::MatrixXd& block) {
    std::vector<int> at;
    for (const int node : nodes)
      at.insert(at.end(), {3 * node, 3 * node + 1, 3 * node + 2});
    K.add(at, -block);
  };
  const solid::Supports supports(wall, model_.heart.base, model_.heart.surroundings);
  supports.add_stiffness(0.0, add);
  if (model_.heart.base.kind != solid::BasalSupport::Kind::sliding || !parallel::is_root())
    return;
  const solid::BasalPenalty springs(wall, model_.heart.base);
  for (const auto& spring : springs.springs()) {
    const Vec3& X = spring.reference;
    const Vec3 u = seen_.nodes[spring.node] - X;
    const double r = std::hypot(X.x(), X.y());
    const Vec3 e_r(X.x() / r, X.y() / r, 0.0);
    const Vec3 e_t(-e_r.y(), e_r.x(), 0.0);
    const Vec3 turned = spring.stiffness(2, 2) / r * (e_r.dot(u) * e_t + e_t.dot(u) * e_r);
    const Mat3 by_X = turned * e_t.transpose();
    add(std::array{spring.node}, by_X);
  }
}

}  // namespace lv::implicit
