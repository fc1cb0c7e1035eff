#include "lv/report/heart_figures.hpp"

#include "lv/analysis/quantities.hpp"
#include "lv/base/units.hpp"
#include "lv/drawing/sticks.hpp"
#include "lv/drawing/wall_surface.hpp"
#include "lv/mesh/curved.hpp"
#include "lv/mesh/fibres.hpp"
#include "lv/mesh/regions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace lv::report {
namespace {

using analysis::CellFields;
using mesh::Mesh;
using units::degree;
using units::mmHg;

const drawing::Colour tissue = drawing::hex(0xd9b8ae);

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

/// From the 1st to the 99th percentile, rounded outwards to a step that ticks can name, with the
/// quantity's own floor.
drawing::ColourScale common_scale(std::vector<double> values, const analysis::Quantity& quantity) {
  std::erase_if(values, [](double value) { return !std::isfinite(value); });
  if (values.empty())
    return {drawing::sequential(), 0.0, 1.0, quantity.middle, quantity.floor};
  std::sort(values.begin(), values.end());
  const auto at = [&](double fraction) {
    return values[static_cast<std::size_t>(fraction * static_cast<double>(values.size() - 1))];
  };
  const double low = at(0.01);
  const double high = std::max(at(0.99), low + 1e-6);
  const double step = std::pow(10.0, std::floor(std::log10(high - low))) / 2.0;
  return {drawing::sequential(), step * std::floor(low / step), step * std::ceil(high / step),
          quantity.middle, quantity.floor};
}

/// A wall to draw, its elements curved as they are, with the nodes of its mesh at `positions`.
struct DrawnWall {
  const mesh::CurvedMesh& curved;
  std::vector<Vec3> x;

  DrawnWall(const mesh::CurvedMesh& wall, std::span<const Vec3> positions)
      : curved(wall), x(wall.at_nodes(positions)) {}

  [[nodiscard]] drawing::WallPatch surface(mesh::Surface Mesh::*side) const {
    return drawing::wall_surface(curved.mesh, x, curved.mesh.*side, curved.faces_per_side);
  }
  [[nodiscard]] drawing::WallPatch section(const drawing::Plane& plane) const {
    return drawing::wall_section(curved.mesh, x, plane, curved.cells_per_element);
  }
};

constexpr std::array sides{&Mesh::endo, &Mesh::epi, &Mesh::base};

/// A nodal field on a wall.
struct PaintedWall {
  DrawnWall wall;
  std::vector<double> nodal;
  drawing::ColourScale scale;

  PaintedWall(const DrawnWall& drawn, const std::vector<double>& field,
              const drawing::ColourScale& colours)
      : wall(drawn), nodal(drawn.curved.at_nodes(field)), scale(colours) {}

  [[nodiscard]] drawing::Item item(const drawing::WallPatch& patch) const {
    return {.patch = patch.patch, .paint = drawing::PointValues{patch.at_points(nodal), scale}};
  }
  [[nodiscard]] drawing::Scene whole() const {
    drawing::Scene scene;
    for (const auto side : sides)
      scene.items.push_back(item(wall.surface(side)));
    return scene;
  }
  /// What a plane leaves, and the section.
  [[nodiscard]] drawing::Scene open(const drawing::Plane& plane) const {
    drawing::Scene scene = whole();
    scene.items.push_back(section(plane));
    scene.cut = plane;
    return scene;
  }
  [[nodiscard]] drawing::Item section(const drawing::Plane& plane) const {
    return item(wall.section(plane));
  }
  /// Half of the way from the base to the endocardial apex.
  [[nodiscard]] drawing::Plane middle() const {
    double lowest = 0.0;
    for (const int node : wall.curved.mesh.endo.nodes)
      lowest = std::min(lowest, wall.x[node].z());
    return drawing::short_axis_plane(0.5 * lowest);
  }
};

std::vector<Vec3> points_of(const std::vector<drawing::Scene>& scenes) {
  std::vector<Vec3> points;
  for (const drawing::Scene& scene : scenes)
    for (const drawing::Item& item : scene.items)
      points.insert(points.end(), item.patch.points.begin(), item.patch.points.end());
  return points;
}

/// Pictures of scenes by one camera, with letters.
std::vector<drawing::Picture> pictures(const std::vector<drawing::Scene>& scenes,
                                       const drawing::Look& look, const drawing::Orientation& o) {
  auto letters = drawing::wall_letters(o, points_of(scenes), look.view);
  if (std::abs(look.view.normalized().z()) < 0.9)  // not along the axis, where they would hide it
    for (const drawing::Letter& end : drawing::assumed_ends(o, points_of(scenes)))
      letters.push_back(end);
  std::vector<Vec3> places;
  for (const drawing::Letter& letter : letters)
    places.push_back(letter.at);
  drawing::Scene all;
  for (const drawing::Scene& scene : scenes) {
    all.items.insert(all.items.end(), scene.items.begin(), scene.items.end());
    all.cut = scene.cut;
  }
  constexpr double margin = 1.1;  // for the letters' own size
  drawing::Camera camera = drawing::fitted(all, look.view, look.up, places);
  camera.width *= margin;
  camera.height *= margin;
  std::vector<drawing::Picture> list;
  for (const drawing::Scene& scene : scenes)
    list.push_back({scene, camera, letters});
  return list;
}

drawing::Picture picture(const drawing::Scene& scene, const drawing::Look& look,
                         const drawing::Orientation& o) {
  return pictures({scene}, look, o).front();
}

/// The middle of the infarct, weighted by M.
Vec3 infarct_middle(const Mesh& mesh) {
  Vec3 sum = Vec3::Zero();
  double weight = 1e-12;
  for (std::size_t a = 0; a < mesh.nodes.size(); ++a) {
    sum += mesh.infarct[a] * mesh.nodes[a];
    weight += mesh.infarct[a];
  }
  return sum / weight;
}

/// From where the infarct is in front, a little from above.
drawing::Look facing(const Vec3& middle) {
  const Vec3 outwards(middle.x(), middle.y(), 0.0);
  const Vec3 towards = outwards.norm() > 1e-6 ? outwards.normalized() : Vec3(Vec3::UnitX());
  return {-towards - 0.25 * Vec3::UnitZ(), Vec3::UnitZ()};
}

constexpr const char* four_chamber_title = "four-chamber view, cut open";

std::string notes(const drawing::Orientation& o) {
  return drawing::star_note(o, {"septum", "early diastole", "apex", "base", "infarct"});
}

std::string base_and_apex(const drawing::Orientation& o) {
  return fmt::format("{} above, {} below", o.starred("base", "base"), o.starred("apex", "apex"));
}

/// ", early diastole*": of a picture of the undeformed wall where that moment was assumed; else
/// empty.
std::string moment_if_assumed(const drawing::Orientation& o) {
  return o.assumes("early diastole") ? ", " + o.at_rest() : "";
}

/// Long-axis pictures in a row, short-axis sections of the same walls below.
std::vector<drawing::Panel> both_axes(const std::vector<std::string>& titles,
                                      const std::vector<PaintedWall>& walls,
                                      const drawing::Orientation& o) {
  std::vector<drawing::Scene> open;
  std::vector<drawing::Scene> across;
  for (const PaintedWall& wall : walls) {
    open.push_back(wall.open(drawing::four_chamber_plane(o)));
    across.push_back({.items = {wall.section(wall.middle())}});
  }
  std::vector<drawing::Panel> panels;
  for (const drawing::Picture& p : pictures(open, drawing::four_chamber(o), o))
    panels.push_back({.title = titles[panels.size()], .content = p});
  for (const drawing::Picture& p : pictures(across, drawing::short_axis(o), o))
    panels.push_back({.title = "middle short axis, from the apex", .content = p});
  return panels;
}

/// Elements at one side of the wall whose face centres are at least `apart` mm from each other.
struct FacesToShow {
  std::vector<Vec3> centres;
  std::vector<int> cells;
};
FacesToShow thinned(const drawing::WallPatch& patch, double apart) {
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
drawing::Item fibre_sticks(const drawing::WallPatch& patch, const mesh::CurvedMesh& curved,
                           const std::vector<CellFields>& cells,
                           const drawing::ColourScale& scale) {
  const FacesToShow shown = thinned(patch, 3.2);
  std::vector<Vec3> directions;
  std::vector<std::optional<drawing::Colour>> colours;
  for (const int c : shown.cells) {
    const CellFields& cell = cells[c / curved.cells_per_part];
    directions.emplace_back(cell.fibre_frame.col(0));
    colours.push_back(scale(helix_degrees(cell)));
  }
  const auto segments = drawing::sticks(shown.centres, directions, 4.0);
  return {.patch = drawing::tubes(segments, 0.45), .paint = drawing::tube_colours(colours)};
}

/// "552 quadratic elements"
std::string elements_text(const Mesh& mesh) {
  return mesh.order == 2 ? fmt::format("{} quadratic elements", mesh.cell_count() / 8)
                         : fmt::format("{} elements", mesh.cell_count());
}

}  // namespace

drawing::Figure mesh_figure(const Mesh& mesh, const drawing::Orientation& o) {
  const auto drawn = [](const drawing::WallPatch& wall) {
    return drawing::Item{.patch = wall.patch, .paint = tissue, .outline_width = 0.25};
  };
  const mesh::CurvedMesh curved = mesh::curved(mesh);
  const DrawnWall wall(curved, mesh.nodes);
  drawing::Scene outside;
  for (const auto side : {&Mesh::epi, &Mesh::endo, &Mesh::base})
    outside.items.push_back(drawn(wall.surface(side)));
  drawing::Scene inside = outside;
  inside.items.push_back(drawn(wall.section(drawing::four_chamber_plane(o))));
  inside.cut = drawing::four_chamber_plane(o);
  return {
      .panels = {{.title = "from the anterior side",
                  .content = picture(outside, drawing::four_chamber(o), o)},
                 {.title = four_chamber_title,
                  .content = picture(inside, drawing::four_chamber(o), o)},
                 {.title = o.starred("apex", "apex") + ", from below",
                  .content = picture({{outside.items.front()}, {}}, drawing::short_axis(o), o)}},
      .columns = 3,
      .title = fmt::format("mesh{}: {}, {} nodes; {}", moment_if_assumed(o), elements_text(mesh),
                           mesh.nodes.size(), base_and_apex(o)),
      .footnote = notes(o)};
}

drawing::Figure fibre_figure(const Mesh& mesh, const std::vector<CellFields>& undeformed,
                             const drawing::Orientation& o) {
  const drawing::ColourScale scale{drawing::diverging(), -60.0, 60.0};
  const mesh::CurvedMesh curved = mesh::curved(mesh);
  const DrawnWall drawn(curved, mesh.nodes);
  const drawing::WallPatch epi = drawn.surface(&Mesh::epi);
  const drawing::WallPatch endo = drawn.surface(&Mesh::endo);
  const drawing::Scene outside{.items = {{.patch = epi.patch, .paint = drawing::hex(0xf2f2f2)},
                                         fibre_sticks(epi, curved, undeformed, scale)}};
  drawing::Scene inside{.items = {{.patch = endo.patch, .paint = drawing::hex(0xf2f2f2)},
                                  fibre_sticks(endo, curved, undeformed, scale)}};
  inside.cut = drawing::four_chamber_plane(o);
  const PaintedWall wall(drawn, at_nodes(mesh, undeformed, helix_degrees), scale);
  return {.panels = {{.title = "epicardium, from the anterior side",
                      .content = picture(outside, drawing::four_chamber(o), o)},
                     {.title = "endocardium, cut open",
                      .content = picture(inside, drawing::four_chamber(o), o)},
                     {.title = "through the wall, four-chamber view",
                      .content = picture(wall.open(drawing::four_chamber_plane(o)),
                                         drawing::four_chamber(o), o)}},
          .columns = 3,
          .title = "fibres" + moment_if_assumed(o),
          .footnote =
              "Helix angle as in Gao et al. 2014: negative where the fibre rises towards "
              "the base when followed anticlockwise seen from the base, a right-handed "
              "helix as at the endocardium of human hearts. LDRB tools give the same fibre "
              "the opposite sign (+60 at the endocardium, -60 at the epicardium). " +
              notes(o),
          .colour_bar = drawing::ColourBar{"helix angle [deg]", scale}};
}

drawing::Figure infarct_figure(const Mesh& mesh, const drawing::Orientation& o) {
  const drawing::ColourScale scale{drawing::sequential(), 0.0, 1.0, 0.0,
                                   analysis::infarct_extent().floor};
  const mesh::CurvedMesh curved = mesh::curved(mesh);
  const PaintedWall wall({curved, mesh.nodes}, mesh.infarct, scale);
  const Vec3 middle = infarct_middle(mesh);
  const drawing::Scene across{.items = {wall.section(drawing::short_axis_plane(middle.z()))}};
  return {.panels = {{.title = "from outside, the infarct in front",
                      .content = picture(wall.whole(), facing(middle), o)},
                     {.title = "short axis through its middle, from the apex",
                      .content = picture(across, drawing::short_axis(o), o)},
                     {.title = four_chamber_title,
                      .content = picture(wall.open(drawing::four_chamber_plane(o)),
                                         drawing::four_chamber(o), o)},
                     {.title = "two-chamber view, cut open",
                      .content = picture(wall.open(drawing::two_chamber_plane(o)),
                                         drawing::two_chamber(o), o)}},
          .columns = 2,
          .title = o.starred("infarct", "infarct") + moment_if_assumed(o),
          .footnote = notes(o),
          .colour_bar = drawing::ColourBar{"extent M: 1 infarct, 0 remote muscle", scale}};
}

drawing::Figure states_figure(const Mesh& mesh, const heartbeat::Beat& beat,
                              const analysis::BeatFields& fields, const drawing::Orientation& o) {
  const auto stretch = [](const CellFields& c) { return c.fibre_stretch; };
  const drawing::ColourScale scale{drawing::diverging(), 0.75, 1.25};
  std::vector<std::vector<double>> nodal{at_nodes(mesh, fields.early_diastole, stretch)};
  std::vector<std::string> titles{o.at_rest() + ": free of stress"};
  for (const auto& [name, phase, by_criterion, wall] : beat.moments) {
    nodal.push_back(at_nodes(mesh, fields.at(name), stretch));
    titles.push_back(fmt::format("{}: {:.0f} mmHg, {:.1f} ml", heartbeat::title(name),
                                 wall.pressure / mmHg, 1e-3 * wall.volume));
  }
  const mesh::CurvedMesh curved = mesh::curved(mesh);
  std::vector<PaintedWall> walls{{{curved, mesh.nodes}, nodal.front(), scale}};
  for (std::size_t i = 0; i < beat.moments.size(); ++i)
    walls.push_back({{curved, beat.moments[i].wall.positions}, nodal[i + 1], scale});
  return {.panels = both_axes(titles, walls, o),
          .columns = static_cast<int>(walls.size()),
          .footnote = notes(o),
          .colour_bar = drawing::ColourBar{
              fmt::format("{} from {}", analysis::quantity("fibre_stretch").title, o.at_rest()),
              scale}};
}

/// What has no colour of its scale though the wall is there; empty where nothing is so.
std::string pale_note(std::span<const PaintedWall> walls, const analysis::Quantity& quantity) {
  const bool any = std::any_of(walls.begin(), walls.end(), [](const PaintedWall& w) {
    return std::any_of(w.nodal.begin(), w.nodal.end(),
                       [&](double value) { return w.scale.is_nothing(value); });
  });
  return any ? fmt::format("Pale: less than {:g} {}, as good as none. ", quantity.floor,
                           quantity.unit)
             : "";
}

drawing::Figure stress_figure(const Mesh& mesh, const heartbeat::Beat& beat,
                              const analysis::BeatFields& fields, const drawing::Orientation& o) {
  const analysis::Quantity& fibre_stress = analysis::quantity("fibre_stress");
  const analysis::Quantity& active_tension = analysis::quantity("active_tension");
  const auto stress = [](const CellFields& c) { return c.fibre_stress(); };
  const auto tension = [](const CellFields& c) { return c.tension; };
  const auto ed = at_nodes(mesh, fields.at(heartbeat::end_diastole), stress);
  const auto es = at_nodes(mesh, fields.at(heartbeat::end_systole), stress);
  const auto active = at_nodes(mesh, fields.at(heartbeat::end_systole), tension);
  const mesh::CurvedMesh curved = mesh::curved(mesh);
  const DrawnWall filled(curved, beat.at(heartbeat::end_diastole).positions);
  const DrawnWall contracted(curved, beat.at(heartbeat::end_systole).positions);
  std::vector<double> both = ed;
  both.insert(both.end(), es.begin(), es.end());
  const drawing::ColourScale of_stress = common_scale(both, fibre_stress);
  const std::vector<PaintedWall> walls{{filled, ed, of_stress},
                                       {contracted, es, of_stress},
                                       {contracted, active, common_scale(active, active_tension)}};
  drawing::Figure figure{.panels = both_axes({heartbeat::title(heartbeat::end_diastole),
                                              heartbeat::title(heartbeat::end_systole),
                                              heartbeat::title(heartbeat::end_systole)},
                                             walls, o),
                         .columns = 3,
                         .footnote = pale_note(walls, fibre_stress) + notes(o)};
  for (std::size_t i = 0; i < figure.panels.size(); ++i)
    figure.panels[i].colour_bar = drawing::ColourBar{
        analysis::label(i % 3 == 2 ? active_tension : fibre_stress), walls[i % 3].scale};
  return figure;
}

}  // namespace lv::report
