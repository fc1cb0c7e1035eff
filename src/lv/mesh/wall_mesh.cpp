#include "lv/mesh/wall_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lv::mesh {
namespace {

using std::numbers::pi;
constexpr int meridian_samples = 400;
constexpr int angle_samples = 24;

/// Linear interpolation of y(x) in a table with ascending x.
double interpolate(const std::vector<double>& x, const std::vector<double>& y, double at) {
  const auto upper = std::upper_bound(x.begin() + 1, x.end() - 1, at) - x.begin();
  const double w = (at - x[upper - 1]) / (x[upper] - x[upper - 1]);
  return (1.0 - w) * y[upper - 1] + w * y[upper];
}

/// From [0, 1] to itself with this slope at 0: s (slope + (1 - slope) s).
double graded(double s, double slope) {
  return s * (slope + (1.0 - slope) * s);
}

/// The mean meridian of the middle surface, from apex to base.
struct Meridian {
  std::vector<double> u;         ///< wall coordinate
  std::vector<double> length;    ///< arc length from the apex [mm]
  std::vector<double> radius;    ///< mean distance from the long axis [mm]
  std::vector<double> latitude;  ///< conformal latitude: d(latitude) = d(length)/radius
  double thickness = 0.0;        ///< mean, along straight lines of constant (u, theta)
};

Meridian mean_meridian(const WallMap& wall) {
  Meridian m;
  const int n = meridian_samples;
  m.u.resize(n + 1);
  m.length.assign(n + 1, 0.0);
  m.radius.assign(n + 1, 0.0);
  m.latitude.assign(n + 1, 0.0);
  for (int a = 0; a < angle_samples; ++a) {
    const double theta = 2.0 * pi * a / angle_samples;
    Vec3 previous = wall(0.0, theta, 0.5);
    double length = 0.0;
    for (int i = 0; i <= n; ++i) {
      const double u = static_cast<double>(i) / n;
      const Vec3 x = wall(u, theta, 0.5);
      length += (x - previous).norm();
      previous = x;
      m.u[i] = u;
      m.length[i] += length / angle_samples;
      m.radius[i] += std::hypot(x.x(), x.y()) / angle_samples;
      m.thickness += (wall(u, theta, 1.0) - wall(u, theta, 0.0)).norm() / (angle_samples * (n + 1));
    }
  }
  // Near the apex radius = length, so the latitude starts as log(length) there.
  m.latitude[1] = std::log(m.length[1]);
  for (int i = 2; i <= n; ++i)
    m.latitude[i] =
        m.latitude[i - 1] + (m.length[i] - m.length[i - 1]) * 2.0 / (m.radius[i] + m.radius[i - 1]);
  m.latitude[0] = m.latitude[1] - 20.0;
  return m;
}

/// Numbers of elements: `side` along each side of the apical patch, `rows` from the patch to the
/// base, `layers` through the wall; and the arc length from the apex to the middle of a side of the
/// patch.
struct Counts {
  int side, rows, layers;
  double patch;
};

Counts count_elements(const Meridian& m, const WallMeshParameters& p) {
  const double widest = 2.0 * pi * *std::max_element(m.radius.begin(), m.radius.end());
  Counts c{};
  c.side = std::max(2, 2 * static_cast<int>(std::lround(
                               widest / (8.0 * p.edge_length))));  // even: a node at the apex
  c.patch = std::min(0.5 * c.side * p.edge_length, 0.45 * m.length.back());
  c.rows =
      std::max(2, static_cast<int>(std::lround((m.length.back() - 1.1 * c.patch) / p.edge_length)));
  c.layers = p.layers > 0 ? p.layers
                          : std::max(3, static_cast<int>(std::lround(m.thickness / p.edge_length)));
  if (p.order == 2) {
    c.rows += c.rows % 2;
    c.layers += c.layers % 2;
  }
  return c;
}

/// A point of the middle surface in wall coordinates.
struct SurfacePoint {
  double u, theta;
};

/// The quadrilateral mesh of the middle surface: patch first, then row after row towards the base.
struct QuadMesh {
  std::vector<SurfacePoint> points;
  std::vector<std::array<int, 4>> quads;  ///< anticlockwise seen from outside
  std::vector<int> base_ring;             ///< points on the base, in order
};

class QuadMesher {
 public:
  QuadMesher(const Meridian& m, const Counts& c, int order) : m_(m), c_(c), order_(order) {
    // On the sphere the middle of a side of the cube's face lies 45 degrees from the pole.
    offset_ = std::log(std::tan(pi / 8.0)) - interpolate(m.length, m.latitude, c.patch);
  }

  QuadMesh mesh() {
    add_patch();
    std::vector<int> ring = patch_boundary();
    const std::vector<int> start = ring;
    for (int row = 1; row <= c_.rows; ++row)
      ring = add_row(start, ring, row);
    mesh_.base_ring = ring;
    if (order_ == 2)
      mesh_.quads = grouped(mesh_.quads);
    return std::move(mesh_);
  }

 private:
  /// The quadrilaterals in groups of four, the quarters of one: first the two along a
  /// quadrilateral's first side, then the two beyond. Even counts only.
  [[nodiscard]] std::vector<std::array<int, 4>> grouped(
      const std::vector<std::array<int, 4>>& quads) const {
    std::vector<std::array<int, 4>> result;
    const int n = c_.side;
    for (int j = 0; j < n; j += 2)
      for (int i = 0; i < n; i += 2)
        for (const int q : {j * n + i, (j + 1) * n + i, j * n + i + 1, (j + 1) * n + i + 1})
          result.push_back(quads[q]);
    const int ring = 4 * n;
    for (int row = 0; row < c_.rows; row += 2) {
      for (int i = 0; i < ring; i += 2) {
        const int first = n * n + row * ring + i;
        for (const int q : {first, first + 1, first + ring, first + ring + 1})
          result.push_back(quads[q]);
      }
    }
    return result;
  }

  /// The wall coordinate at angle `phi` from the sphere's pole.
  [[nodiscard]] double u_at(double phi) const {
    if (phi <= 0.0)
      return 0.0;
    return interpolate(m_.latitude, m_.u, std::log(std::tan(0.5 * phi)) - offset_);
  }

  [[nodiscard]] int patch_point(int i, int j) const { return j * (c_.side + 1) + i; }

  void add_patch() {
    const int n = c_.side;
    for (int j = 0; j <= n; ++j) {
      for (int i = 0; i <= n; ++i) {
        const double x = std::tan(pi / 4.0 * (2.0 * i / n - 1.0));
        const double y = std::tan(pi / 4.0 * (2.0 * j / n - 1.0));
        mesh_.points.push_back({u_at(std::atan(std::hypot(x, y))), std::atan2(y, x)});
      }
    }
    // Seen from outside (below the apex) the patch turns clockwise: x to y with theta.
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
        mesh_.quads.push_back({patch_point(i, j), patch_point(i, j + 1), patch_point(i + 1, j + 1),
                               patch_point(i + 1, j)});
  }

  /// The patch's outermost points, anticlockwise as seen from the base.
  [[nodiscard]] std::vector<int> patch_boundary() const {
    const int n = c_.side;
    std::vector<int> ring;
    for (int i = 0; i < n; ++i)
      ring.push_back(patch_point(i, 0));
    for (int j = 0; j < n; ++j)
      ring.push_back(patch_point(n, j));
    for (int i = n; i > 0; --i)
      ring.push_back(patch_point(i, n));
    for (int j = n; j > 0; --j)
      ring.push_back(patch_point(0, j));
    return ring;
  }

  /// One more row of points at equal distances along each meridian from the patch to the base.
  std::vector<int> add_row(const std::vector<int>& start, const std::vector<int>& below, int row) {
    std::vector<int> ring;
    const double fraction = static_cast<double>(row) / c_.rows;
    for (const int p : start) {
      const SurfacePoint from = mesh_.points[p];
      const double s0 = interpolate(m_.u, m_.length, from.u);
      const double s = (1.0 - fraction) * s0 + fraction * m_.length.back();
      const double u = row == c_.rows ? 1.0 : interpolate(m_.length, m_.u, s);
      ring.push_back(static_cast<int>(mesh_.points.size()));
      mesh_.points.push_back({u, from.theta});
    }
    const std::size_t n = ring.size();
    for (std::size_t i = 0; i < n; ++i)
      mesh_.quads.push_back({below[i], below[(i + 1) % n], ring[(i + 1) % n], ring[i]});
    return ring;
  }

  const Meridian& m_;
  Counts c_;
  int order_;
  double offset_ = 0.0;
  QuadMesh mesh_;
};

/// Nine points of a quadratic side, row after row; its first direction is along a row.
using Lattice = std::array<int, 9>;

/// The points of four quadrilaterals as QuadMesher groups them.
Lattice lattice(const std::array<int, 4>* q) {
  return {q[0][0], q[0][1], q[1][1], q[0][3], q[0][2], q[1][2], q[2][3], q[2][2], q[3][2]};
}

/// The four quarters of a side, as refine() orders them; `mirrored` turns the normal round.
void add_side(const Lattice& p, bool mirrored, std::vector<int>& faces) {
  const std::array<int, 8> straight{0, 1, 2, 5, 8, 7, 6, 3};  // corners and middles in turn
  const std::array<int, 8> other{0, 3, 6, 7, 8, 5, 2, 1};
  const auto& round = mirrored ? other : straight;
  for (int i = 0; i < 4; ++i)
    for (const int at : {round[2 * i], round[2 * i + 1], 4, round[(2 * i + 7) % 8]})
      faces.push_back(p[at]);
}

/// Stacks the quadrilaterals through the wall.
class Extrusion {
 public:
  Extrusion(const QuadMesh& quads, const WallMap& wall, int layers,
            const WallMeshParameters& parameters)
      : quads_(quads), layers_(layers), per_layer_(static_cast<int>(quads.points.size())) {
    mesh_.order = parameters.order;
    add_nodes(wall, parameters);
    parameters.order == 2 ? add_quadratic() : add_linear();
    mesh_.infarct.assign(mesh_.nodes.size(), 0.0);
  }

  Mesh mesh() { return std::move(mesh_); }

 private:
  [[nodiscard]] int node(int layer, int point) const { return layer * per_layer_ + point; }
  [[nodiscard]] int ring_node(int layer, std::size_t i) const {
    return node(layer, quads_.base_ring[i % quads_.base_ring.size()]);
  }

  void add_nodes(const WallMap& wall, const WallMeshParameters& parameters) {
    for (int l = 0; l <= layers_; ++l) {
      const double t = graded(static_cast<double>(l) / layers_, parameters.endocardium);
      for (const SurfacePoint& p : quads_.points) {
        mesh_.nodes.push_back(wall(graded(p.u, parameters.apex), p.theta, t));
        mesh_.transmural.push_back(t);
      }
    }
    for (const int p : quads_.base_ring)
      for (int l = 0; l <= layers_; ++l)
        mesh_.nodes[node(l, p)].z() = 0.0;  // rounding off
  }

  void add_cell(const std::array<int, 4>& quad, int layer) {
    for (const int l : {layer, layer + 1})
      for (const int p : quad)
        mesh_.cells.push_back(node(l, p));
  }

  void add_linear() {
    for (int l = 0; l < layers_; ++l)
      for (const auto& q : quads_.quads)
        add_cell(q, l);
    for (const auto& q : quads_.quads) {
      for (int i = 3; i >= 0; --i)
        mesh_.endo.nodes.push_back(q[i]);
      for (const int p : q)
        mesh_.epi.nodes.push_back(node(layers_, p));
    }
    for (int l = 0; l < layers_; ++l)
      for (std::size_t i = 0; i < quads_.base_ring.size(); ++i)
        mesh_.base.nodes.insert(
            mesh_.base.nodes.end(),
            {ring_node(l, i), ring_node(l + 1, i), ring_node(l + 1, i + 1), ring_node(l, i + 1)});
  }

  void add_quadratic() {
    for (int l = 0; l < layers_; l += 2)
      for (std::size_t first = 0; first < quads_.quads.size(); first += 4)
        for (const int layer : {l, l + 1})
          for (std::size_t q = first; q < first + 4; ++q)
            add_cell(quads_.quads[q], layer);
    for (std::size_t first = 0; first < quads_.quads.size(); first += 4) {
      Lattice side = lattice(&quads_.quads[first]);
      add_side(side, true, mesh_.endo.nodes);
      for (int& p : side)
        p = node(layers_, p);
      add_side(side, false, mesh_.epi.nodes);
    }
    for (int l = 0; l < layers_; l += 2) {
      for (std::size_t i = 0; i < quads_.base_ring.size(); i += 2) {
        Lattice side{};
        for (int k = 0; k < 9; ++k)
          side[k] = ring_node(l + k % 3, i + k / 3);
        add_side(side, false, mesh_.base.nodes);
      }
    }
  }

  const QuadMesh& quads_;
  int layers_, per_layer_;
  Mesh mesh_;
};

}  // namespace

Mesh wall_mesh(const WallMap& wall, const WallMeshParameters& parameters) {
  const Meridian meridian = mean_meridian(wall);
  const Counts counts = count_elements(meridian, parameters);
  const QuadMesh quads = QuadMesher(meridian, counts, parameters.order).mesh();
  return Extrusion(quads, wall, counts.layers, parameters).mesh();
}

}  // namespace lv::mesh
