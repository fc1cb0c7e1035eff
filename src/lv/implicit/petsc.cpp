#include "lv/implicit/petsc.hpp"

#include "lv/base/check.hpp"

#include <fmt/format.h>

namespace lv::implicit {

void check(PetscErrorCode code) {
  if (code == 0)
    return;
  const char* text = nullptr;
  PetscErrorMessage(code, &text, nullptr);
  throw RunError(fmt::format("PETSc failed: {}", text == nullptr ? "unknown error" : text),
                 "Not enough memory is the usual reason: take a coarser mesh or more machines");
}

void start_petsc() {
  PetscBool started = PETSC_FALSE;
  check(PetscInitialized(&started));
  if (started)
    return;
  check(PetscOptionsSetValue(nullptr, "-no_signal_handler", "true"));  // interrupts are ours
  check(PetscInitializeNoArguments());
  check(PetscPushErrorHandler(PetscReturnErrorHandler, nullptr));
}

}  // namespace lv::implicit
