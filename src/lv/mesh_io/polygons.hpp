#pragma once

#include <vtkSmartPointer.h>

#include <string>

class vtkPolyData;

namespace lv::mesh_io {

/// Reads a surface from an .stl, .ply, .obj, .vtp or legacy .vtk file; the ending may be in
/// capitals. Throws InputError when it cannot be read or its polygons stand on points that there
/// are not.
[[nodiscard]] vtkSmartPointer<vtkPolyData> read_polygons(const std::string& file);

}  // namespace lv::mesh_io
