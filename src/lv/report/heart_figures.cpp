#include "lv/report/heart_figures.hpp"

#include "lv/base/units.hpp"
#include "lv/mesh/fibres.hpp"
#include "lv/mesh/regions.hpp"
#include "lv/report/sticks.hpp"
#include "lv/report/wall_surface.hpp"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lv::report {
namespace {

using analysis::CellFields;
using mesh::Mesh;
using units::degree;
using units::mmHg;

const Colour tissue = hex(0xd9b8ae);
const Vec3 from_the_side(0.25, 1.0, -0.25);  // the viewer's direction: a little from the left above
const Plane half{Vec3::Zero(), -Vec3::UnitY()};

/// Means of the elements' values at the nodes, weighted by volume.
std::vector<double> at_nodes(const Mesh& mesh, const std::vector<CellFields>& cells,
                             const std::function<double(const CellFields&)>& value) {
  std::vector<double> sum(mesh.nodes.size(), 0.0);
  std::vector<double> weight(mesh.nodes.size(), 0.0);
  for (int c = 0; c < mesh.cell_count(); ++c)
    for (const int a : mesh.cell(c)) {
      sum[a] += cells[c].volume * value(cells[c]);
      weight[a] += cells[c].volume;
    }
  for (std::size_t a = 0; a < sum.size(); ++a)
    sum[a] /= weight[a];
  return sum;
}

/// From the 1st to the 99th percentile, rounded outwards to a step that ticks can name.
ColourScale scale_of(std::vector<double> values, const ColourMap& map = sequential()) {
  std::erase_if(values, [](double value) { return !std::isfinite(value); });
  if (values.empty())
    return {map, 0.0, 1.0};
  std::sort(values.begin(), values.end());
  const auto at = [&](double fraction) {
    return values[static_cast<std::size_t>(fraction * static_cast<double>(values.size() - 1))];
  };
  const double low = at(0.01);
  const double high = std::max(at(0.99), low + 1e-6);
  const double step = std::pow(10.0, std::floor(std::log10(high - low))) / 2.0;
  return {map, step * std::floor(low / step), step * std::ceil(high / step)};
}

/// The points turned about the long axis by an angle [rad].
std::vector<Vec3> turned(std::span<const Vec3> points, double angle) {
  const Mat3 R = Eigen::AngleAxisd(angle, Vec3::UnitZ()).toRotationMatrix();
  std::vector<Vec3> result;
  for (const Vec3& x : points)
    result.emplace_back(R * x);
  return result;
}

/// Angle about the long axis of the infarct's middle, from x towards y.
double infarct_direction(const Mesh& mesh) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t a = 0; a < mesh.nodes.size(); ++a)
    sum += mesh.infarct[a] * mesh.nodes[a];
  return std::atan2(sum.y(), sum.x());
}

Item painted(const WallPatch& patch, const std::vector<double>& nodal, const ColourScale& scale) {
  return {.patch = patch.patch, .paint = PointValues{patch.at_points(nodal), scale}};
}

/// The far half of the wall, seen from inside, and its section.
Scene open_wall(const Mesh& mesh, std::span<const Vec3> x, const std::vector<double>& nodal,
                const ColourScale& scale) {
  Scene scene;
  for (const mesh::Surface* side : {&mesh.endo, &mesh.epi, &mesh.base})
    scene.items.push_back(painted(wall_surface(mesh, x, *side), nodal, scale));
  scene.items.push_back(painted(wall_section(mesh, x, half), nodal, scale));
  scene.cut = half;
  return scene;
}

Panel open_wall_panel(const std::string& title, const Mesh& mesh, std::span<const Vec3> x,
                      const std::vector<double>& nodal, const ColourScale& scale,
                      const Camera& camera) {
  return {.title = title, .content = Picture{open_wall(mesh, x, nodal, scale), camera}};
}

Camera camera_for(const Mesh& mesh, const heartbeat::Beat& beat) {
  const std::vector<double> none(mesh.nodes.size(), 0.0);
  Scene all;
  const auto add = [&](const std::vector<Vec3>& x) {
    const Scene one = open_wall(mesh, x, none, {});
    all.items.insert(all.items.end(), one.items.begin(), one.items.end());
  };
  add(mesh.nodes);
  for (const heartbeat::NamedMoment& moment : beat.moments)
    add(moment.wall.positions);
  all.cut = half;
  return fitted(all, from_the_side);
}

/// Elements at one side of the wall whose face centres are at least `apart` mm from each other.
struct FacesToShow {
  std::vector<Vec3> centres;
  std::vector<int> cells;
};
FacesToShow thinned(const WallPatch& patch, double apart) {
  FacesToShow shown;
  for (std::size_t k = 0; k < patch.patch.triangles.size(); ++k) {
    Vec3 centre = Vec3::Zero();
    for (const int p : patch.patch.triangles[k])
      centre += patch.patch.points[p] / 3.0;
    const bool free = std::all_of(shown.centres.begin(), shown.centres.end(),
                                  [&](const Vec3& c) { return (c - centre).norm() >= apart; });
    if (!free)
      continue;
    shown.centres.push_back(centre);
    shown.cells.push_back(patch.cells[k]);
  }
  return shown;
}

double helix_degrees(const CellFields& cell) {
  return mesh::helix_angle(cell.fibre_frame.col(0), cell.axes) / degree;
}

/// Fibres on one side of the wall as sticks coloured by their helix angle.
Item fibre_sticks(const WallPatch& patch, const std::vector<CellFields>& cells,
                  const ColourScale& scale) {
  const FacesToShow shown = thinned(patch, 3.2);
  std::vector<Vec3> directions;
  std::vector<std::optional<Colour>> colours;
  for (const int c : shown.cells) {
    directions.emplace_back(cells[c].fibre_frame.col(0));
    colours.push_back(scale(helix_degrees(cells[c])));
  }
  const auto segments = sticks(shown.centres, directions, 4.0);
  return {.patch = tubes(segments, 0.45), .paint = tube_colours(colours)};
}

}  // namespace

Figure mesh_figure(const Mesh& mesh) {
  const auto drawn = [&](const mesh::Surface& side) {
    return Item{.patch = wall_surface(mesh, mesh.nodes, side).patch,
                .paint = tissue,
                .outline_width = 0.25};
  };
  Scene outside{.items = {drawn(mesh.epi), drawn(mesh.endo), drawn(mesh.base)}};
  Scene inside = outside;
  inside.items.push_back({.patch = wall_section(mesh, mesh.nodes, half).patch,
                          .paint = tissue,
                          .outline_width = 0.25});
  inside.cut = half;
  Scene below{.items = {drawn(mesh.epi)}};
  const Camera camera = fitted(outside, from_the_side);
  return {
      .panels = {{.title = "from the side", .content = Picture{outside, camera}},
                 {.title = "cut open", .content = Picture{inside, camera}},
                 {.title = "apex from below",
                  .content = Picture{below, fitted(below, Vec3::UnitZ(), Vec3::UnitY())}}},
      .columns = 3,
      .title = fmt::format("mesh: {} elements, {} nodes", mesh.cell_count(), mesh.nodes.size())};
}

Figure fibre_figure(const Mesh& mesh, const std::vector<CellFields>& undeformed) {
  const ColourScale scale{diverging(), -60.0, 60.0};
  const WallPatch epi = wall_surface(mesh, mesh.nodes, mesh.epi);
  const WallPatch endo = wall_surface(mesh, mesh.nodes, mesh.endo);
  const Scene outside{.items = {{.patch = epi.patch, .paint = hex(0xf2f2f2)},
                                fibre_sticks(epi, undeformed, scale)}};
  Scene inside{.items = {{.patch = endo.patch, .paint = hex(0xf2f2f2)},
                         fibre_sticks(endo, undeformed, scale)}};
  inside.cut = half;
  const auto helix = at_nodes(mesh, undeformed, helix_degrees);
  const Camera camera = fitted(outside, from_the_side);
  return {.panels = {{.title = "epicardium", .content = Picture{outside, camera}},
                     {.title = "endocardium, cut open", .content = Picture{inside, camera}},
                     open_wall_panel("through the wall", mesh, mesh.nodes, helix, scale, camera)},
          .columns = 3,
          .title = "fibres",
          .colour_bar = ColourBar{"helix angle [deg], the paper's sign", scale}};
}

Figure infarct_figure(const Mesh& mesh) {
  constexpr double quarter = 0.5 * std::numbers::pi;
  const ColourScale scale{sequential(), 0.0, 1.0};
  const double to_front = -quarter - infarct_direction(mesh);  // the viewer stands at -y
  const auto front = turned(mesh.nodes, to_front);
  Scene outside;
  for (const mesh::Surface* side : {&mesh.epi, &mesh.endo, &mesh.base})
    outside.items.push_back(painted(wall_surface(mesh, front, *side), mesh.infarct, scale));
  const Camera camera = fitted(outside, from_the_side);
  const auto open = [&](const std::string& title, double turn) {
    return open_wall_panel(title, mesh, turned(mesh.nodes, to_front + turn), mesh.infarct, scale,
                           camera);
  };
  return {.panels = {{.title = "from outside", .content = Picture{outside, camera}},
                     open("from inside", 2.0 * quarter),
                     open("section", quarter)},
          .columns = 3,
          .title = "infarct",
          .colour_bar = ColourBar{"extent M: 1 infarct, 0 remote muscle", scale}};
}

Figure states_figure(const Mesh& mesh, const heartbeat::Beat& beat,
                     const analysis::BeatFields& fields) {
  const auto stretch = [](const CellFields& c) { return c.fibre_stretch; };
  const Camera camera = camera_for(mesh, beat);
  const ColourScale scale{diverging(), 0.75, 1.25};
  Figure figure{
      .panels = {open_wall_panel("early diastole: free of stress", mesh, mesh.nodes,
                                 at_nodes(mesh, fields.early_diastole, stretch), scale, camera)},
      .columns = static_cast<int>(1 + beat.moments.size()),
      .colour_bar = ColourBar{"fibre stretch from early diastole", scale}};
  for (const auto& [name, phase, by_criterion, wall] : beat.moments)
    figure.panels.push_back(open_wall_panel(
        fmt::format("{}: {:.0f} mmHg, {:.1f} ml", heartbeat::title(name), wall.pressure / mmHg,
                    1e-3 * wall.volume),
        mesh, wall.positions, at_nodes(mesh, fields.at(name), stretch), scale, camera));
  return figure;
}

Figure stress_figure(const Mesh& mesh, const heartbeat::Beat& beat,
                     const analysis::BeatFields& fields) {
  const auto stress = [](const CellFields& c) { return c.fibre_stress(); };
  const auto tension = [](const CellFields& c) { return c.tension; };
  const Camera camera = camera_for(mesh, beat);
  const auto panel = [&](const char* moment, const auto& value, const char* label) {
    const std::vector<double> nodal = at_nodes(mesh, fields.at(moment), value);
    const ColourScale scale = scale_of(nodal);
    Panel p = open_wall_panel(heartbeat::title(moment), mesh, beat.at(moment).positions, nodal,
                              scale, camera);
    p.colour_bar = ColourBar{label, scale};
    return p;
  };
  return {.panels = {panel(heartbeat::end_diastole, stress, "fibre stress [kPa]"),
                     panel(heartbeat::end_systole, stress, "fibre stress [kPa]"),
                     panel(heartbeat::end_systole, tension, "active tension [kPa]")},
          .columns = 3};
}

}  // namespace lv::report
