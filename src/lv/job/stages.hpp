#pragma once

#include "lv/analysis/results.hpp"
#include "lv/heartbeat/immersed_beat.hpp"
#include "lv/job/anatomy.hpp"
#include "lv/job/beat_result.hpp"
#include "lv/job/mesh_result.hpp"
#include "lv/report/summary.hpp"

#include <filesystem>
#include <optional>

namespace lv::job {

/// Throws InputError when the immersed engine has no room for the wall in its box, or when the mesh
/// is too coarse for the grid.
void check_room(const Case& c, const mesh::Mesh& mesh);

[[nodiscard]] MeshResult make_mesh(const Case& c, const Shape& shape);

/// Writes the mesh for ParaView, its quality table and pictures; collective.
void show_mesh(const MeshResult& result, const Case& c, const std::filesystem::path& folder);

/// Runs the beat in `folder`, writing fields and curves as it goes; collective.
[[nodiscard]] heartbeat::Beat make_beat(const Case& c, const MeshResult& mesh,
                                        const std::filesystem::path& folder);

/// Computes and writes the results; collective. `fitted` is empty unless the case is calibrated,
/// `unloaded` unless the wall was seen under load.
/// Returns the text for the terminal on the root.
[[nodiscard]] std::string make_results(const Case& c, const MeshResult& mesh,
                                       const BeatResult& beat,
                                       const std::vector<report::FittedVolume>& fitted,
                                       const std::optional<report::UnloadedShape>& unloaded,
                                       const std::filesystem::path& folder);

}  // namespace lv::job
