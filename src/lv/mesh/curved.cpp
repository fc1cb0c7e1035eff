#include "lv/mesh/curved.hpp"

#include "lv/mesh/quadratic.hpp"
#include "lv/mesh/refine.hpp"
#include "lv/mesh/shapes.hpp"

#include <map>

namespace lv::mesh {
namespace {

constexpr int parts = 8;  // of a cell that refine() cuts

/// Where the nodes of one element lie in the reference element.
std::map<int, Vec3> places_of(std::span<const int> element, const std::vector<Vec3>& places) {
  std::map<int, Vec3> of;
  for (std::size_t a = 0; a < element.size(); ++a)
    of.emplace(element[a], places[a]);
  return of;
}

/// The shape functions of an element in the middle of some of its nodes.
std::vector<std::pair<int, double>> weights_at(CellKind kind, std::span<const int> element,
                                               const std::map<int, Vec3>& places,
                                               const std::vector<int>& middle_of) {
  Vec3 xi = Vec3::Zero();
  for (const int node : middle_of)
    xi += places.at(node) / static_cast<double>(middle_of.size());
  const Eigen::VectorXd phi = shapes<3>(kind, 2, {xi.x(), xi.y(), xi.z()}).value;
  std::vector<std::pair<int, double>> terms;
  for (std::size_t a = 0; a < element.size(); ++a)
    if (const double value = phi[static_cast<Eigen::Index>(a)]; value != 0.0)
      terms.emplace_back(element[a], value);
  return terms;
}

}  // namespace

CurvedMesh curved(const Mesh& mesh) {
  CurvedMesh result;
  if (mesh.order != 2) {
    result.mesh = mesh;
    for (std::size_t a = 0; a < mesh.nodes.size(); ++a)
      result.weights.push_back({{static_cast<int>(a), 1.0}});
    return result;
  }
  Mesh bare = mesh;
  bare.fibres = {};
  Refinement fine = refinement(bare);
  const int per_cell = nodes_per_cell(mesh.kind);
  const ElementNodes all = elements(mesh);
  const std::vector<Vec3> places = node_places(mesh.kind, 2);
  result.weights.resize(fine.mesh.nodes.size());
  for (int e = 0; e < all.size(); ++e) {
    const auto place = places_of(all.element(e), places);
    for (int i = 0; i < parts * parts * per_cell; ++i) {
      const int node = fine.mesh.cells[static_cast<std::size_t>(e) * parts * parts * per_cell + i];
      if (result.weights[node].empty())
        result.weights[node] = weights_at(mesh.kind, all.element(e), place, fine.middle_of[node]);
    }
  }
  result.mesh = std::move(fine.mesh);
  result.mesh.nodes = result.at_nodes(mesh.nodes);
  result.cells_per_element = parts * parts;
  result.cells_per_part = parts;
  result.faces_per_side = 16;
  return result;
}

}  // namespace lv::mesh
