#pragma once

#include "lv/base/tensor.hpp"
#include "lv/mesh/mesh.hpp"

#include <span>
#include <vector>

namespace lv::mesh {

/// Directions of the wall at one point, orthonormal: circumferential, longitudinal, radial.
struct WallAxes {
  Vec3 circumferential;  ///< anticlockwise seen from the base
  Vec3 longitudinal;     ///< towards the base, in the wall
  Vec3 radial;           ///< out of the cavity
};

/// The axes from the gradient of the transmural coordinate. The longitudinal direction is the
/// model's z axis projected on the wall; where the two are parallel (the apex itself) any direction
/// serves. The gradient must not vanish.
[[nodiscard]] WallAxes wall_axes(const Vec3& transmural_gradient);

/// The radial direction at every node: the mean of grad t over the cells around it, weighted by
/// their volumes, normalised; a node whose cells all lie on one side of the wall, where t is
/// constant, takes the mean of its neighbours. It serves tetrahedra, whose own grad t may vanish:
/// unstructured meshes have cells with all nodes on one side.
[[nodiscard]] std::vector<Vec3> radial_directions(const Mesh& mesh);

/// The fibre frame at transmural position t: columns f0, s0, n0.
[[nodiscard]] Mat3 fibre_frame(const FibreRule& rule, const WallAxes& axes, double t);

/// A point of a cell of the wall.
struct WallPoint {
  int cell = 0;
  std::span<const int> nodes;   ///< of the element that is interpolated in
  std::span<const double> phi;  ///< its shapes' values
  WallAxes axes;
  double t = 0.0;  ///< transmural coordinate
};

/// The frame of a mesh's fibres at a point: the directions that are given, if there are any, else
/// the rule's. Directions at nodes are interpolated as lines, whose sign does not count: the mean
/// is the principal direction of sum phi_a f_a (x) f_a. Given fibres without sheets get the rule's.
[[nodiscard]] Mat3 fibre_frame(const Mesh& mesh, const WallPoint& point);

/// The principal direction of the sum of w_i d_i (x) d_i; of one direction, that direction.
[[nodiscard]] Vec3 mean_direction(std::span<const Vec3> directions,
                                  std::span<const double> weights);

/// The mesh with its nodes elsewhere: the same muscle, so that the directions which it brings turn
/// with it (f = F f0/|F f0|, F the mean deformation gradient of the cell, or of those at the node).
[[nodiscard]] Mesh with_nodes(const Mesh& mesh, std::vector<Vec3> nodes);

/// The helix angle of a direction in the paper's sign, in (-pi/2, pi/2].
[[nodiscard]] double helix_angle(const Vec3& f0, const WallAxes& axes);

}  // namespace lv::mesh
