#include "lv/mesh_io/polygons.hpp"

#include "lv/base/check.hpp"
#include "lv/base/ending.hpp"
#include "lv/base/files.hpp"
#include "lv/base/formats.hpp"
#include "lv/mesh_io/vtk_file.hpp"

#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkOBJReader.h>
#include <vtkPLYReader.h>
#include <vtkPolyData.h>
#include <vtkPolyDataReader.h>
#include <vtkSTLReader.h>
#include <vtkXMLPolyDataReader.h>

namespace lv::mesh_io {
namespace {

template <class Reader>
vtkSmartPointer<vtkPolyData> read_with(const std::string& file) {
  vtkNew<Reader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  return reader->GetOutput();
}

}  // namespace

vtkSmartPointer<vtkPolyData> read_polygons(const std::string& file) {
  const std::string ending = ending_of(file);
  require_readable(file, "Check the name of the surface");
  const auto polygons = read_by_vtk(file, [&] {
    if (ending == ".stl")
      return read_with<vtkSTLReader>(file);
    if (ending == ".ply")
      return read_with<vtkPLYReader>(file);
    if (ending == ".obj")
      return read_with<vtkOBJReader>(file);
    if (ending == ".vtp")
      return read_with<vtkXMLPolyDataReader>(file);
    if (ending == ".vtk") {
      check_legacy_cells(file);
      return read_with<vtkPolyDataReader>(file);
    }
    throw InputError(file, fmt::format("has the unknown ending \"{}\"", ending),
                     fmt::format("Surfaces are read from {}", formats::surfaces));
  });
  check_cells(file, polygons->GetPolys(), polygons->GetNumberOfPoints());
  return polygons;
}

}  // namespace lv::mesh_io
