#include "lv/mesh_io/polygons.hpp"

#include "lv/base/check.hpp"
#include "lv/base/ending.hpp"
#include "lv/base/files.hpp"
#include "lv/base/formats.hpp"
#include "lv/base/lines.hpp"
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

#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <sstream>

namespace lv::mesh_io {
namespace {

template <class Reader>
vtkSmartPointer<vtkPolyData> read_with(const std::string& file) {
  vtkNew<Reader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  return reader->GetOutput();
}

/// VTK reads what there is of a binary STL file and says nothing of what is lacking: 80 bytes of
/// header, the number of triangles, 50 bytes for each.
void check_stl_length(const std::string& file) {
  constexpr std::uintmax_t before_triangles = 84;
  constexpr std::uintmax_t per_triangle = 50;
  constexpr std::size_t enough = 1024;
  const std::string first = first_bytes(file, enough);
  const bool is_text = first.starts_with("solid") && first.find("facet") != std::string::npos;
  const std::uintmax_t there = std::filesystem::file_size(file);
  if (is_text || there < before_triangles)
    return;
  std::uint32_t triangles = 0;
  std::memcpy(&triangles, first.data() + before_triangles - sizeof triangles, sizeof triangles);
  const std::uintmax_t stated = before_triangles + per_triangle * triangles;
  if (there < stated)
    throw InputError(
        file,
        fmt::format(
            "the file is truncated: {} of the {} bytes that its {} triangles take are there", there,
            stated, triangles),
        "Copy or export the file again");
}

/// Throws InputError for a vertex without three finite coordinates: VTK says nothing of it.
void check_obj_vertices(const std::string& file) {
  LineReader line(file, Columns::any);
  for (int vertex = 1; line.next();) {
    std::istringstream words{std::string(line.text())};
    std::string word;
    if (!(words >> word) || word != "v")
      continue;
    for (int i = 0; i < 3; ++i) {
      word.clear();
      words >> word;
      const auto x = number_of<double>(word);
      if (!x || !std::isfinite(*x))
        throw InputError(
            line.where(),
            fmt::format("vertex {} is not a place: \"{}\"", vertex, trimmed(line.text())),
            "Repair the coordinates in the file");
    }
    ++vertex;
  }
}

}  // namespace

vtkSmartPointer<vtkPolyData> read_polygons(const std::string& file) {
  const std::string ending = ending_of(file);
  require_readable(file, "Check the name of the surface");
  auto polygons = read_by_vtk(file, [&] {
    if (ending == ".stl") {
      check_stl_length(file);
      return read_with<vtkSTLReader>(file);
    }
    if (ending == ".ply")
      return read_with<vtkPLYReader>(file);
    if (ending == ".obj") {
      check_obj_vertices(file);
      return read_with<vtkOBJReader>(file);
    }
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
