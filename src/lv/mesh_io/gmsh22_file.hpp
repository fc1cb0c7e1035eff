#pragma once

#include "lv/base/tensor.hpp"

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

/// Gmsh files of format 2.2, text or binary (reference manual, "MSH file format version 2"). Gmsh
/// itself hands the physical group of one element on to all that share its elementary tag, and
/// leaves out elements whose number another one bears; in the file a group belongs to its element.
namespace lv::mesh_io {

/// What a type of Gmsh's elements is; its corners are the first of its nodes.
struct GmshShape {
  int dimension = 0;
  int nodes = 0;
  int corners = 0;
  std::string name;  ///< "Hexahedron 8"
};

struct Gmsh22File {
  struct Node {
    std::int64_t number = 0;
    Vec3 X = Vec3::Zero();
    int line = 0;  ///< 0 in a binary file
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

/// Throws InputError, with the line of a text file, where it is damaged.
[[nodiscard]] Gmsh22File read_gmsh22_file(const std::string& file);

}  // namespace lv::mesh_io
