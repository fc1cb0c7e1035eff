#pragma once

#include "lv/mesh/mesh.hpp"
#include "lv/mesh/parameters.hpp"

#include <functional>

namespace lv::mesh {

/// The wall as a map from (u, theta, t) to space: u from the apex (0) to the base plane (1), theta
/// about the long axis, t from the endocardium (0) to the epicardium (1).
using WallMap = std::function<Vec3(double u, double theta, double t)>;

/// An all-hexahedral mesh of the wall without collapsed elements.
///
/// The wall's middle surface is mapped conformally to a sphere with the apex at the pole; one face
/// of a cube, projected on the sphere, gives a regular square patch around the apex whose corners
/// meet the four remaining blocks at 120 degrees, and these run from the patch to the base along
/// meridians.
[[nodiscard]] Mesh wall_mesh(const WallMap& wall, const WallMeshParameters& parameters);

}  // namespace lv::mesh
