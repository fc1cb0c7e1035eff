#pragma once

#include "lv/base/tensor.hpp"

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

/// Gmsh files of format 2.2 or 4.1, text or binary (reference manual, "MSH file format" and "MSH
/// file format version 2"). In the older format a physical group belongs to each element, whatever
/// its elementary tag; in the newer one to all elements of an entity.
namespace lv::mesh_io {

/// What a type of Gmsh's elements is; its corners are the first of its nodes.
struct GmshShape {
  int dimension = 0;
  int nodes = 0;
  int corners = 0;
  std::string name;  ///< "Hexahedron 8"
};

struct GmshFile {
  struct Node {
    std::int64_t number = 0;
    Vec3 X = Vec3::Zero();
    int line = 0;  ///< of X; 0 in a binary file
  };
  struct Element {
    GmshShape shape;
    std::int64_t number = 0;
    std::set<int> groups;               ///< physical ones
    std::vector<std::int64_t> corners;  ///< numbers of nodes
    int line = 0;
  };

  std::vector<Node> nodes;
  std::vector<Element> elements;
  std::map<std::pair<int, int>, std::string> names;  ///< of groups, by dimension and number
  bool has_fields = false;                           ///< data at nodes or in elements
};

/// Nodes and elements in the file's order (2.2), or by their numbers (4.1, which has them entity by
/// entity). Throws InputError, with the line of a text file, where it is damaged or of another
/// format.
[[nodiscard]] GmshFile read_gmsh_file(const std::string& file);

}  // namespace lv::mesh_io
