#include "lv/page/wall_series.hpp"

#include "lv/analysis/quantities.hpp"
#include "lv/base/check.hpp"
#include "lv/base/interrupt.hpp"
#include "lv/mesh/cell.hpp"
#include "lv/mesh/regions.hpp"
#include "lv/mesh_io/vtk_file.hpp"

#include <fmt/format.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkDataArraySelection.h>
#include <vtkNew.h>
#include <vtkObject.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string_view>

namespace lv::page {
namespace {

/// The state that a frame's strains are from.
const char* strained_from(bool from_end_diastole) {
  return from_end_diastole ? "end_diastole" : "early_diastole";
}

/// Whether a frame comes after the end of diastole.
bool is_after(const TimedFrame& frame, double end_diastole) {
  constexpr double rounding = 1e-5;  // of times in a series [s]
  return frame.time > end_diastole + rounding;
}

[[noreturn]] void fail(const std::filesystem::path& file) {
  throw RunError(fmt::format("{} cannot be read", file.string()),
                 "Remove the stage's folder and run the case again");
}

/// One VTU file with those of its arrays that are asked for.
class WrittenFrame {
 public:
  WrittenFrame(const std::filesystem::path& file, const std::vector<std::string>& cell_arrays)
      : file_(file) {
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
      fail(file);
    mesh_io::check_cells(file.string(), grid_->GetCells(), grid_->GetNumberOfPoints());
  }

  vtkUnstructuredGrid* operator->() const { return grid_; }

  /// Null when the file has no such array.
  [[nodiscard]] vtkDataArray* cells(const std::string& name, int components = 1) const {
    return checked(grid_->GetCellData()->GetArray(name.c_str()), components,
                   grid_->GetNumberOfCells());
  }
  [[nodiscard]] vtkDataArray* nodes(const char* name, int components) const {
    return checked(grid_->GetPointData()->GetArray(name), components, grid_->GetNumberOfPoints());
  }
  [[nodiscard]] const std::filesystem::path& file() const { return file_; }

 private:
  vtkDataArray* checked(vtkDataArray* array, int components, vtkIdType count) const {
    if (array != nullptr &&
        (array->GetNumberOfComponents() != components || array->GetNumberOfTuples() != count))
      fail(file_);
    return array;
  }

  std::filesystem::path file_;
  vtkSmartPointer<vtkUnstructuredGrid> grid_;
};

std::vector<int> whole_numbers(vtkDataArray* array) {
  std::vector<int> values;
  for (vtkIdType i = 0; array != nullptr && i < array->GetNumberOfTuples(); ++i)
    values.push_back(static_cast<int>(std::fmax(-1e9, std::fmin(1e9, array->GetComponent(i, 0)))));
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

Vec3 displacement(const WrittenFrame& frame, vtkIdType node) {
  vtkDataArray* u = frame.nodes("displacement", 3);
  if (u == nullptr)
    return Vec3::Zero();
  return {u->GetComponent(node, 0), u->GetComponent(node, 1), u->GetComponent(node, 2)};
}

/// What does not change from frame to frame.
WallSeries fixed_part(const WrittenFrame& frame) {
  WallSeries wall;
  wall.kind =
      frame->GetCellType(0) == VTK_TETRA ? mesh::CellKind::tetrahedron : mesh::CellKind::hexahedron;
  for (vtkIdType a = 0; a < frame->GetNumberOfPoints(); ++a)
    wall.undeformed.emplace_back(Vec3(frame->GetPoint(a)) - displacement(frame, a));
  for (vtkIdType c = 0; c < frame->GetNumberOfCells(); ++c) {
    vtkIdType count = 0;
    const vtkIdType* nodes = nullptr;
    frame->GetCellPoints(c, count, nodes);
    wall.cells.insert(wall.cells.end(), nodes, nodes + count);
  }
  if (wall.cells.size() !=
      static_cast<std::size_t>(mesh::nodes_per_cell(wall.kind) * frame->GetNumberOfCells()))
    fail(frame.file());
  vtkDataArray* f0 = frame.cells("f0", 3);
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
  for (const analysis::Quantity& q : analysis::quantities())
    if (q.is_shown)
      names.push_back(q.field_name(strained_from(from_end_diastole)));
  return names;
}

void add_frame(WallSeries& wall, const TimedFrame& timed, bool from_end_diastole) {
  const WrittenFrame frame(timed.file, moving_arrays(from_end_diastole));
  const auto corners = mesh::nodes_per_cell(wall.kind) * frame->GetNumberOfCells();
  if (static_cast<std::size_t>(frame->GetNumberOfPoints()) != wall.undeformed.size() ||
      static_cast<std::size_t>(corners) != wall.cells.size())
    fail(timed.file);
  wall.times.push_back(timed.time);
  auto& u = wall.displacement.emplace_back();
  for (vtkIdType a = 0; a < frame->GetNumberOfPoints(); ++a)
    for (const double component : displacement(frame, a))
      u.push_back(static_cast<float>(component));
  for (const analysis::Quantity& q : analysis::quantities())
    if (q.is_shown)
      if (auto* array = frame.cells(q.field_name(strained_from(from_end_diastole))))
        wall.quantities[q.name].push_back(to_nodes(array, wall));
}

/// Strains and stresses that the page shows and a frame has.
std::vector<const analysis::Quantity*> strains_and_stresses(const TimedFrame& first) {
  const WrittenFrame frame(first.file, moving_arrays(false));
  std::vector<const analysis::Quantity*> found;
  for (const analysis::Quantity& q : analysis::quantities())
    if (q.is_shown && (q.is_strain || std::string_view(q.unit) == "kPa") &&
        frame.cells(q.field_name(strained_from(false))) != nullptr)
      found.push_back(&q);
  return found;
}

/// The array of an element's numbers that every frame must have.
vtkDataArray* needed(const WrittenFrame& frame, const std::string& name) {
  vtkDataArray* array = frame.cells(name);
  if (array == nullptr)
    fail(frame.file());
  return array;
}

/// The mean over every AHA segment; not a number where a segment has no elements.
std::vector<double> segment_means(vtkDataArray* values, const std::vector<int>& segment,
                                  vtkDataArray* volume) {
  std::vector<double> sum(mesh::aha_count + 1, 0.0);
  std::vector<double> whole(sum.size(), 0.0);
  for (std::size_t c = 0; c < segment.size(); ++c) {
    const double part = volume->GetComponent(static_cast<vtkIdType>(c), 0);
    sum.at(segment[c]) += part * values->GetComponent(static_cast<vtkIdType>(c), 0);
    whole.at(segment[c]) += part;
  }
  for (std::size_t s = 0; s < sum.size(); ++s)
    sum[s] /= whole[s];
  return sum;
}

void add_segments(Table& table, const TimedFrame& timed,
                  const std::vector<const analysis::Quantity*>& quantities,
                  bool from_end_diastole) {
  std::vector<std::string> arrays = moving_arrays(from_end_diastole);
  arrays.insert(arrays.end(), {"aha17", "reference_volume"});
  const WrittenFrame frame(timed.file, arrays);
  const std::vector<int> segment = whole_numbers(needed(frame, "aha17"));
  if (std::any_of(segment.begin(), segment.end(),
                  [](int s) { return s < 1 || s > mesh::aha_count; }))
    fail(timed.file);
  std::vector<std::vector<double>> means;
  for (const analysis::Quantity* q : quantities)
    means.push_back(segment_means(needed(frame, q->field_name(strained_from(from_end_diastole))),
                                  segment, needed(frame, "reference_volume")));
  constexpr int digits = 6;  // fields have single precision
  for (int s = 1; s <= mesh::aha_count; ++s) {
    std::vector<std::string> row{Table::number(timed.time), std::to_string(s), mesh::aha_name(s)};
    for (const auto& mean : means)
      row.push_back(Table::number(mean[s], digits));
    table.add_row(row);
  }
}

Skin skin_of(const WallSeries& wall) {
  const int per_cell = mesh::nodes_per_cell(wall.kind);
  const int per_face = wall.kind == mesh::CellKind::hexahedron ? 4 : 3;
  struct Face {
    std::array<int, 4> sorted, nodes;
    int cell;
  };
  std::vector<Face> faces;
  for (std::size_t first = 0; first < wall.cells.size(); first += per_cell)
    for (const mesh::LocalFace& local : mesh::cell_faces(wall.kind)) {
      Face face{{-1, -1, -1, -1}, {-1, -1, -1, -1}, static_cast<int>(first) / per_cell};
      for (int i = 0; i < per_face; ++i)
        face.nodes.at(i) = wall.cells[first + local.at(i)];
      face.sorted = face.nodes;
      std::sort(face.sorted.begin(), face.sorted.end());
      faces.push_back(face);
    }
  std::stable_sort(faces.begin(), faces.end(),
                   [](const Face& a, const Face& b) { return a.sorted < b.sorted; });
  Skin skin;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const bool shared = (f > 0 && faces[f - 1].sorted == faces[f].sorted) ||
                        (f + 1 < faces.size() && faces[f + 1].sorted == faces[f].sorted);
    if (shared)
      continue;
    skin.nodes.insert(skin.nodes.end(), faces[f].nodes.begin(), faces[f].nodes.begin() + per_face);
    skin.cells.push_back(faces[f].cell);
  }
  return skin;
}

Reach reach_of(const WallSeries& wall) {
  Reach reach;
  for (std::size_t frame = 0; frame < wall.displacement.size(); ++frame)
    for (const Vec3& x : wall.positions(frame)) {
      reach.radius = std::max(reach.radius, std::hypot(x.x(), x.y()));
      reach.bottom = std::min(reach.bottom, x.z());
      reach.top = std::max(reach.top, x.z());
    }
  return reach;
}

/// The value of an attribute in the text of an XML element; empty if it has none.
std::string_view attribute(std::string_view element, const std::string& name) {
  const std::string begin = fmt::format(" {}=\"", name);
  const auto at = element.find(begin);
  if (at == std::string_view::npos)
    return {};
  element.remove_prefix(at + begin.size());
  return element.substr(0, element.find('"'));
}

}  // namespace

std::vector<Vec3> WallSeries::positions(std::size_t frame) const {
  std::vector<Vec3> x = undeformed;
  const std::vector<float>& u = displacement[frame];
  for (std::size_t a = 0; a < x.size(); ++a)
    x[a] += Vec3(u[3 * a], u[3 * a + 1], u[3 * a + 2]);
  return x;
}

mesh::Mesh WallSeries::mesh(int order) const {
  mesh::Mesh mesh;
  mesh.kind = kind;
  mesh.nodes = undeformed;
  mesh.cells = cells;
  mesh.epi.nodes_per_face = kind == mesh::CellKind::hexahedron ? 4 : 3;
  mesh.epi.nodes.assign(skin.nodes.begin(), skin.nodes.end());
  mesh.endo.nodes_per_face = mesh.base.nodes_per_face = mesh.epi.nodes_per_face;
  mesh.order = order;
  mesh.transmural.assign(undeformed.size(), 0.0);
  mesh.infarct = mesh.transmural;
  return mesh;
}

std::vector<TimedFrame> frames_of(const std::filesystem::path& pvd) {
  if (!std::filesystem::exists(pvd))
    return {};
  const std::string text = read_file(pvd);
  constexpr std::string_view tag = "<DataSet";
  std::vector<TimedFrame> frames;
  for (auto at = text.find(tag); at != std::string::npos; at = text.find(tag, at + 1)) {
    const std::string_view element = std::string_view(text).substr(at, text.find('>', at) - at);
    const auto file = pvd.parent_path() / attribute(element, "file");
    const std::string_view timestep = attribute(element, "timestep");
    double time = 0.0;
    const auto [end, error] =
        std::from_chars(timestep.data(), timestep.data() + timestep.size(), time);
    if (error != std::errc() || end != timestep.data() + timestep.size() || !std::isfinite(time))
      fail(pvd);
    if (std::filesystem::is_regular_file(file))
      frames.push_back({time, file});
  }
  return frames;
}

WallSeries read_wall_series(const std::vector<TimedFrame>& frames, double end_diastole) {
  WallSeries wall =
      fixed_part(WrittenFrame(frames.front().file, {"f0", "infarct", "slice", "sector", "aha17"}));
  for (const TimedFrame& frame : frames) {
    interrupt::check();
    add_frame(wall, frame, is_after(frame, end_diastole));
  }
  wall.skin = skin_of(wall);
  wall.reach = reach_of(wall);
  return wall;
}

Table segments_over_time(const std::vector<TimedFrame>& frames, double end_diastole) {
  const auto quantities = strains_and_stresses(frames.front());
  std::vector<std::string> columns{"time_s", "segment", "name"};
  for (const analysis::Quantity* q : quantities)
    columns.push_back(q->is_strain ? q->name : fmt::format("{}_{}", q->name, q->unit));
  Table table(columns);
  for (const TimedFrame& frame : frames) {
    interrupt::check();
    add_segments(table, frame, quantities, is_after(frame, end_diastole));
  }
  return table;
}

}  // namespace lv::page
