#pragma once

#include "lv/drawing/orientation.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

/// What figures and page have to know of a stage and no table of it says. The stage leaves it in
/// facts.bin of its folder, as numbers; the record of its ingredients is read by nobody else.
namespace lv::report {

inline constexpr const char* facts_name = "facts.bin";

/// Of the mesh.
struct MeshFacts {
  double septum_angle = 0.0;  ///< as mesh::RegionParameters has it [rad]
  int order = 1;              ///< 2: every eight consecutive cells are one quadratic element
  bool is_immersed = false;   ///< it was made for that engine; else for the quasi-static one
};

/// Of a beat, from its beginning on.
struct BeatFacts {
  bool has_valves = false;  ///< heartbeats of a circulation
};

void write_facts(const MeshFacts& facts, const std::filesystem::path& folder);
void write_facts(const BeatFacts& facts, const std::filesystem::path& folder);
/// Of the results: what of the ventricle was assumed.
void write_facts(const drawing::Orientation& orientation, const std::filesystem::path& folder);

/// Those of a work folder; nothing where the stage has not left any. Throw RunError when a file is
/// damaged.
[[nodiscard]] std::optional<MeshFacts> mesh_facts(const std::filesystem::path& work);
[[nodiscard]] std::optional<BeatFacts> beat_facts(const std::filesystem::path& work);

/// How the ventricle of a run lies, by its mesh, and what of it was assumed, by its results;
/// nothing is known of what is not there.
[[nodiscard]] drawing::Orientation orientation_of(const std::filesystem::path& work);

/// A stage that was finished and left no facts, as those of earlier versions are, and what is not
/// known for that reason, in sentences.
[[nodiscard]] std::vector<std::string> missing_facts(const std::filesystem::path& work);

}  // namespace lv::report
