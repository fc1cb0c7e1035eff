#include "lv/implicit/direct_solver.hpp"

#include "lv/base/check.hpp"
#include "lv/base/parallel.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace lv::implicit {
namespace {

constexpr int most_room = 4000;

/// Whether MUMPS found the room too small that it had set aside for pivots that move (MUMPS 5.5
/// Users' Guide, section 8: INFOG(1) = -8 or -9), though there is memory.
bool lacks_room(PC pc) {
  Mat factor = nullptr;
  check(PCFactorGetMatrix(pc, &factor));
  PetscInt error = 0;
  check(MatMumpsGetInfog(factor, 1, &error));
  return error == -8 || error == -9;
}

}  // namespace

DirectSolver::~DirectSolver() {
  KSPDestroy(&ksp_);
  VecDestroy(&x_);
  VecDestroy(&b_);
  if (whole_ != nullptr)
    MatDestroySubMatrices(1, &whole_);
}

void DirectSolver::update() {
  if (parallel::size() > 1)
    gather();
  if (!parallel::is_root())
    return;
  const bool is_first = ksp_ == nullptr;
  if (is_first)
    check(KSPCreate(PETSC_COMM_SELF, &ksp_));
  check(KSPSetOperators(ksp_, here(), here()));
  if (!is_first)
    return;
  configure();
  check(MatCreateVecs(here(), &x_, &b_));
}

Mat DirectSolver::here() const {
  return whole_ != nullptr ? *whole_ : matrix_;
}

/// The whole matrix to the first rank.
void DirectSolver::gather() {
  PetscInt size = 0;
  check(MatGetSize(matrix_, &size, nullptr));
  IS all = nullptr;
  check(ISCreateStride(PETSC_COMM_SELF, parallel::is_root() ? size : 0, 0, 1, &all));
  const MatReuse reuse = whole_ == nullptr ? MAT_INITIAL_MATRIX : MAT_REUSE_MATRIX;
  check(MatCreateSubMatrices(matrix_, 1, &all, &all, reuse, &whole_));
  check(ISDestroy(&all));
}

void DirectSolver::configure() {
  check(KSPSetType(ksp_, KSPPREONLY));
  PC pc = nullptr;
  check(KSPGetPC(ksp_, &pc));
  check(PCSetType(pc, PCLU));
  check(PCFactorSetMatSolverType(pc, MATSOLVERMUMPS));
  check(PCFactorSetUpMatSolverType(pc));
  Mat factor = nullptr;
  check(PCFactorGetMatrix(pc, &factor));
  check(MatMumpsSetIcntl(factor, 14, room_));
}

void DirectSolver::forget_factors() {
  if (ksp_ == nullptr)
    return;
  check(KSPReset(ksp_));
  check(KSPSetOperators(ksp_, here(), here()));
  configure();
}

Outcome<std::vector<double>> DirectSolver::solve(std::span<const double> b) {
  std::vector<double> x(b.size());
  std::vector<double> reason(1);
  parallel::on_root([&] { reason[0] = static_cast<double>(solve_here(b, x)); });
  parallel::broadcast(reason);
  const auto why = static_cast<KSPConvergedReason>(static_cast<int>(reason[0]));
  if (why < 0)
    return Unsolved{fmt::format("the linear equations are singular ({}), as those of a wall that "
                                "nothing holds",
                                KSPConvergedReasons[why]),
                    "Look at the base"};
  parallel::broadcast(x);
  return x;
}

KSPConvergedReason DirectSolver::solve_here(std::span<const double> b, std::span<double> x) {
  PetscScalar* values = nullptr;
  check(VecGetArray(b_, &values));
  std::copy(b.begin(), b.end(), values);
  check(VecRestoreArray(b_, &values));
  const KSPConvergedReason reason = solve_with_room();
  if (reason < 0) {
    forget_factors();  // MUMPS cannot go on with those of a singular matrix
    return reason;
  }
  const PetscScalar* found = nullptr;
  check(VecGetArrayRead(x_, &found));
  std::copy(found, found + x.size(), x.begin());
  check(VecRestoreArrayRead(x_, &found));
  return reason;
}

/// Solves, with as much room for pivots as it takes: a matrix whose pivots need more than any is as
/// good as singular.
KSPConvergedReason DirectSolver::solve_with_room() {
  while (true) {
    check(KSPSolve(ksp_, b_, x_));
    KSPConvergedReason reason{};
    check(KSPGetConvergedReason(ksp_, &reason));
    if (reason >= 0)
      return reason;
    PC pc = nullptr;
    check(KSPGetPC(ksp_, &pc));
    PCFailedReason failure{};
    check(PCGetFailedReason(pc, &failure));
    if (failure != PC_FACTOR_OUTMEMORY)
      return reason;
    if (!lacks_room(pc))
      throw RunError("Memory does not suffice to factorise the linear equations",
                     "Take a coarser mesh, a machine with more memory, or "
                     "quasi_static.linear_solver = \"iterative\"");
    if (room_ >= most_room)
      return reason;
    room_ *= 3;
    forget_factors();
  }
}

}  // namespace lv::implicit
