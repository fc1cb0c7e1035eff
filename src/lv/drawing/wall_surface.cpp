#include "lv/drawing/wall_surface.hpp"

#include "lv/base/check.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <map>

namespace lv::drawing {
namespace {

using Edge = std::array<int, 2>;

/// The edges of a cell as pairs of its corners.
std::span<const Edge> cell_edges(mesh::CellKind kind) {
  static constexpr std::array<Edge, 12> hexahedron{{{0, 1},
                                                    {1, 2},
                                                    {2, 3},
                                                    {3, 0},
                                                    {4, 5},
                                                    {5, 6},
                                                    {6, 7},
                                                    {7, 4},
                                                    {0, 4},
                                                    {1, 5},
                                                    {2, 6},
                                                    {3, 7}}};
  static constexpr std::array<Edge, 6> tetrahedron{
      {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}};
  return kind == mesh::CellKind::hexahedron ? std::span<const Edge>(hexahedron)
                                            : std::span<const Edge>(tetrahedron);
}

/// A patch in the making: polygons as fans of triangles, each in a group that is outlined as one.
class Polygons {
 public:
  explicit Polygons(WallPatch& wall) : wall_(wall) {}

  void add(std::span<const int> corners, int cell, int group) {
    for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
      wall_.patch.triangles.push_back({corners[0], corners[i], corners[i + 1]});
      wall_.cells.push_back(cell);
      groups_.push_back(group);
    }
  }

  /// Sides between two triangles of one group lie within it; all others are outlined.
  void outline() {
    std::map<Edge, std::vector<int>> around;
    for (std::size_t t = 0; t < groups_.size(); ++t)
      for (int i = 0; i < 3; ++i)
        around[side(t, i)].push_back(groups_[t]);
    for (std::size_t t = 0; t < groups_.size(); ++t) {
      auto& outlined = wall_.patch.outlined.emplace_back();
      for (int i = 0; i < 3; ++i) {
        const auto& both = around.at(side(t, i));
        outlined.at(i) = both.size() != 2 || both[0] != both[1];
      }
    }
  }

 private:
  [[nodiscard]] Edge side(std::size_t triangle, int i) const {
    const auto& corners = wall_.patch.triangles[triangle];
    return {std::min(corners.at(i), corners.at((i + 1) % 3)),
            std::max(corners.at(i), corners.at((i + 1) % 3))};
  }

  WallPatch& wall_;
  std::vector<int> groups_;
};

/// The cells around each node.
std::vector<std::vector<int>> cells_of_nodes(const mesh::Mesh& mesh) {
  std::vector<std::vector<int>> cells(mesh.nodes.size());
  for (int c = 0; c < mesh.cell_count(); ++c)
    for (const int node : mesh.cell(c))
      cells[node].push_back(c);
  return cells;
}

/// The cell around all nodes of a face.
int cell_behind(std::span<const int> face, const std::vector<std::vector<int>>& cells_of) {
  const auto has = [&](int node, int cell) {
    return std::find(cells_of[node].begin(), cells_of[node].end(), cell) != cells_of[node].end();
  };
  const auto& candidates = cells_of[face[0]];
  const auto cell = std::find_if(candidates.begin(), candidates.end(), [&](int c) {
    return std::all_of(face.begin(), face.end(), [&](int node) { return has(node, c); });
  });
  LV_CHECK(cell != candidates.end());
  return *cell;
}

/// Cuts cells by a plane; each edge of the mesh is cut once.
class Cutter {
 public:
  Cutter(const mesh::Mesh& mesh, std::span<const Vec3> positions, const Plane& plane)
      : mesh_(mesh), positions_(positions), normal_(plane.normal.normalized()) {
    along_ = normal_.unitOrthogonal();
    across_ = normal_.cross(along_);
    for (const Vec3& x : positions)
      height_.push_back(plane.height(x));
  }

  WallPatch section(int outlined_together) {
    Polygons polygons(wall_);
    for (int c = 0; c < mesh_.cell_count(); ++c) {
      std::vector<int> corners = crossings(mesh_.cell(c));
      sort_around_centre(corners);
      polygons.add(corners, c, c / outlined_together);
    }
    polygons.outline();
    return std::move(wall_);
  }

 private:
  /// The points where the plane meets the cell's edges. A node in the plane counts as above it.
  std::vector<int> crossings(std::span<const int> cell) {
    std::vector<int> found;
    for (const auto& [i, j] : cell_edges(mesh_.kind)) {
      const Edge edge{std::min(cell[i], cell[j]), std::max(cell[i], cell[j])};
      if ((height_[edge[0]] < 0.0) != (height_[edge[1]] < 0.0))
        found.push_back(crossing(edge));
    }
    return found;
  }

  int crossing(const Edge& edge) {
    const auto [entry, is_new] = points_.try_emplace(edge, static_cast<int>(points_.size()));
    if (is_new) {
      const auto [a, b] = edge;
      const double w = height_[a] / (height_[a] - height_[b]);
      wall_.origins.push_back({a, b, w});
      wall_.patch.points.emplace_back((1.0 - w) * positions_[a] + w * positions_[b]);
    }
    return entry->second;
  }

  /// The section of a convex cell is convex: its corners in order of their angle.
  void sort_around_centre(std::vector<int>& corners) const {
    Vec3 centre = Vec3::Zero();
    for (const int p : corners)
      centre += wall_.patch.points[p] / static_cast<double>(corners.size());
    const auto angle = [&](int p) {
      const Vec3 arm = wall_.patch.points[p] - centre;
      return std::atan2(arm.dot(across_), arm.dot(along_));
    };
    std::sort(corners.begin(), corners.end(), [&](int p, int q) { return angle(p) < angle(q); });
  }

  const mesh::Mesh& mesh_;
  std::span<const Vec3> positions_;
  Vec3 normal_, along_, across_;
  std::vector<double> height_;
  std::map<Edge, int> points_;
  WallPatch wall_;
};

}  // namespace

WallPatch wall_surface(const mesh::Mesh& mesh, std::span<const Vec3> positions,
                       const mesh::Surface& side, int outlined_together) {
  WallPatch wall;
  Polygons polygons(wall);
  const auto cells_of = cells_of_nodes(mesh);
  std::map<int, int> points;
  for (int f = 0; f < side.size(); ++f) {
    std::vector<int> corners;
    for (const int node : side.face(f)) {
      const auto [entry, is_new] = points.try_emplace(node, static_cast<int>(points.size()));
      if (is_new) {
        wall.origins.push_back({node, node, 0.0});
        wall.patch.points.push_back(positions[node]);
      }
      corners.push_back(entry->second);
    }
    polygons.add(corners, cell_behind(side.face(f), cells_of), f / outlined_together);
  }
  polygons.outline();
  return wall;
}

WallPatch wall_section(const mesh::Mesh& mesh, std::span<const Vec3> positions, const Plane& plane,
                       int outlined_together) {
  return Cutter(mesh, positions, plane).section(outlined_together);
}

}  // namespace lv::drawing
