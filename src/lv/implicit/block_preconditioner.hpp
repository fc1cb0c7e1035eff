#pragma once

#include "lv/base/tensor.hpp"
#include "lv/implicit/numbering.hpp"
#include "lv/implicit/petsc.hpp"

#include <Eigen/Core>

#include <span>

namespace lv::implicit {

/// The preconditioner of the saddle-point matrix K = [ A  B ; B^T  0 ]:
///
///   [ M(A)  B ; 0  -S ]^-1,   S = int N N^T / mu dV
///
/// S: pressures, their mass weighted by the inverse shear modulus, which is close to B^T A^-1 B
/// (Elman, Silvester & Wathen, Finite Elements and Fast Iterative Solvers, 2014, chapter 4).
///
/// M: displacements, by multigrid. The first coarse level of the quadratic elements are linear ones
/// between their corners (A_c = P^T A P), the next come from smoothed aggregation that knows the
/// rigid motions.
///
/// Linear elements have pressures that no displacement feels (checkerboards), which S does not
/// know.
class BlockPreconditioner {
 public:
  /// Becomes the preconditioner of `ksp`. `nodes`: their places [mm], for the rigid motions. The
  /// elements must be quadratic.
  BlockPreconditioner(KSP ksp, const Pattern& pattern, const Numbering& numbers,
                      std::span<const Vec3> nodes);
  ~BlockPreconditioner();
  BlockPreconditioner(const BlockPreconditioner&) = delete;
  BlockPreconditioner& operator=(const BlockPreconditioner&) = delete;

  void set_zero();

  /// Adds to S, of these numbers of pressures.
  void add_pressure_mass(std::span<const PetscInt> at, const Eigen::MatrixXd& block);

  /// The matrix of `ksp` and S have been made anew on all ranks. Collective.
  void update();

 private:
  void split(const Numbering& numbers);
  void make_interpolation(const Pattern& pattern, const Runs& fine, std::span<const Vec3> nodes);
  void make_multigrid(KSP of_displacements, Mat A);

  KSP ksp_;
  Mat S_ = nullptr;
  Mat P_ = nullptr;               ///< from the corners to all nodes
  Mat A_c_ = nullptr;             ///< the linear level
  MatNullSpace rigid_ = nullptr;  ///< motions of the corners
};

}  // namespace lv::implicit
