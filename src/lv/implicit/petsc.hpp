#pragma once

#include <petscksp.h>

/// PETSc's headers are included by the sources that name it alone.
namespace lv::implicit {

/// Throws RunError with PETSc's text unless the code is 0.
void check(PetscErrorCode code);

/// Starts PETSc when it is first needed. It stays until the program ends: once finished and started
/// again, it no longer knows all of its types.
void start_petsc();

}  // namespace lv::implicit
