#pragma once

#include "lv/heartbeat/beat.hpp"
#include "lv/mesh/mesh.hpp"

#include <filesystem>

namespace lv::pipeline {

/// Name of a finished beat inside its folder.
inline constexpr const char* beat_name = "beat.bin";

void write_beat(const heartbeat::Beat& beat, const std::filesystem::path& folder);
struct BeatResult {
  heartbeat::Beat beat;
  int ranks = 1;
};
/// Throws RunError when the beat is not one of this wall.
[[nodiscard]] BeatResult read_beat(const std::filesystem::path& folder, const mesh::Mesh& mesh);

/// The heartbeats of a beat in `folder`. Throws RunError when it holds none.
[[nodiscard]] circulation::Cycle read_cycle(const std::filesystem::path& folder);

}  // namespace lv::pipeline
