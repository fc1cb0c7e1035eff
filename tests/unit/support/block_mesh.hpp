#pragma once

#include "lv/mesh/mesh.hpp"

#include <span>
#include <vector>

namespace lv::test {

/// A block of n x n x n distorted cells (each split in tetrahedra for that kind), 2 mm wide, away
/// from the long axis. No cell is a parallelepiped and no side is plane. t grows linearly along x;
/// the endocardium is at low x, the epicardium at high x, the base on top.
[[nodiscard]] mesh::Mesh block_mesh(mesh::CellKind kind, int n = 3);

/// n x n x n cubes with edges of 2 mm from the origin on, or the tetrahedra they split into; no
/// sides.
[[nodiscard]] mesh::Mesh cubes(mesh::CellKind kind, int n);

/// The nodes moved by X -> F X + c.
[[nodiscard]] std::vector<Vec3> moved(std::span<const Vec3> nodes, const Mat3& F,
                                      const Vec3& c = Vec3::Zero());

[[nodiscard]] double volume(const mesh::Mesh& mesh);

/// Sum of forces, and of their torques about the origin.
[[nodiscard]] Vec3 resultant(std::span<const Vec3> forces);
[[nodiscard]] Vec3 torque(std::span<const Vec3> positions, std::span<const Vec3> forces);

/// Work of the forces along the displacements, sum F.d.
[[nodiscard]] double work(std::span<const Vec3> forces, std::span<const Vec3> displacements);

/// Sum of |F|: what rounding is measured against.
[[nodiscard]] double magnitude(std::span<const Vec3> forces);

/// x + scale d, node by node.
[[nodiscard]] std::vector<Vec3> displaced(std::span<const Vec3> positions,
                                          std::span<const Vec3> displacements, double scale);

}  // namespace lv::test
