#pragma once

#include "lv/mesh_io/foreign_mesh.hpp"

namespace lv::mesh_io {

/// Makes the directions of fibres and sheets that a file brings unit vectors, the sheets' normal to
/// the fibres', and notes what was changed by more than rounding. Throws InputError, naming the
/// place, for directions that are zero, no numbers, or along each other.
void make_orthonormal(ForeignMesh& foreign);

}  // namespace lv::mesh_io
