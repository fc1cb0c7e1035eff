#include "lv/implicit/block_preconditioner.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>

namespace lv::implicit {
namespace {

/// Smoothed aggregation at the given place among PETSc's options. Jacobi, Gauss-Seidel or ILU(0) as
/// its smoothers do not converge: the springs of the base hold one direction, which is not along an
/// axis, and leave another free. On several ranks each factorises its own block, in which zero
/// pivots occur: these are shifted.
std::string aggregation(const std::string& at) {
  return fmt::format(
      "-{0}ksp_type preonly -{0}pc_type gamg -{0}pc_gamg_threshold 0.02 "
      "-{0}mg_levels_pc_type bjacobi -{0}mg_levels_sub_pc_type ilu "
      "-{0}mg_levels_sub_pc_factor_levels 1 -{0}mg_levels_sub_pc_factor_shift_type nonzero ",
      at);
}

/// How the blocks are solved. Smoother of the quadratic level: two symmetric sweeps of
/// Gauss-Seidel, a node's three displacements at once.
std::string block_options() {
  const std::string u = "lv_fieldsplit_u_";
  return fmt::format(
             "-{0}ksp_type preonly -{0}mg_levels_ksp_type richardson -{0}mg_levels_ksp_max_it 2 "
             "-{0}mg_levels_pc_type sor ",
             u) +
         aggregation(u + "mg_coarse_") +
         "-lv_fieldsplit_p_ksp_type preonly -lv_fieldsplit_p_pc_type bjacobi";
}

/// The six rigid motions of points given component by component; `own` of them are this rank's.
MatNullSpace rigid_motions(std::span<const double> own) {
  Vec places = nullptr;
  check(VecCreate(PETSC_COMM_WORLD, &places));
  check(VecSetSizes(places, static_cast<PetscInt>(own.size()), PETSC_DETERMINE));
  check(VecSetBlockSize(places, 3));
  check(VecSetUp(places));
  PetscScalar* values = nullptr;
  check(VecGetArray(places, &values));
  std::copy(own.begin(), own.end(), values);
  check(VecRestoreArray(places, &values));
  MatNullSpace rigid = nullptr;
  check(MatNullSpaceCreateRigidBody(places, &rigid));
  check(VecDestroy(&places));
  return rigid;
}

/// The corners of quadratic elements.
struct Corners {
  std::vector<int> nodes;
  std::vector<int> of_node;  ///< which corner a node is; -1: none

  explicit Corners(const Pattern& pattern) : of_node(pattern.nodes, -1) {
    for (int a = 0; a < pattern.nodes; ++a) {
      if (pattern.corners[a].size() != 1)
        continue;
      of_node[a] = static_cast<int>(nodes.size());
      nodes.push_back(a);
    }
  }
};

/// The places of this rank's corners, in their order.
std::vector<double> own_places(const Corners& corners, const Runs& runs,
                               std::span<const Vec3> nodes) {
  std::vector<double> result(3 * runs.own());
  for (int c = 0; c < runs.size(); ++c)
    if (runs.is_own(c))
      for (int i = 0; i < 3; ++i)
        result[3 * (runs[c] - runs.begin()) + i] = nodes[corners.nodes[c]][i];
  return result;
}

Runs runs_of(const Corners& corners, const Runs& of_nodes) {
  std::vector<int> owners;
  for (const int node : corners.nodes)
    owners.push_back(of_nodes.owner(node));
  return {std::move(owners), parallel::size()};
}

}  // namespace

BlockPreconditioner::BlockPreconditioner(KSP ksp, const Pattern& pattern, const Numbering& numbers,
                                         std::span<const Vec3> nodes)
    : ksp_(ksp) {
  const PetscInt local = numbers.pressures().own();
  check(MatCreate(PETSC_COMM_WORLD, &S_));
  check(MatSetSizes(S_, local, local, pattern.pressures, pattern.pressures));
  check(MatSetType(S_, MATAIJ));
  check(MatSetUp(S_));
  check(MatSetOption(S_, MAT_NEW_NONZERO_ALLOCATION_ERR, PETSC_FALSE));
  make_interpolation(pattern, numbers.nodes(), nodes);
  check(PetscOptionsInsertString(nullptr, block_options().c_str()));
  split(numbers);
}

BlockPreconditioner::~BlockPreconditioner() {
  MatDestroy(&S_);
  MatDestroy(&P_);
  MatDestroy(&A_c_);
  MatNullSpaceDestroy(&rigid_);
}

void BlockPreconditioner::set_zero() {
  check(MatZeroEntries(S_));
}

void BlockPreconditioner::add_pressure_mass(std::span<const PetscInt> at,
                                            const Eigen::MatrixXd& block) {
  const Eigen::MatrixXd negative = -block;  // symmetric: the order of its entries does not matter
  const auto n = static_cast<PetscInt>(at.size());
  check(MatSetValues(S_, n, at.data(), n, at.data(), negative.data(), ADD_VALUES));
}

void BlockPreconditioner::split(const Numbering& numbers) {
  PC pc = nullptr;
  check(KSPGetPC(ksp_, &pc));
  check(PCSetType(pc, PCFIELDSPLIT));
  const PetscInt displacements = 3 * numbers.nodes().own();
  IS of_displacements = nullptr, of_pressures = nullptr;
  check(ISCreateStride(PETSC_COMM_WORLD, displacements, numbers.begin(), 1, &of_displacements));
  check(ISSetBlockSize(of_displacements, 3));
  check(ISCreateStride(PETSC_COMM_WORLD, numbers.pressures().own(), numbers.begin() + displacements,
                       1, &of_pressures));
  check(PCFieldSplitSetIS(pc, "u", of_displacements));
  check(PCFieldSplitSetIS(pc, "p", of_pressures));
  check(PCFieldSplitSetType(pc, PC_COMPOSITE_SCHUR));
  check(PCFieldSplitSetSchurFactType(pc, PC_FIELDSPLIT_SCHUR_FACT_UPPER));
  check(PCFieldSplitSetSchurPre(pc, PC_FIELDSPLIT_SCHUR_PRE_USER, S_));
  check(ISDestroy(&of_displacements));
  check(ISDestroy(&of_pressures));
}

void BlockPreconditioner::make_interpolation(const Pattern& pattern, const Runs& fine,
                                             std::span<const Vec3> nodes) {
  const Corners corners(pattern);
  const Runs coarse = runs_of(corners, fine);
  check(MatCreateAIJ(PETSC_COMM_WORLD, 3 * fine.own(), 3 * coarse.own(), 3 * fine.size(),
                     3 * coarse.size(), 8, nullptr, 8, nullptr, &P_));
  check(MatSetBlockSizes(P_, 3, 3));
  for (int a = 0; a < pattern.nodes; ++a) {
    if (!fine.is_own(a))
      continue;
    for (const auto& [corner, weight] : pattern.corners[a])
      for (int i = 0; i < 3; ++i)
        check(MatSetValue(P_, 3 * fine[a] + i, 3 * coarse[corners.of_node[corner]] + i, weight,
                          INSERT_VALUES));
  }
  check(MatAssemblyBegin(P_, MAT_FINAL_ASSEMBLY));
  check(MatAssemblyEnd(P_, MAT_FINAL_ASSEMBLY));
  rigid_ = rigid_motions(own_places(corners, coarse, nodes));
}

void BlockPreconditioner::update() {
  check(MatAssemblyBegin(S_, MAT_FINAL_ASSEMBLY));
  check(MatAssemblyEnd(S_, MAT_FINAL_ASSEMBLY));
  check(KSPSetUp(ksp_));  // makes A
  PC pc = nullptr;
  check(KSPGetPC(ksp_, &pc));
  PetscInt count = 0;
  KSP* blocks = nullptr;
  check(PCFieldSplitSchurGetSubKSP(pc, &count, &blocks));
  KSP of_displacements = blocks[0];
  check(PetscFree(blocks));
  Mat A = nullptr;
  check(KSPGetOperators(of_displacements, &A, nullptr));
  if (A_c_ == nullptr)
    make_multigrid(of_displacements, A);
  else
    check(MatPtAP(A, P_, MAT_REUSE_MATRIX, PETSC_DEFAULT, &A_c_));
}

void BlockPreconditioner::make_multigrid(KSP of_displacements, Mat A) {
  check(MatPtAP(A, P_, MAT_INITIAL_MATRIX, PETSC_DEFAULT, &A_c_));
  check(MatSetNearNullSpace(A_c_, rigid_));
  PC multigrid = nullptr;
  check(KSPGetPC(of_displacements, &multigrid));
  check(PCSetType(multigrid, PCMG));
  check(PCMGSetLevels(multigrid, 2, nullptr));
  check(PCMGSetInterpolation(multigrid, 1, P_));
  check(PCSetFromOptions(multigrid));
  KSP coarse = nullptr;
  check(PCMGGetCoarseSolve(multigrid, &coarse));
  check(KSPSetOperators(coarse, A_c_, A_c_));
}

}  // namespace lv::implicit
