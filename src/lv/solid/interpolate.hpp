#pragma once

#include "lv/mesh/mesh.hpp"

#include <span>
#include <vector>

namespace lv::solid {

/// A field with values at the nodes of a mesh, at points of the wall: sum_a phi_a(xi) value_a in
/// the element that holds the point. A point that lies a little outside all elements, as a finer
/// mesh's nodes do where the wall is curved, takes the nearest element's polynomial. Throws
/// RunError for a point farther off than a quarter of an element.
[[nodiscard]] std::vector<Vec3> interpolate(const mesh::Mesh& mesh, std::span<const Vec3> values,
                                            std::span<const Vec3> points);

}  // namespace lv::solid
