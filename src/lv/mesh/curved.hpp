#pragma once

#include "lv/mesh/mesh.hpp"

#include <type_traits>
#include <utility>
#include <vector>

namespace lv::mesh {

/// A mesh to draw: straight cells so small that they follow the curved shape of quadratic elements.
/// Each part of a quadratic element is cut into eight once more, and a node of those lies where the
/// element's shape functions put it, x = sum_a phi_a(xi) x_a. A mesh of linear elements stays as it
/// is.
struct CurvedMesh {
  Mesh mesh;  ///< nodes at early diastole; t and M between their neighbours', no fibres
  int cells_per_element = 1;
  int faces_per_side = 1;
  int cells_per_part = 1;  ///< of a cell of the mesh that was given

  /// A field of the given mesh's nodes (numbers or vectors) at these nodes.
  template <class Field>
  [[nodiscard]] auto at_nodes(const Field& nodal) const {
    std::vector<std::decay_t<decltype(nodal[0])>> values;
    for (const auto& terms : weights) {
      std::decay_t<decltype(nodal[0])> sum = terms.front().second * nodal[terms.front().first];
      for (std::size_t i = 1; i < terms.size(); ++i)
        sum += terms[i].second * nodal[terms[i].first];
      values.push_back(sum);
    }
    return values;
  }

  /// Of each node: nodes of the given mesh and their weights.
  std::vector<std::vector<std::pair<int, double>>> weights;
};

[[nodiscard]] CurvedMesh curved(const Mesh& mesh);

}  // namespace lv::mesh
