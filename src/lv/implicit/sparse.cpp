#include "lv/implicit/sparse.hpp"

#include "lv/base/check.hpp"
#include "lv/implicit/block_preconditioner.hpp"
#include "lv/implicit/direct_solver.hpp"
#include "lv/implicit/linear_work.hpp"
#include "lv/implicit/petsc.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace lv::implicit {
namespace {

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

// in tangents, on walls of 81 to 500 quadratic elements
constexpr double work_of_solution = 0.06;
constexpr double work_of_pattern = 0.6;  // of a new matrix, and of its order of unknowns

double& work() {
  static double done = 0.0;
  return done;
}

}  // namespace

double linear_work() {
  return work();
}

class SparseMatrix::Implementation {
 public:
  Implementation(const Pattern& pattern, const LinearParameters& parameters,
                 std::span<const Vec3> nodes)
      : parameters_(parameters), displacements_(pattern.displacements()), numbers_(pattern) {
    start_petsc();
    make_matrix(pattern);
    if (parameters.method == LinearMethod::direct) {
      direct_.emplace(K_);
      return;
    }
    LV_CHECK(!pattern.corners.empty());  // linear elements are refused with the case
    check(MatCreateVecs(K_, &x_, &b_));
    check(VecScatterCreateToAll(x_, &to_all_, &everything_));
    configure_iterative();
    blocks_.emplace(ksp_, pattern, numbers_, nodes);
    check(KSPSetFromOptions(ksp_));
  }
  ~Implementation() {
    KSPDestroy(&ksp_);
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
    if (blocks_)
      blocks_->set_zero();
  }

  void add(std::span<const int> unknowns, const Eigen::MatrixXd& block) {
    at_.clear();
    for (const int u : unknowns)
      at_.push_back(numbers_[u]);
    const auto n = static_cast<PetscInt>(at_.size());
    row_major_ = block;
    check(MatSetValues(K_, n, at_.data(), n, at_.data(), row_major_.data(), ADD_VALUES));
  }

  void add_pressure_mass(std::span<const int> pressures, const Eigen::MatrixXd& block) {
    if (!blocks_)
      return;
    at_.clear();
    for (const int p : pressures)
      at_.push_back(numbers_.pressures()[p - displacements_]);
    blocks_->add_pressure_mass(at_, block);
  }

  void finish() {
    check(MatAssemblyBegin(K_, MAT_FINAL_ASSEMBLY));
    check(MatAssemblyEnd(K_, MAT_FINAL_ASSEMBLY));
    work() += 1.0;
    if (direct_) {
      direct_->update();
      return;
    }
    check(KSPSetOperators(ksp_, K_, K_));
    blocks_->update();
  }

  [[nodiscard]] int iterations() const {
    PetscInt count = 0;
    if (blocks_)
      check(KSPGetIterationNumber(ksp_, &count));
    return count;
  }

  void begin_anew() {
    if (direct_)
      direct_->forget_factors();
  }

  Outcome<std::vector<double>> solve(std::span<const double> b) {
    work() += work_of_solution;
    std::vector<double> numbered(b.size());
    for (std::size_t u = 0; u < b.size(); ++u)
      numbered[numbers_[static_cast<int>(u)]] = b[u];
    const auto found = direct_ ? direct_->solve(numbered) : iterate(numbered);
    if (!found)
      return found.why();
    std::vector<double> x(b.size());
    for (std::size_t u = 0; u < x.size(); ++u)
      x[u] = (*found)[numbers_[static_cast<int>(u)]];
    return x;
  }

 private:
  /// b and x in the matrix's order, complete on every rank.
  Outcome<std::vector<double>> iterate(std::span<const double> b) {
    PetscScalar* mine = nullptr;
    check(VecGetArray(b_, &mine));
    std::copy(b.begin() + numbers_.begin(), b.begin() + numbers_.end(), mine);
    check(VecRestoreArray(b_, &mine));
    check(KSPSolve(ksp_, b_, x_));
    KSPConvergedReason reason{};
    check(KSPGetConvergedReason(ksp_, &reason));
    if (reason < 0)
      return Unsolved{fmt::format("GMRES does not solve the linear equations ({})",
                                  KSPConvergedReasons[reason]),
                      "Set quasi_static.linear_solver = \"direct\""};
    check(VecScatterBegin(to_all_, x_, everything_, INSERT_VALUES, SCATTER_FORWARD));
    check(VecScatterEnd(to_all_, x_, everything_, INSERT_VALUES, SCATTER_FORWARD));
    const PetscScalar* values = nullptr;
    check(VecGetArrayRead(everything_, &values));
    std::vector<double> x(values, values + b.size());
    check(VecRestoreArrayRead(everything_, &values));
    return x;
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

  void configure_iterative() {
    check(KSPCreate(PETSC_COMM_WORLD, &ksp_));
    check(KSPSetOperators(ksp_, K_, K_));
    check(KSPSetOptionsPrefix(ksp_, "lv_"));
    check(KSPSetType(ksp_, KSPFGMRES));
    check(KSPGMRESSetRestart(ksp_, 100));
    check(KSPSetTolerances(ksp_, parameters_.tolerance, PETSC_DEFAULT, PETSC_DEFAULT,
                           parameters_.iterations));
  }

  LinearParameters parameters_;
  int displacements_;
  Numbering numbers_;
  Mat K_ = nullptr;
  std::optional<DirectSolver> direct_;  ///< or, of the iterative method, what follows
  KSP ksp_ = nullptr;
  std::optional<BlockPreconditioner> blocks_;
  Vec x_ = nullptr, b_ = nullptr, everything_ = nullptr;
  VecScatter to_all_ = nullptr;
  std::vector<PetscInt> at_;
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> row_major_;
};

SparseMatrix::SparseMatrix(const Pattern& pattern, const LinearParameters& parameters,
                           std::span<const Vec3> nodes)
    : implementation_(std::make_unique<Implementation>(pattern, parameters, nodes)) {
  work() += work_of_pattern;
}
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

void SparseMatrix::forget_factors() {
  implementation_->begin_anew();
}

int SparseMatrix::iterations() const {
  return implementation_->iterations();
}

Outcome<std::vector<double>> SparseMatrix::solve(std::span<const double> b) {
  return implementation_->solve(b);
}

}  // namespace lv::implicit
