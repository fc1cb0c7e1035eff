// Meshes, surfaces and labelled volumes of other programs, damaged: see support/mutations.hpp.
#include "support/mutations.hpp"

#include "lv/mesh/split.hpp"
#include "lv/mesh_io/closed_surface.hpp"
#include "lv/mesh_io/cut_surfaces.hpp"
#include "lv/mesh_io/import.hpp"
#include "lv/mesh_io/label_volume.hpp"

#include "mesh_io/mesh_files.hpp"
#include "mesh_io/surface_files.hpp"
#include "support/temporary_folder.hpp"
#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <vtkDoubleArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataReader.h>
#include <vtkPolyDataWriter.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>
#include <vtkUnstructuredGridReader.h>
#include <vtkUnstructuredGridWriter.h>
#include <vtkXMLImageDataWriter.h>
#include <vtkXMLPolyDataWriter.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <array>
#include <string>

namespace {

using namespace lv;
using mesh::CellKind;
using test::AbaqusTags;
using test::try_damaged;
using test::VtkTags;

/// A ventricle of few elements.
mesh::Mesh smallest(CellKind kind) {
  const mesh::Mesh hexahedra = test::ellipsoid_mesh({}, 25.0, 1);
  return kind == CellKind::hexahedron ? hexahedra : mesh::split_into_tetrahedra(hexahedra);
}

test::Read import_as(mesh::ImportParameters parameters) {
  return [parameters](const std::filesystem::path& file) {
    mesh::ImportParameters own = parameters;
    own.file = file.string();
    static_cast<void>(mesh_io::import_mesh(own));
  };
}

void read_surface(const std::filesystem::path& file) {
  const mesh_io::ClosedSurface surface = mesh_io::read_closed_surface(file.string(), 1.0);
  static_cast<void>(surface.contains(Vec3(0.4, 0.5, 0.6)));
}

void read_labels(const std::filesystem::path& file) {
  const mesh_io::LabelVolume volume(file.string(), "", 1.0);
  static_cast<void>(volume.has(Vec3(1.0, 2.0, 1.5), {7}));
  static_cast<void>(volume.box());
}

/// A file that a VTK writer makes of some data.
template <class Writer, class Data>
std::string written(const std::string& name, Data* data, bool binary) {
  const test::TemporaryFolder folder;
  vtkNew<Writer> writer;
  writer->SetFileName((folder / name).c_str());
  writer->SetInputData(data);
  if constexpr (requires { writer->SetFileTypeToBinary(); })
    binary ? writer->SetFileTypeToBinary() : writer->SetFileTypeToASCII();
  else
    binary ? writer->SetDataModeToAppended() : writer->SetDataModeToAscii();
  writer->Write();
  return test::bytes_of(folder / name);
}

/// What a VTK reader makes of a text.
template <class Reader>
vtkSmartPointer<Reader> reader_of(const test::TemporaryFolder& folder, const std::string& text) {
  test::write_bytes(folder / "text.vtk", text);
  const auto reader = vtkSmartPointer<Reader>::New();
  reader->SetFileName((folder / "text.vtk").c_str());
  if constexpr (requires { reader->ReadAllScalarsOn(); })
    reader->ReadAllScalarsOn();
  reader->Update();
  return reader;
}

std::string cube() {
  return "# vtk DataFile Version 3.0\ncube\nASCII\nDATASET POLYDATA\nPOINTS 8 float\n"
         "0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\nPOLYGONS 12 48\n"
         "3 0 3 2\n3 0 2 1\n3 4 5 6\n3 4 6 7\n3 0 1 5\n3 0 5 4\n3 1 2 6\n3 1 6 5\n"
         "3 2 3 7\n3 2 7 6\n3 3 0 4\n3 3 4 7\n";
}

std::string stl_cube() {
  const std::array<std::array<int, 3>, 12> faces{{{0, 3, 2},
                                                  {0, 2, 1},
                                                  {4, 5, 6},
                                                  {4, 6, 7},
                                                  {0, 1, 5},
                                                  {0, 5, 4},
                                                  {1, 2, 6},
                                                  {1, 6, 5},
                                                  {2, 3, 7},
                                                  {2, 7, 6},
                                                  {3, 0, 4},
                                                  {3, 4, 7}}};
  std::string text = "solid cube\n";
  for (const auto& face : faces) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (const int corner : face)
      text += fmt::format("vertex {} {} {}\n", corner % 4 == 1 || corner % 4 == 2 ? 1 : 0,
                          corner % 4 > 1 ? 1 : 0, corner / 4);
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid cube\n";
}

std::string ply_cube() {
  return "ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float y\n"
         "property float z\nelement face 6\nproperty list uchar int vertex_indices\nend_header\n"
         "0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n"
         "4 0 3 2 1\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n";
}

vtkSmartPointer<vtkImageData> image() {
  const auto labels = vtkSmartPointer<vtkImageData>::New();
  labels->SetDimensions(5, 4, 3);
  vtkNew<vtkDoubleArray> tissue;
  tissue->SetName("tissue");
  for (int v = 0; v < 60; ++v)
    tissue->InsertNextValue(v % 3 == 0 ? 7.0 : 0.0);
  labels->GetPointData()->AddArray(tissue);
  return labels;
}

constexpr const char* image_text =
    "# vtk DataFile Version 3.0\nscar\nASCII\nDATASET STRUCTURED_POINTS\nDIMENSIONS 3 3 3\n"
    "ORIGIN 0 0 0\nSPACING 1 1 2\nPOINT_DATA 27\nSCALARS tissue int 1\nLOOKUP_TABLE default\n"
    "0 0 0 0 7 0 0 0 0 0 7 0 0 7 0 0 7 0 0 0 0 7 7 0 0 0 0\n";

}  // namespace

TEST_CASE("damaged ABAQUS meshes are read or refused", "[unit][mesh_io][mutations]") {
  for (const AbaqusTags tags :
       {AbaqusTags::labelled_faces, AbaqusTags::node_sets, AbaqusTags::shells})
    try_damaged("x.inp", abaqus_text(smallest(CellKind::hexahedron), tags), import_as({}),
                {.few = 10});
  mesh::ImportParameters by_geometry;
  by_geometry.sides = mesh::SideSource::geometry;
  try_damaged("x.inp", abaqus_text(smallest(CellKind::tetrahedron), AbaqusTags::none),
              import_as(by_geometry), {.few = 10});
}

TEST_CASE("ABAQUS sets that hold too much are refused", "[unit][mesh_io][mutations]") {
  const std::string sets =
      "*Elset, elset=A, generate\n1, 9, 2\n*Elset, elset=B\nA, A\n*Elset, elset=C\nB, B, 3\n"
      "*Nset, nset=D, elset=C\n*Include, input=x.inp\n*Part, name=P\n*End Part\n";
  const std::string mesh = abaqus_text(smallest(CellKind::hexahedron), AbaqusTags::node_sets);
  try_damaged("sets.inp", mesh + sets.substr(0, sets.find("*Include")), import_as({}),
              {.within = 0, .few = 10}, [&, random = std::mt19937(1)](std::string& text) mutable {
                text = mesh + test::mutated(sets, random);
              });
}

TEST_CASE("damaged VTK meshes are read or refused", "[unit][mesh_io][mutations]") {
  const mesh::Mesh hexahedra = smallest(CellKind::hexahedron);
  mesh::ImportParameters numbered;
  numbered.endo = std::to_string(1);
  numbered.epi = std::to_string(2);
  numbered.base = std::to_string(3);
  numbered.side_array = "side";
  numbered.infarct_array = "infarct";
  const test::Read by_cells = import_as(numbered);
  const std::string text = vtk_text(hexahedra, VtkTags::surface_cells);
  try_damaged("x.vtk", text, by_cells, {.few = 10});
  try_damaged("x.vtk", vtk_text(smallest(CellKind::tetrahedron), VtkTags::point_arrays),
              import_as({}), {.few = 10});
  try_damaged("x.vtu", vtu_text(hexahedra, VtkTags::surface_cells), by_cells, {.few = 10});
  const test::TemporaryFolder folder;
  const auto reader = reader_of<vtkUnstructuredGridReader>(folder, text);
  vtkUnstructuredGrid* grid = reader->GetOutput();
  try_damaged("x.vtk", written<vtkUnstructuredGridWriter>("x.vtk", grid, true), by_cells,
              {.few = 10});
  const std::string appended = written<vtkXMLUnstructuredGridWriter>("x.vtu", grid, true);
  try_damaged("x.vtu", appended, by_cells, {.few = 10});
  try_damaged("x.vtu", appended, by_cells, {.within = appended.find("_"), .few = 10});
}

TEST_CASE("damaged Gmsh meshes are read or refused", "[unit][mesh_io][mutations]") {
  const mesh::Mesh hexahedra = smallest(CellKind::hexahedron);
  for (const std::string& file :
       {test::gmsh22_text(hexahedra), test::gmsh22_bytes(hexahedra, false),
        test::gmsh41(smallest(CellKind::tetrahedron)),
        test::gmsh41(hexahedra, test::GmshNumbers::bytes),
        test::gmsh41(hexahedra, test::GmshNumbers::swapped_bytes, true)})
    try_damaged("x.msh", file, import_as({}));
}

TEST_CASE("damaged surfaces of sides and files of fibres are read or refused",
          "[unit][mesh_io][mutations]") {
  const mesh::Mesh tetrahedra = smallest(CellKind::tetrahedron);
  const test::TemporaryFile plain(".vtu", vtu_text(tetrahedra, VtkTags::point_arrays));
  const auto read_with = [&](std::string mesh::ImportParameters::*name) -> test::Read {
    return [&plain, name](const std::filesystem::path& file) {
      mesh::ImportParameters parameters;
      parameters.file = plain.path();
      parameters.*name = file.string();
      static_cast<void>(mesh_io::import_mesh(parameters));
    };
  };
  for (const int first : {0, -1})
    try_damaged("x.vtp", test::vtp_text(tetrahedra, tetrahedra.endo, first),
                read_with(&mesh::ImportParameters::endo), {.few = 10});
  const std::vector<Vec3> directions(tetrahedra.cell_count(), Vec3(0.6, 0.0, 0.8));
  try_damaged("x.vtu",
              test::replaced(vtu_text(tetrahedra, VtkTags::none), "<CellData>\n",
                             "<CellData>\n" + test::vtu_array("FIB_DIR", directions)),
              read_with(&mesh::ImportParameters::fibres), {.few = 10});
}

TEST_CASE("damaged surfaces are read or refused", "[unit][mesh_io][mutations]") {
  const test::TemporaryFolder folder;
  const auto reader = reader_of<vtkPolyDataReader>(folder, cube());
  vtkPolyData* polygons = reader->GetOutput();
  try_damaged("x.stl", stl_cube(), read_surface, {.few = 10});
  try_damaged("x.ply", ply_cube(), read_surface, {.few = 10});
  try_damaged("x.vtk", cube(), read_surface, {.few = 10});
  try_damaged("x.vtk", written<vtkPolyDataWriter>("x.vtk", polygons, true), read_surface,
              {.few = 10});
  try_damaged("x.vtp", written<vtkXMLPolyDataWriter>("x.vtp", polygons, false), read_surface,
              {.few = 10});
  try_damaged("x.vtp", written<vtkXMLPolyDataWriter>("x.vtp", polygons, true), read_surface,
              {.few = 10});
}

TEST_CASE("damaged labelled volumes are read or refused", "[unit][mesh_io][mutations]") {
  try_damaged("x.vtk", image_text, read_labels, {.few = 10});
  const auto labels = image();
  try_damaged("x.vti", written<vtkXMLImageDataWriter>("x.vti", labels.GetPointer(), false),
              read_labels, {.few = 10});
  try_damaged("x.vti", written<vtkXMLImageDataWriter>("x.vti", labels.GetPointer(), true),
              read_labels, {.few = 10});
}

TEST_CASE("damaged surfaces of the wall are cut or refused", "[unit][mesh_io][mutations]") {
  const test::Bowl outer = test::half_ellipsoid(35.0, 70.0, 0.3, false);
  const test::TemporaryFolder folder;
  test::write_bytes(folder / "epi.obj", test::obj_text(outer));
  const auto epi = mesh_io::read_triangles((folder / "epi.obj").string(), 1.0, "LPS");
  const auto cut = [&](const std::filesystem::path& file) {
    static_cast<void>(mesh_io::cut_across(mesh_io::read_triangles(file.string(), 1.0, "LPS"), epi));
  };
  const test::Bowl inner = test::half_ellipsoid(25.0, 60.0, 0.3, true);
  test::try_damaged("x.obj", test::obj_text(inner), cut, {.few = 10});
  test::try_damaged("x.stl", test::stl_text(inner), cut, {.few = 10});
}
