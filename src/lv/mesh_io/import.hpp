#pragma once

#include "lv/geometry/frame.hpp"
#include "lv/mesh/mesh.hpp"
#include "lv/mesh/parameters.hpp"
#include "lv/mesh_io/unread_infarct.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace lv::mesh_io {

struct ImportedMesh {
  mesh::Mesh mesh;  ///< in the model frame, t by distance (see transmural.hpp)

  /// How it was moved: `frame.to_image` leads back to the file's place [mm]. z is the normal of the
  /// best-fit plane of the base, away from the apex; x is the file's x axis turned into that plane
  /// (its y axis where x is nearly normal to it); the origin is the centre of the endocardium's
  /// edge.
  geometry::Frame frame;

  std::vector<bool> infarcted;             ///< per cell; empty unless the parameters name a set
  std::optional<UnreadInfarct> unread;     ///< where no infarct was read and none asked for
  std::vector<std::int64_t> node_numbers;  ///< of the nodes in the file
  std::vector<std::int64_t> cell_numbers;  ///< of the cells in the file
  std::vector<std::string> notes;          ///< what was changed on the way, for the log
  std::vector<std::string> warnings;       ///< where elements seem to be missing (notches.hpp)
};

/// Reads a mesh of the wall made elsewhere. Quadratic elements are read by their corners, a file
/// that says SPACE=RAS is turned to LPS, directions of fibres are made orthonormal. Nodes that no
/// cell uses are dropped, the order of nodes is mirrored if all cells are inverted, and the base's
/// nodes are moved onto their plane.
///
/// Throws InputError where the file cannot be read or the mesh cannot be used: other cells than
/// hexahedra or tetrahedra, missing tags, sides that overlap or leave gaps, inverted or collapsed
/// cells, cracks, a base that is not plane, a size that no ventricle has, fibres without direction.
[[nodiscard]] ImportedMesh import_mesh(const mesh::ImportParameters& parameters);

}  // namespace lv::mesh_io
