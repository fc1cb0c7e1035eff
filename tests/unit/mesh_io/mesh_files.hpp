#pragma once

#include "lv/geometry/ellipsoid.hpp"
#include "lv/mesh/mesh.hpp"
#include "lv/mesh/surface.hpp"
#include "lv/mesh_io/import.hpp"

#include "support/cell_kinds.hpp"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

/// Meshes for tests, and the files of other programs that hold them.
namespace lv::test {

/// A wall_mesh of the ellipsoid; `layers` 0 follows the edge length.
[[nodiscard]] mesh::Mesh ellipsoid_mesh(const geometry::Ellipsoid& ellipsoid, double edge_length,
                                        int layers = 0);

/// A coarse ventricle of the default size: hexahedra, or the tetrahedra they split into.
[[nodiscard]] mesh::Mesh coarse_mesh(mesh::CellKind kind);

/// The faces of a surface whatever their order and the order of their nodes.
[[nodiscard]] std::vector<mesh::FaceKey> sorted_keys(const mesh::Surface& surface);

/// A file that holds `text` as long as the object lives.
class TemporaryFile {
 public:
  TemporaryFile(const std::string& ending, const std::string& text);
  ~TemporaryFile();
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  [[nodiscard]] std::string path() const { return path_.string(); }

 private:
  std::filesystem::path path_;
};

/// What import_mesh makes of a file that ends in `ending` and holds `text`.
[[nodiscard]] mesh_io::ImportedMesh import_text(const std::string& ending, const std::string& text,
                                                mesh::ImportParameters parameters = {});

/// Sides by geometry; by the numbers 1, 2, 3 in the cell array "side"; else they are "endo", "epi"
/// and "base".
[[nodiscard]] mesh::ImportParameters by_geometry();
[[nodiscard]] mesh::ImportParameters by_cells();

/// How an ABAQUS file marks the sides ENDO, EPI and BASE.
enum class AbaqusTags { none, labelled_faces, node_sets, shells };
[[nodiscard]] std::string abaqus_text(const mesh::Mesh& mesh, AbaqusTags tags);

/// How a VTK file marks them: cell array "side" with 1, 2, 3 on surface cells, or point arrays
/// "endo", "epi", "base". The infarct is the point array "infarct".
enum class VtkTags { none, surface_cells, point_arrays };
[[nodiscard]] std::string vtk_text(const mesh::Mesh& mesh, VtkTags tags);
[[nodiscard]] std::string vtu_text(const mesh::Mesh& mesh, VtkTags tags);

/// Gmsh files with the physical surfaces "endo" (1), "epi" (2), "base" (3), and the volumes "wall"
/// (1) and, for the flagged cells, "scar" (2). Elements of format 2.2 have their group's number as
/// elementary tag, or that of the function.
[[nodiscard]] std::string gmsh22_text(const mesh::Mesh& mesh, const std::vector<bool>& scar = {},
                                      const std::function<int(int group)>& elementary = {});
/// The same of format 4.1, with nodes and elements in several blocks and not by their numbers; its
/// entities are those of partitions if asked.
enum class GmshNumbers { text, bytes, swapped_bytes };
[[nodiscard]] std::string gmsh41(const mesh::Mesh& mesh, GmshNumbers numbers = GmshNumbers::text,
                                 bool partitioned = false);

/// A binary file of format 2.2 with those sides and the volume 7, all of one elementary tag, in
/// this machine's order of bytes or the other.
[[nodiscard]] std::string gmsh22_bytes(const mesh::Mesh& mesh, bool swapped);

/// The mesh's elements as quadratic ones: nodes in the middles of edges behind the corners.
struct Quadratic {
  std::vector<Vec3> nodes;
  std::vector<std::vector<int>> cells;
};
[[nodiscard]] Quadratic quadratic(const mesh::Mesh& mesh);

/// The surface of a side as a .vtp file; its points are numbered as the mesh's nodes are, plus
/// `first`, in the array GlobalNodeID; without it if that is negative.
[[nodiscard]] std::string vtp_text(const mesh::Mesh& mesh, const mesh::Surface& side, int first);

/// A data array of a .vtu file.
[[nodiscard]] std::string vtu_array(const std::string& name, const std::vector<Vec3>& vectors);

/// The text with the first `from` in it replaced, which must be there.
[[nodiscard]] std::string replaced(std::string text, const std::string& from,
                                   const std::string& to);

}  // namespace lv::test
