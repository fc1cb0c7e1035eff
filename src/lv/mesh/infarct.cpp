#include "lv/mesh/infarct.hpp"

#include "lv/base/check.hpp"
#include "lv/mesh/cell.hpp"
#include "lv/mesh/distance.hpp"
#include "lv/mesh/surface.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lv::mesh {
namespace {

/// Of the apex of the epicardium.
double apex_z(const Mesh& mesh) {
  double z = 0.0;
  for (const int a : mesh.epi.nodes)
    z = std::min(z, mesh.nodes[a].z());
  return z;
}

double mean_transmural(const Mesh& mesh, int cell) {
  double sum = 0.0;
  for (const int a : mesh.cell(cell))
    sum += mesh.transmural[a];
  return sum / static_cast<double>(mesh.cell(cell).size());
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

}  // namespace

Infarcted infarcted_where(const Mesh& mesh, const std::function<bool(const Vec3&)>& inside) {
  Infarcted infarcted;
  for (int c = 0; c < mesh.cell_count(); ++c)
    infarcted.push_back(inside(cell_centre(mesh, c)));
  return infarcted;
}

Infarcted infarcted_as_described(const Mesh& mesh, const DescribedInfarct& infarct,
                                 const RegionParameters& regions) {
  constexpr double turn = 2.0 * std::numbers::pi;
  const auto axis = cavity_axis(mesh, regions);
  const double lowest = apex_z(mesh);
  const double middle = regions.septum_angle + infarct.angle;
  const auto in_sector = [&](const Vec3& X, double h) {
    const Vec3 r = X - axis(X.z());
    const double theta = std::remainder(std::atan2(r.y(), r.x()) - middle, turn);
    return std::abs(theta) <= 0.5 * infarct.width && h >= infarct.bottom && h <= infarct.top;
  };
  Infarcted infarcted;
  for (int c = 0; c < mesh.cell_count(); ++c) {
    const Vec3 X = cell_centre(mesh, c);
    const double h = 1.0 - X.z() / lowest;
    infarcted.push_back(mean_transmural(mesh, c) <= infarct.transmurality &&
                        (h <= infarct.apex || in_sector(X, h)));
  }
  return infarcted;
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

InfarctVolumes infarct_volumes(const Mesh& mesh) {
  InfarctVolumes volumes;
  for (int c = 0; c < mesh.cell_count(); ++c) {
    double least = 1.0;
    double most = 0.0;
    for (const int a : mesh.cell(c)) {
      least = std::min(least, mesh.infarct[a]);
      most = std::max(most, mesh.infarct[a]);
    }
    const double V = cell_volume(mesh, c);
    volumes.wall += V;
    if (least == 1.0)
      volumes.infarct += V;
    else if (most > 0.0)
      volumes.border += V;
  }
  return volumes;
}

}  // namespace lv::mesh
