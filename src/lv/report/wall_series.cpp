#include "lv/report/wall_series.hpp"

#include "lv/base/check.hpp"
#include "lv/base/table.hpp"

#include <fmt/format.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkDataArraySelection.h>
#include <vtkNew.h>
#include <vtkObject.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <array>
#include <regex>

namespace lv::report {
namespace {

struct Source {
  const char* quantity;
  const char* array;  ///< a strain's name lacks the state it is measured from
  bool is_strain;
};

constexpr std::array<Source, 8> sources{{{"active_tension", "active_tension", false},
                                         {"fibre_stress", "fibre_stress", false},
                                         {"fibre_stress_passive", "fibre_stress_passive", false},
                                         {"fibre_strain", "E_fibre", true},
                                         {"circumferential_strain", "E_circumferential", true},
                                         {"radial_strain", "E_radial", true},
                                         {"longitudinal_strain", "E_longitudinal", true},
                                         {"J", "J", false}}};

std::string array_name(const Source& source, bool from_end_diastole) {
  if (!source.is_strain)
    return source.array;
  return fmt::format("{}_{}", source.array, from_end_diastole ? "end_diastole" : "early_diastole");
}

/// One VTU file with those of its arrays that are asked for.
class Frame {
 public:
  Frame(const std::filesystem::path& file, const std::vector<std::string>& cell_arrays) {
    vtkObject::GlobalWarningDisplayOff();  // what goes wrong is said once, below
    vtkNew<vtkXMLUnstructuredGridReader> reader;
    reader->SetFileName(file.c_str());
    reader->UpdateInformation();
    auto* selection = reader->GetCellDataArraySelection();
    selection->DisableAllArrays();
    for (const std::string& name : cell_arrays)
      selection->EnableArray(name.c_str());
    reader->Update();
    grid_ = reader->GetOutput();
    if (reader->GetErrorCode() != 0 || grid_->GetNumberOfPoints() == 0)
      throw RunError(fmt::format("{} cannot be read", file.string()),
                     "Remove the stage's folder and run the case again");
  }

  vtkUnstructuredGrid* operator->() const { return grid_; }

  /// Null when the file has no such array.
  [[nodiscard]] vtkDataArray* cells(const std::string& name) const {
    return grid_->GetCellData()->GetArray(name.c_str());
  }
  [[nodiscard]] vtkDataArray* nodes(const char* name) const {
    return grid_->GetPointData()->GetArray(name);
  }

 private:
  vtkSmartPointer<vtkUnstructuredGrid> grid_;
};

std::vector<int> whole_numbers(vtkDataArray* array) {
  std::vector<int> values;
  for (vtkIdType i = 0; array != nullptr && i < array->GetNumberOfTuples(); ++i)
    values.push_back(static_cast<int>(array->GetComponent(i, 0)));
  return values;
}

/// The mean over the cells around each node.
std::vector<float> to_nodes(vtkDataArray* array, const WallSeries& wall) {
  const int n = mesh::nodes_per_cell(wall.kind);
  std::vector<float> sum(wall.undeformed.size(), 0.0F);
  std::vector<float> count(wall.undeformed.size(), 0.0F);
  for (std::size_t i = 0; i < wall.cells.size(); ++i) {
    const int node = wall.cells[i];
    sum[node] += static_cast<float>(array->GetComponent(static_cast<vtkIdType>(i) / n, 0));
    count[node] += 1.0F;
  }
  for (std::size_t a = 0; a < sum.size(); ++a)
    sum[a] /= count[a];
  return sum;
}

Vec3 displacement(const Frame& frame, vtkIdType node) {
  vtkDataArray* u = frame.nodes("displacement");
  if (u == nullptr)
    return Vec3::Zero();
  return {u->GetComponent(node, 0), u->GetComponent(node, 1), u->GetComponent(node, 2)};
}

/// What does not change from frame to frame.
WallSeries fixed_part(const Frame& frame) {
  WallSeries wall;
  wall.kind =
      frame->GetCellType(0) == VTK_TETRA ? mesh::CellKind::tetrahedron : mesh::CellKind::hexahedron;
  for (vtkIdType a = 0; a < frame->GetNumberOfPoints(); ++a)
    wall.undeformed.push_back(Vec3(frame->GetPoint(a)) - displacement(frame, a));
  for (vtkIdType c = 0; c < frame->GetNumberOfCells(); ++c) {
    vtkIdType count = 0;
    const vtkIdType* nodes = nullptr;
    frame->GetCellPoints(c, count, nodes);
    wall.cells.insert(wall.cells.end(), nodes, nodes + count);
  }
  vtkDataArray* f0 = frame.cells("f0");
  for (vtkIdType c = 0; f0 != nullptr && c < frame->GetNumberOfCells(); ++c)
    wall.f0.emplace_back(f0->GetComponent(c, 0), f0->GetComponent(c, 1), f0->GetComponent(c, 2));
  if (vtkDataArray* M = frame.cells("infarct"); M != nullptr)
    wall.infarct = to_nodes(M, wall);
  wall.slice = whole_numbers(frame.cells("slice"));
  wall.sector = whole_numbers(frame.cells("sector"));
  wall.aha17 = whole_numbers(frame.cells("aha17"));
  return wall;
}

std::vector<std::string> moving_arrays(bool from_end_diastole) {
  std::vector<std::string> names;
  for (const Source& source : sources)
    names.push_back(array_name(source, from_end_diastole));
  return names;
}

void add_frame(WallSeries& wall, const TimedFrame& timed, bool from_end_diastole) {
  const Frame frame(timed.file, moving_arrays(from_end_diastole));
  wall.times.push_back(timed.time);
  auto& u = wall.displacement.emplace_back();
  for (vtkIdType a = 0; a < frame->GetNumberOfPoints(); ++a)
    for (const double component : displacement(frame, a))
      u.push_back(static_cast<float>(component));
  for (const Source& source : sources)
    if (vtkDataArray* array = frame.cells(array_name(source, from_end_diastole)))
      wall.quantities[source.quantity].push_back(to_nodes(array, wall));
}

}  // namespace

std::vector<TimedFrame> frames_of(const std::filesystem::path& pvd) {
  if (!std::filesystem::exists(pvd))
    return {};
  const std::string text = read_file(pvd);
  const std::regex entry(R"rx(timestep="([^"]*)"[^>]*file="([^"]*)")rx");
  std::vector<TimedFrame> frames;
  for (std::sregex_iterator i(text.begin(), text.end(), entry), end; i != end; ++i) {
    const auto file = pvd.parent_path() / (*i)[2].str();
    if (std::filesystem::exists(file))
      frames.push_back({std::stod((*i)[1].str()), file});
  }
  return frames;
}

WallSeries read_wall_series(const std::vector<TimedFrame>& frames, double end_diastole) {
  WallSeries wall =
      fixed_part(Frame(frames.front().file, {"f0", "infarct", "slice", "sector", "aha17"}));
  constexpr double rounding = 1e-5;  // of times in a series [s]
  for (const TimedFrame& frame : frames)
    add_frame(wall, frame, frame.time > end_diastole + rounding);
  return wall;
}

}  // namespace lv::report
