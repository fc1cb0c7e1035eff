#pragma once

#include "lv/mesh/mesh.hpp"

namespace lv::verify {

/// A closed spherical shell of hexahedra about the origin: each of the six faces of a cube is cut
/// into `around` x `around` squares of equal angles, projected on the sphere, and extended through
/// `layers` of equal thickness. Inner side: endo; outer side: epi; no base.
[[nodiscard]] mesh::Mesh spherical_shell(double inner_radius, double outer_radius, int around,
                                         int layers);

}  // namespace lv::verify
