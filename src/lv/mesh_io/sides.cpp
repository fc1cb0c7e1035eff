#include "lv/mesh_io/sides.hpp"

#include "lv/base/check.hpp"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <queue>
#include <set>

namespace lv::mesh_io {
namespace {

constexpr std::array<const char*, 3> side_names{"endocardium", "epicardium", "base"};
constexpr int base_side = 2;
constexpr int nowhere = -1;
constexpr const char* tag_sides = "Tag the sides in the file and set anatomy.mesh.sides = \"tags\"";

[[noreturn]] void fail(const ForeignMesh& foreign, const std::string& what,
                       const std::string& remedy) {
  throw InputError(foreign.files.front(), what, remedy);
}

/// For every face of the boundary the side it belongs to, or `nowhere`.
class TaggedFaces {
 public:
  TaggedFaces(const ForeignMesh& foreign, const mesh::Surface& boundary)
      : foreign_(foreign), boundary_(boundary), side_(boundary.size(), nowhere) {
    for (int f = 0; f < boundary.size(); ++f)
      face_of_key_[mesh::face_key(boundary.face(f))] = f;
    for (int s = 0; s < 3; ++s)
      mark_faces(s);
    mark_faces_of_nodes();
    if (overlaps_ > 0)
      fail(foreign_, overlap_, "Every face of the boundary must belong to one side");
    refuse_gaps();
  }

  [[nodiscard]] const std::vector<int>& sides() const { return side_; }

 private:
  void mark_faces(int s) {
    const auto& faces = foreign_.sides[s].faces;
    std::size_t strange = 0;
    for (const mesh::FaceKey& key : faces) {
      const auto found = face_of_key_.find(key);
      if (found == face_of_key_.end())
        ++strange;
      else
        mark(found->second, s);
    }
    if (strange > 0)
      fail(foreign_,
           fmt::format("{} of the {} faces tagged as {} are not faces of the wall's boundary",
                       strange, faces.size(), side_names[s]),
           "Tag outer faces of the volume cells, on the same nodes");
  }

  /// Faces that the file does not tag itself. Sets of nodes meet at the rim, so that a face of the
  /// base with all its corners there is in two of them: the rim's nodes lie in the base, and so
  /// does it.
  void mark_faces_of_nodes() {
    const std::vector<int> tagged = side_;
    const std::array<std::vector<bool>, 3> in_set{in_nodes_of(0), in_nodes_of(1), in_nodes_of(2)};
    for (int f = 0; f < boundary_.size(); ++f) {
      const auto is_in = [&](int s) {
        const auto face = boundary_.face(f);
        return std::all_of(face.begin(), face.end(), [&](int node) { return in_set[s][node]; });
      };
      if (tagged[f] != nowhere)
        continue;
      for (const int s : is_in(base_side) ? std::vector{base_side} : std::vector{0, 1})
        if (is_in(s))
          mark(f, s);
    }
  }

  [[nodiscard]] std::vector<bool> in_nodes_of(int s) const {
    std::vector<bool> in_set(foreign_.mesh.nodes.size(), false);
    for (const int node : foreign_.sides[s].nodes)
      in_set[node] = true;
    return in_set;
  }

  void mark(int f, int s) {
    if (side_[f] != nowhere && side_[f] != s && overlaps_++ == 0)
      overlap_ = fmt::format("the face at {} is tagged both as {} and as {}", place(f),
                             side_names[side_[f]], side_names[s]);
    side_[f] = s;
  }

  void refuse_gaps() const {
    const auto gaps = std::count(side_.begin(), side_.end(), nowhere);
    if (gaps == 0)
      return;
    const auto first = std::find(side_.begin(), side_.end(), nowhere) - side_.begin();
    fail(foreign_,
         fmt::format("{} of the {} boundary faces belong to no side, the first at {}", gaps,
                     boundary_.size(), place(static_cast<int>(first))),
         "Endocardium, epicardium and base must cover the boundary");
  }

  [[nodiscard]] std::string place(int f) const {
    return foreign_.format_place(mesh::face_centre(foreign_.mesh.nodes, boundary_.face(f)));
  }

  const ForeignMesh& foreign_;
  const mesh::Surface& boundary_;
  std::vector<int> side_;
  std::map<mesh::FaceKey, int> face_of_key_;
  int overlaps_ = 0;
  std::string overlap_;
};

/// For every face those that share an edge with it.
std::vector<std::vector<int>> face_neighbours(const mesh::Surface& surface) {
  std::vector<std::vector<int>> neighbours(surface.size());
  for (const auto& [edge, faces] : mesh::faces_at_edges(surface))
    for (const int f : faces)
      for (const int g : faces)
        if (f != g)
          neighbours[f].push_back(g);
  return neighbours;
}

/// Finds the largest flat part of the boundary.
class FlatPart {
 public:
  FlatPart(std::span<const Vec3> nodes, const mesh::Surface& boundary, double tolerance)
      : nodes_(nodes),
        boundary_(boundary),
        tolerance_(tolerance),
        neighbours_(face_neighbours(boundary)) {}

  [[nodiscard]] std::vector<bool> find() const {
    std::vector<int> last_seed(boundary_.size(), nowhere);
    std::vector<int> largest;
    double largest_area = 0.0;
    for (int seed = 0; seed < boundary_.size(); ++seed) {
      if (last_seed[seed] != nowhere)
        continue;  // part of a flat piece already
      const std::vector<int> faces = flat_faces_around(seed, last_seed);
      double part_area = 0.0;
      for (const int f : faces)
        part_area += mesh::area_vector(nodes_, boundary_.face(f)).norm();
      if (part_area > largest_area) {
        largest_area = part_area;
        largest = faces;
      }
    }
    return faces_in(plane_of(largest));
  }

 private:
  [[nodiscard]] bool lies_in(const mesh::Plane& plane, int f) const {
    const auto face = boundary_.face(f);
    return std::all_of(face.begin(), face.end(), [&](int node) {
      return std::abs(plane.height(nodes_[node])) <= tolerance_;
    });
  }

  /// The faces in the seed's plane that hang together with it; `last_seed` of each is set to it.
  [[nodiscard]] std::vector<int> flat_faces_around(int seed, std::vector<int>& last_seed) const {
    const mesh::Plane plane{mesh::face_centre(nodes_, boundary_.face(seed)),
                            mesh::area_vector(nodes_, boundary_.face(seed)).normalized()};
    std::vector<int> faces{seed};
    last_seed[seed] = seed;
    for (std::size_t i = 0; i < faces.size(); ++i) {
      for (const int f : neighbours_[faces[i]]) {
        if (last_seed[f] != seed && lies_in(plane, f)) {
          last_seed[f] = seed;
          faces.push_back(f);
        }
      }
    }
    return faces;
  }

  [[nodiscard]] mesh::Plane plane_of(const std::vector<int>& faces) const {
    std::vector<Vec3> points;
    for (const int f : faces)
      for (const int node : boundary_.face(f))
        points.push_back(nodes_[node]);
    return mesh::fit_plane(points);
  }

  [[nodiscard]] std::vector<bool> faces_in(const mesh::Plane& plane) const {
    std::vector<bool> flat;
    for (int f = 0; f < boundary_.size(); ++f)
      flat.push_back(lies_in(plane, f));
    return flat;
  }

  std::span<const Vec3> nodes_;
  const mesh::Surface& boundary_;
  double tolerance_;
  std::vector<std::vector<int>> neighbours_;
};

/// A face beside the base that looks the same way but does not lie in its plane would go to
/// endocardium or epicardium unnoticed.
void check_rim(const ForeignMesh& foreign, const mesh::Surface& all,
               const std::vector<bool>& is_base, const Vec3& up) {
  constexpr double nearly_parallel = 0.7;  // within 45 degrees
  const auto& nodes = foreign.mesh.nodes;
  const auto neighbours = face_neighbours(all);
  for (int f = 0; f < all.size(); ++f) {
    const bool beside =
        std::any_of(neighbours[f].begin(), neighbours[f].end(), [&](int g) { return is_base[g]; });
    const bool parallel =
        mesh::area_vector(nodes, all.face(f)).normalized().dot(up) > nearly_parallel;
    if (!is_base[f] && beside && parallel)
      fail(foreign,
           fmt::format("the base is not plane: the face at {} does not lie in the plane of those "
                       "beside it",
                       foreign.format_place(mesh::face_centre(nodes, all.face(f)))),
           fmt::format("{}, or raise anatomy.mesh.base_tolerance", tag_sides));
  }
}

using Loops = std::vector<std::vector<std::array<int, 2>>>;

Vec3 middle_of_shortest(std::span<const Vec3> nodes, const Loops& loops) {
  Vec3 middle = Vec3::Zero();
  double shortest = std::numeric_limits<double>::infinity();
  for (const auto& loop : loops) {
    Vec3 moment = Vec3::Zero();
    double length = 0.0;
    for (const auto& [a, b] : loop) {
      const double piece = (nodes[b] - nodes[a]).norm();
      moment += 0.5 * piece * (nodes[a] + nodes[b]);
      length += piece;
    }
    if (length < shortest) {
      shortest = length;
      middle = moment / length;
    }
  }
  return middle;
}

void check_shape(const ForeignMesh& foreign, const mesh::Surface& side, const std::string& name,
                 int loops) {
  if (side.size() == 0)
    fail(foreign, fmt::format("no face of the boundary belongs to the {}", name),
         "Check what its tag holds");
  const int parts = mesh::count_parts(mesh::face_parts(side));
  if (parts > 1)
    fail(foreign, fmt::format("the {} consists of {} unconnected parts", name, parts),
         "It must be one surface; check its tag, and the mesh for holes");
  const auto found = mesh::boundary_loops(side);
  const int count = static_cast<int>(found.size());
  if (count != loops)
    fail(foreign,
         fmt::format("the {} has {} closed edges instead of {}{}", name, count, loops,
                     count > loops ? fmt::format(", the shortest around {}",
                                                 foreign.format_place(
                                                     middle_of_shortest(foreign.mesh.nodes, found)))
                                   : ""),
         "The wall must be closed at the apex and have one opening, the base");
}

/// Holes through a wall whose boundary hangs together: the handles of that surface, by Euler's
/// formula for the vertices, edges and faces of a closed surface, V - E + F = 2 - 2 holes.
int count_holes(const mesh::Surface& boundary) {
  std::set<std::pair<int, int>> edges;
  for (int f = 0; f < boundary.size(); ++f) {
    const auto face = boundary.face(f);
    for (std::size_t i = 0; i < face.size(); ++i)
      edges.insert(std::minmax(face[i], face[(i + 1) % face.size()]));
  }
  const int vertices = static_cast<int>(mesh::surface_nodes(boundary).size());
  return (2 - (vertices - static_cast<int>(edges.size()) + boundary.size())) / 2;
}

/// For every face which of two edges of the surface is nearer along it, by the faces' centres.
std::vector<int> nearer_edges(std::span<const Vec3> nodes, const mesh::Surface& surface,
                              const std::array<std::vector<bool>, 2>& is_on_edge) {
  struct Reached {
    double distance;
    int face, edge;
    bool operator>(const Reached& other) const { return distance > other.distance; }
  };
  std::priority_queue<Reached, std::vector<Reached>, std::greater<>> front;
  for (int f = 0; f < surface.size(); ++f)
    for (int e = 0; e < 2; ++e)
      for (const int node : surface.face(f))
        if (is_on_edge[e][node])
          front.push({0.0, f, e});
  const auto neighbours = face_neighbours(surface);
  std::vector<int> edge(surface.size(), nowhere);
  while (!front.empty()) {
    const Reached now = front.top();
    front.pop();
    if (edge[now.face] != nowhere)
      continue;
    edge[now.face] = now.edge;
    const Vec3 centre = mesh::face_centre(nodes, surface.face(now.face));
    for (const int f : neighbours[now.face])
      front.push({now.distance + (mesh::face_centre(nodes, surface.face(f)) - centre).norm(), f,
                  now.edge});
  }
  return edge;
}

/// Where, away from the base, the two sides of a wall hang together: what is nearer to the inner
/// edge of the base meets there what is nearer to the outer. Nothing where the base is no ring.
std::optional<Vec3> place_of_hole(std::span<const Vec3> nodes, const mesh::Surface& rest) {
  const auto edges = mesh::boundary_loops(rest);
  if (edges.size() != 2)
    return {};
  std::array<std::vector<bool>, 2> is_on_edge;
  for (std::size_t e = 0; e < 2; ++e) {
    is_on_edge[e].assign(nodes.size(), false);
    for (const auto& piece : edges[e])
      for (const int node : piece)
        is_on_edge[e][node] = true;
  }
  const mesh::Surface one = mesh::take_part(rest, nearer_edges(nodes, rest, is_on_edge), 0);
  Loops fronts = mesh::boundary_loops(one);
  std::erase_if(fronts, [&](const auto& loop) { return is_on_edge[0][loop.front()[0]]; });
  if (fronts.empty())
    return {};
  return middle_of_shortest(nodes, fronts);
}

/// Why what is left of the boundary beside the base is not endocardium and epicardium.
[[noreturn]] void fail_division(const ForeignMesh& foreign, const mesh::Surface& all,
                                const mesh::Surface& base, const mesh::Surface& rest,
                                const std::vector<int>& parts) {
  const auto& nodes = foreign.mesh.nodes;
  const int count = mesh::count_parts(parts);
  for (int p = 0; p < count; ++p)
    if (const mesh::Surface part = mesh::take_part(rest, parts, p); mesh::edge_loops(part) == 0)
      fail(foreign,
           fmt::format("the wall has a void near {}: a part of the boundary is closed in itself",
                       foreign.format_place(mesh::face_centre(nodes, part.face(0)))),
           "Put in the elements that are missing there");
  const std::string flat = fmt::format(
      "the flat part of the boundary (centre {}, area {:.3g} mm^2)",
      foreign.format_place(outward_plane(foreign, base).point), mesh::area(nodes, base));
  const int holes = count == 1 ? count_holes(all) : 0;
  if (holes > 0) {
    const std::optional<Vec3> place = place_of_hole(nodes, rest);
    fail(foreign,
         fmt::format("the wall has {}{}: endocardium and epicardium hang together there, and not "
                     "across the base alone, for which {} is taken",
                     holes == 1 ? "a hole" : fmt::format("{} holes", holes),
                     place ? fmt::format("{} near {}", holes == 1 ? "" : ", one",
                                         foreign.format_place(*place))
                           : "",
                     flat),
         fmt::format("Put in the elements that are missing. If the base is another part: {}",
                     tag_sides));
  }
  fail(
      foreign,
      fmt::format("{} does not divide the rest into endocardium and epicardium, but into {} part{}",
                  flat, count, count == 1 ? "" : "s"),
      fmt::format("{}, or raise anatomy.mesh.base_tolerance if the base is not quite flat",
                  tag_sides));
}

}  // namespace

Sides tagged_sides(const ForeignMesh& foreign) {
  const mesh::Surface all = mesh::boundary(foreign.mesh);
  const std::vector<int> side = TaggedFaces(foreign, all).sides();
  return {mesh::take_part(all, side, 0), mesh::take_part(all, side, 1),
          mesh::take_part(all, side, 2)};
}

Sides sides_by_geometry(const ForeignMesh& foreign, double tolerance) {
  const mesh::Surface all = mesh::boundary(foreign.mesh);
  const auto& nodes = foreign.mesh.nodes;
  const std::vector<bool> flat = FlatPart(nodes, all, tolerance).find();
  const std::vector<int> is_base(flat.begin(), flat.end());
  const mesh::Surface base = mesh::take_part(all, is_base, 1);
  const mesh::Surface rest = mesh::take_part(all, is_base, 0);
  const std::vector<int> parts = mesh::face_parts(rest);
  if (mesh::count_parts(parts) != 2)
    fail_division(foreign, all, base, rest, parts);
  const mesh::Plane plane = outward_plane(foreign, base);
  check_rim(foreign, all, flat, plane.normal);
  mesh::Surface first = mesh::take_part(rest, parts, 0);
  mesh::Surface second = mesh::take_part(rest, parts, 1);
  if (mesh::signed_volume(nodes, first, plane.point) > signed_volume(nodes, second, plane.point))
    std::swap(first, second);
  return {first, second, base};
}

void check_sides(const ForeignMesh& foreign, const Sides& sides) {
  for (int s = 0; s < 3; ++s)
    check_shape(foreign, sides[s], side_names[s], s == 2 ? 2 : 1);
  const auto& [endo, epi, base] = sides;
  const std::vector<int> inner = mesh::surface_nodes(endo);
  for (const int node : mesh::surface_nodes(epi))
    if (std::binary_search(inner.begin(), inner.end(), node))
      throw InputError(
          foreign.where_node(node),
          fmt::format("endocardium and epicardium meet at {}", foreign.name_node(node)),
          "The wall must have a thickness everywhere");
  const Vec3 centre = outward_plane(foreign, base).point;
  if (mesh::signed_volume(foreign.mesh.nodes, endo, centre) > 0.0)
    fail(foreign, "the endocardium's normals point away from the cavity",
         "Are the tags of endocardium and epicardium exchanged?");
}

mesh::Plane outward_plane(const ForeignMesh& foreign, const mesh::Surface& side) {
  std::vector<Vec3> points;
  for (const int node : mesh::surface_nodes(side))
    points.push_back(foreign.mesh.nodes[node]);
  mesh::Plane plane = mesh::fit_plane(points);
  Vec3 centre = Vec3::Zero();
  for (const Vec3& X : foreign.mesh.nodes)
    centre += X / static_cast<double>(foreign.mesh.nodes.size());
  if (plane.height(centre) > 0.0)
    plane.normal = -plane.normal;
  return plane;
}

}  // namespace lv::mesh_io
