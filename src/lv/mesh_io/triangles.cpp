#include "lv/mesh_io/triangles.hpp"

#include "lv/base/check.hpp"
#include "lv/base/log.hpp"
#include "lv/mesh_io/polygons.hpp"
#include "lv/mesh_io/stated_space.hpp"

#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <array>
#include <map>

namespace lv::mesh_io {
namespace {

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

std::string stated_space(const std::string& file) {
  return space_of(file, *read_polygons(file));
}

Triangles read_triangles(const std::string& file, double unit, const std::string& space) {
  constexpr double farthest = 1e6;  // from the scanner's centre [mm]
  const auto polygons = read_polygons(file);
  const std::string stated = space_of(file, *polygons);
  const bool in_ras = (stated.empty() ? space : stated) == "RAS";
  if (stated == "RAS")
    log::info("{} says SPACE=RAS: x and y change their signs", file);
  const Vec3 scale = unit * (in_ras ? ras_to_lps : Vec3(Vec3::Ones()));
  PointNumbers number;
  Triangles triangles;
  triangles.file = file;
  vtkCellArray& polys = *polygons->GetPolys();
  vtkNew<vtkIdList> corners;
  for (vtkIdType p = 0; p < polys.GetNumberOfCells(); ++p) {
    polys.GetCellAtId(p, corners);
    std::vector<int> n;
    for (vtkIdType i = 0; i < corners->GetNumberOfIds(); ++i) {
      const Vec3 x = scale.cwiseProduct(Vec3(polygons->GetPoint(corners->GetId(i))));
      if (!(x.cwiseAbs().array() <= farthest).all())  // nor NaN
        throw InputError(file, fmt::format("point {} is not a place", corners->GetId(i)),
                         "Repair the coordinates in the file");
      n.push_back(number(x));
    }
    for (std::size_t i = 2; i < n.size(); ++i)
      triangles.faces.nodes.insert(triangles.faces.nodes.end(), {n[0], n[i - 1], n[i]});
  }
  if (triangles.faces.size() == 0)
    throw InputError(file, "holds no triangles", "Export the surface as polygons");
  triangles.nodes = std::move(number.points);
  return triangles;
}

}  // namespace lv::mesh_io
