#pragma once

#include "lv/base/tensor.hpp"

#include <memory>
#include <span>
#include <stdexcept>
#include <vector>

/// Sparse linear algebra by PETSc; its headers stay in sparse.cpp.
namespace lv::quasi_static {

/// Which unknowns there are and which meet in an element: the displacement of node a along i is
/// 3 a + i, pressures follow.
struct Pattern {
  int nodes = 0;
  int pressures = 0;
  std::vector<std::vector<int>> groups;  ///< the unknowns of each element; of all ranks

  [[nodiscard]] int displacements() const { return 3 * nodes; }
  [[nodiscard]] int size() const { return displacements() + pressures; }
};

/// Iterations did not find what they look for, an equilibrium or the solution of a linear system;
/// says why. Shorter steps may help.
class NoConvergence : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// How systems are solved.
enum class LinearMethod {
  direct,    ///< MUMPS: robust; memory and time grow faster than the mesh
  iterative  ///< flexible GMRES, preconditioned block by block: for large meshes and many ranks
};

struct LinearParameters {
  LinearMethod method = LinearMethod::direct;
  double tolerance = 1e-6;  ///< of the iterative method: residual over right-hand side [-]
  int iterations = 1000;    ///< before the iterative method gives up
};

/// A square matrix of saddle-point form, its rows shared by the ranks, and the solution of systems
/// with it.
///
///   K = [ A  B ; B^T  0 ]     preconditioner  [ AMG(A)  B ; 0  -S ],  S = int N N^T / mu dV
///
/// A: displacements, by algebraic multigrid that knows the rigid motions; S: pressures, their mass
/// weighted by the inverse shear modulus, which is close to B^T A^-1 B (Elman, Silvester & Wathen,
/// Finite Elements and Fast Iterative Solvers, 2014, chapter 4).
class SparseMatrix {
 public:
  /// `nodes`: their places [mm], for the rigid motions.
  SparseMatrix(const Pattern& pattern, const LinearParameters& parameters,
               std::span<const Vec3> nodes);
  ~SparseMatrix();
  SparseMatrix(SparseMatrix&&) noexcept;
  SparseMatrix& operator=(SparseMatrix&&) noexcept;

  void set_zero();

  /// Adds a dense block.
  void add(std::span<const int> unknowns, const Eigen::MatrixXd& block);

  /// Adds to S, of these pressures (numbers among all unknowns). The direct method does not use it.
  void add_pressure_mass(std::span<const int> pressures, const Eigen::MatrixXd& block);

  /// All ranks have added all. Collective.
  void finish();

  /// Solves K x = b; b and x complete on every rank. The factorisation is kept until the matrix
  /// changes. Throws RunError when the matrix is singular, NoConvergence when iterations fail.
  /// Collective.
  [[nodiscard]] std::vector<double> solve(std::span<const double> b);

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace lv::quasi_static
