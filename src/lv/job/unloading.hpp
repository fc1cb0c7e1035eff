#pragma once

#include "lv/job/stages.hpp"

#include <optional>

namespace lv::job {

/// Finds the wall without load behind the one that was seen under unloaded.pressure, with the
/// quasi-static engine on `elements`, and writes it for the engine of the case in place of `seen`
/// (for the immersed engine the displacement is carried over to its mesh), with unloading.csv (the
/// search) and unloaded.json (what is left); collective. Depth, regions and infarct are carried
/// with the wall.
void make_unloading(const Case& c, const MeshResult& seen, const mesh::Mesh& elements,
                    const std::filesystem::path& folder);

/// What make_unloading left in a folder; nothing when it was not there.
[[nodiscard]] std::optional<report::UnloadedShape> unloaded_shape(
    const std::filesystem::path& folder);

}  // namespace lv::job
