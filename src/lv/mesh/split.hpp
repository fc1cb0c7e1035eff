#pragma once

#include "lv/mesh/mesh.hpp"

namespace lv::mesh {

/// Every hexahedron cut into six tetrahedra on the same nodes. Each face is cut by the diagonal
/// from its node of smallest number, so neighbours agree (Dompierre et al., Proc. 8th Int. Meshing
/// Roundtable, 1999).
[[nodiscard]] Mesh split_into_tetrahedra(const Mesh& hexahedra);

}  // namespace lv::mesh
