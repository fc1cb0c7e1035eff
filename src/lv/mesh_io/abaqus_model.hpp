#pragma once

#include "lv/mesh_io/abaqus_blocks.hpp"

#include <cstdint>
#include <map>
#include <string>
#include <unordered_map>
#include <vector>

namespace lv::mesh_io {

/// What an element type of ABAQUS is to a wall.
struct AbaqusElementType {
  enum class Use {
    volume,   ///< part of the wall
    surface,  ///< three or four nodes: can mark a side
    other     ///< lines, points, springs, connectors
  } use = Use::other;
  int nodes = 0;      ///< 0 if not known
  std::string shape;  ///< of volume elements, in words
  int corners = 0;    ///< the first of its nodes; the others lie between them and are not kept
};

/// The nodes, elements, sets and surfaces of an ABAQUS input file, by the file's own numbers and by
/// names in upper case.
struct AbaqusModel {
  using Number = std::int64_t;
  using Sets = std::map<std::string, std::vector<Number>>;

  struct Node {
    Number number;
    Vec3 X;
    FileLine at;
  };
  struct Element {
    Number number;
    AbaqusElementType type;
    std::vector<Number> nodes;
    FileLine at;
  };
  struct SurfaceEntry {
    std::string target;  ///< an element or node, or a set of either
    std::string label;   ///< S1 to S6 for a face of a volume element
    FileLine at;
  };
  struct Surface {
    bool of_nodes = false;
    std::vector<SurfaceEntry> entries;
  };

  std::vector<std::string> files;
  std::vector<Node> nodes;
  std::vector<Element> elements;
  std::unordered_map<Number, int> node_index, element_index;
  Sets node_sets, element_sets;
  std::map<std::string, Surface> surfaces;
  std::map<std::string, int> volume_shapes;  ///< how many volume elements of each shape
  int quadratic = 0;                         ///< how many of those of more nodes than corners
  std::vector<std::string> notes;

  /// The number itself, or the members of the set of that name, with or without an instance's name
  /// before a dot.
  [[nodiscard]] std::vector<Number> members(const Sets& sets, const std::string& name,
                                            FileLine at) const;

  [[noreturn]] void fail(FileLine at, const std::string& what, const std::string& remedy) const;
};

/// Throws InputError with the line of whatever is damaged, undefined or not understood.
[[nodiscard]] AbaqusModel read_abaqus_model(const std::string& file);

}  // namespace lv::mesh_io
