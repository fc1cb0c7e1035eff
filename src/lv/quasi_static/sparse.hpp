#pragma once

#include <Eigen/Core>

#include <memory>
#include <span>
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

/// A square matrix, its rows shared by the ranks, and the solution of systems with it by MUMPS.
class SparseMatrix {
 public:
  explicit SparseMatrix(const Pattern& pattern);
  ~SparseMatrix();
  SparseMatrix(SparseMatrix&&) noexcept;
  SparseMatrix& operator=(SparseMatrix&&) noexcept;

  void set_zero();

  /// Adds a dense block.
  void add(std::span<const int> unknowns, const Eigen::MatrixXd& block);

  /// All ranks have added all. Collective.
  void finish();

  /// Solves K x = b; b and x complete on every rank. The factorisation is kept until the matrix
  /// changes. Throws RunError when the matrix is singular. Collective.
  [[nodiscard]] std::vector<double> solve(std::span<const double> b);

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace lv::quasi_static
