#include "lv/activation/times_file.hpp"

#include "lv/base/check.hpp"
#include "lv/base/ending.hpp"
#include "lv/base/lines.hpp"
#include "lv/mesh/cell.hpp"
#include "lv/mesh/quadratic.hpp"
#include "lv/mesh/shapes.hpp"
#include "lv/mesh_io/vtk_grid.hpp"

#include <fmt/format.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <cmath>

namespace lv::activation {
namespace {

/// The arrays of single numbers, those in cells and those at points.
std::vector<std::string> single_numbers(vtkFieldData& data) {
  std::vector<std::string> names;
  for (const std::string& name : mesh_io::array_names(data))
    if (const vtkDataArray* array = data.GetArray(name.c_str());
        array != nullptr && array->GetNumberOfComponents() == 1)
      names.push_back(name);
  return names;
}

/// `what` says which of the file's times it is.
void check_time(double time, const std::string& where, const std::string& what) {
  if (!(time >= 0.0 && std::isfinite(time)))
    throw InputError(where, fmt::format("{} is {:g}, which is no time from 0 on", what, time),
                     "Give all muscle a time from 0 on, after which its calcium begins; a time "
                     "below 0 usually means that the front never came");
}

vtkDataArray& times_of(const TimesFile& source, vtkUnstructuredGrid& grid) {
  vtkFieldData& points = *grid.GetPointData();
  vtkFieldData& cells = *grid.GetCellData();
  std::string name = source.array;
  if (name.empty()) {
    std::vector<std::string> all = single_numbers(points);
    const auto in_cells = single_numbers(cells);
    all.insert(all.end(), in_cells.begin(), in_cells.end());
    if (all.size() != 1)
      throw InputError(source.file,
                       fmt::format("has {} arrays of single numbers{}{}", all.size(),
                                   all.empty() ? "" : ": ", fmt::join(all, ", ")),
                       "Say which holds the times: activation.array = \"...\"");
    name = all.front();
  }
  if (points.HasArray(name.c_str()) != 0)
    return mesh_io::find_array(source.file, points, grid.GetNumberOfPoints(), 1, "point array",
                               name);
  return mesh_io::find_array(source.file, cells, grid.GetNumberOfCells(), 1, "cell array", name);
}

std::vector<double> read_vtk(const TimesFile& source) {
  const auto grid = mesh_io::read_grid(source.file);
  vtkDataArray& array = times_of(source, *grid);
  const bool is_at_points = grid->GetPointData()->HasArray(array.GetName()) != 0;
  std::vector<double> numbers;
  for (vtkIdType i = 0; i < array.GetNumberOfTuples(); ++i) {
    numbers.push_back(array.GetComponent(i, 0));
    check_time(numbers.back(), source.file,
               fmt::format("{} of {} {} (counted from 0, as ParaView does)", array.GetName(),
                           is_at_points ? "point" : "cell", i));
  }
  return numbers;
}

std::vector<double> read_lines(const std::string& file) {
  LineReader lines(file);
  if (!lines.is_open())
    throw InputError(file, "cannot be read", "Check the name; it is read beside the case");
  std::vector<double> numbers;
  while (lines.next()) {
    const std::string_view text = trimmed(lines.text());
    if (text.starts_with('#'))
      continue;
    const auto number = number_of<double>(text);
    if (!number)
      throw InputError(lines.where(), why_no_number(text, "is no number"), "Write one time a line");
    check_time(*number, lines.where(), "the time");
    numbers.push_back(*number);
  }
  return numbers;
}

/// Means of the cells around each node.
std::vector<double> from_cells(const mesh::Mesh& mesh, const std::vector<double>& cells) {
  std::vector<double> sum(mesh.nodes.size(), 0.0);
  std::vector<double> volume(mesh.nodes.size(), 0.0);
  for (int c = 0; c < mesh.cell_count(); ++c) {
    const double V = mesh::cell_volume(mesh, c);
    for (const int node : mesh.cell(c)) {
      sum[node] += V * cells[c];
      volume[node] += V;
    }
  }
  for (std::size_t a = 0; a < sum.size(); ++a)
    sum[a] /= volume[a];
  return sum;
}

std::vector<double> eight_times(const std::vector<double>& elements) {
  std::vector<double> cells;
  for (const double value : elements)
    cells.insert(cells.end(), 8, value);
  return cells;
}

/// How much of each corner of a quadratic element its nodes have, with linear shapes.
std::vector<std::vector<double>> shares_of_corners(mesh::CellKind kind) {
  std::vector<std::vector<double>> shares;
  for (const Vec3& place : mesh::node_places(kind, 2)) {
    const Eigen::VectorXd phi = mesh::shapes<3>(kind, 1, {place.x(), place.y(), place.z()}).value;
    shares.emplace_back(phi.begin(), phi.end());
  }
  return shares;
}

/// The corners of quadratic elements, in the order of their numbers: a mesh keeps the nodes of the
/// one that it was refined from as its first.
class Corners {
 public:
  explicit Corners(const mesh::Mesh& mesh)
      : elements_(mesh::elements(mesh)), shares_(shares_of_corners(mesh.kind)) {
    for (std::size_t c = 0; c < shares_.front().size(); ++c)
      for (std::size_t a = 0; a < shares_.size(); ++a)
        if (shares_[a][c] > 1.0 - 1e-12)
          at_.push_back(a);
    for (int e = 0; e < elements_.size(); ++e)
      for (const std::size_t a : at_)
        numbers_.push_back(elements_.element(e)[a]);
    std::sort(numbers_.begin(), numbers_.end());
    numbers_.erase(std::unique(numbers_.begin(), numbers_.end()), numbers_.end());
  }

  [[nodiscard]] std::size_t count() const { return numbers_.size(); }

  [[nodiscard]] std::vector<double> to_nodes(const std::vector<double>& corners,
                                             std::size_t nodes) const {
    const auto of = [&](int node) {
      const auto place = std::lower_bound(numbers_.begin(), numbers_.end(), node);
      return corners[static_cast<std::size_t>(place - numbers_.begin())];
    };
    std::vector<double> values(nodes, 0.0);
    for (int e = 0; e < elements_.size(); ++e) {
      const auto element = elements_.element(e);
      for (std::size_t a = 0; a < element.size(); ++a) {
        double value = 0.0;
        for (std::size_t c = 0; c < at_.size(); ++c)
          value += shares_[a][c] * of(element[at_[c]]);
        values[element[a]] = value;
      }
    }
    return values;
  }

 private:
  mesh::ElementNodes elements_;
  std::vector<std::vector<double>> shares_;
  std::vector<std::size_t> at_;  ///< the corners among the nodes of an element
  std::vector<int> numbers_;     ///< of nodes that are corners, ascending
};

[[noreturn]] void fail_count(const TimesFile& source, std::size_t count, const std::string& has) {
  throw InputError(source.file, fmt::format("has {} times, but the wall has {}", count, has),
                   "Write one time for each of them, in the order of 02_mesh/mesh.vtu");
}

std::vector<double> on_nodes(const TimesFile& source, const mesh::Mesh& mesh,
                             const std::vector<double>& times) {
  const std::size_t count = times.size();
  const auto cells = static_cast<std::size_t>(mesh.cell_count());
  if (count == mesh.nodes.size())
    return times;
  if (count == cells)
    return from_cells(mesh, times);
  const std::string has = fmt::format("{} nodes and {} cells", mesh.nodes.size(), cells);
  if (mesh.order == 1)
    fail_count(source, count, has);
  const Corners corners(mesh);
  if (count == corners.count())
    return corners.to_nodes(times, mesh.nodes.size());
  if (count == cells / 8)
    return from_cells(mesh, eight_times(times));
  fail_count(
      source, count,
      fmt::format("{}, of {} quadratic elements with {} corners", has, cells / 8, corners.count()));
}

}  // namespace

std::vector<double> read_times(const TimesFile& source, const mesh::Mesh& mesh) {
  const std::string end = ending_of(source.file);
  std::vector<double> times =
      end == ".vtu" || end == ".vtk" ? read_vtk(source) : read_lines(source.file);
  for (double& time : times)
    time *= source.unit;
  return on_nodes(source, mesh, times);
}

}  // namespace lv::activation
