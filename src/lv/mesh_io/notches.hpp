#pragma once

#include "lv/mesh/surface.hpp"

#include <span>
#include <vector>

namespace lv::mesh_io {

/// Which way a side of a wall bends, seen from outside of the wall: the epicardium bulges, the
/// endocardium is hollow.
enum class Bulge { outwards, inwards };

/// Where elements seem to be missing from a side of a wall: the middle of each patch of edges at
/// which the side, sharply, bends both its own way and the other way, or at which more than two of
/// its faces meet [mm].
///
/// An element that is not there leaves a pit whose floor, walls and rim meet at the angles of an
/// element. A smooth surface bends its own way alone; the apex of a coarse endocardium does so
/// sharply too, the furrows and trabeculae of a heart bend both ways, but not by half a right angle
/// from one face to the next, unless the surface is made of steps.
[[nodiscard]] std::vector<Vec3> notches(std::span<const Vec3> nodes, const mesh::Surface& side,
                                        Bulge bulge);

}  // namespace lv::mesh_io
