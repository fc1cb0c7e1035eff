#pragma once

#include "lv/immersed/coupling.hpp"

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCore>

#include <map>

namespace lv::immersed {

/// The paper's coupling (Griffith & Luo; section 2.5): the Lagrangian force density F of (2.10) and
/// the velocity of the wall are finite-element functions, and the integrals with the delta function
/// run over Gauss points that are made anew from the present size of each element, so that at least
/// `points_per_cell` points fall on every mesh width, and two on every edge of an element:
///
///   M F = nodal forces,   f(x) = sum_q w_q F(X_q) delta_h(x - chi(X_q))                                    (2.9)
///   M U = sum_q w_q phi(X_q) sum_x u(x) delta_h(x - chi(X_q)) h^3                                          (2.4)
///
/// with the consistent mass matrix M of the undeformed wall.
class QuadratureCoupling final : public Coupling {
 public:
  QuadratureCoupling(const mesh::Mesh& mesh, const Transfer& transfer, double spacing,
                     double points_per_cell);

  void spread(std::span<const Vec3> positions, std::span<const Vec3> forces,
              fluid::FaceField& force) const override;
  void interpolate(const fluid::FaceField& velocity, std::span<const Vec3> positions,
                   std::span<Vec3> velocities) const override;

  /// Points of all elements at these positions: the cost of one transfer.
  [[nodiscard]] std::size_t point_count(std::span<const Vec3> positions) const;

 private:
  /// Shape functions, their gradients and the weight at a point of the reference element.
  struct ReferencePoint {
    std::array<double, 8> phi;
    std::array<std::array<double, 3>, 8> gradient;
    double weight;
  };
  using Rule = std::vector<ReferencePoint>;

  [[nodiscard]] std::array<int, 3> points_along(std::span<const int> cell,
                                                std::span<const Vec3> positions) const;
  [[nodiscard]] const Rule& rule(const std::array<int, 3>& points) const;
  [[nodiscard]] Rule make_rule(const std::array<int, 3>& points) const;
  [[nodiscard]] std::vector<Vec3> project(std::span<const Vec3> loads) const;
  void assemble_mass();
  template <class Visit>
  void for_points(std::span<const Vec3> positions, const Visit& visit) const;

  const mesh::Mesh& mesh_;
  Transfer transfer_;
  double spacing_;
  double points_per_cell_;
  Eigen::SparseMatrix<double, Eigen::RowMajor> mass_;
  Eigen::ConjugateGradient<Eigen::SparseMatrix<double, Eigen::RowMajor>,
                           Eigen::Lower | Eigen::Upper>
      solver_;
  mutable std::map<std::array<int, 3>, Rule> rules_;  ///< made when first needed
};

}  // namespace lv::immersed
