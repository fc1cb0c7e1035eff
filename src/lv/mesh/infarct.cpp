#include "lv/mesh/infarct.hpp"

#include "lv/base/check.hpp"
#include "lv/mesh/cell.hpp"
#include "lv/mesh/distance.hpp"
#include "lv/mesh/quadratic.hpp"
#include "lv/mesh/spread_points.hpp"
#include "lv/mesh/surface.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <optional>

namespace lv::mesh {
namespace {

/// Of the apex of the epicardium.
double apex_z(const Mesh& mesh) {
  double z = 0.0;
  for (const int a : mesh.epi.nodes)
    z = std::min(z, mesh.nodes[a].z());
  return z;
}

/// The faces of a cell, each by its nodes in ascending order.
std::vector<std::vector<int>> faces_of(const Mesh& mesh, int c) {
  std::vector<std::vector<int>> faces;
  for (const LocalFace& local : cell_faces(mesh.kind)) {
    std::vector<int>& face = faces.emplace_back();
    for (const int a : local)
      if (a >= 0)
        face.push_back(mesh.cell(c)[a]);
    std::sort(face.begin(), face.end());
  }
  return faces;
}

/// The infarcted elements alone, on the nodes of the whole wall.
Mesh infarcted_part(const Mesh& mesh, const Infarcted& infarcted) {
  Mesh part;
  part.kind = mesh.kind;
  part.nodes = mesh.nodes;
  for (int c = 0; c < mesh.cell_count(); ++c)
    if (infarcted[c])
      part.cells.insert(part.cells.end(), mesh.cell(c).begin(), mesh.cell(c).end());
  return part;
}

/// Numbers the parts of the wall that are not infarcted, of cells that share faces; -1 in the
/// infarct.
std::vector<int> healthy_parts(const Mesh& mesh, const Infarcted& infarcted) {
  std::map<std::vector<int>, std::vector<int>> cells_of_face;
  for (int c = 0; c < mesh.cell_count(); ++c)
    if (!infarcted[c])
      for (const auto& face : faces_of(mesh, c))
        cells_of_face[face].push_back(c);
  std::vector<std::vector<int>> neighbours(mesh.cell_count());
  for (const auto& [face, cells] : cells_of_face)
    if (cells.size() == 2) {
      neighbours[cells[0]].push_back(cells[1]);
      neighbours[cells[1]].push_back(cells[0]);
    }
  std::vector<int> part(mesh.cell_count(), -1);
  int parts = 0;
  for (int c = 0; c < mesh.cell_count(); ++c) {
    if (infarcted[c] || part[c] >= 0)
      continue;
    std::vector<int> front{c};
    part[c] = parts;
    while (!front.empty()) {
      const int at = front.back();
      front.pop_back();
      for (const int next : neighbours[at])
        if (part[next] < 0) {
          part[next] = parts;
          front.push_back(next);
        }
    }
    ++parts;
  }
  return part;
}

/// The transmural coordinate t of a cell's centre.
double depth_of(const Mesh& mesh, int c) {
  double t = 0.0;
  for (const int a : mesh.cell(c))
    t += mesh.transmural[a];
  return t / nodes_per_cell(mesh.kind);
}

}  // namespace

Infarcted infarcted_where(const Mesh& mesh, const Region& inside) {
  Infarcted infarcted;
  for (int c = 0; c < mesh.cell_count(); ++c)
    infarcted.push_back(inside(cell_centre(mesh, c), depth_of(mesh, c)));
  return infarcted;
}

std::vector<double> infarcted_part(const Mesh& mesh, const Region& inside) {
  std::vector<double> part;
  for (int c = 0; c < mesh.cell_count(); ++c) {
    const auto nodes = mesh.cell(c);
    double whole = 0.0;
    double infarcted = 0.0;
    for (const CellPoint& point : spread_points(mesh, c)) {
      Vec3 X = Vec3::Zero();
      double t = 0.0;
      for (std::size_t a = 0; a < nodes.size(); ++a) {
        X += point.shape[a] * mesh.nodes[nodes[a]];
        t += point.shape[a] * mesh.transmural[nodes[a]];
      }
      whole += point.volume;
      if (inside(X, t))
        infarcted += point.volume;
    }
    part.push_back(infarcted / whole);
  }
  return part;
}

Region described_region(const Mesh& mesh, const DescribedInfarct& infarct,
                        const RegionParameters& regions) {
  constexpr double turn = 2.0 * std::numbers::pi;
  return [=, axis = cavity_axis(mesh, regions), lowest = apex_z(mesh)](const Vec3& X, double t) {
    const double h = 1.0 - X.z() / lowest;
    if (t > infarct.transmurality || h <= infarct.apex)
      return t <= infarct.transmurality;
    const Vec3 r = X - axis(X.z());
    const double middle = regions.septum_angle + infarct.angle;
    const double theta = std::remainder(std::atan2(r.y(), r.x()) - middle, turn);
    return std::abs(theta) <= 0.5 * infarct.width && h >= infarct.bottom && h <= infarct.top;
  };
}

std::vector<double> infarct_field(const Mesh& mesh, const Infarcted& infarcted, double border) {
  LV_CHECK(border > 0.0);
  const Mesh part = infarcted_part(mesh, infarcted);
  const SurfaceDistance d(part.nodes, boundary(part));
  std::vector<double> M;
  for (const Vec3& X : mesh.nodes)
    M.push_back(std::max(0.0, 1.0 - d(X) / border));
  for (const int a : part.cells)  // inside, the distance is that to the edge
    M[a] = 1.0;
  return M;
}

Infarcted with_enclosed(const Mesh& mesh, const Infarcted& infarcted) {
  const std::vector<int> part = healthy_parts(mesh, infarcted);
  const int parts = 1 + *std::max_element(part.begin(), part.end());
  std::vector<double> volume(parts, 0.0);
  std::vector<bool> open(parts, false);
  std::vector<bool> outside(mesh.nodes.size(), false);
  for (const Surface* surface : {&mesh.epi, &mesh.base})
    for (const int a : surface->nodes)
      outside[a] = true;
  for (int c = 0; c < mesh.cell_count(); ++c) {
    if (part[c] < 0)
      continue;
    volume[part[c]] += cell_volume(mesh, c);
    for (const int a : mesh.cell(c))
      if (outside[a])
        open[part[c]] = true;
  }
  const auto largest = std::max_element(volume.begin(), volume.end()) - volume.begin();
  Infarcted all = infarcted;
  for (int c = 0; c < mesh.cell_count(); ++c)
    if (part[c] >= 0 && part[c] != largest && !open[part[c]])
      all[c] = true;
  return all;
}

std::vector<double> part_by_extent(const Mesh& mesh) {
  std::vector<double> part;
  for (int c = 0; c < mesh.cell_count(); ++c) {
    const auto nodes = mesh.cell(c);
    part.push_back(
        std::all_of(nodes.begin(), nodes.end(), [&](int a) { return mesh.infarct[a] == 1.0; }));
  }
  return part;
}

namespace {

/// A column of the wall, of some layers from endocardium to epicardium.
struct Column {
  static constexpr std::size_t layers = 4;
  std::array<double, layers> wall{}, infarct{};  // [mm^3]

  [[nodiscard]] static double sum(const std::array<double, layers>& volumes, std::size_t first = 0,
                                  std::size_t last = layers - 1) {
    return std::accumulate(volumes.begin() + static_cast<std::ptrdiff_t>(first),
                           volumes.begin() + static_cast<std::ptrdiff_t>(last + 1), 0.0);
  }

  /// How much of its cross-section is infarcted. Infarct in several layers ends in the depth within
  /// the first or the last of them, so that the others tell; of infarct in one layer nobody knows
  /// whether it ends in the depth or along the wall.
  [[nodiscard]] std::optional<double> covered() const {
    std::size_t first = layers, last = 0;
    for (std::size_t k = 0; k < layers; ++k)
      if (infarct.at(k) > 0.0) {
        first = std::min(first, k);
        last = k;
      }
    if (first >= last)
      return {};
    const auto part = [&](std::size_t from, std::size_t to) {
      return sum(infarct, from, to) / sum(wall, from, to);
    };
    return std::max(part(first, last - 1), part(first + 1, last));
  }
};

/// Infarct, and the wall that it takes along the wall [mm^3].
struct Extent {
  double infarct = 0.0, wall = 0.0;

  void add(double of_infarct, double of_wall) {
    infarct += of_infarct;
    wall += of_wall;
  }
};

/// Columns of this size hold two elements each way, or more [mm].
double column_size(const Mesh& mesh) {
  double volume = 0.0;
  for (int c = 0; c < mesh.cell_count(); ++c)
    volume += cell_volume(mesh, c);
  return std::max(5.0, 2.0 * std::cbrt(volume / mesh.cell_count()));
}

std::size_t layer_of(const Mesh& mesh, int cell) {
  const double t = std::max(depth_of(mesh, cell), 0.0);
  return std::min(Column::layers - 1, static_cast<std::size_t>(Column::layers * t));
}

}  // namespace

std::vector<SegmentInfarct> infarct_by_segment(const Mesh& mesh, const std::vector<double>& part,
                                               const Regions& regions,
                                               const RegionParameters& parameters) {
  const double size = column_size(mesh);
  constexpr double usual_radius = 30.0;  // of the wall [mm]
  const double width = size / usual_radius;
  const auto axis = cavity_axis(mesh, parameters);
  const std::vector<double> volumes = cell_volumes(mesh);
  std::map<std::array<int, 3>, Column> columns;
  for (int c = 0; c < mesh.cell_count(); ++c) {
    const Vec3 X = cell_centre(mesh, c);
    const Vec3 r = X - axis(X.z());
    Column& column = columns[{regions.aha[c], static_cast<int>(std::floor(X.z() / size)),
                              static_cast<int>(std::floor(std::atan2(r.y(), r.x()) / width))}];
    const double V = volumes[c];
    const std::size_t layer = layer_of(mesh, c);
    column.wall.at(layer) += V;
    column.infarct.at(layer) += part[c] * V;
  }
  std::vector<SegmentInfarct> segments(17);
  std::vector<Extent> deep(17), shallow(17);
  for (int s = 0; s < 17; ++s)
    segments[s].segment = s + 1;
  for (const auto& [key, column] : columns) {
    SegmentInfarct& segment = segments.at(key[0] - 1);
    const double wall = Column::sum(column.wall);
    const double infarct = Column::sum(column.infarct);
    segment.wall += wall;
    segment.infarct += infarct;
    if (const auto covered = column.covered())
      deep.at(key[0] - 1).add(infarct, *covered * wall);
    else if (infarct > 0.0)
      shallow.at(key[0] - 1).add(infarct, wall);
  }
  for (int s = 0; s < 17; ++s) {
    Extent extent = deep[s];
    if (shallow[s].infarct > deep[s].infarct)  // else they are the edges of a deeper infarct
      extent.add(shallow[s].infarct, shallow[s].wall);
    segments[s].transmurality =
        extent.wall > 0.0 ? std::min(1.0, extent.infarct / extent.wall) : 0.0;
  }
  return segments;
}

InfarctVolumes infarct_volumes(const Mesh& mesh, const std::vector<double>& part) {
  InfarctVolumes volumes;
  const std::vector<double> of_cells = cell_volumes(mesh);
  for (int c = 0; c < mesh.cell_count(); ++c) {
    const auto nodes = mesh.cell(c);
    const double V = of_cells[c];
    volumes.wall += V;
    volumes.infarct += part[c] * V;
    if (std::any_of(nodes.begin(), nodes.end(), [&](int a) { return mesh.infarct[a] > 0.0; }))
      volumes.border += (1.0 - part[c]) * V;
  }
  return volumes;
}

}  // namespace lv::mesh
