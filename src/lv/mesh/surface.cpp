#include "lv/mesh/surface.hpp"

#include "lv/mesh/cell.hpp"

#include <Eigen/Geometry>
#include <boost/pending/disjoint_sets.hpp>

#include <algorithm>
#include <limits>
#include <map>
#include <utility>

namespace lv::mesh {
namespace {

struct FaceOfCell {
  FaceKey key;
  int cell;
  int face;
};

/// The nodes of a face of a cell, in the order of the outward normal.
std::vector<int> face_nodes(const Mesh& mesh, int cell, int face) {
  std::vector<int> nodes;
  for (const int a : cell_faces(mesh.kind)[face])
    if (a >= 0)
      nodes.push_back(mesh.cell(cell)[a]);
  return nodes;
}

/// All faces of all cells, those of the same nodes next to each other.
std::vector<FaceOfCell> sorted_faces(const Mesh& mesh) {
  std::vector<FaceOfCell> faces;
  const int per_cell = static_cast<int>(cell_faces(mesh.kind).size());
  faces.reserve(static_cast<std::size_t>(mesh.cell_count()) * per_cell);
  for (int c = 0; c < mesh.cell_count(); ++c)
    for (int f = 0; f < per_cell; ++f)
      faces.push_back({face_key(face_nodes(mesh, c, f)), c, f});
  std::sort(faces.begin(), faces.end(), [](const FaceOfCell& a, const FaceOfCell& b) {
    return std::tie(a.key, a.cell) < std::tie(b.key, b.cell);
  });
  return faces;
}

/// Sets that grow together, numbered from 0 in the order of their first members.
class Parts {
 public:
  explicit Parts(int members) : members_(members), sets_(members) {}

  void join(int a, int b) { sets_.union_set(a, b); }

  std::vector<int> numbers() {
    std::vector<int> part(members_);
    std::map<int, int> number_of_set;
    for (int i = 0; i < members_; ++i) {
      const auto next = static_cast<int>(number_of_set.size());
      part[i] = number_of_set.emplace(static_cast<int>(sets_.find_set(i)), next).first->second;
    }
    return part;
  }

 private:
  int members_;
  boost::disjoint_sets_with_storage<> sets_;
};

}  // namespace

FaceKey face_key(std::span<const int> face) {
  constexpr int after_all = std::numeric_limits<int>::max();
  FaceKey key{after_all, after_all, after_all, after_all};
  std::copy(face.begin(), face.end(), key.begin());
  // the optimal network for four numbers
  for (const auto& [i, j] : {std::pair{0, 1}, {2, 3}, {0, 2}, {1, 3}, {1, 2}})
    if (key[j] < key[i])
      std::swap(key[i], key[j]);
  if (key[3] == after_all)
    key[3] = -1;
  return key;
}

Surface boundary(const Mesh& mesh) {
  Surface surface;
  surface.nodes_per_face = mesh.kind == CellKind::hexahedron ? 4 : 3;
  const auto faces = sorted_faces(mesh);
  std::vector<FaceOfCell> single;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const bool as_before = i > 0 && faces[i - 1].key == faces[i].key;
    const bool as_after = i + 1 < faces.size() && faces[i + 1].key == faces[i].key;
    if (!as_before && !as_after)
      single.push_back(faces[i]);
  }
  std::sort(single.begin(), single.end(), [](const FaceOfCell& a, const FaceOfCell& b) {
    return std::tie(a.cell, a.face) < std::tie(b.cell, b.face);
  });
  for (const FaceOfCell& f : single)
    for (const int node : face_nodes(mesh, f.cell, f.face))
      surface.nodes.push_back(node);
  return surface;
}

std::vector<FaceKey> crowded_faces(const Mesh& mesh) {
  std::vector<FaceKey> crowded;
  const auto faces = sorted_faces(mesh);
  for (std::size_t i = 2; i < faces.size(); ++i) {
    const bool third = faces[i - 2].key == faces[i].key;
    if (third && (crowded.empty() || crowded.back() != faces[i].key))
      crowded.push_back(faces[i].key);
  }
  return crowded;
}

std::vector<int> cell_parts(const Mesh& mesh) {
  Parts parts(mesh.cell_count());
  const auto faces = sorted_faces(mesh);
  for (std::size_t i = 1; i < faces.size(); ++i)
    if (faces[i - 1].key == faces[i].key)
      parts.join(faces[i - 1].cell, faces[i].cell);
  return parts.numbers();
}

std::map<std::array<int, 2>, std::vector<int>> faces_at_edges(const Surface& surface) {
  std::map<std::array<int, 2>, std::vector<int>> faces;
  for (int f = 0; f < surface.size(); ++f) {
    const auto face = surface.face(f);
    for (std::size_t i = 0; i < face.size(); ++i) {
      const auto [a, b] = std::minmax(face[i], face[(i + 1) % face.size()]);
      faces[{a, b}].push_back(f);
    }
  }
  return faces;
}

std::vector<int> face_parts(const Surface& surface) {
  Parts parts(surface.size());
  for (const auto& [edge, faces] : faces_at_edges(surface))
    for (const int f : faces)
      parts.join(faces.front(), f);
  return parts.numbers();
}

std::vector<int> edge_parts(std::span<const std::array<int, 2>> edges) {
  std::map<int, int> edge_at_node;
  Parts parts(static_cast<int>(edges.size()));
  for (int e = 0; e < static_cast<int>(edges.size()); ++e) {
    for (const int node : edges[e]) {
      const auto [entry, added] = edge_at_node.emplace(node, e);
      if (!added)
        parts.join(entry->second, e);
    }
  }
  return parts.numbers();
}

std::vector<std::vector<std::array<int, 2>>> boundary_loops(const Surface& surface) {
  const auto edges = boundary_edges(surface);
  const std::vector<int> number = edge_parts(edges);
  std::vector<std::vector<std::array<int, 2>>> loops(count_parts(number));
  for (std::size_t e = 0; e < edges.size(); ++e)
    loops[number[e]].push_back(edges[e]);
  return loops;
}

int edge_loops(const Surface& surface) {
  return static_cast<int>(boundary_loops(surface).size());
}

int count_parts(const std::vector<int>& parts) {
  return parts.empty() ? 0 : 1 + *std::max_element(parts.begin(), parts.end());
}

Surface take_part(const Surface& surface, const std::vector<int>& parts, int part) {
  Surface taken;
  taken.nodes_per_face = surface.nodes_per_face;
  for (int f = 0; f < surface.size(); ++f)
    if (parts[f] == part)
      taken.nodes.insert(taken.nodes.end(), surface.face(f).begin(), surface.face(f).end());
  return taken;
}

Vec3 area_vector(std::span<const Vec3> nodes, std::span<const int> face) {
  Vec3 sum = Vec3::Zero();
  for_triangles(face, [&](int a, int b, int c) {
    sum += 0.5 * (nodes[b] - nodes[a]).cross(nodes[c] - nodes[a]);
  });
  return sum;
}

Vec3 face_centre(std::span<const Vec3> nodes, std::span<const int> face) {
  Vec3 sum = Vec3::Zero();
  for (const int node : face)
    sum += nodes[node];
  return sum / static_cast<double>(face.size());
}

double area(std::span<const Vec3> nodes, const Surface& surface) {
  double sum = 0.0;
  for (int f = 0; f < surface.size(); ++f)
    for_triangles(surface.face(f), [&](int a, int b, int c) {
      sum += 0.5 * (nodes[b] - nodes[a]).cross(nodes[c] - nodes[a]).norm();
    });
  return sum;
}

double signed_volume(std::span<const Vec3> nodes, const Surface& surface, const Vec3& about) {
  double six_V = 0.0;
  const auto add = [&](double weight, int a, int b, int c) {
    six_V += weight * (nodes[a] - about).dot((nodes[b] - about).cross(nodes[c] - about));
  };
  for (int f = 0; f < surface.size(); ++f) {
    const auto n = surface.face(f);
    if (n.size() == 3) {
      add(1.0, n[0], n[1], n[2]);
      continue;
    }
    add(0.5, n[0], n[1], n[2]);
    add(0.5, n[0], n[2], n[3]);
    add(0.5, n[0], n[1], n[3]);
    add(0.5, n[1], n[2], n[3]);
  }
  return six_V / 6.0;
}

}  // namespace lv::mesh
