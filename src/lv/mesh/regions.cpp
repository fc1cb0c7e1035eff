#include "lv/mesh/regions.hpp"

#include "lv/mesh/cell.hpp"
#include "lv/mesh/surface.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

namespace lv::mesh {
namespace {

Vec3 centre(const Mesh& mesh, int cell) {
  Vec3 sum = Vec3::Zero();
  const auto nodes = mesh.cell(cell);
  for (const int a : nodes)
    sum += mesh.nodes[a];
  return sum / static_cast<double>(nodes.size());
}

double lowest(const Mesh& mesh, const Surface& surface) {
  double z = 0.0;
  for (const int a : surface.nodes)
    z = std::min(z, mesh.nodes[a].z());
  return z;
}

/// Slabs of the wall, counted from the base.
using SlabOf = std::function<int(double z)>;

/// The middle of the endocardium in each slab, weighted by area. Slabs beyond the cavity have the
/// middle of the one before.
std::vector<Vec3> cavity_centres(const Mesh& mesh, int slabs, const SlabOf& slab_of) {
  std::vector<Vec3> sum(slabs, Vec3::Zero());
  std::vector<double> area(slabs, 0.0);
  for (int f = 0; f < mesh.endo.size(); ++f) {
    const auto face = mesh.endo.face(f);
    Vec3 middle = Vec3::Zero();
    for (const int a : face)
      middle += mesh.nodes[a] / static_cast<double>(face.size());
    const Vec3 diagonal = mesh.nodes[face[2]] - mesh.nodes[face[0]];
    const double dA = 0.5 * diagonal.cross(mesh.nodes[face.back()] - mesh.nodes[face[1]]).norm();
    const int slab = slab_of(middle.z());
    sum[slab] += dA * middle;
    area[slab] += dA;
  }
  std::vector<Vec3> centres(slabs, Vec3::Zero());
  for (int s = 0; s < slabs; ++s)
    centres[s] = area[s] > 0.0 ? Vec3(sum[s] / area[s]) : s > 0 ? centres[s - 1] : Vec3::Zero();
  return centres;
}

/// The seven short-axis planes, from the base on.
struct SlicePlanes {
  double spacing;

  SlicePlanes(const Mesh& mesh, const RegionParameters& parameters)
      : spacing(parameters.slice_spacing > 0.0 ? parameters.slice_spacing
                                               : -lowest(mesh, mesh.epi) / (slice_count - 0.5)) {}

  [[nodiscard]] int nearest(double z) const {
    return std::clamp(static_cast<int>(std::lround(-z / spacing)), 0, slice_count - 1);
  }
  [[nodiscard]] std::vector<Vec3> centres(const Mesh& mesh) const {
    return cavity_centres(mesh, slice_count, [this](double z) { return nearest(z); });
  }
};

double angle_about(const Vec3& centre, const Vec3& x) {
  return std::atan2(x.y() - centre.y(), x.x() - centre.x());
}

/// `third` 0 to 2 from the base, 3 beyond the cavity.
int aha_segment(int third, double angle, double septum) {
  if (third == 3)
    return 17;
  return 6 * third + sector_at(angle, septum, third == 2 ? 4 : 6);
}

}  // namespace

std::function<Vec3(double z)> cavity_axis(const Mesh& mesh, const RegionParameters& parameters) {
  const SlicePlanes planes(mesh, parameters);
  return [spacing = planes.spacing, centres = planes.centres(mesh)](double z) {
    const double place = std::clamp(-z / spacing, 0.0, slice_count - 1.0);
    const int above = std::min(static_cast<int>(place), slice_count - 2);
    const double s = place - above;
    return Vec3((1.0 - s) * centres[above] + s * centres[above + 1]);
  };
}

Regions divide(const Mesh& mesh, const RegionParameters& parameters) {
  const double cavity_length = -lowest(mesh, mesh.endo);
  const SlicePlanes planes(mesh, parameters);
  const SlabOf third_of = [&](double z) {
    return std::clamp(static_cast<int>(std::floor(-3.0 * z / cavity_length)), 0, 3);
  };
  const std::vector<Vec3> plane_centres = planes.centres(mesh);
  const std::vector<Vec3> third_centres = cavity_centres(mesh, 4, third_of);
  Regions regions;
  for (int c = 0; c < mesh.cell_count(); ++c) {
    const Vec3 x = centre(mesh, c);
    const int plane = planes.nearest(x.z());
    const int third = third_of(x.z());
    regions.slice.push_back(plane + 1);
    regions.sector.push_back(sector_at(angle_about(plane_centres[plane], x),
                                       parameters.septum_angle, sectors_of_slice(plane + 1)));
    regions.aha.push_back(
        aha_segment(third, angle_about(third_centres[third], x), parameters.septum_angle));
  }
  return regions;
}

int sector_at(double angle, double septum_angle, int sectors) {
  constexpr double turn = 2.0 * std::numbers::pi;
  const double from_anterior = septum_angle + 0.25 * turn - angle;
  const int sector = static_cast<int>(std::lround(from_anterior / (turn / sectors))) % sectors;
  return (sector + sectors) % sectors + 1;
}

std::vector<double> at_nodes(const Mesh& mesh, const SegmentFactors& factors) {
  if (mesh.segment.empty() || factors == even_segments())
    return {};
  std::vector<double> sum(mesh.nodes.size(), 0.0);
  std::vector<double> cells(mesh.nodes.size(), 0.0);
  for (int c = 0; c < mesh.cell_count(); ++c)
    for (const int node : mesh.cell(c)) {
      sum[node] += factors[mesh.segment[c] - 1];
      cells[node] += 1.0;
    }
  for (std::size_t a = 0; a < sum.size(); ++a)
    sum[a] /= cells[a];
  return sum;
}

std::string sector_name(int slice, int sector) {
  static const std::array<std::string, 6> six{"ant", "antsept", "infsept",
                                              "inf", "inflat",  "antlat"};
  static const std::array<std::string, 4> four{"ant", "sept", "inf", "lat"};
  return sectors_of_slice(slice) == 6 ? six.at(sector - 1) : four.at(sector - 1);
}

std::string aha_name(int segment) {
  static const std::array<std::string, 6> six{"anterior", "anteroseptal",  "inferoseptal",
                                              "inferior", "inferolateral", "anterolateral"};
  static const std::array<std::string, 4> four{"anterior", "septal", "inferior", "lateral"};
  if (segment == 17)
    return "apex";
  if (segment > 12)
    return "apical " + four.at(segment - 13);
  return (segment > 6 ? "mid " : "basal ") + six.at((segment - 1) % 6);
}

Surface septum(const Mesh& mesh) {
  constexpr std::array septal{2, 3, 8, 9, 14};
  std::set<FaceKey> of_cells;
  for (std::size_t c = 0; c < mesh.segment.size(); ++c)
    if (std::find(septal.begin(), septal.end(), mesh.segment[c]) != septal.end())
      for (const auto& face : cell_faces(mesh.kind)) {
        std::vector<int> nodes;
        for (const int corner : face)
          if (corner >= 0)
            nodes.push_back(mesh.cell(static_cast<int>(c))[corner]);
        of_cells.insert(face_key(nodes));
      }
  Surface surface{mesh.epi.nodes_per_face, {}};
  const int faces_per_side = mesh.order == 2 ? 4 : 1;
  for (int f = 0; f < mesh.epi.size(); f += faces_per_side) {
    int count = 0;
    for (int part = f; part < f + faces_per_side; ++part)
      count += of_cells.contains(face_key(mesh.epi.face(part))) ? 1 : 0;
    if (2 * count >= faces_per_side)
      for (int part = f; part < f + faces_per_side; ++part)
        for (const int node : mesh.epi.face(part))
          surface.nodes.push_back(node);
  }
  return surface;
}

}  // namespace lv::mesh
