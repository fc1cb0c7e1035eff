#include "lv/analysis/results.hpp"

#include "lv/base/check.hpp"
#include "lv/solid/endocardial_surface.hpp"

#include <algorithm>
#include <cmath>

namespace lv::analysis {
namespace {

VentricleShape shape(const mesh::Mesh& mesh, const std::vector<Vec3>& positions,
                     const std::vector<CellFields>& cells) {
  VentricleShape s;
  s.cavity_volume = solid::EndocardialSurface(mesh).volume(positions);
  for (const CellFields& cell : cells)
    s.wall_volume += cell.J * cell.volume;
  for (const int a : mesh.endo.nodes)
    s.apex_endo_z = std::min(s.apex_endo_z, positions[a].z());
  for (const int a : mesh.epi.nodes)
    s.apex_epi_z = std::min(s.apex_epi_z, positions[a].z());
  for (const int a : mesh.base.nodes)
    s.base_axial_shift =
        std::max(s.base_axial_shift, std::abs(positions[a].z() - mesh.nodes[a].z()));
  const auto edge = mesh::boundary_edges(mesh.endo);
  Vec3 centre = Vec3::Zero();
  for (const auto& side : edge)
    centre += positions[side[0]] / static_cast<double>(edge.size());
  for (const int a : mesh.endo.nodes)
    s.long_axis = std::max(s.long_axis, (positions[a] - centre).norm());
  for (const auto& side : edge)
    s.base_endo_radius += (positions[side[0]] - centre).norm() / static_cast<double>(edge.size());
  return s;
}

VentricleShape shape(const mesh::Mesh& mesh, const heartbeat::Snapshot& snapshot,
                     const std::vector<CellFields>& cells) {
  VentricleShape s = shape(mesh, snapshot.positions, cells);
  s.time = snapshot.time;
  s.pressure = snapshot.pressure;
  return s;
}

void add_regional(const std::string& state, const std::vector<CellQuantity>& quantities,
                  const std::vector<Region>& regions, const std::vector<CellFields>& cells,
                  std::vector<RegionalValue>& rows) {
  for (const Region& region : regions) {
    double volume = 0.0;
    for (const int c : region.cells)
      volume += cells[c].volume;
    for (const CellQuantity& q : quantities)
      rows.push_back({state, region.scheme, region.name, q.quantity->name, q.quantity->unit, volume,
                      statistics(q.values, cells, region.cells)});
  }
}

/// Mean over the wall of a function of each element.
template <class Value>
double mean(const std::vector<CellFields>& cells, const Value& value) {
  double sum = 0.0;
  double volume = 0.0;
  for (std::size_t c = 0; c < cells.size(); ++c) {
    sum += cells[c].volume * value(c);
    volume += cells[c].volume;
  }
  return sum / volume;
}

/// The entry of a list of named things.
template <class List, class Name>
auto& named(const List& list, const std::string& name, const Name& name_of) {
  const auto found =
      std::find_if(list.begin(), list.end(), [&](const auto& x) { return name_of(x) == name; });
  LV_CHECK(found != list.end());
  return *found;
}

}  // namespace

const std::vector<CellFields>& BeatFields::at(const std::string& moment) const {
  return named(moments, moment, [](const Moment& m) { return m.name; }).cells;
}

const VentricleShape& Results::at(const std::string& moment) const {
  return named(moments, moment, [](const auto& m) { return m.first; }).second;
}

const Statistics& Results::whole(const std::string& moment, const std::string& quantity) const {
  const auto found = std::find_if(regional.begin(), regional.end(), [&](const RegionalValue& r) {
    return r.state == moment && r.scheme == "whole" && r.quantity == quantity;
  });
  LV_CHECK(found != regional.end());
  return found->statistics;
}

Results results(const mesh::Mesh& mesh, const mesh::Regions& regions, const heartbeat::Beat& beat,
                const BeatFields& fields) {
  const std::vector<CellFields>& early = fields.early_diastole;
  const std::vector<CellFields>& ed = fields.at(heartbeat::end_diastole);
  const std::vector<CellFields>& es = fields.at(heartbeat::end_systole);
  Results r;
  r.early_diastole = shape(mesh, mesh.nodes, early);
  const std::vector<Region> list = region_list(regions, early);
  std::vector<CellFields> from;  // strains start at early diastole, then at end-diastole
  for (const auto& [name, cells] : fields.moments) {
    r.moments.emplace_back(name, shape(mesh, beat.at(name), cells));
    add_regional(name, cell_quantities(cells, from), list, early, r.regional);
    if (name == heartbeat::end_diastole)
      from = cells;
  }
  for (const Region& region : list)
    if (region.scheme == "slice")
      r.rotation.push_back({std::stoi(region.name), rotation(es, ed, region.cells),
                            rotation(es, early, region.cells), rotation(ed, early, region.cells)});

  r.fibre_shortening =
      mean(es, [&](std::size_t c) { return 1.0 - es[c].fibre_stretch / ed[c].fibre_stretch; });
  r.thickening = r.whole(heartbeat::end_systole, "thickening").mean;
  return r;
}

}  // namespace lv::analysis
