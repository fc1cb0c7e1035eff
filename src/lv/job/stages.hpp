#pragma once

#include "lv/analysis/results.hpp"
#include "lv/base/table.hpp"
#include "lv/heartbeat/immersed_beat.hpp"
#include "lv/job/anatomy.hpp"
#include "lv/report/summary.hpp"

#include <filesystem>
#include <optional>

namespace lv::job {

/// The wall ready for an engine.
struct MeshResult {
  mesh::Mesh mesh;
  mesh::Regions regions;
  std::vector<double> infarcted;  ///< per element: the part of its volume that is infarcted
  /// See InfarctExtent; not read back from a folder, where it is slice_moves.csv.
  std::optional<Table> slice_moves = {};
};

/// Throws InputError when the immersed engine has no room for the wall in its box, or when the mesh
/// is too coarse for the grid.
void check_room(const Case& c, const mesh::Mesh& mesh);

[[nodiscard]] MeshResult make_mesh(const Case& c, const Shape& shape);

void write_mesh_result(const MeshResult& result, const std::filesystem::path& folder);
/// Throws RunError when the folder's mesh is absent, damaged or none.
[[nodiscard]] MeshResult read_mesh_result(const std::filesystem::path& folder);

/// Writes the mesh for ParaView, its quality table and pictures; collective.
void show_mesh(const MeshResult& result, const Case& c, const std::filesystem::path& folder);

/// Runs the beat in `folder`, writing fields and curves as it goes; collective.
[[nodiscard]] heartbeat::Beat make_beat(const Case& c, const MeshResult& mesh,
                                        const std::filesystem::path& folder);

/// Name of a finished beat inside its folder.
inline constexpr const char* beat_name = "beat.bin";

void write_beat(const heartbeat::Beat& beat, const std::filesystem::path& folder);
struct BeatResult {
  heartbeat::Beat beat;
  int ranks = 1;
};
/// Throws RunError when the beat is not one of this wall.
[[nodiscard]] BeatResult read_beat(const std::filesystem::path& folder, const mesh::Mesh& mesh);

/// Computes and writes the results; collective. `fitted` is empty unless the case is calibrated,
/// `unloaded` unless the wall was seen under load.
/// Returns the text for the terminal on the root.
[[nodiscard]] std::string make_results(const Case& c, const MeshResult& mesh,
                                       const BeatResult& beat,
                                       const std::vector<report::FittedVolume>& fitted,
                                       const std::optional<report::UnloadedShape>& unloaded,
                                       const std::filesystem::path& folder);

}  // namespace lv::job
