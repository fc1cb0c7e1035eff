#pragma once

#include "lv/base/mistakes.hpp"
#include "lv/mesh/mesh.hpp"
#include "lv/mesh/parameters.hpp"
#include "lv/mesh/surface.hpp"
#include "lv/mesh_io/unread_infarct.hpp"

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace lv::mesh_io {

/// A line of one of the files that were read.
struct FileLine {
  int file = 0;
  int number = 0;
};

/// What a file calls a side of the wall: faces, or nodes that faces are made of.
struct ForeignSide {
  std::vector<mesh::FaceKey> faces;
  std::vector<int> nodes;
};

/// A mesh as a file has it, unchecked and in the file's place.
struct ForeignMesh {
  mesh::Mesh mesh;                 ///< kind, nodes, cells, and M(X) if the file has it
  bool in_ras = false;             ///< the file says that it is (stated_space.hpp)
  Vec3 scale{1, 1, 1};             ///< by which the file's coordinates have been multiplied
  std::vector<ForeignSide> sides;  ///< endocardium, epicardium, base; none if found by geometry
  std::vector<bool> infarcted;     ///< per cell; empty if no set of infarcted cells was asked for
  std::optional<UnreadInfarct> unread;  ///< what seems an infarct, where none was asked for
  std::vector<std::int64_t> node_numbers, cell_numbers;  ///< as the file counts
  std::vector<std::string> files;                        ///< the file and those it includes
  std::vector<FileLine> node_lines, cell_lines;          ///< empty where the reader knows none
  std::vector<std::string> notes;                        ///< what the user should know

  /// Notes that elements have been read by their corners, if any; that a Gmsh file has fields.
  void note_quadratic(int elements);
  void note_fields(bool has_fields);

  /// "file:line" of a node or cell, or the file alone.
  [[nodiscard]] std::string where_node(int node) const;
  [[nodiscard]] std::string where_cell(int cell) const;

  /// "node 12 at (1.0, 2.0, 3.0)" and the like, with the file's numbers and coordinates.
  [[nodiscard]] std::string name_node(int node) const;
  [[nodiscard]] std::string name_cell(int cell) const;

  /// "(1.0, 2.0, 3.0)", a place of the mesh in the file's coordinates.
  [[nodiscard]] std::string format_place(const Vec3& place) const;
};

/// "file:line"
[[nodiscard]] std::string format_line(const std::vector<std::string>& files, FileLine line);

/// Whether a side's tag or the name of fibres is that of a file beside the mesh's (.vtp, .vtk,
/// .vtu), not of something in it.
[[nodiscard]] bool names_file(const std::string& name);

/// The name of a shape of Gmsh's ("Hexahedron 20") as only_kind knows it.
[[nodiscard]] std::string gmsh_shape(const std::string& name);

/// The tags of endocardium, epicardium and base, in this order.
[[nodiscard]] std::array<std::string, 3> side_tags(const mesh::ImportParameters& parameters);

/// The sides of those tags, each as `find` finds it. What is wrong with several is told at once.
template <class Find>
[[nodiscard]] std::vector<ForeignSide> find_sides(const mesh::ImportParameters& parameters,
                                                  const Find& find) {
  std::vector<ForeignSide> sides;
  Mistakes mistakes;
  for (const std::string& tag : side_tags(parameters))
    mistakes.attempt([&] { sides.push_back(find(tag)); });
  mistakes.raise();
  return sides;
}

/// The kind of all volume cells, from the counts of each shape. Throws InputError if there are
/// none, several, or others than hexahedra and tetrahedra, which count under these names.
inline constexpr const char* hexahedron_name = "hexahedron";
inline constexpr const char* tetrahedron_name = "tetrahedron";
[[nodiscard]] mesh::CellKind only_kind(const std::string& file,
                                       const std::map<std::string, int>& counts);

/// Throws InputError for a tag that the file does not have: lists those it has, suggests the
/// nearest. `what` names what a tag is in this file ("physical surface").
[[noreturn]] void fail_missing_tag(const std::string& file, const std::string& what,
                                   const std::string& tag, const std::vector<std::string>& tags);

}  // namespace lv::mesh_io
