#include "lv/mesh_io/vtk_sides.hpp"

#include "lv/base/check.hpp"
#include "lv/base/lines.hpp"
#include "lv/mesh_io/polygons.hpp"
#include "lv/mesh_io/vtk_grid.hpp"

#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkDataSet.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkStaticPointLocator.h>
#include <vtkUnstructuredGrid.h>

#include <cmath>
#include <cstdint>
#include <map>
#include <unordered_map>

namespace lv::mesh_io {
namespace {

/// The nodes at which a point array of zeros and ones is one.
ForeignSide side_of_points(const std::string& file, vtkUnstructuredGrid& grid,
                           const std::string& tag) {
  vtkDataArray& array =
      find_array(file, *grid.GetPointData(), grid.GetNumberOfPoints(), 1, "point array", tag);
  ForeignSide side;
  for (vtkIdType p = 0; p < array.GetNumberOfTuples(); ++p) {
    const double value = array.GetTuple1(p);
    if (value != 0.0 && value != 1.0)
      throw InputError(file, fmt::format("point array \"{}\" is {} at point {}", tag, value, p),
                       "It must be 1 on the side and 0 elsewhere");
    if (value == 1.0)
      side.nodes.push_back(static_cast<int>(p));
  }
  return side;
}

/// The surface cells by their value in a cell array.
std::map<double, ForeignSide> sides_by_value(const std::string& file, vtkUnstructuredGrid& grid,
                                             vtkDataArray& array) {
  std::map<double, ForeignSide> sides;
  for (vtkIdType c = 0; c < grid.GetNumberOfCells(); ++c)
    if (const VtkShape shape = shape_of(grid.GetCellType(c));
        shape.dimension == 2 && shape.corners > 0)
      sides[array.GetTuple1(c)].faces.push_back(mesh::face_key(corners_of(file, grid, c)));
  return sides;
}

ForeignSide side_of_value(const mesh::ImportParameters& parameters, const std::string& tag,
                          const std::map<double, ForeignSide>& sides) {
  const auto wanted = number_of<double>(tag);
  if (!wanted)
    throw InputError(
        parameters.file,
        fmt::format("\"{}\" is not a number of the cell array \"{}\"", tag, parameters.side_array),
        "Give the side's number, or name no cell array to use point arrays");
  if (const auto found = sides.find(*wanted); found != sides.end())
    return found->second;
  std::vector<std::string> tags;
  for (const auto& [value, side] : sides)
    tags.push_back(fmt::format("{}", value));
  fail_missing_tag(parameters.file,
                   fmt::format("surface cell whose \"{}\" is", parameters.side_array), tag, tags);
}

/// The nodes of a grid that the points of a surface stand for: by number where both files number
/// them, as SimVascular does, else by place.
class SurfaceNodes {
 public:
  SurfaceNodes(const std::string& file, vtkPolyData& surface, vtkUnstructuredGrid& grid)
      : file_(file), surface_(surface) {
    if (has_numbers(surface) && has_numbers(grid)) {
      numbers_ = &numbers_of(surface);
      vtkDataArray& numbers = numbers_of(grid);
      for (vtkIdType p = 0; p < grid.GetNumberOfPoints(); ++p)
        nodes_.emplace(std::llround(numbers.GetComponent(p, 0)), static_cast<int>(p));
      return;
    }
    check_places(surface);
    check_places(grid);
    locator_->SetDataSet(&grid);
    locator_->BuildLocator();
    tolerance_ = 1e-5 * grid.GetLength();
  }

  [[nodiscard]] int operator()(vtkIdType point) const {
    return numbers_ == nullptr ? by_place(point) : by_number(point);
  }

 private:
  static constexpr const char* numbers_name = "GlobalNodeID";

  /// VTK does not expect others.
  void check_places(vtkDataSet& data) const {
    for (vtkIdType p = 0; p < data.GetNumberOfPoints(); ++p)
      if (!Vec3(data.GetPoint(p)).allFinite())
        throw InputError(file_, fmt::format("point {} of it or of the mesh is not a place", p),
                         "Repair the coordinates in the file");
  }

  static bool has_numbers(vtkDataSet& data) {
    return data.GetPointData()->HasArray(numbers_name) != 0;
  }

  [[nodiscard]] vtkDataArray& numbers_of(vtkDataSet& data) const {
    return find_array(file_, *data.GetPointData(), data.GetNumberOfPoints(), 1, "point array",
                      numbers_name);
  }

  [[nodiscard]] int by_number(vtkIdType point) const {
    const auto number = std::llround(numbers_->GetComponent(point, 0));
    const auto found = nodes_.find(number);
    if (found == nodes_.end())
      throw InputError(
          file_,
          fmt::format("{} {} of point {} is no node of the mesh", numbers_name, number, point),
          "Take the surfaces that were written with this mesh");
    return found->second;
  }

  [[nodiscard]] int by_place(vtkIdType point) const {
    const Vec3 x(surface_.GetPoint(point));
    double distance2 = 0.0;
    const vtkIdType node = locator_->FindClosestPointWithinRadius(tolerance_, x.data(), distance2);
    if (node < 0)
      throw InputError(file_,
                       fmt::format("no node of the mesh lies at point {}, ({:.4g}, {:.4g}, {:.4g})",
                                   point, x.x(), x.y(), x.z()),
                       "Take the surfaces that were written with this mesh");
    return static_cast<int>(node);
  }

  std::string file_;
  vtkPolyData& surface_;
  vtkDataArray* numbers_ = nullptr;  ///< of the surface's points; none if either file has none
  std::unordered_map<std::int64_t, int> nodes_;  ///< by number
  vtkNew<vtkStaticPointLocator> locator_;
  double tolerance_ = 0.0;
};

/// The polygons of a surface in a file of its own.
ForeignSide side_of_surface(const std::string& file, vtkUnstructuredGrid& grid) {
  const auto surface = read_polygons(file);
  const SurfaceNodes node_of(file, *surface, grid);
  ForeignSide side;
  vtkNew<vtkIdList> corners;
  for (vtkIdType p = 0; p < surface->GetPolys()->GetNumberOfCells(); ++p) {
    surface->GetPolys()->GetCellAtId(p, corners);
    std::vector<int> face;
    for (vtkIdType i = 0; i < corners->GetNumberOfIds(); ++i)
      face.push_back(node_of(corners->GetId(i)));
    if (face.size() != 3 && face.size() != 4)
      throw InputError(file, fmt::format("polygon {} has {} corners", p, face.size()),
                       "Sides are made of the faces of tetrahedra and hexahedra");
    side.faces.push_back(mesh::face_key(face));
  }
  if (side.faces.empty())
    throw InputError(file, "holds no polygons", "Write the faces of the wall's side");
  return side;
}

}  // namespace

std::vector<ForeignSide> read_vtk_sides(const mesh::ImportParameters& parameters,
                                        vtkUnstructuredGrid& grid) {
  std::map<double, ForeignSide> by_value;
  if (!parameters.side_array.empty())
    by_value =
        sides_by_value(parameters.file, grid,
                       find_array(parameters.file, *grid.GetCellData(), grid.GetNumberOfCells(), 1,
                                  "cell array", parameters.side_array));
  return find_sides(parameters, [&](const std::string& tag) {
    return names_file(tag)                 ? side_of_surface(tag, grid)
           : parameters.side_array.empty() ? side_of_points(parameters.file, grid, tag)
                                           : side_of_value(parameters, tag, by_value);
  });
}

}  // namespace lv::mesh_io
