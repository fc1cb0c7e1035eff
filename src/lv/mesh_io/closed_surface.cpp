#include "lv/mesh_io/closed_surface.hpp"

#include "lv/base/check.hpp"
#include "lv/mesh_io/triangles.hpp"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <cmath>
#include <map>
#include <numbers>

namespace lv::mesh_io {
namespace {

/// Omega of a triangle with the corners a, b, c seen from the origin.
double solid_angle(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double la = a.norm();
  const double lb = b.norm();
  const double lc = c.norm();
  return 2.0 * std::atan2(a.dot(b.cross(c)),
                          la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
}

/// Throws unless every edge is run through as often one way as the other.
void check_closed(const std::vector<Vec3>& nodes, const mesh::Surface& triangles,
                  const std::string& where) {
  std::map<std::array<int, 2>, int> balance;
  for (int f = 0; f < triangles.size(); ++f) {
    const auto n = triangles.face(f);
    for (int i = 0; i < 3; ++i) {
      const int a = n[i];
      const int b = n[(i + 1) % 3];
      balance[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : -1;
    }
  }
  std::erase_if(balance, [](const auto& edge) { return edge.second == 0; });
  if (balance.empty())
    return;
  const Vec3& first = nodes[balance.begin()->first[0]];
  throw InputError(
      where,
      fmt::format("is not closed: {} edges have no triangle of the same orientation on their other "
                  "side, the first at ({:.4g}, {:.4g}, {:.4g}) mm",
                  balance.size(), first.x(), first.y(), first.z()),
      "Close the holes, and turn all normals outwards, in the program that made the surface");
}

}  // namespace

ClosedSurface::ClosedSurface(std::vector<Vec3> nodes, mesh::Surface triangles,
                             const std::string& where)
    : nodes_(std::move(nodes)), triangles_(std::move(triangles)) {
  if (triangles_.size() == 0)
    throw InputError(where, "holds no triangles", "Export the surface as polygons");
  check_closed(nodes_, triangles_, where);
  box_ = bounds(nodes_);
}

bool ClosedSurface::contains(const Vec3& x) const {
  if (!box_.contains(x))
    return false;
  double sum = 0.0;
  for (int f = 0; f < triangles_.size(); ++f) {
    const auto n = triangles_.face(f);
    sum += solid_angle(nodes_[n[0]] - x, nodes_[n[1]] - x, nodes_[n[2]] - x);
  }
  return std::lround(sum / (4.0 * std::numbers::pi)) != 0;
}

ClosedSurface read_closed_surface(const std::string& file, double unit) {
  Triangles triangles = read_triangles(file, unit, "LPS");
  return {std::move(triangles.nodes), std::move(triangles.faces), file};
}

}  // namespace lv::mesh_io
