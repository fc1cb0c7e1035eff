#pragma once

#include "lv/geometry/ellipsoid.hpp"
#include "lv/heartbeat/immersed_beat.hpp"
#include "lv/mesh/parameters.hpp"

#include <array>

namespace lv::verify {

/// The mesh of an idealised ventricle, by default the healthy one, with elements as these
/// parameters ask.
[[nodiscard]] mesh::Mesh ideal_mesh(const mesh::WallMeshParameters& parameters,
                                    const geometry::Ellipsoid& ellipsoid = {});

/// The engine's parameters for a wall in the middle of the default box of 150 x 150 x 200 mm, in
/// this many cells.
[[nodiscard]] immersed::ModelParameters in_default_box(const mesh::Mesh& mesh,
                                                       const std::array<int, 3>& cells);

/// A beat with the program's default muscle and loads and no output. The mesh must outlive it.
[[nodiscard]] heartbeat::BeatSetup default_beat(const mesh::Mesh& mesh,
                                                const std::array<int, 3>& cells, double time_step);

/// Heartbeats of human muscle in few cells: too short for a heart, after a filling too short for a
/// wall to come to rest, so that they take seconds. The mesh must outlive it.
[[nodiscard]] heartbeat::BeatSetup quick_heartbeat(const mesh::Mesh& mesh);

}  // namespace lv::verify
