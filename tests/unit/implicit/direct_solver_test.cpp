#include "lv/implicit/direct_solver.hpp"

#include <catch2/catch.hpp>

#include <array>

namespace {

using namespace lv;
using implicit::DirectSolver;

/// A square matrix of PETSc's with at most three entries in a row.
class Matrix {
 public:
  explicit Matrix(PetscInt size) : size_(size) {
    implicit::start_petsc();
    implicit::check(MatCreateSeqAIJ(PETSC_COMM_SELF, size, size, 3, nullptr, &matrix_));
  }
  ~Matrix() { MatDestroy(&matrix_); }
  Matrix(const Matrix&) = delete;
  Matrix& operator=(const Matrix&) = delete;

  /// Springs between joints in a row, which are held at both ends: stiffness times -1 2 -1.
  void chain(double stiffness) {
    for (PetscInt i = 0; i < size_; ++i) {
      set(i, i, 2.0 * stiffness);
      if (i > 0)
        set(i, i - 1, -stiffness);
      if (i + 1 < size_)
        set(i, i + 1, -stiffness);
    }
    finish();
  }

  /// A joint that is held, and others that nothing holds.
  void first_joint_alone() {
    chain(0.0);
    set(0, 0, 1.0);
    finish();
  }

  [[nodiscard]] Mat get() const { return matrix_; }

 private:
  void set(PetscInt row, PetscInt column, double value) {
    implicit::check(MatSetValue(matrix_, row, column, value, INSERT_VALUES));
  }

  void finish() {
    implicit::check(MatAssemblyBegin(matrix_, MAT_FINAL_ASSEMBLY));
    implicit::check(MatAssemblyEnd(matrix_, MAT_FINAL_ASSEMBLY));
  }

  PetscInt size_;
  Mat matrix_ = nullptr;
};

/// A chain of n joints under one load each hangs through as i (n + 1 - i)/2.
void check_solution(DirectSolver& solver, int n, double stiffness) {
  const auto x = solver.solve(std::vector<double>(n, 1.0)).value();
  REQUIRE(x.size() == static_cast<std::size_t>(n));
  for (int i = 1; i <= n; ++i)
    CHECK(x[i - 1] == Approx(0.5 * i * (n + 1 - i) / stiffness).epsilon(1e-12));
}

}  // namespace

TEST_CASE("the direct solver solves a chain of springs, and again when they have changed",
          "[unit][implicit]") {
  constexpr int n = 12;
  Matrix chain(n);
  chain.chain(1.0);
  DirectSolver solver(chain.get());
  solver.update();
  check_solution(solver, n, 1.0);
  chain.chain(4.0);
  solver.update();
  check_solution(solver, n, 4.0);
  solver.forget_factors();
  solver.update();
  check_solution(solver, n, 4.0);
}

TEST_CASE("joints that nothing holds are singular, and the next one is solved all the same",
          "[unit][implicit]") {
  constexpr int n = 6;
  Matrix chain(n);
  chain.first_joint_alone();
  DirectSolver solver(chain.get());
  solver.update();
  const auto x = solver.solve(std::vector<double>(n, 1.0));
  REQUIRE(!x);
  CHECK_THAT(x.why().what, Catch::Matchers::Contains("singular"));
  chain.chain(2.0);
  solver.update();
  check_solution(solver, n, 2.0);
}
