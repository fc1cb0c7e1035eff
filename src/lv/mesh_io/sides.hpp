#pragma once

#include "lv/mesh/plane.hpp"
#include "lv/mesh_io/foreign_mesh.hpp"

#include <array>

/// The sides of a wall that was read from a file.
namespace lv::mesh_io {

/// Endocardium, epicardium and base, in this order: together the whole boundary of the wall.
using Sides = std::array<mesh::Surface, 3>;

/// The sides as the file tags them. Throws InputError for tagged faces inside the wall or in two
/// sides, and for boundary faces in none.
[[nodiscard]] Sides tagged_sides(const ForeignMesh& foreign);

/// The sides of a wall without tags: the base is the largest flat part of the boundary (faces whose
/// nodes lie within `tolerance` [mm] of one plane); the rest falls into two parts, of which the
/// endocardium's normals point inwards.
[[nodiscard]] Sides sides_by_geometry(const ForeignMesh& foreign, double tolerance);

/// Throws InputError unless endocardium and epicardium are one disc each with no common node, the
/// base is one ring, and the normals of the endocardium point towards the cavity.
void check_sides(const ForeignMesh& foreign, const Sides& sides);

/// The best-fit plane of a side's nodes, its normal away from the rest of the wall.
[[nodiscard]] mesh::Plane outward_plane(const ForeignMesh& foreign, const mesh::Surface& side);

}  // namespace lv::mesh_io
