#include "lv/bench/bare_transforms.hpp"

#include "lv/base/parallel.hpp"
#include "lv/bench/stopwatch.hpp"

#include <fftw3-mpi.h>

#include <array>
#include <vector>

namespace lv::bench {
namespace {

/// The forward and the inverse plan of one velocity component, in place. z is the slowest axis, as
/// in the program's fields; with one rank the plans are FFTW's serial ones.
class ComponentPlans {
 public:
  ComponentPlans(const fluid::Grid& grid, int component) {
    std::array<ptrdiff_t, 3> n{};
    std::array<fftw_r2r_kind, 3> forward{};
    std::array<fftw_r2r_kind, 3> inverse{};
    for (int d = 0; d < 3; ++d) {  // FFTW counts axes from the slowest
      n[d] = grid.points(component, 2 - d);
      forward[d] = component == 2 - d ? FFTW_REDFT00 : FFTW_RODFT10;
      inverse[d] = component == 2 - d ? FFTW_REDFT00 : FFTW_RODFT01;
    }
    if (parallel::size() == 1)
      plan_serial(n, forward, inverse);
    else
      plan_parallel(n, forward, inverse);
  }
  ~ComponentPlans() {
    fftw_destroy_plan(forward_);
    fftw_destroy_plan(inverse_);
  }
  ComponentPlans(const ComponentPlans&) = delete;
  ComponentPlans& operator=(const ComponentPlans&) = delete;

  void forward() const { fftw_execute(forward_); }
  void inverse() const { fftw_execute(inverse_); }

 private:
  void plan_serial(const std::array<ptrdiff_t, 3>& n, const std::array<fftw_r2r_kind, 3>& forward,
                   const std::array<fftw_r2r_kind, 3>& inverse) {
    values_.assign(static_cast<std::size_t>(n[0] * n[1] * n[2]), 0.0);
    const auto plan = [&](const std::array<fftw_r2r_kind, 3>& kind) {
      return fftw_plan_r2r_3d(static_cast<int>(n[0]), static_cast<int>(n[1]),
                              static_cast<int>(n[2]), values_.data(), values_.data(), kind[0],
                              kind[1], kind[2], FFTW_ESTIMATE);
    };
    forward_ = plan(forward);
    inverse_ = plan(inverse);
  }

  void plan_parallel(const std::array<ptrdiff_t, 3>& n, const std::array<fftw_r2r_kind, 3>& forward,
                     const std::array<fftw_r2r_kind, 3>& inverse) {
    std::array<ptrdiff_t, 4> local{};
    const ptrdiff_t size = fftw_mpi_local_size_3d_transposed(
        n[0], n[1], n[2], MPI_COMM_WORLD, &local[0], &local[1], &local[2], &local[3]);
    values_.assign(static_cast<std::size_t>(size), 0.0);
    forward_ = fftw_mpi_plan_r2r_3d(n[0], n[1], n[2], values_.data(), values_.data(),
                                    MPI_COMM_WORLD, forward[0], forward[1], forward[2],
                                    FFTW_ESTIMATE | FFTW_MPI_TRANSPOSED_OUT);
    inverse_ = fftw_mpi_plan_r2r_3d(n[0], n[1], n[2], values_.data(), values_.data(),
                                    MPI_COMM_WORLD, inverse[0], inverse[1], inverse[2],
                                    FFTW_ESTIMATE | FFTW_MPI_TRANSPOSED_IN);
  }

  std::vector<double> values_;
  fftw_plan forward_ = nullptr;
  fftw_plan inverse_ = nullptr;
};

}  // namespace

double bare_transforms(const fluid::Grid& grid) {
  fftw_mpi_init();
  const std::array<ComponentPlans, 3> plans{ComponentPlans(grid, 0), ComponentPlans(grid, 1),
                                            ComponentPlans(grid, 2)};
  return median_seconds([&] {
    for (const ComponentPlans& p : plans)
      p.forward();
    for (const ComponentPlans& p : plans)
      p.inverse();
  });
}

}  // namespace lv::bench
