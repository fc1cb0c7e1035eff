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
                 code == PETSC_ERR_MEM || code == PETSC_ERR_LIB
                     ? "Memory did not suffice, as it seems: take a coarser mesh or more machines"
                     : "This is a defect of the program: please report it with its case file");
}

void start_petsc() {
  PetscBool started = PETSC_FALSE;
  check(PetscInitialized(&started));
  if (started)
    return;
  check(PetscOptionsSetValue(nullptr, "-no_signal_handler", "true"));  // interrupts are ours
  // entries of a matrix that come from other ranks are added in the order of the ranks, not of
  // their arrival: every run then has the same bits
  check(PetscOptionsSetValue(nullptr, "-matstash_legacy", "true"));
  check(PetscOptionsSetValue(nullptr, "-matstash_reproduce", "true"));
  check(PetscInitializeNoArguments());
  check(PetscPushErrorHandler(PetscReturnErrorHandler, nullptr));
}

}  // namespace lv::implicit
