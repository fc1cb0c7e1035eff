#pragma once

#include "lv/analysis/results.hpp"
#include "lv/heartbeat/immersed_beat.hpp"
#include "lv/job/case.hpp"

#include <filesystem>

namespace lv::job {

/// The wall's shape as a map, and how image space relates to the model.
struct Shape {
  mesh::WallMap wall;
};

/// The wall ready for an engine.
struct MeshResult {
  mesh::Mesh mesh;
  mesh::Regions regions;
};

[[nodiscard]] Shape make_anatomy(const Case& c);
[[nodiscard]] MeshResult make_mesh(const Case& c, const Shape& shape);

void write_anatomy(const Case& c, const Shape& shape, const std::filesystem::path& folder);
void write_mesh_result(const MeshResult& result, const Case& c,
                       const std::filesystem::path& folder);
[[nodiscard]] MeshResult read_mesh_result(const std::filesystem::path& folder);

/// Runs the beat in `folder`, writing fields and curves as it goes; collective.
[[nodiscard]] heartbeat::Beat make_beat(const Case& c, const MeshResult& mesh,
                                        const std::filesystem::path& folder);

void write_beat(const heartbeat::Beat& beat, double wall_clock,
                const std::filesystem::path& folder);
struct BeatResult {
  heartbeat::Beat beat;
  double wall_clock = 0.0;  ///< [s]
  int ranks = 1;
};
[[nodiscard]] BeatResult read_beat(const std::filesystem::path& folder);

/// Computes and writes the results; collective. Returns the text for the terminal on the root.
[[nodiscard]] std::string make_results(const Case& c, const MeshResult& mesh,
                                       const BeatResult& beat, const std::filesystem::path& folder);

}  // namespace lv::job
