#include "lv/activation/front.hpp"
#include "lv/mesh/split.hpp"
#include "lv/verify/problems.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <vector>

/// Fronts in a cube of muscle whose fibres lie across its edges. All ways are straight, so that the
/// exact time is the length of the shortest way from the source in the metric of the muscle.
namespace lv::verify {
namespace {

constexpr double side = 24.0;  // [mm]
constexpr double known = 4.0;  // the exact times up to this distance from the source are given [mm]

/// v^3 cubes.
mesh::Mesh cubes(int v) {
  mesh::Mesh mesh;
  const auto number = [&](int i, int j, int k) { return (k * (v + 1) + j) * (v + 1) + i; };
  for (int k = 0; k <= v; ++k)
    for (int j = 0; j <= v; ++j)
      for (int i = 0; i <= v; ++i)
        mesh.nodes.push_back(side / v * Vec3(i, j, k));
  for (int k = 0; k < v; ++k)
    for (int j = 0; j < v; ++j)
      for (int i = 0; i < v; ++i)
        mesh.cells.insert(mesh.cells.end(),
                          {number(i, j, k), number(i + 1, j, k), number(i + 1, j + 1, k),
                           number(i, j + 1, k), number(i, j, k + 1), number(i + 1, j, k + 1),
                           number(i + 1, j + 1, k + 1), number(i, j + 1, k + 1)});
  mesh.transmural.assign(mesh.nodes.size(), 0.0);
  mesh.infarct = mesh.transmural;
  return mesh;
}

Mat3 oblique_metric() {
  const auto frame = Eigen::AngleAxisd(0.6, Vec3::UnitZ()) * Eigen::AngleAxisd(0.4, Vec3::UnitX()) *
                     Eigen::AngleAxisd(-0.3, Vec3::UnitY());
  return activation::travel_metric(frame.toRotationMatrix(), {});
}

using Times = std::function<double(const Vec3& x)>;
using Sources = std::function<bool(const Vec3& x)>;

struct Errors {
  double mean = 0.0;      ///< [s]
  double earliest = 0.0;  ///< of an arrival before the exact one [s]
};

/// Against the exact times; they are given where `is_source` holds.
Errors errors(const mesh::Mesh& mesh, const Mat3& metric, const Times& exact,
              const Sources& is_source) {
  std::vector<activation::Start> starts;
  for (std::size_t a = 0; a < mesh.nodes.size(); ++a)
    if (is_source(mesh.nodes[a]))
      starts.push_back({static_cast<int>(a), exact(mesh.nodes[a])});
  const std::vector<Mat3> metrics(mesh.cell_count(), metric);
  const auto times = activation::arrival_times(mesh, metrics, {.endocardium = 0.0}, starts);
  Errors e;
  for (std::size_t a = 0; a < times.size(); ++a) {
    const double off = times[a] - exact(mesh.nodes[a]);
    e.mean += std::abs(off) / static_cast<double>(times.size());
    e.earliest = std::max(e.earliest, -off);
  }
  return e;
}

/// Of the cubes, and of the tetrahedra that they are cut into. What linear elements say of a
/// convex function is too much, so that no front is early. The errors are those of a front that is
/// resolved by few elements: the order is asked within a fifth.
void add_order(Findings& found, const Mat3& metric, const Times& exact, const Sources& is_source) {
  double latest = 0.0;
  for (const Vec3& x : cubes(8).nodes)
    latest = std::max(latest, exact(x));
  const Errors coarse = errors(cubes(16), metric, exact, is_source);
  const Errors fine = errors(cubes(32), metric, exact, is_source);
  found.add("order in space, cells of 1.5 and 0.75 mm", std::log2(coarse.mean / fine.mean), 1.0,
            0.2);
  found.add_error("mean error over the latest time, cells of 0.75 mm", fine.mean / latest, 0.01);
  found.add_error("arrival before the exact one", std::max(coarse.earliest, fine.earliest), 1e-12,
                  "s");
  const Errors split = errors(mesh::split_into_tetrahedra(cubes(16)), metric, exact, is_source);
  found.add_error("mean error over the latest time, tetrahedra of 1.5 mm", split.mean / latest,
                  0.02);
}

/// The shortest way to x from the side z = 0: the squared length is convex in the way's beginning
/// (y_1, y_2), whose y_2 follows from y_1.
double time_from_side(const Vec3& x, const Mat3& G) {
  const auto along = [&](double y_1) {
    const Vec3 d = x - Vec3(y_1, 0.0, 0.0);
    const double y_2 = std::clamp(Vec3::UnitY().dot(G * d) / G(1, 1), 0.0, side);
    const Vec3 way = d - y_2 * Vec3::UnitY();
    return std::sqrt(way.dot(G * way));
  };
  constexpr double golden = 0.6180339887498949;
  std::array<double, 2> between{0.0, side};
  for (int i = 0; i < 60; ++i) {
    const double step = golden * (between[1] - between[0]);
    if (along(between[1] - step) < along(between[0] + step))
      between[1] = between[0] + step;
    else
      between[0] = between[1] - step;
  }
  return along(0.5 * (between[0] + between[1]));
}

}  // namespace

/// From the middle of the cube.
void eikonal_point(Findings& found) {
  const Mat3 G = oblique_metric();
  const Vec3 source = Vec3::Constant(0.5 * side);
  add_order(
      found, G,
      [&](const Vec3& x) {
        const Vec3 way = x - source;
        return std::sqrt(way.dot(G * way));
      },
      [&](const Vec3& x) { return (x - source).norm() <= known; });
}

/// From a side of the cube: a plane, round which the front comes in its shadow, since ways do not
/// run along the side's normal.
void eikonal_plane(Findings& found) {
  const Mat3 G = oblique_metric();
  add_order(
      found, G, [&](const Vec3& x) { return time_from_side(x, G); },
      [](const Vec3& x) { return x.z() <= known; });
}

}  // namespace lv::verify
