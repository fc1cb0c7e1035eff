#pragma once

#include "lv/base/outcome.hpp"
#include "lv/implicit/petsc.hpp"

#include <span>
#include <vector>

namespace lv::implicit {

/// The factors of a square matrix whose rows the ranks share, by MUMPS on the first rank alone.
///
/// MUMPS on several ranks adds up what other ranks send in the order in which it arrives, so that
/// two runs differ in their last bits (P. R. Amestoy et al., SIAM J. Matrix Anal. Appl. 23:15,
/// 2001, section 4: scheduling at run time). On one rank the order is that of the elimination tree,
/// and a run that is stopped and goes on, or is done again, gets the same bits.
class DirectSolver {
 public:
  /// Of the matrix, which stays the caller's.
  explicit DirectSolver(Mat matrix) : matrix_(matrix) {}
  ~DirectSolver();
  DirectSolver(const DirectSolver&) = delete;
  DirectSolver& operator=(const DirectSolver&) = delete;

  /// The matrix has other entries. Collective.
  void update();

  /// Forgets the factorisation and the order of unknowns, which was chosen by the first matrix: the
  /// next one is solved as in a new program.
  void forget_factors();

  /// Solves K x = b, in the matrix's order, b and x complete on every rank, unless the matrix is
  /// singular. It is factorised by the first solution after an update(). Throws RunError when
  /// memory runs out. Collective.
  Outcome<std::vector<double>> solve(std::span<const double> b);

 private:
  void gather();
  void configure();
  [[nodiscard]] Mat here() const;
  [[nodiscard]] KSPConvergedReason solve_here(std::span<const double> b, std::span<double> x);
  [[nodiscard]] KSPConvergedReason solve_with_room();

  Mat matrix_;
  Mat* whole_ = nullptr;  ///< on the first of several ranks: the whole; on the others: nothing
  KSP ksp_ = nullptr;     ///< on the first rank
  Vec x_ = nullptr, b_ = nullptr;
  int room_ = 60;  ///< for pivots that move [%]
};

}  // namespace lv::implicit
