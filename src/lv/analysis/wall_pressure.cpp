#include "lv/analysis/wall_pressure.hpp"

#include "lv/base/log.hpp"
#include "lv/base/parallel.hpp"
#include "lv/solid/element.hpp"
#include "lv/solid/endocardial_surface.hpp"

#include <Eigen/LU>
#include <Eigen/SparseCore>

#include <array>
#include <limits>
#include <utility>

namespace lv::analysis {
namespace {

using Sparse = Eigen::SparseMatrix<double, Eigen::RowMajor>;
using Entries = std::vector<Eigen::Triplet<double>>;

/// Integrals over the deformed wall between pairs of nodes.
struct Integrals {
  std::array<Sparse, 3> gradient;  ///< int phi_b d phi_a/dx_d dv, row a, column b
  Sparse laplacian;                ///< int grad phi_a . grad phi_b dv
  Eigen::VectorXd volume;          ///< int phi_a dv
};

/// The integrals of one deformed element.
template <class E>
struct CellIntegrals {
  using Matrix = Eigen::Matrix<double, E::nodes, E::nodes>;

  CellIntegrals(std::span<const int> cell, std::span<const Vec3> x) {
    constexpr auto rule = E::full_quadrature();
    for (int q = 0; q < E::points; ++q)
      add_point(cell, x, rule.value[q], rule.gradient[q], rule.weight[q]);
  }

  void add_point(std::span<const int> cell, std::span<const Vec3> x,
                 const std::array<double, E::nodes>& value,
                 const std::array<std::array<double, 3>, E::nodes>& reference_gradient,
                 double weight) {
    Eigen::Matrix<double, 3, E::nodes> local;  // gradients in the reference element
    Mat3 jacobian = Mat3::Zero();              // dx/dxi
    for (int a = 0; a < E::nodes; ++a) {
      local.col(a) = Vec3(reference_gradient[a].data());
      jacobian += x[cell[a]] * local.col(a).transpose();
    }
    const Eigen::Matrix<double, 3, E::nodes> grad = jacobian.inverse().transpose() * local;
    const Eigen::Map<const Eigen::Matrix<double, E::nodes, 1>> phi(value.data());
    const double dv = weight * jacobian.determinant();
    volume += dv * phi;
    for (int d = 0; d < 3; ++d)
      gradient[d] += dv * grad.row(d).transpose() * phi.transpose();
    laplacian += dv * grad.transpose() * grad;
  }

  std::array<Matrix, 3> gradient{Matrix::Zero(), Matrix::Zero(), Matrix::Zero()};
  Matrix laplacian = Matrix::Zero();
  Eigen::Matrix<double, E::nodes, 1> volume = Eigen::Matrix<double, E::nodes, 1>::Zero();
};

template <class E>
Integrals assemble(const mesh::Mesh& mesh, std::span<const Vec3> x) {
  const auto n = static_cast<Eigen::Index>(x.size());
  Eigen::VectorXd volume = Eigen::VectorXd::Zero(n);
  std::array<Entries, 4> entries;  // of the gradient's components and the Laplacian
  for (int c = 0; c < mesh.cell_count(); ++c) {
    const auto cell = mesh.cell(c);
    const CellIntegrals<E> local(cell, x);
    for (int a = 0; a < E::nodes; ++a) {
      volume[cell[a]] += local.volume[a];
      for (int b = 0; b < E::nodes; ++b) {
        for (int d = 0; d < 3; ++d)
          entries[d].emplace_back(cell[a], cell[b], local.gradient[d](a, b));
        entries[3].emplace_back(cell[a], cell[b], local.laplacian(a, b));
      }
    }
  }
  std::array<Sparse, 4> matrix;
  for (int m = 0; m < 4; ++m) {
    matrix[m].resize(n, n);
    matrix[m].setFromTriplets(entries[m].begin(), entries[m].end());
    entries[m] = {};
  }
  return {{matrix[0], matrix[1], matrix[2]}, matrix[3], volume};
}

Integrals integrals(const mesh::Mesh& mesh, std::span<const Vec3> x) {
  return mesh.kind == mesh::CellKind::hexahedron ? assemble<solid::Hex8>(mesh, x)
                                                 : assemble<solid::Tet4>(mesh, x);
}

/// All nodal forces but those of p, complete on every rank.
std::vector<Vec3> forces_without_pressure(const mesh::Mesh& mesh, const solid::Wall& wall,
                                          const solid::Supports& supports,
                                          const heartbeat::Snapshot& s) {
  std::vector<Vec3> forces(mesh.nodes.size(), Vec3::Zero());
  wall.add_elastic_forces(s.positions, s.tension, forces);
  solid::EndocardialSurface(mesh).add_gradient(s.pressure, s.positions, forces);
  supports.add_forces(s.positions, {}, forces);
  parallel::sum({forces.data()->data(), 3 * forces.size()});
  return forces;
}

constexpr double epsilon = 1e-3;

/// The normal equations of the least squares, applied without being assembled: the products of the
/// gradients would have 125 entries a row.
class NormalEquations {
 public:
  explicit NormalEquations(const Integrals& wall)
      : wall_(wall), weight_(wall.volume.cwiseInverse()) {
    for (int d = 0; d < 3; ++d)
      transposed_[d] = wall.gradient[d].transpose();
  }

  [[nodiscard]] Eigen::VectorXd times(const Eigen::VectorXd& p) const {
    Eigen::VectorXd result = epsilon * (wall_.laplacian * p);
    for (int d = 0; d < 3; ++d)
      result += transposed_[d] * weight_.cwiseProduct(wall_.gradient[d] * p);
    return result;
  }

  [[nodiscard]] Eigen::VectorXd right_side(const std::vector<Vec3>& forces) const {
    Eigen::VectorXd right = Eigen::VectorXd::Zero(weight_.size());
    Eigen::VectorXd f(weight_.size());
    for (int d = 0; d < 3; ++d) {
      for (Eigen::Index a = 0; a < f.size(); ++a)
        f[a] = forces[static_cast<std::size_t>(a)][d];
      right -= transposed_[d] * weight_.cwiseProduct(f);
    }
    return right;
  }

  [[nodiscard]] Eigen::VectorXd diagonal() const {
    Eigen::VectorXd result = epsilon * wall_.laplacian.diagonal();
    for (int d = 0; d < 3; ++d)
      result += transposed_[d].cwiseAbs2() * weight_;
    return result;
  }

 private:
  const Integrals& wall_;
  Eigen::VectorXd weight_;  ///< 1 / V_a
  std::array<Sparse, 3> transposed_;
};

/// The nodal p of least squares, by conjugate gradients.
Eigen::VectorXd nodal_pressure(const Integrals& wall, const std::vector<Vec3>& forces) {
  constexpr double tolerance = 1e-5;  // of the residual, relative
  constexpr int most_iterations = 5000;
  const NormalEquations normal(wall);
  const Eigen::VectorXd inverse_diagonal = normal.diagonal().cwiseInverse();
  Eigen::VectorXd residual = normal.right_side(forces);
  Eigen::VectorXd p = Eigen::VectorXd::Zero(residual.size());
  Eigen::VectorXd z = inverse_diagonal.cwiseProduct(residual);
  Eigen::VectorXd direction = z;
  double rz = residual.dot(z);
  const double goal = tolerance * tolerance * residual.squaredNorm();
  for (int i = 0; !(residual.squaredNorm() <= goal); ++i) {
    if (i == most_iterations) {
      log::warn("the pressure in the wall could not be found from the balance of forces");
      return Eigen::VectorXd::Constant(p.size(), std::numeric_limits<double>::quiet_NaN());
    }
    const Eigen::VectorXd image = normal.times(direction);
    const double alpha = rz / direction.dot(image);
    p += alpha * direction;
    residual -= alpha * image;
    z = inverse_diagonal.cwiseProduct(residual);
    const double rz_before = std::exchange(rz, residual.dot(z));
    direction = z + (rz / rz_before) * direction;
  }
  return p;
}

}  // namespace

std::vector<double> wall_pressure(const mesh::Mesh& mesh, const solid::Wall& wall,
                                  const solid::Supports& supports,
                                  const heartbeat::Snapshot& snapshot) {
  const std::vector<Vec3> forces = forces_without_pressure(mesh, wall, supports, snapshot);
  if (!parallel::is_root())
    return {};
  const Eigen::VectorXd p = nodal_pressure(integrals(mesh, snapshot.positions), forces);
  std::vector<double> of_cells;
  for (int c = 0; c < mesh.cell_count(); ++c) {
    double sum = 0.0;
    for (const int a : mesh.cell(c))
      sum += p[a];
    of_cells.push_back(sum / static_cast<double>(mesh.cell(c).size()));
  }
  return of_cells;
}

}  // namespace lv::analysis
