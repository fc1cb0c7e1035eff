#pragma once

#include "lv/heartbeat/archive.hpp"
#include "lv/implicit/unload.hpp"
#include "lv/pipeline/stages.hpp"

#include <optional>
#include <span>
#include <vector>

namespace lv::pipeline {

/// Finds the wall without load behind the one that was seen under unloaded.pressure, with the
/// quasi-static engine on `elements`, and writes it for the engine of the case in place of `seen`
/// (for the immersed engine the displacement is carried over to its mesh), with unloading.csv (the
/// search) and unloaded.json (what is left); collective. Depth, regions and infarct are carried
/// with the wall. The search begins at the shape in the file `start` if it is there; one that was
/// stopped goes on from what it left in `folder`. The pictures at the end take about as long as
/// those of `seen` took, which is part of the time left; 0 if that is not known [s].
void make_unloading(const case_file::Case& c, const anatomy::MeshResult& seen,
                    const mesh::Mesh& elements, const std::filesystem::path& folder,
                    const std::filesystem::path& start, double seconds_of_pictures = 0.0);

/// The nodes of another mesh of the same wall, moved as those of `elements` were moved to
/// `unloaded`.
[[nodiscard]] std::vector<Vec3> carried(const mesh::Mesh& elements, std::span<const Vec3> unloaded,
                                        const mesh::Mesh& other);

/// The search alone, whose record in `folder` is for whoever called to remove; what it says is left
/// contains what comes `afterwards` [s].
[[nodiscard]] implicit::Unloaded find_unloaded(const case_file::Case& c, const mesh::Mesh& elements,
                                               const std::filesystem::path& folder,
                                               const std::filesystem::path& start,
                                               double afterwards = 0.0);

/// A wall without load as the start of a search, in a file and back.
inline constexpr const char* unloaded_shape_name = "unloaded.bin";
inline constexpr const char* search_record = "search.bin";
void write_unloaded(const implicit::Unloaded& unloaded, const std::filesystem::path& file);

/// The name in an archive of the n-th of several equilibria.
[[nodiscard]] std::string equilibrium_name(std::size_t n);

/// A shape and its equilibrium, or an equilibrium, as arrays of an archive, and back; `nodes` of
/// the wall.
void store(const implicit::State& state, const std::string& name, heartbeat::Archive& archive);
[[nodiscard]] implicit::State load_state(const heartbeat::Archive& archive, const std::string& name,
                                         std::size_t nodes);
void store(const implicit::Unloaded& unloaded, heartbeat::Archive& archive);
[[nodiscard]] implicit::Unloaded load_unloaded(const heartbeat::Archive& archive,
                                               std::size_t nodes);

/// What make_unloading leaves in a folder of how well it did, and the same from there; nothing when
/// it was not there.
void write_shape(const report::UnloadedShape& shape, const std::filesystem::path& folder);
[[nodiscard]] std::optional<report::UnloadedShape> unloaded_shape(
    const std::filesystem::path& folder);

}  // namespace lv::pipeline
