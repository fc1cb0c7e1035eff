#pragma once

#include "lv/base/outcome.hpp"
#include "lv/base/tensor.hpp"
#include "lv/implicit/numbering.hpp"

#include <memory>
#include <span>
#include <vector>

namespace lv::implicit {

/// How systems are solved.
enum class LinearMethod {
  direct,    ///< MUMPS: robust; memory and time grow faster than the mesh
  iterative  ///< flexible GMRES with a BlockPreconditioner: for large meshes and many ranks
};

struct LinearParameters {
  LinearMethod method = LinearMethod::direct;
  double tolerance = 1e-4;  ///< of the iterative method: residual over right-hand side [-]
  int iterations = 300;     ///< before the iterative method gives up
};

/// A square matrix of saddle-point form, [ A  B ; B^T  0 ], its rows shared by the ranks, and the
/// solution of systems with it, by PETSc.
class SparseMatrix {
 public:
  /// `nodes`: their places [mm], for the rigid motions. The iterative method needs quadratic
  /// elements.
  SparseMatrix(const Pattern& pattern, const LinearParameters& parameters,
               std::span<const Vec3> nodes);
  ~SparseMatrix();
  SparseMatrix(SparseMatrix&&) noexcept;
  SparseMatrix& operator=(SparseMatrix&&) noexcept;

  void set_zero();

  /// Adds a dense block.
  void add(std::span<const int> unknowns, const Eigen::MatrixXd& block);

  /// Adds int N N^T / mu dX of an element, for its pressures (numbers among all unknowns), to the
  /// S of the BlockPreconditioner. The direct method does not use it.
  void add_pressure_mass(std::span<const int> pressures, const Eigen::MatrixXd& block);

  /// All ranks have added all. Collective.
  void finish();

  /// Solves K x = b, unless the matrix is singular or iterations fail; b and x complete on every
  /// rank. The factorisation is kept until the matrix changes. Throws RunError when memory runs
  /// out. Collective.
  Outcome<std::vector<double>> solve(std::span<const double> b);

  /// Forgets the factorisation and the order of unknowns, which the direct method chose by the
  /// first matrix that it was given: the next one is solved as in a new program. Collective.
  void forget_factors();

  /// Of the iterative method, in the last solve; 0 of the direct one.
  [[nodiscard]] int iterations() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace lv::implicit
