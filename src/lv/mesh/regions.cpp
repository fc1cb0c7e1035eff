#include "lv/mesh/regions.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace lv::mesh {
namespace {

/// The sector 1..n whose centre is nearest: sector 1 (anterior) a quarter turn beyond the septum,
/// the next ones clockwise seen from the base.
int sector_at(double angle, double septum, int n) {
  constexpr double turn = 2.0 * std::numbers::pi;
  const double from_anterior = septum + 0.25 * turn - angle;
  const int sector = static_cast<int>(std::lround(from_anterior / (turn / n))) % n;
  return (sector + n) % n + 1;
}

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

int aha_segment(const Vec3& x, double cavity_length, double septum) {
  const double depth = -x.z() / cavity_length;
  const double angle = std::atan2(x.y(), x.x());
  if (depth >= 1.0)
    return 17;
  if (depth >= 2.0 / 3.0)
    return 12 + sector_at(angle, septum, 4);
  return (depth >= 1.0 / 3.0 ? 6 : 0) + sector_at(angle, septum, 6);
}

}  // namespace

Regions divide(const Mesh& mesh, const RegionParameters& parameters) {
  const double length = -lowest(mesh, mesh.epi);
  const double cavity_length = -lowest(mesh, mesh.endo);
  const double spacing =
      parameters.slice_spacing > 0.0 ? parameters.slice_spacing : length / (slice_count - 0.5);
  Regions regions;
  for (int c = 0; c < mesh.cell_count(); ++c) {
    const Vec3 x = centre(mesh, c);
    const int plane = static_cast<int>(std::lround(-x.z() / spacing));
    const int slice = std::clamp(plane + 1, 1, slice_count);
    regions.slice.push_back(slice);
    regions.sector.push_back(
        sector_at(std::atan2(x.y(), x.x()), parameters.septum_angle, sectors_of_slice(slice)));
    regions.aha.push_back(aha_segment(x, cavity_length, parameters.septum_angle));
  }
  return regions;
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

}  // namespace lv::mesh
