#pragma once

#include "lv/base/tensor.hpp"
#include "lv/base/units.hpp"
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

/// Rule-based fibres (section 2.2; Potse et al., IEEE Trans. Biomed. Eng. 53:2425, 2006). Angles in
/// radians.
///
/// The helix angle grows linearly through the wall from `helix_endo` to `helix_epi`. It is the
/// paper's angle: from -60 degrees at the endocardium to +60 at the epicardium, positive when the
/// fibre, followed anticlockwise as seen from the base, goes down towards the apex. So -60 at the
/// endocardium is a right-handed helix there, as in every human heart, and the apex turns
/// anticlockwise as seen from the apex in systole. LDRB tools use the opposite sign.
///
///   f0 = cos(helix) c - sin(helix) l
///   s0 = the part normal to f0 of  cos(sheet) r + sin(sheet) l,  normalised;   n0 = f0 x s0
struct FibreRule {
  double helix_endo = -1.0471975511965976;  ///< -60 degrees
  double helix_epi = 1.0471975511965976;    ///< +60 degrees
  double sheet_endo = -0.7853981633974483;  ///< -45 degrees
  double sheet_epi = 0.7853981633974483;    ///< +45 degrees
};

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

/// The fibre frame at a point: the directions that the mesh brings, if it does, else the rule's.
/// Directions at nodes are interpolated as lines, whose sign does not count: the mean is the
/// principal direction of sum phi_a f_a (x) f_a. Without sheets of its own the mesh's fibres get
/// the rule's.
[[nodiscard]] Mat3 fibre_frame(const Mesh& mesh, const FibreRule& rule, const WallPoint& point);

/// The principal direction of the sum of w_i d_i (x) d_i; of one direction, that direction.
[[nodiscard]] Vec3 mean_direction(std::span<const Vec3> directions,
                                  std::span<const double> weights);

/// The mesh with its nodes elsewhere: the same muscle, so that the directions which it brings turn
/// with it (f = F f0/|F f0|, F the mean deformation gradient of the cell, or of those at the node).
[[nodiscard]] Mesh with_nodes(const Mesh& mesh, std::vector<Vec3> nodes);

/// The helix angle of a direction in the paper's sign, in (-pi/2, pi/2].
[[nodiscard]] double helix_angle(const Vec3& f0, const WallAxes& axes);

}  // namespace lv::mesh
