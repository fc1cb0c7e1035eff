#include "lv/report/fields_vtk.hpp"

#include "lv/analysis/quantities.hpp"
#include "lv/base/check.hpp"
#include "lv/base/table.hpp"

#include <Eigen/LU>
#include <fmt/format.h>
#include <vtkCellData.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkObject.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLImageDataWriter.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <array>
#include <limits>
#include <numbers>

namespace lv::report {
namespace {

using analysis::CellFields;
using analysis::CellStrain;

/// Adds arrays to the points or cells of a data set, one value function each.
class Arrays {
 public:
  Arrays(vtkDataSetAttributes* to, std::size_t count) : to_(to), count_(count) {}

  template <class Value>
  void scalar(const char* name, const Value& value) {
    fill(name, 1, [&](std::size_t i, float* out) { out[0] = static_cast<float>(value(i)); });
  }
  template <class Value>
  void vector(const char* name, const Value& value) {
    fill(name, 3, [&](std::size_t i, float* out) {
      const Vec3 v = value(i);
      for (int d = 0; d < 3; ++d)
        out[d] = static_cast<float>(v[d]);
    });
  }
  /// Nine numbers, row by row.
  template <class Value>
  void tensor(const char* name, const Value& value) {
    fill(name, 9, [&](std::size_t i, float* out) {
      const Mat3 t = value(i);
      for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c)
          out[3 * r + c] = static_cast<float>(t(r, c));
    });
  }
  void integers(const char* name, const std::vector<int>& values) {
    vtkNew<vtkIntArray> array;
    array->SetName(name);
    array->SetNumberOfTuples(static_cast<vtkIdType>(count_));
    for (std::size_t i = 0; i < count_; ++i)
      array->SetValue(static_cast<vtkIdType>(i), values[i]);
    to_->AddArray(array);
  }

 private:
  template <class Fill>
  void fill(const char* name, int components, const Fill& value) {
    vtkNew<vtkFloatArray> array;
    array->SetName(name);
    array->SetNumberOfComponents(components);
    array->SetNumberOfTuples(static_cast<vtkIdType>(count_));
    for (std::size_t i = 0; i < count_; ++i)
      value(i, array->GetPointer(components * static_cast<vtkIdType>(i)));
    to_->AddArray(array);
  }

  vtkDataSetAttributes* to_;
  std::size_t count_;
};

vtkNew<vtkUnstructuredGrid> grid_of(const mesh::Mesh& mesh, const std::vector<Vec3>& positions) {
  vtkNew<vtkUnstructuredGrid> grid;
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const Vec3& x : positions)
    points->InsertNextPoint(x.data());
  grid->SetPoints(points);
  const int type = mesh.kind == mesh::CellKind::hexahedron ? VTK_HEXAHEDRON : VTK_TETRA;
  grid->Allocate(mesh.cell_count());
  for (int c = 0; c < mesh.cell_count(); ++c) {
    const auto cell = mesh.cell(c);
    const std::vector<vtkIdType> nodes(cell.begin(), cell.end());
    grid->InsertNextCell(type, static_cast<vtkIdType>(nodes.size()), nodes.data());
  }
  return grid;
}

/// Writes under a temporary name and renames.
template <class Writer, class Data>
void write_whole(const std::filesystem::path& file, Data* data) {
  std::filesystem::path unfinished = file;
  unfinished.replace_extension(".part" + file.extension().string());
  vtkObject::GlobalWarningDisplayOff();  // what goes wrong is said once, below
  vtkNew<Writer> writer;
  writer->SetFileName(unfinished.c_str());
  writer->SetInputData(data);
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  writer->SetCompressorTypeToZLib();
  // VTK returns 1 also when the disk is full
  bool good = writer->Write() != 0 && writer->GetErrorCode() == 0;
  if (good) {
    std::error_code error;
    std::filesystem::rename(unfinished, file, error);
    good = !error;
  }
  if (!good)
    throw RunError(fmt::format("{} cannot be written", file.string()),
                   "Check the folder's permissions and the space left on the disk");
}

void add_regions(Arrays& arrays, const mesh::Regions& regions) {
  arrays.integers("slice", regions.slice);
  arrays.integers("sector", regions.sector);
  arrays.integers("aha17", regions.aha);
}

void add_frames(Arrays& arrays, const std::vector<CellFields>& cells) {
  arrays.vector("f0", [&](auto c) -> Vec3 { return cells[c].fibre_frame.col(0); });
  arrays.vector("s0", [&](auto c) -> Vec3 { return cells[c].fibre_frame.col(1); });
  arrays.vector("n0", [&](auto c) -> Vec3 { return cells[c].fibre_frame.col(2); });
  arrays.scalar("infarct", [&](auto c) { return cells[c].infarct; });
  arrays.scalar("reference_volume", [&](auto c) { return cells[c].volume; });
}

/// Strain and its components.
void add_strain(Arrays& arrays, const std::string& from, const std::vector<CellFields>& now,
                const std::vector<CellStrain>& strains, const std::vector<Mat3>& E) {
  arrays.tensor(fmt::format("E_{}", from).c_str(), [&](auto c) { return E[c]; });
  for (const analysis::Quantity& q : analysis::quantities())
    if (q.is_strain)
      arrays.scalar(q.field_name(from).c_str(), [&](auto c) { return q.of(now[c], strains[c]); });
}

Mat3 green_lagrange(const Mat3& F) {
  return 0.5 * (F.transpose() * F - Mat3::Identity());
}

void add_strains(Arrays& arrays, const std::vector<CellFields>& now,
                 const std::vector<CellFields>& end_diastole) {
  std::vector<CellStrain> strains;
  std::vector<Mat3> E;
  for (const CellFields& cell : now) {
    strains.push_back(analysis::strain(cell));
    E.push_back(green_lagrange(cell.F));
  }
  add_strain(arrays, "early_diastole", now, strains, E);
  constexpr double missing = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t c = 0; c < now.size(); ++c) {
    const bool known = !end_diastole.empty();
    strains[c] =
        known ? analysis::strain(now[c], end_diastole[c])
              : CellStrain{missing, missing, missing, missing, missing, missing, missing, missing};
    E[c] = known ? green_lagrange(now[c].F * end_diastole[c].F.inverse())
                 : Mat3::Constant(missing).eval();
  }
  add_strain(arrays, "end_diastole", now, strains, E);
}

void add_stresses(Arrays& arrays, const std::vector<CellFields>& now) {
  arrays.tensor("cauchy_total", [&](auto c) { return now[c].cauchy_total(); });
  arrays.tensor("cauchy_passive", [&](auto c) { return now[c].cauchy_passive; });
  arrays.tensor("cauchy_active", [&](auto c) { return now[c].cauchy_active; });
}

/// All that needs no other state.
void add_quantities(Arrays& arrays, const std::vector<CellFields>& now) {
  for (const analysis::Quantity& q : analysis::quantities())
    if (!q.is_strain && *q.field != '\0' && analysis::is_known(q, now))
      arrays.scalar(q.field, [&](auto c) { return q.of(now[c], {}); });
}

}  // namespace

void write_wall(const std::filesystem::path& file, const mesh::Mesh& mesh,
                const mesh::Regions& regions, const heartbeat::Snapshot& snapshot,
                const std::vector<CellFields>& now, const std::vector<CellFields>& end_diastole) {
  const auto grid = grid_of(mesh, snapshot.positions);
  Arrays nodal(grid->GetPointData(), mesh.nodes.size());
  nodal.vector("displacement",
               [&](auto a) -> Vec3 { return snapshot.positions[a] - mesh.nodes[a]; });
  nodal.scalar("transmural", [&](auto a) { return mesh.transmural[a]; });
  Arrays cells(grid->GetCellData(), now.size());
  add_frames(cells, now);
  cells.tensor("F", [&](auto c) { return now[c].F; });
  add_quantities(cells, now);
  add_strains(cells, now, end_diastole);
  add_stresses(cells, now);
  add_regions(cells, regions);
  write_whole<vtkXMLUnstructuredGridWriter>(file, grid.Get());
}

void write_mesh(const std::filesystem::path& file, const mesh::Mesh& mesh,
                const mesh::Regions& regions, const std::vector<CellFields>& undeformed) {
  const auto grid = grid_of(mesh, mesh.nodes);
  Arrays nodal(grid->GetPointData(), mesh.nodes.size());
  nodal.scalar("transmural", [&](auto a) { return mesh.transmural[a]; });
  nodal.scalar("infarct", [&](auto a) { return mesh.infarct[a]; });
  Arrays cells(grid->GetCellData(), undeformed.size());
  add_frames(cells, undeformed);
  add_regions(cells, regions);
  write_whole<vtkXMLUnstructuredGridWriter>(file, grid.Get());
}

void write_surfaces(const std::filesystem::path& file, const mesh::WallMap& wall) {
  constexpr int rows = 60;
  constexpr int columns = 90;
  vtkNew<vtkUnstructuredGrid> grid;
  vtkNew<vtkPoints> points;
  vtkNew<vtkFloatArray> depth;
  depth->SetName("t");
  for (const double t : {0.0, 1.0}) {
    const vtkIdType first = points->GetNumberOfPoints();
    for (int i = 0; i <= rows; ++i) {
      for (int j = 0; j < columns; ++j) {
        points->InsertNextPoint(
            wall(1.0 * i / rows, 2.0 * std::numbers::pi * j / columns, t).data());
        depth->InsertNextValue(static_cast<float>(t));
      }
    }
    for (int i = 0; i < rows; ++i) {
      for (int j = 0; j < columns; ++j) {
        const vtkIdType here = first + static_cast<vtkIdType>(i) * columns;
        const vtkIdType next = (j + 1) % columns;
        const std::array<vtkIdType, 4> quad{here + j, here + next, here + columns + next,
                                            here + columns + j};
        grid->InsertNextCell(VTK_QUAD, 4, quad.data());
      }
    }
  }
  grid->SetPoints(points);
  grid->GetPointData()->AddArray(depth);
  write_whole<vtkXMLUnstructuredGridWriter>(file, grid.Get());
}

void write_surfaces(const std::filesystem::path& file, const mesh::Mesh& mesh) {
  vtkNew<vtkUnstructuredGrid> grid;
  vtkNew<vtkPoints> points;
  for (const Vec3& x : mesh.nodes)
    points->InsertNextPoint(x.data());
  grid->SetPoints(points);
  for (const mesh::Surface* side : {&mesh.endo, &mesh.epi})
    for (int f = 0; f < side->size(); ++f) {
      const auto face = side->face(f);
      const std::vector<vtkIdType> nodes(face.begin(), face.end());
      grid->InsertNextCell(nodes.size() == 4 ? VTK_QUAD : VTK_TRIANGLE,
                           static_cast<vtkIdType>(nodes.size()), nodes.data());
    }
  Arrays(grid->GetPointData(), mesh.nodes.size()).scalar("t", [&](auto a) {
    return mesh.transmural[a];
  });
  write_whole<vtkXMLUnstructuredGridWriter>(file, grid.Get());
}

void write_blood(const std::filesystem::path& file, const BloodFields& blood) {
  vtkNew<vtkImageData> image;
  image->SetDimensions(blood.cells[0] + 1, blood.cells[1] + 1, blood.cells[2] + 1);
  image->SetOrigin(blood.lower.data());
  image->SetSpacing(blood.spacing.data());
  Arrays cells(image->GetCellData(), blood.pressure.size());
  cells.vector("velocity", [&](auto c) { return Vec3(blood.velocity.data() + 3 * c); });
  cells.scalar("pressure", [&](auto c) { return blood.pressure[c]; });
  write_whole<vtkXMLImageDataWriter>(file, image.Get());
}

void write_pvd(const std::filesystem::path& file, const std::vector<TimedFile>& series) {
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n<Collection>\n";
  for (const TimedFile& entry : series)
    text += fmt::format("<DataSet timestep=\"{:.6g}\" file=\"{}\"/>\n", entry.time, entry.file);
  write_file(file, text + "</Collection>\n</VTKFile>\n");
}

}  // namespace lv::report
