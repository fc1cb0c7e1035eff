#include "lv/mesh_io/notches.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

namespace lv::mesh_io {
namespace {

constexpr double sharp = 0.25 * std::numbers::pi;  // from one face to the next

using Edge = std::array<int, 2>;

/// The angle between the normals of two faces, positive where they look at each other.
double bend(std::span<const Vec3> nodes, const mesh::Surface& side, int f, int g) {
  const Vec3 n = mesh::area_vector(nodes, side.face(f)).normalized();
  const Vec3 m = mesh::area_vector(nodes, side.face(g)).normalized();
  const Vec3 way = mesh::face_centre(nodes, side.face(g)) - mesh::face_centre(nodes, side.face(f));
  return std::copysign(std::atan2(n.cross(m).norm(), n.dot(m)), way.dot(n - m));
}

/// Edges at which a side bends sharply.
struct SharpEdges {
  std::vector<Edge> its_own_way, other_way;
};

SharpEdges sharp_edges(std::span<const Vec3> nodes, const mesh::Surface& side, Bulge bulge) {
  SharpEdges edges;
  for (const auto& [edge, faces] : mesh::faces_at_edges(side)) {
    if (faces.size() == 1)
      continue;
    const bool is_crowded = faces.size() > 2;
    const double towards = is_crowded ? 0.0 : bend(nodes, side, faces[0], faces[1]);
    const double own = bulge == Bulge::outwards ? -towards : towards;
    if (is_crowded || own > sharp)
      edges.its_own_way.push_back(edge);
    if (is_crowded || own < -sharp)
      edges.other_way.push_back(edge);
  }
  return edges;
}

}  // namespace

std::vector<Vec3> notches(std::span<const Vec3> nodes, const mesh::Surface& side, Bulge bulge) {
  const SharpEdges edges = sharp_edges(nodes, side, bulge);
  const std::vector<int> part = mesh::edge_parts(edges.other_way);
  std::map<int, int> part_at_node;
  for (std::size_t e = 0; e < part.size(); ++e)
    for (const int node : edges.other_way[e])
      part_at_node[node] = part[e];
  std::vector<bool> is_notch(mesh::count_parts(part), false);
  for (const Edge& edge : edges.its_own_way)
    for (const int node : edge)
      if (const auto found = part_at_node.find(node); found != part_at_node.end())
        is_notch[found->second] = true;
  std::vector<Vec3> places;
  for (int p = 0; p < static_cast<int>(is_notch.size()); ++p) {
    Vec3 sum = Vec3::Zero();
    double count = 0.0;
    for (const auto& [node, of] : part_at_node)
      if (of == p) {
        sum += nodes[node];
        count += 1.0;
      }
    if (is_notch[p])
      places.emplace_back(sum / count);
  }
  return places;
}

}  // namespace lv::mesh_io
