#include "lv/job/stages.hpp"

#include "lv/base/log.hpp"
#include "lv/base/parallel.hpp"
#include "lv/heartbeat/archive.hpp"
#include "lv/job/parameters.hpp"
#include "lv/job/run.hpp"
#include "lv/report/fields_vtk.hpp"
#include "lv/report/summary.hpp"
#include "lv/report/tables_csv.hpp"

#include <fmt/format.h>

namespace lv::job {
namespace {

using heartbeat::Archive;

std::vector<double> as_numbers(const std::vector<int>& whole) {
  return {whole.begin(), whole.end()};
}

std::vector<int> as_whole(const std::vector<double>& numbers) {
  std::vector<int> whole;
  for (const double number : numbers)
    whole.push_back(static_cast<int>(number));
  return whole;
}

void store(const mesh::Surface& surface, const std::string& name, Archive& archive) {
  archive.set(name + ".nodes_per_face", {static_cast<double>(surface.nodes_per_face)});
  archive.set(name, as_numbers(surface.nodes));
}

mesh::Surface load_surface(const Archive& archive, const std::string& name) {
  return {static_cast<int>(archive.number(name + ".nodes_per_face")), as_whole(archive.get(name))};
}

/// The undeformed wall as a snapshot.
heartbeat::Snapshot at_rest(const mesh::Mesh& mesh) {
  heartbeat::Snapshot s;
  s.positions = mesh.nodes;
  s.tension.assign(mesh.nodes.size(), 0.0);
  s.wall_pressure.assign(mesh.cell_count(), 0.0);
  return s;
}

/// Velocity averaged to the cell centres, and pressure, of the whole box on the root.
report::BloodFields blood_fields(const heartbeat::Frame& frame) {
  const fluid::Grid& grid = frame.model.grid();
  const fluid::FaceField& u = frame.model.velocity();
  report::BloodFields blood{
      grid.lower, grid.spacing, grid.cells, {}, fluid::gather(frame.pressure)};
  std::vector<double> mine;
  for (int k = 0; k < frame.model.slab().planes.size(); ++k)
    for (int j = 0; j < grid.cells[1]; ++j)
      for (int i = 0; i < grid.cells[0]; ++i)
        mine.insert(mine.end(),
                    {0.5 * (u.component[0].at(i, j, k) + u.component[0].at(i + 1, j, k)),
                     0.5 * (u.component[1].at(i, j, k) + u.component[1].at(i, j + 1, k)),
                     0.5 * (u.component[2].at(i, j, k) + u.component[2].at(i, j, k + 1))});
  blood.velocity = parallel::gather(mine);
  return blood;
}

/// Writes frames and curves of a running beat.
class BeatWriter {
 public:
  BeatWriter(const Case& c, const MeshResult& mesh, std::filesystem::path folder)
      : case_(c),
        mesh_(mesh),
        folder_(std::move(folder)),
        wall_(mesh.mesh, c.fibres, wall_material(c)) {
    if (parallel::is_root())
      std::filesystem::create_directories(folder_ / "fields");
  }

  void frame(const heartbeat::Frame& f) {
    const auto cells = analysis::cell_fields(wall_, f.wall);
    const auto& ed = f.run.beat.end_diastole;
    const bool ed_known = !ed.positions.empty();
    if (ed_known && end_diastole_.empty())
      end_diastole_ = analysis::cell_fields(wall_, ed);
    if (parallel::is_root())
      report::write_wall(folder_ / wall_file(f.number), mesh_.mesh, mesh_.regions, f.wall, cells,
                         end_diastole_);
    if (case_.output.blood) {
      const auto blood = blood_fields(f);
      if (parallel::is_root())
        report::write_blood(folder_ / blood_file(f.number), blood);
    }
    if (parallel::is_root())
      write_series(f.run);
  }

  void curves(const heartbeat::RunState& run) const {
    if (parallel::is_root())
      report::curves_table(run.beat.curves).write_csv(folder_ / "curves.csv");
  }

 private:
  static std::string wall_file(int number) { return fmt::format("fields/wall_{:04d}.vtu", number); }
  static std::string blood_file(int number) {
    return fmt::format("fields/blood_{:04d}.vti", number);
  }

  void write_series(const heartbeat::RunState& run) const {
    std::vector<report::TimedFile> wall;
    std::vector<report::TimedFile> blood;
    for (int n = 0; n < run.frames; ++n) {
      wall.push_back({run.frame_times[n], wall_file(n)});
      blood.push_back({run.frame_times[n], blood_file(n)});
    }
    report::write_pvd(folder_ / "wall.pvd", wall);
    if (case_.output.blood)
      report::write_pvd(folder_ / "blood.pvd", blood);
  }

  const Case& case_;
  const MeshResult& mesh_;
  std::filesystem::path folder_;
  solid::Wall wall_;
  std::vector<analysis::CellFields> end_diastole_;
};

report::RunFacts run_facts(const Case& c, const MeshResult& mesh, const BeatResult& beat) {
  report::RunFacts facts;
  facts.case_name = c.name;
  facts.version = version();
  facts.engine = "immersed";
  facts.ranks = beat.ranks;
  facts.nodes = static_cast<int>(mesh.mesh.nodes.size());
  facts.cells = mesh.mesh.cell_count();
  facts.grid = fmt::format("{} x {} x {}", c.box.cells[0], c.box.cells[1], c.box.cells[2]);
  facts.mesh_width = model_parameters(c, mesh.mesh).grid.spacing.minCoeff();
  facts.wall_clock = beat.wall_clock;
  for (const Parameter& p : parameters())
    facts.parameters.emplace_back(p.name, p.get(c));
  facts.origins.assign(c.origin.begin(), c.origin.end());
  if (!beat.beat.filling_was_steady)
    facts.warnings.push_back(
        "filling ended at protocol.filling_longest before the volume was steady");
  if (!beat.beat.contraction_was_steady)
    facts.warnings.push_back(
        "contraction ended at protocol.contraction_longest before its criterion was met");
  if (beat.beat.retries > 0)
    facts.warnings.push_back(
        fmt::format("{} steps were taken back and repeated smaller", beat.beat.retries));
  return facts;
}

}  // namespace

Shape make_anatomy(const Case& c) {
  const geometry::Ellipsoid e = c.anatomy.ellipsoid;
  return {[e](double u, double theta, double t) { return e.point(u, theta, t); }};
}

void write_anatomy(const Case& /*c*/, const Shape& shape, const std::filesystem::path& folder) {
  report::write_surfaces(folder / "surfaces.vtu", shape.wall);
}

MeshResult make_mesh(const Case& c, const Shape& shape) {
  MeshResult result;
  result.mesh = mesh::wall_mesh(shape.wall, c.mesh);
  result.regions = mesh::divide(result.mesh, c.regions);
  return result;
}

void write_mesh_result(const MeshResult& result, const Case& c,
                       const std::filesystem::path& folder) {
  const mesh::Mesh& m = result.mesh;
  Archive archive;
  archive.set("kind", {m.kind == mesh::CellKind::hexahedron ? 0.0 : 1.0});
  archive.set("nodes", {m.nodes.front().data(), m.nodes.front().data() + 3 * m.nodes.size()});
  archive.set("cells", as_numbers(m.cells));
  archive.set("transmural", m.transmural);
  archive.set("infarct", m.infarct);
  store(m.endo, "endo", archive);
  store(m.epi, "epi", archive);
  store(m.base, "base", archive);
  archive.set("slice", as_numbers(result.regions.slice));
  archive.set("sector", as_numbers(result.regions.sector));
  archive.set("aha", as_numbers(result.regions.aha));
  archive.write(folder / "mesh.bin");
  const solid::Wall wall(m, c.fibres, wall_material(c));
  report::write_mesh(folder / "mesh.vtu", m, result.regions,
                     analysis::cell_fields(wall, at_rest(m)));
}

MeshResult read_mesh_result(const std::filesystem::path& folder) {
  const Archive archive = Archive::read(folder / "mesh.bin");
  MeshResult result;
  mesh::Mesh& m = result.mesh;
  m.kind = archive.number("kind") == 0.0 ? mesh::CellKind::hexahedron : mesh::CellKind::tetrahedron;
  const auto& nodes = archive.get("nodes");
  for (std::size_t a = 0; a + 2 < nodes.size(); a += 3)
    m.nodes.emplace_back(nodes[a], nodes[a + 1], nodes[a + 2]);
  m.cells = as_whole(archive.get("cells"));
  m.transmural = archive.get("transmural");
  m.infarct = archive.get("infarct");
  m.endo = load_surface(archive, "endo");
  m.epi = load_surface(archive, "epi");
  m.base = load_surface(archive, "base");
  result.regions = {as_whole(archive.get("slice")), as_whole(archive.get("sector")),
                    as_whole(archive.get("aha"))};
  return result;
}

heartbeat::Beat make_beat(const Case& c, const MeshResult& mesh,
                          const std::filesystem::path& folder) {
  BeatWriter writer(c, mesh, folder);
  const heartbeat::BeatSetup setup{
      mesh.mesh,  c.fibres, wall_material(c), c.active, model_parameters(c, mesh.mesh),
      c.protocol, c.time,   c.output};
  const heartbeat::Observers observers{[&](const heartbeat::Frame& f) { writer.frame(f); },
                                       [&](const heartbeat::RunState& run) { writer.curves(run); }};
  return heartbeat::run_immersed_beat(setup, folder, observers);
}

void write_beat(const heartbeat::Beat& beat, double wall_clock,
                const std::filesystem::path& folder) {
  Archive archive;
  heartbeat::store(beat.curves, archive);
  heartbeat::store(beat.end_diastole, "end_diastole", archive);
  heartbeat::store(beat.end_systole, "end_systole", archive);
  archive.set("facts",
              {beat.filling_was_steady ? 1.0 : 0.0, beat.contraction_was_steady ? 1.0 : 0.0,
               static_cast<double>(beat.steps), static_cast<double>(beat.retries), wall_clock,
               static_cast<double>(parallel::size())});
  archive.write(folder / "beat.bin");
}

BeatResult read_beat(const std::filesystem::path& folder) {
  const Archive archive = Archive::read(folder / "beat.bin");
  const auto& facts = archive.get("facts");
  BeatResult result;
  result.beat.curves = heartbeat::load_curves(archive);
  result.beat.end_diastole = heartbeat::load_snapshot(archive, "end_diastole");
  result.beat.end_systole = heartbeat::load_snapshot(archive, "end_systole");
  result.beat.filling_was_steady = facts.at(0) != 0.0;
  result.beat.contraction_was_steady = facts.at(1) != 0.0;
  result.beat.steps = static_cast<int>(facts.at(2));
  result.beat.retries = static_cast<int>(facts.at(3));
  result.wall_clock = facts.at(4);
  result.ranks = static_cast<int>(facts.at(5));
  return result;
}

std::string make_results(const Case& c, const MeshResult& mesh, const BeatResult& beat,
                         const std::filesystem::path& folder) {
  const solid::Wall wall(mesh.mesh, c.fibres, wall_material(c));
  const analysis::BeatFields fields{analysis::cell_fields(wall, at_rest(mesh.mesh)),
                                    analysis::cell_fields(wall, beat.beat.end_diastole),
                                    analysis::cell_fields(wall, beat.beat.end_systole)};
  if (!parallel::is_root())
    return "";
  const analysis::Results results = analysis::results(mesh.mesh, mesh.regions, beat.beat, fields);
  const report::RunFacts facts = run_facts(c, mesh, beat);
  write_file(folder / "summary.json", report::summary_json(facts, beat.beat, results));
  report::regions_table(results).write_csv(folder / "regions.csv");
  report::rotation_table(results).write_csv(folder / "rotation.csv");
  report::curves_table(beat.beat.curves).write_csv(folder / "curves.csv");
  return report::summary_text(facts, beat.beat, results);
}

}  // namespace lv::job
