#include "lv/mesh_io/closed_surface.hpp"

#include "lv/base/check.hpp"
#include "lv/base/log.hpp"
#include "lv/mesh_io/polygons.hpp"
#include "lv/mesh_io/stated_space.hpp"

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

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

/// The number of each point, the same for points in the same place.
class PointNumbers {
 public:
  std::vector<Vec3> points;

  int operator()(const Vec3& x) {
    const auto [entry, added] =
        number_.emplace(std::array{x.x(), x.y(), x.z()}, static_cast<int>(points.size()));
    if (added)
      points.push_back(x);
    return entry->second;
  }

 private:
  std::map<std::array<double, 3>, int> number_;
};

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
  const auto polygons = read_polygons(file);
  const bool in_ras = says_ras(file, *polygons);
  if (in_ras)
    log::info("{} says SPACE=RAS: x and y change their signs", file);
  const Vec3 scale = unit * (in_ras ? ras_to_lps : Vec3(Vec3::Ones()));
  PointNumbers number;
  mesh::Surface triangles{.nodes_per_face = 3, .nodes = {}};
  vtkCellArray& polys = *polygons->GetPolys();
  vtkNew<vtkIdList> corners;
  for (vtkIdType p = 0; p < polys.GetNumberOfCells(); ++p) {
    polys.GetCellAtId(p, corners);
    std::vector<int> n;
    for (vtkIdType i = 0; i < corners->GetNumberOfIds(); ++i) {
      const Vec3 x = scale.cwiseProduct(Vec3(polygons->GetPoint(corners->GetId(i))));
      if (!x.allFinite())
        throw InputError(file, fmt::format("point {} is not a place", corners->GetId(i)),
                         "Repair the coordinates in the file");
      n.push_back(number(x));
    }
    for (std::size_t i = 2; i < n.size(); ++i)
      triangles.nodes.insert(triangles.nodes.end(), {n[0], n[i - 1], n[i]});
  }
  return {std::move(number.points), std::move(triangles), file};
}

}  // namespace lv::mesh_io
