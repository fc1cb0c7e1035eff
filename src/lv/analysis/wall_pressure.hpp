#pragma once

#include "lv/heartbeat/beat.hpp"
#include "lv/solid/support.hpp"
#include "lv/solid/wall.hpp"

#include <vector>

namespace lv::analysis {

/// The pressure p of (2.6) in every element of a wall at rest, from the equilibrium of its nodes
/// [kPa]. On the root; empty on other ranks. Collective.
///
/// Incompressible muscle leaves p open; neither the blood's pressure on the grid, which the kernel
/// smears over the wall's edge, nor the volumetric penalty of an element, which follows its last
/// per mille of volume, shows it at the scale of an element. But p is the one scalar field that
/// holds the other forces f (passive and active stress, endocardial pressure, supports) in
/// balance. With p continuous, p = sum_b p_b phi_b, and the nodes' volumes V_a:
///
///   minimise  sum_a |f_a + sum_b p_b int phi_b grad phi_a dv|^2 / V_a  +  epsilon int |grad p|^2 dv
///
/// epsilon = 1e-3 stands against modes that change sign from node to node, which the first term
/// does not see and the mean over an element's nodes, the value returned, removes. Inertia and
/// dashpots are left out: in fast motion p is that of the wall held in its place. NaN when the
/// solution does not converge (nearly flat elements), with a warning in the log.
///
/// `wall` must have been made without volumetric penalty.
[[nodiscard]] std::vector<double> wall_pressure(const mesh::Mesh& mesh, const solid::Wall& wall,
                                                const solid::Supports& supports,
                                                const heartbeat::Snapshot& snapshot);

}  // namespace lv::analysis
