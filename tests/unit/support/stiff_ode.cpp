#include "support/stiff_ode.hpp"

#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include <memory>
#include <stdexcept>
#include <string>

namespace lv::test {
namespace {

void require(int flag, const char* what) {
  if (flag < 0)
    throw std::runtime_error(std::string(what) + " failed with " + std::to_string(flag));
}

std::span<double> values(N_Vector v) {
  return {N_VGetArrayPointer(v), static_cast<std::size_t>(N_VGetLength(v))};
}

int evaluate(double t, N_Vector y, N_Vector rate, void* user) {
  (*static_cast<const OdeRate*>(user))(t, values(y), values(rate));
  return 0;
}

struct FreeContext {
  void operator()(SUNContext context) const { SUNContext_Free(&context); }
};
struct FreeMemory {
  void operator()(void* memory) const { CVodeFree(&memory); }
};
template <class Object, auto Free>
using Owned = std::unique_ptr<Object, decltype([](Object* object) { Free(object); })>;

}  // namespace

std::vector<std::vector<double>> solve_stiff_ode(const OdeRate& rate, std::vector<double> start,
                                                 std::span<const double> times, double tolerance) {
  SUNContext created = nullptr;
  require(SUNContext_Create(nullptr, &created), "SUNContext_Create");
  const std::unique_ptr<std::remove_pointer_t<SUNContext>, FreeContext> context(created);
  const auto n = static_cast<sunindextype>(start.size());
  const Owned<std::remove_pointer_t<N_Vector>, N_VDestroy> y(
      N_VMake_Serial(n, start.data(), created));
  const Owned<std::remove_pointer_t<SUNMatrix>, SUNMatDestroy> matrix(
      SUNDenseMatrix(n, n, created));
  const Owned<std::remove_pointer_t<SUNLinearSolver>, SUNLinSolFree> solver(
      SUNLinSol_Dense(y.get(), matrix.get(), created));
  const std::unique_ptr<void, FreeMemory> cvode(CVodeCreate(CV_BDF, created));

  OdeRate user = rate;
  require(CVodeInit(cvode.get(), evaluate, 0.0, y.get()), "CVodeInit");
  require(CVodeSetUserData(cvode.get(), &user), "CVodeSetUserData");
  require(CVodeSStolerances(cvode.get(), tolerance, tolerance), "CVodeSStolerances");
  require(CVodeSetLinearSolver(cvode.get(), solver.get(), matrix.get()), "CVodeSetLinearSolver");
  require(CVodeSetMaxNumSteps(cvode.get(), 1000000), "CVodeSetMaxNumSteps");

  std::vector<std::vector<double>> result;
  for (const double time : times) {
    double reached = 0.0;
    require(CVode(cvode.get(), time, y.get(), &reached, CV_NORMAL), "CVode");
    const auto now = values(y.get());
    result.emplace_back(now.begin(), now.end());
  }
  return result;
}

}  // namespace lv::test
