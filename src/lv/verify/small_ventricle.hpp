#pragma once

#include "lv/geometry/ellipsoid.hpp"
#include "lv/heartbeat/immersed_beat.hpp"

#include <array>

namespace lv::verify {

/// The mesh of an idealised ventricle, by default the healthy one, with elements of this edge
/// length [mm].
[[nodiscard]] mesh::Mesh ideal_mesh(double edge_length, const geometry::Ellipsoid& ellipsoid = {});

/// The engine's parameters for a wall in the middle of the default box of 150 x 150 x 200 mm, in
/// this many cells.
[[nodiscard]] immersed::ModelParameters in_default_box(const mesh::Mesh& mesh,
                                                       const std::array<int, 3>& cells);

/// A beat with the program's default muscle and loads and no output. The mesh must outlive it.
[[nodiscard]] heartbeat::BeatSetup default_beat(const mesh::Mesh& mesh,
                                                const std::array<int, 3>& cells, double time_step);

}  // namespace lv::verify
