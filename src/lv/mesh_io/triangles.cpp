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
#include <cmath>
#include <cstdint>
#include <map>

namespace lv::mesh_io {
namespace {

/// The number of each point, the same for points in the same place: closer than 2.5e-5 mm, for the
/// points of a circle that programs compute twice differ in their last digits.
class PointNumbers {
 public:
  std::vector<Vec3> points;

  int operator()(const Vec3& x) {
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3 towards((corner & 1) != 0 ? 0.25 : -0.25, (corner & 2) != 0 ? 0.25 : -0.25,
                         (corner & 4) != 0 ? 0.25 : -0.25);
      const auto box = boxes_.find(box_of(x / side + towards));
      if (box == boxes_.end())
        continue;
      for (const int number : box->second)
        if ((points[number] - x).cwiseAbs().maxCoeff() < 0.25 * side)
          return number;
    }
    const int number = static_cast<int>(points.size());
    points.push_back(x);
    boxes_[box_of(x / side)].push_back(number);
    return number;
  }

 private:
  static constexpr double side = 1e-4;  // of a box [mm]
  using Box = std::array<std::int64_t, 3>;
  std::map<Box, std::vector<int>> boxes_;

  static Box box_of(const Vec3& x) {
    return {std::llround(x.x()), std::llround(x.y()), std::llround(x.z())};
  }
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
      if (n[0] != n[i - 1] && n[i - 1] != n[i] && n[i] != n[0])
        triangles.faces.nodes.insert(triangles.faces.nodes.end(), {n[0], n[i - 1], n[i]});
  }
  if (triangles.faces.size() == 0)
    throw InputError(file, "holds no triangles", "Export the surface as polygons");
  triangles.nodes = std::move(number.points);
  return triangles;
}

}  // namespace lv::mesh_io
