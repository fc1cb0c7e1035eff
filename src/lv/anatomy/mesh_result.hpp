#pragma once

#include "lv/base/table.hpp"
#include "lv/mesh/regions.hpp"

#include <filesystem>
#include <optional>
#include <vector>

namespace lv::anatomy {

/// The wall ready for an engine.
struct MeshResult {
  mesh::Mesh mesh;
  mesh::Regions regions;
  std::vector<double> infarcted;  ///< per element: the part of its volume that is infarcted
  /// See InfarctExtent; not read back from a folder, where it is slice_moves.csv.
  std::optional<Table> slice_moves = {};
};

void write_mesh_result(const MeshResult& result, const std::filesystem::path& folder);

/// The mesh of a folder, with the fibres' rule, which is the case's: a folder holds given
/// directions alone and stays as it is when the rule changes. Throws RunError when the mesh is
/// absent, damaged or none.
[[nodiscard]] MeshResult read_mesh_result(const std::filesystem::path& folder,
                                          const mesh::FibreRule& rule);

}  // namespace lv::anatomy
