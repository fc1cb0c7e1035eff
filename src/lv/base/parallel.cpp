#include "lv/base/parallel.hpp"

#include "lv/base/check.hpp"
#include "lv/base/interrupt.hpp"
#include "lv/base/launch.hpp"

#include <dlfcn.h>
#include <mpi.h>

#include <exception>

namespace lv::parallel {
namespace {

double reduce(double value, MPI_Op op) {
  double result = 0.0;
  MPI_Allreduce(&value, &result, 1, MPI_DOUBLE, op, MPI_COMM_WORLD);
  return result;
}

/// Every rank's count on every rank, and where its piece begins in rank order.
struct Layout {
  std::vector<int> counts;
  std::vector<int> begins;
  int total = 0;
};

Layout layout_of(std::size_t count) {
  Layout layout;
  layout.counts.resize(size());
  const int mine = static_cast<int>(count);
  MPI_Allgather(&mine, 1, MPI_INT, layout.counts.data(), 1, MPI_INT, MPI_COMM_WORLD);
  for (const int n : layout.counts) {
    layout.begins.push_back(layout.total);
    layout.total += n;
  }
  return layout;
}

/// One thread of BLAS: with more, sums take another order on every number of processors, and a run
/// that goes on elsewhere would end with other bits (docs/verification.md has what that costs).
/// Other libraries than OpenBLAS have no such function.
void keep_blas_to_one_thread() {
  using SetThreads = void (*)(int);
  if (const auto set =
          reinterpret_cast<SetThreads>(dlsym(RTLD_DEFAULT, "openblas_set_num_threads")))
    set(1);
}

}  // namespace

Session::Session(int* argc, char*** argv) {
  keep_blas_to_one_thread();
  launch::prepare();
  MPI_Init(argc, argv);
}
Session::~Session() {
  // a rank that fails alone must not wait here for the others: whoever reports the failure ends
  // them
  if (std::uncaught_exceptions() == 0)
    MPI_Finalize();
}

int rank() {
  int value = 0;
  int running = 0;
  MPI_Initialized(&running);
  if (running != 0)
    MPI_Comm_rank(MPI_COMM_WORLD, &value);
  return value;
}

int size() {
  int value = 1;
  MPI_Comm_size(MPI_COMM_WORLD, &value);
  return value;
}

void on_root(const std::function<void()>& work) {
  std::exception_ptr failure;
  bool stopped = false;
  if (is_root()) {
    try {
      work();
    } catch (const Interrupted&) {
      failure = std::current_exception();
      stopped = true;
    } catch (...) {
      failure = std::current_exception();
    }
  }
  if (!any(failure != nullptr))
    return;
  stopped = any(stopped);
  if (failure)
    std::rethrow_exception(failure);
  if (stopped)
    throw Interrupted("stopped");
  throw FailedElsewhere();
}

bool root_says(bool value) {
  return any(is_root() && value);
}

void barrier() {
  MPI_Barrier(MPI_COMM_WORLD);
}

double sum(double value) {
  return reduce(value, MPI_SUM);
}
double max(double value) {
  return reduce(value, MPI_MAX);
}
double min(double value) {
  return reduce(value, MPI_MIN);
}
bool any(bool value) {
  return reduce(value ? 1.0 : 0.0, MPI_MAX) > 0.0;
}

void sum(std::span<double> values) {
  if (size() > 1)
    MPI_Allreduce(MPI_IN_PLACE, values.data(), static_cast<int>(values.size()), MPI_DOUBLE, MPI_SUM,
                  MPI_COMM_WORLD);
}

void broadcast(std::span<double> values) {
  MPI_Bcast(values.data(), static_cast<int>(values.size()), MPI_DOUBLE, 0, MPI_COMM_WORLD);
}

void broadcast(std::string& text) {
  int length = static_cast<int>(text.size());
  MPI_Bcast(&length, 1, MPI_INT, 0, MPI_COMM_WORLD);
  text.resize(length);
  MPI_Bcast(text.data(), length, MPI_CHAR, 0, MPI_COMM_WORLD);
}

std::vector<double> gather(std::span<const double> piece) {
  const Layout layout = layout_of(piece.size());
  std::vector<double> all(is_root() ? layout.total : 0);
  MPI_Gatherv(piece.data(), static_cast<int>(piece.size()), MPI_DOUBLE, all.data(),
              layout.counts.data(), layout.begins.data(), MPI_DOUBLE, 0, MPI_COMM_WORLD);
  return all;
}

std::vector<double> scatter(std::span<const double> all, std::size_t count) {
  const Layout layout = layout_of(count);
  LV_CHECK(!is_root() || static_cast<int>(all.size()) == layout.total);
  std::vector<double> piece(count);
  MPI_Scatterv(all.data(), layout.counts.data(), layout.begins.data(), MPI_DOUBLE, piece.data(),
               static_cast<int>(count), MPI_DOUBLE, 0, MPI_COMM_WORLD);
  return piece;
}

Range share(int n, int rank, int ranks) {
  const auto cut = [&](int r) {
    return static_cast<int>(static_cast<std::int64_t>(n) * r / ranks);
  };
  return {cut(rank), cut(rank + 1)};
}

}  // namespace lv::parallel
