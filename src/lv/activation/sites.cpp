#include "lv/activation/sites.hpp"

#include "lv/base/check.hpp"
#include "lv/base/lines.hpp"
#include "lv/base/nearest.hpp"
#include "lv/base/units.hpp"
#include "lv/mesh/cell.hpp"
#include "lv/mesh/undeformed_wall.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace lv::activation {
namespace {

constexpr int segments = 17;
constexpr double site_radius = 2.0;     // [mm]
constexpr double farthest_point = 5.0;  // from the nearest node [mm]

/// The segment of that name or number; 0: none.
int segment_of(const std::string& words) {
  for (int s = 1; s <= segments; ++s)
    if (words == mesh::aha_name(s) || words == std::to_string(s))
      return s;
  return 0;
}

/// Whether the words are three numbers and a unit of length.
bool is_point(const std::vector<std::string_view>& fields) {
  return fields.size() == 4 && std::all_of(fields.begin(), fields.end() - 1, [](auto field) {
           return number_of<double>(field).has_value();
         });
}

Vec3 point_of(const std::string& words, const std::vector<std::string_view>& fields) {
  const units::Unit unit = units::parse_unit(fields[3]);
  if (unit.dimension != units::parse_unit("mm").dimension)
    throw std::invalid_argument(
        fmt::format("names the point \"{}\", whose unit is no length", words));
  return unit.factor * Vec3(*number_of<double>(fields[0]), *number_of<double>(fields[1]),
                            *number_of<double>(fields[2]));
}

/// The first of some nodes that is nearest to a place.
template <class Nodes>
int nearest_of(const mesh::Mesh& mesh, const Nodes& nodes, const Vec3& x) {
  return *std::min_element(nodes.begin(), nodes.end(), [&](int a, int b) {
    return (mesh.nodes[a] - x).squaredNorm() < (mesh.nodes[b] - x).squaredNorm();
  });
}

int node_of_segment(const ActivatedWall& wall, int segment) {
  Vec3 sum = Vec3::Zero();
  double volume = 0.0;
  for (int c = 0; c < wall.mesh.cell_count(); ++c) {
    if (wall.regions.aha[c] != segment)
      continue;
    const double V = mesh::cell_volume(wall.mesh, c);
    sum += V * mesh::cell_centre(wall.mesh, c);
    volume += V;
  }
  if (!(volume > 0.0))
    throw InputError(
        wall.sites_are_at,
        fmt::format("activation.sites name the {} segment, of which this wall has no element",
                    mesh::aha_name(segment)),
        "Name another segment, or a point");
  return nearest_of(wall.mesh, wall.mesh.endo.nodes, sum / volume);
}

int node_at_point(const ActivatedWall& wall, const Vec3& x) {
  const int node = nearest_of(wall.mesh, wall.mesh.cells, x);
  const double distance = (wall.mesh.nodes[node] - x).norm();
  if (distance > farthest_point)
    throw InputError(wall.sites_are_at,
                     fmt::format("activation.sites name the point ({:g}, {:g}, {:g}) mm, which is "
                                 "{:.3g} mm from the nearest node of the wall",
                                 x.x(), x.y(), x.z(), distance),
                     "Give points in the coordinates of 02_mesh/mesh.vtu: the base lies at z = 0, "
                     "the apex below");
  return node;
}

/// The metric of the first cell that has a node.
const Mat3& metric_at(const ActivatedWall& wall, int node) {
  const auto at = std::find(wall.mesh.cells.begin(), wall.mesh.cells.end(), node);
  const auto place = static_cast<std::size_t>(at - wall.mesh.cells.begin());
  return wall.metrics[place / static_cast<std::size_t>(mesh::nodes_per_cell(wall.mesh.kind))];
}

std::vector<Start> start_around_node(const ActivatedWall& wall, int node) {
  return starts_around(wall.mesh, wall.mesh.nodes[node], site_radius, metric_at(wall, node));
}

}  // namespace

Site site_of(const std::string& words) {
  if (words == "endocardium")
    return Endocardium{};
  if (const int segment = segment_of(words); segment > 0)
    return Segment{segment};
  if (const auto fields = fields_of(words, ' '); is_point(fields))
    return Point{point_of(words, fields)};
  std::vector<std::string> known{"endocardium"};
  for (int s = 1; s <= segments; ++s)
    known.push_back(mesh::aha_name(s));
  const std::string nearest = nearest_name(words, known);
  throw std::invalid_argument(
      fmt::format("names \"{}\", which is no segment (\"mid anterior\", \"apex\", 1 to 17), point "
                  "(\"12 -4 -30 mm\") or \"endocardium\"{}",
                  words, nearest.empty() ? "" : fmt::format("; did you mean \"{}\"?", nearest)));
}

std::vector<Mat3> cell_frames(const mesh::Mesh& mesh) {
  const mesh::UndeformedWall wall(mesh);
  std::vector<Mat3> frames;
  for (int c = 0; c < mesh.cell_count(); ++c)
    frames.push_back(wall.frame_of_cell(c));
  return frames;
}

std::vector<Start> starts_at(const Site& site, const ActivatedWall& wall) {
  if (const auto* segment = std::get_if<Segment>(&site))
    return start_around_node(wall, node_of_segment(wall, segment->number));
  if (const auto* point = std::get_if<Point>(&site))
    return start_around_node(wall, node_at_point(wall, point->x));
  std::vector<Start> starts;
  for (const int node : mesh::surface_nodes(wall.mesh.endo))
    starts.push_back({node, 0.0});
  return starts;
}

}  // namespace lv::activation
