#include "lv/quasi_static/sparse.hpp"

#include "lv/base/check.hpp"
#include "lv/base/parallel.hpp"

#include <fmt/format.h>
#include <petscksp.h>

#include <algorithm>

namespace lv::quasi_static {
namespace {

void check(PetscErrorCode code) {
  if (code == 0)
    return;
  const char* text = nullptr;
  PetscErrorMessage(code, &text, nullptr);
  throw RunError(fmt::format("PETSc failed: {}", text == nullptr ? "unknown error" : text),
                 "Not enough memory is the usual reason: take a coarser mesh or more machines");
}

/// Starts PETSc when it is first needed. It stays until the program ends: once finished and started
/// again, it no longer knows all of its types.
void start_petsc() {
  PetscBool started = PETSC_FALSE;
  check(PetscInitialized(&started));
  if (started)
    return;
  check(PetscOptionsSetValue(nullptr, "-no_signal_handler", "true"));  // interrupts are ours
  check(PetscInitializeNoArguments());
  check(PetscPushErrorHandler(PetscReturnErrorHandler, nullptr));
}

/// PETSc wants each rank's unknowns in one run: here those of its share of the nodes, then those
/// of its share of the pressures.
class Numbering {
 public:
  explicit Numbering(const Pattern& pattern) : numbers_(pattern.size()) {
    const int ranks = parallel::size();
    int next = 0;
    for (int r = 0; r < ranks; ++r) {
      const int begin = next;
      const auto of_nodes = parallel::share(pattern.nodes, r, ranks);
      for (int u = 3 * of_nodes.begin; u < 3 * of_nodes.end; ++u)
        numbers_[u] = next++;
      const auto of_pressures = parallel::share(pattern.pressures, r, ranks);
      for (int p = of_pressures.begin; p < of_pressures.end; ++p)
        numbers_[pattern.displacements() + p] = next++;
      if (r == parallel::rank()) {
        mine_ = {begin, next};
        first_pressure_ = next - (of_pressures.end - of_pressures.begin);
      }
    }
  }

  [[nodiscard]] PetscInt operator[](int unknown) const { return numbers_[unknown]; }
  [[nodiscard]] PetscInt begin() const { return mine_.begin; }
  [[nodiscard]] PetscInt end() const { return mine_.end; }
  [[nodiscard]] PetscInt first_pressure() const { return first_pressure_; }  ///< of this rank's

 private:
  parallel::Range mine_;  ///< of this rank
  PetscInt first_pressure_ = 0;
  std::vector<PetscInt> numbers_;
};

/// How the blocks are solved; PETSc makes their solvers anew with every matrix, from these options.
/// Jacobi, Gauss-Seidel or ILU(0) as smoothers do not converge: the springs of the base hold one
/// direction, which is not along an axis, and leave another free. On several ranks each factorises
/// its own block, in which zero pivots occur: these are shifted.
constexpr const char* block_options =
    "-lv_fieldsplit_u_ksp_type preonly -lv_fieldsplit_u_pc_type gamg "
    "-lv_fieldsplit_u_pc_gamg_threshold 0.02 "
    "-lv_fieldsplit_u_mg_levels_pc_type bjacobi -lv_fieldsplit_u_mg_levels_sub_pc_type ilu "
    "-lv_fieldsplit_u_mg_levels_sub_pc_factor_levels 1 "
    "-lv_fieldsplit_u_mg_levels_sub_pc_factor_shift_type nonzero "
    "-lv_fieldsplit_p_ksp_type preonly -lv_fieldsplit_p_pc_type bjacobi";

/// Numbers of entries of each of this rank's rows, in its own columns and in the others'.
struct RowLengths {
  std::vector<PetscInt> own, other;
};

/// Counts each (row, column) that some group joins once.
RowLengths row_lengths(const Pattern& pattern, const Numbering& numbers) {
  const PetscInt begin = numbers.begin();
  const PetscInt end = numbers.end();
  std::vector<std::vector<int>> groups_of_row(end - begin);
  for (int g = 0; g < static_cast<int>(pattern.groups.size()); ++g)
    for (const int unknown : pattern.groups[g])
      if (numbers[unknown] >= begin && numbers[unknown] < end)
        groups_of_row[numbers[unknown] - begin].push_back(g);
  RowLengths lengths{std::vector<PetscInt>(end - begin), std::vector<PetscInt>(end - begin)};
  std::vector<PetscInt> columns;
  for (PetscInt row = 0; row < end - begin; ++row) {
    columns.clear();
    for (const int g : groups_of_row[row])
      for (const int unknown : pattern.groups[g])
        columns.push_back(numbers[unknown]);
    std::sort(columns.begin(), columns.end());
    columns.erase(std::unique(columns.begin(), columns.end()), columns.end());
    for (const PetscInt column : columns)
      ++(column >= begin && column < end ? lengths.own : lengths.other)[row];
  }
  return lengths;
}

}  // namespace

class SparseMatrix::Implementation {
 public:
  Implementation(const Pattern& pattern, const LinearParameters& parameters,
                 std::span<const Vec3> nodes)
      : parameters_(parameters), displacements_(pattern.displacements()), numbers_(pattern) {
    start_petsc();
    make_matrix(pattern);
    check(MatCreateVecs(K_, &x_, &b_));
    check(VecScatterCreateToAll(x_, &to_all_, &everything_));
    check(KSPCreate(PETSC_COMM_WORLD, &ksp_));
    check(KSPSetOperators(ksp_, K_, K_));
    if (parameters.method == LinearMethod::direct) {
      configure_direct();
    } else {
      make_pressure_mass(pattern);
      configure_iterative(nodes);
    }
  }
  ~Implementation() {
    KSPDestroy(&ksp_);
    MatDestroy(&S_);
    VecScatterDestroy(&to_all_);
    VecDestroy(&everything_);
    VecDestroy(&x_);
    VecDestroy(&b_);
    MatDestroy(&K_);
  }
  Implementation(const Implementation&) = delete;
  Implementation& operator=(const Implementation&) = delete;

  void set_zero() {
    check(MatZeroEntries(K_));
    if (S_ != nullptr)
      check(MatZeroEntries(S_));
  }

  void add(std::span<const int> unknowns, const Eigen::MatrixXd& block) {
    at_.clear();
    for (const int u : unknowns)
      at_.push_back(numbers_[u]);
    insert(block, K_);
  }

  void add_pressure_mass(std::span<const int> pressures, const Eigen::MatrixXd& block) {
    if (S_ == nullptr)
      return;
    at_.clear();
    for (const int p : pressures)
      at_.push_back(p - displacements_);  // ranks hold runs of pressures: no other numbers
    insert(-block, S_);
  }

  void finish() {
    for (Mat matrix : {K_, S_}) {
      if (matrix == nullptr)
        continue;
      check(MatAssemblyBegin(matrix, MAT_FINAL_ASSEMBLY));
      check(MatAssemblyEnd(matrix, MAT_FINAL_ASSEMBLY));
    }
    check(KSPSetOperators(ksp_, K_, K_));
  }

  std::vector<double> solve(std::span<const double> b) {
    set_right_hand_side(b);
    check(KSPSolve(ksp_, b_, x_));
    KSPConvergedReason reason{};
    check(KSPGetConvergedReason(ksp_, &reason));
    if (reason < 0 && parameters_.method == LinearMethod::iterative)
      throw NoConvergence(
          fmt::format("GMRES does not solve the linear equations ({}); "
                      "quasi_static.linear_solver = \"direct\" would",
                      KSPConvergedReasons[reason]));
    if (reason < 0)
      throw RunError(
          fmt::format("The linear equations could not be solved ({})", KSPConvergedReasons[reason]),
          "A wall that nothing holds is the usual reason: look at the base");
    check(VecScatterBegin(to_all_, x_, everything_, INSERT_VALUES, SCATTER_FORWARD));
    check(VecScatterEnd(to_all_, x_, everything_, INSERT_VALUES, SCATTER_FORWARD));
    const PetscScalar* values = nullptr;
    check(VecGetArrayRead(everything_, &values));
    std::vector<double> x(b.size());
    for (std::size_t u = 0; u < x.size(); ++u)
      x[u] = values[numbers_[static_cast<int>(u)]];
    check(VecRestoreArrayRead(everything_, &values));
    return x;
  }

 private:
  void insert(const Eigen::MatrixXd& block, Mat to) {
    const auto n = static_cast<PetscInt>(at_.size());
    row_major_ = block;
    check(MatSetValues(to, n, at_.data(), n, at_.data(), row_major_.data(), ADD_VALUES));
  }

  void set_right_hand_side(std::span<const double> b) {
    PetscScalar* mine = nullptr;
    check(VecGetArray(b_, &mine));
    for (std::size_t u = 0; u < b.size(); ++u) {
      const PetscInt number = numbers_[static_cast<int>(u)];
      if (number >= numbers_.begin() && number < numbers_.end())
        mine[number - numbers_.begin()] = b[u];
    }
    check(VecRestoreArray(b_, &mine));
  }

  void make_matrix(const Pattern& pattern) {
    const PetscInt local = numbers_.end() - numbers_.begin();
    check(MatCreate(PETSC_COMM_WORLD, &K_));
    check(MatSetSizes(K_, local, local, pattern.size(), pattern.size()));
    check(MatSetType(K_, MATAIJ));
    const RowLengths lengths = row_lengths(pattern, numbers_);
    check(MatSeqAIJSetPreallocation(K_, 0, lengths.own.data()));
    check(MatMPIAIJSetPreallocation(K_, 0, lengths.own.data(), 0, lengths.other.data()));
  }

  void make_pressure_mass(const Pattern& pattern) {
    const PetscInt local = numbers_.end() - numbers_.first_pressure();
    check(MatCreate(PETSC_COMM_WORLD, &S_));
    check(MatSetSizes(S_, local, local, pattern.pressures, pattern.pressures));
    check(MatSetType(S_, MATAIJ));
    check(MatSetUp(S_));
    check(MatSetOption(S_, MAT_NEW_NONZERO_ALLOCATION_ERR, PETSC_FALSE));
  }

  void configure_iterative(std::span<const Vec3> nodes) {
    check(KSPSetOptionsPrefix(ksp_, "lv_"));
    check(KSPSetType(ksp_, KSPFGMRES));
    check(KSPGMRESSetRestart(ksp_, 100));
    check(KSPSetTolerances(ksp_, parameters_.tolerance, PETSC_DEFAULT, PETSC_DEFAULT,
                           parameters_.iterations));
    PC pc = nullptr;
    check(KSPGetPC(ksp_, &pc));
    check(PCSetType(pc, PCFIELDSPLIT));
    const PetscInt displacements = numbers_.first_pressure() - numbers_.begin();
    IS of_displacements = nullptr, of_pressures = nullptr;
    check(ISCreateStride(PETSC_COMM_WORLD, displacements, numbers_.begin(), 1, &of_displacements));
    check(ISSetBlockSize(of_displacements, 3));
    check(ISCreateStride(PETSC_COMM_WORLD, numbers_.end() - numbers_.first_pressure(),
                         numbers_.first_pressure(), 1, &of_pressures));
    MatNullSpace rigid = rigid_motions(nodes, displacements);
    check(PetscObjectCompose(reinterpret_cast<PetscObject>(of_displacements), "nearnullspace",
                             reinterpret_cast<PetscObject>(rigid)));
    check(PCFieldSplitSetIS(pc, "u", of_displacements));
    check(PCFieldSplitSetIS(pc, "p", of_pressures));
    check(PCFieldSplitSetType(pc, PC_COMPOSITE_SCHUR));
    check(PCFieldSplitSetSchurFactType(pc, PC_FIELDSPLIT_SCHUR_FACT_UPPER));
    check(PCFieldSplitSetSchurPre(pc, PC_FIELDSPLIT_SCHUR_PRE_USER, S_));
    check(PetscOptionsInsertString(nullptr, block_options));
    check(KSPSetFromOptions(ksp_));
    check(MatNullSpaceDestroy(&rigid));
    check(ISDestroy(&of_displacements));
    check(ISDestroy(&of_pressures));
  }

  static MatNullSpace rigid_motions(std::span<const Vec3> nodes, PetscInt local) {
    Vec places = nullptr;
    check(VecCreate(PETSC_COMM_WORLD, &places));
    check(VecSetSizes(places, local, PETSC_DETERMINE));
    check(VecSetBlockSize(places, 3));
    check(VecSetUp(places));
    PetscInt begin = 0;
    check(VecGetOwnershipRange(places, &begin, nullptr));
    PetscScalar* values = nullptr;
    check(VecGetArray(places, &values));
    for (PetscInt i = 0; i < local; ++i)
      values[i] = nodes[(begin + i) / 3][(begin + i) % 3];
    check(VecRestoreArray(places, &values));
    MatNullSpace rigid = nullptr;
    check(MatNullSpaceCreateRigidBody(places, &rigid));
    check(VecDestroy(&places));
    return rigid;
  }

  void configure_direct() {
    check(KSPSetType(ksp_, KSPPREONLY));
    PC pc = nullptr;
    check(KSPGetPC(ksp_, &pc));
    check(PCSetType(pc, PCLU));
    check(PCFactorSetMatSolverType(pc, MATSOLVERMUMPS));
    check(PCFactorSetUpMatSolverType(pc));
    Mat factor = nullptr;
    check(PCFactorGetMatrix(pc, &factor));
    check(MatMumpsSetIcntl(factor, 14, 60));  // room for pivots that move, in per cent
  }

  LinearParameters parameters_;
  int displacements_;
  Numbering numbers_;
  Mat K_ = nullptr, S_ = nullptr;
  KSP ksp_ = nullptr;
  Vec x_ = nullptr, b_ = nullptr, everything_ = nullptr;
  VecScatter to_all_ = nullptr;
  std::vector<PetscInt> at_;
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> row_major_;
};

SparseMatrix::SparseMatrix(const Pattern& pattern, const LinearParameters& parameters,
                           std::span<const Vec3> nodes)
    : implementation_(std::make_unique<Implementation>(pattern, parameters, nodes)) {}
SparseMatrix::~SparseMatrix() = default;
SparseMatrix::SparseMatrix(SparseMatrix&&) noexcept = default;
SparseMatrix& SparseMatrix::operator=(SparseMatrix&&) noexcept = default;

void SparseMatrix::set_zero() {
  implementation_->set_zero();
}

void SparseMatrix::add(std::span<const int> unknowns, const Eigen::MatrixXd& block) {
  implementation_->add(unknowns, block);
}

void SparseMatrix::add_pressure_mass(std::span<const int> pressures, const Eigen::MatrixXd& block) {
  implementation_->add_pressure_mass(pressures, block);
}

void SparseMatrix::finish() {
  implementation_->finish();
}

std::vector<double> SparseMatrix::solve(std::span<const double> b) {
  return implementation_->solve(b);
}

}  // namespace lv::quasi_static
