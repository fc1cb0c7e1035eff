#include "lv/activation/front.hpp"

#include "lv/base/check.hpp"
#include "lv/mesh/cell.hpp"

#include <Eigen/LU>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <queue>
#include <utility>

namespace lv::activation {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();

/// A place where the time is known.
struct Known {
  Vec3 x = Vec3::Zero();
  double time = 0.0;
};

/// The first arrival at x over the inside of the simplex of `n` places, between which the time is
/// linear; never, if the first way leads over its edge.
///
/// The way's end y = y_0 + E c minimises T_0 + Delta.c + |x - y|. With A = E^T G E and the part r
/// of x - y_0 that is normal to E, both in the metric G,
///
///   c = A^-1 (E^T G (x - y_0) - rho Delta),  rho^2 = r.G r/(1 - Delta.A^-1 Delta),  T = T_0 + Delta.c + rho
template <int n>
double arrival_inside(const Vec3& x, const std::array<Known, n>& from, const Mat3& G) {
  Eigen::Matrix<double, 3, n - 1> E;
  Eigen::Matrix<double, n - 1, 1> Delta;
  for (int i = 1; i < n; ++i) {
    E.col(i - 1) = from[i].x - from[0].x;
    Delta[i - 1] = from[i].time - from[0].time;
  }
  const Vec3 d = x - from[0].x;
  const Eigen::Matrix<double, n - 1, n - 1> A_inverse = (E.transpose() * G * E).inverse();
  const double slope = Delta.dot(A_inverse * Delta);
  if (!(slope < 1.0))  // the times of the places differ by more than the way between them
    return never;
  const Eigen::Matrix<double, n - 1, 1> foot = A_inverse * (E.transpose() * (G * d));
  const Vec3 r = d - E * foot;
  const double rho = std::sqrt(r.dot(G * r) / (1.0 - slope));
  const Eigen::Matrix<double, n - 1, 1> c = foot - rho * (A_inverse * Delta);
  if (!(c.minCoeff() >= 0.0 && c.sum() <= 1.0))
    return never;
  return from[0].time + Delta.dot(c) + rho;
}

double arrival_from(const Vec3& x, const Known& from, const Mat3& G) {
  const Vec3 d = x - from.x;
  return from.time + std::sqrt(d.dot(G * d));
}

/// A corner of a cell with a triangle across the cell from it, as local numbers of nodes.
struct Across {
  int corner;
  std::array<int, 3> triangle;
};

/// All of a kind of cell; a quadrilateral across is cut along both diagonals.
std::vector<Across> triangles_across(mesh::CellKind kind) {
  std::vector<Across> all;
  for (int corner = 0; corner < mesh::nodes_per_cell(kind); ++corner)
    for (const mesh::LocalFace& face : mesh::cell_faces(kind)) {
      if (std::find(face.begin(), face.end(), corner) != face.end())
        continue;
      all.push_back({corner, {face[0], face[1], face[2]}});
      if (face[3] < 0)
        continue;
      all.push_back({corner, {face[0], face[2], face[3]}});
      all.push_back({corner, {face[0], face[1], face[3]}});
      all.push_back({corner, {face[1], face[2], face[3]}});
    }
  return all;
}

/// For each node the cells, or faces, that it belongs to.
std::vector<std::vector<int>> around_nodes(std::size_t nodes, std::span<const int> parts,
                                           int nodes_per_part) {
  std::vector<std::vector<int>> around(nodes);
  for (std::size_t i = 0; i < parts.size(); ++i)
    around[parts[i]].push_back(static_cast<int>(i) / nodes_per_part);
  return around;
}

class Front {
 public:
  Front(const mesh::Mesh& mesh, std::span<const Mat3> metrics, const Speeds& speeds)
      : mesh_(mesh),
        metrics_(metrics),
        across_(triangles_across(mesh.kind)),
        cells_(around_nodes(mesh.nodes.size(), mesh.cells, mesh::nodes_per_cell(mesh.kind))),
        times_(mesh.nodes.size(), never) {
    if (speeds.endocardium > 0.0) {
      surface_metric_ = Mat3::Identity() / (speeds.endocardium * speeds.endocardium);
      faces_ = around_nodes(mesh.nodes.size(), mesh.endo.nodes, mesh.endo.nodes_per_face);
    }
  }

  std::vector<double> spread(std::span<const Start> starts) {
    for (const Start& start : starts)
      arrive(start.node, start.time);
    while (!waiting_.empty()) {
      const auto [time, node] = waiting_.top();
      waiting_.pop();
      if (time == times_[node])  // else it was reached sooner
        pass_on(node);
    }
    return std::move(times_);
  }

 private:
  using Waiting = std::pair<double, int>;  ///< time and node

  [[nodiscard]] Known known(int node) const { return {mesh_.nodes[node], times_[node]}; }

  void arrive(int node, double time) {
    constexpr double rounding = 1e-12;
    if (!(time < times_[node] * (1.0 - rounding)))
      return;
    times_[node] = time;
    waiting_.emplace(time, node);
  }

  void pass_on(int node) {
    for (const int c : cells_[node])
      pass_through_cell(c, node);
    if (!faces_.empty())
      for (const int f : faces_[node])
        pass_along_face(f, node);
  }

  void pass_through_cell(int c, int node) {
    const auto nodes = mesh_.cell(c);
    for (const Across& a : across_) {
      std::array<int, 3> triangle{nodes[a.triangle[0]], nodes[a.triangle[1]], nodes[a.triangle[2]]};
      const auto at = std::find(triangle.begin(), triangle.end(), node);
      if (at == triangle.end())
        continue;
      std::iter_swap(at, triangle.begin());
      const int to = nodes[a.corner];
      arrive(to, over_triangle(mesh_.nodes[to], triangle, metrics_[c]));
    }
  }

  /// The first arrival over the triangle, and over those of its edges that its first node has.
  [[nodiscard]] double over_triangle(const Vec3& x, const std::array<int, 3>& nodes,
                                     const Mat3& G) const {
    const std::array<Known, 3> from{known(nodes[0]), known(nodes[1]), known(nodes[2])};
    double first = arrival_from(x, from[0], G);
    const bool reached_1 = from[1].time < never;
    const bool reached_2 = from[2].time < never;
    if (reached_1)
      first = std::min(first, arrival_inside<2>(x, {from[0], from[1]}, G));
    if (reached_2)
      first = std::min(first, arrival_inside<2>(x, {from[0], from[2]}, G));
    if (reached_1 && reached_2)
      first = std::min(first, arrival_inside<3>(x, from, G));
    return first;
  }

  void pass_along_face(int f, int node) {
    const auto nodes = mesh_.endo.face(f);
    const std::size_t n = nodes.size();
    for (std::size_t i = 0; i < n; ++i) {
      const int other = nodes[i];
      if (other == node)
        continue;
      for (const int to : nodes) {
        if (to == node || to == other)
          continue;
        const Vec3& x = mesh_.nodes[to];
        arrive(to, arrival_from(x, known(node), surface_metric_));
        if (times_[other] < never)
          arrive(to, arrival_inside<2>(x, {known(node), known(other)}, surface_metric_));
      }
    }
  }

  const mesh::Mesh& mesh_;
  std::span<const Mat3> metrics_;
  Mat3 surface_metric_ = Mat3::Zero();
  std::vector<Across> across_;
  std::vector<std::vector<int>> cells_, faces_;
  std::vector<double> times_;
  std::priority_queue<Waiting, std::vector<Waiting>, std::greater<>> waiting_;
};

}  // namespace

Mat3 travel_metric(const Mat3& frame, const Speeds& speeds) {
  const Vec3 slowness(1.0 / speeds.v_f, 1.0 / speeds.v_s, 1.0 / speeds.v_n);
  return frame * slowness.cwiseAbs2().asDiagonal() * frame.transpose();
}

std::vector<Start> starts_around(const mesh::Mesh& mesh, const Vec3& point, double radius,
                                 const Mat3& metric) {
  std::vector<Start> starts;
  for (std::size_t a = 0; a < mesh.nodes.size(); ++a)
    if (const Vec3 way = mesh.nodes[a] - point; way.norm() <= radius)
      starts.push_back({static_cast<int>(a), std::sqrt(way.dot(metric * way))});
  return starts;
}

std::vector<double> arrival_times(const mesh::Mesh& mesh, std::span<const Mat3> metrics,
                                  const Speeds& speeds, std::span<const Start> starts) {
  LV_CHECK(metrics.size() == static_cast<std::size_t>(mesh.cell_count()));
  std::vector<double> times = Front(mesh, metrics, speeds).spread(starts);
  const auto missed = std::count(times.begin(), times.end(), never);
  if (missed > 0)
    throw InputError("activation",
                     fmt::format("never reaches {} of the wall's {} nodes", missed, times.size()),
                     "Give every part of the wall a site that activation starts from");
  return times;
}

}  // namespace lv::activation
