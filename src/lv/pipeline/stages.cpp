#include "lv/pipeline/stages.hpp"

#include "lv/anatomy/drawn.hpp"
#include "lv/anatomy/shape_distance.hpp"
#include "lv/base/bounds.hpp"
#include "lv/base/check.hpp"
#include "lv/base/interrupt.hpp"
#include "lv/base/log.hpp"
#include "lv/base/parallel.hpp"
#include "lv/base/table.hpp"
#include "lv/base/time_left.hpp"
#include "lv/beating_wall/activation.hpp"
#include "lv/calibrate/summary.hpp"
#include "lv/case_file/beat_fit.hpp"
#include "lv/case_file/parameters.hpp"
#include "lv/cine/strain.hpp"
#include "lv/heartbeat/quasi_static_beat.hpp"
#include "lv/mesh/infarct.hpp"
#include "lv/mesh/quadratic.hpp"
#include "lv/mesh/quality.hpp"
#include "lv/mesh/refine.hpp"
#include "lv/page/wall_series.hpp"
#include "lv/pipeline/calibration.hpp"
#include "lv/pipeline/circulation.hpp"
#include "lv/report/fields_vtk.hpp"
#include "lv/report/heart_figures.hpp"
#include "lv/report/stage_facts.hpp"
#include "lv/report/table_figures.hpp"
#include "lv/report/tables_csv.hpp"
#include "lv/report/work_folder.hpp"
#include "lv/scar/infarct.hpp"
#include "lv/scar/strain_infarct.hpp"
#include "lv/work/ingredients.hpp"
#include "lv/work/version.hpp"
#include "lv/work/workspace.hpp"

#include <fmt/format.h>

namespace lv::pipeline {
namespace {

using case_file::Case;

analysis::FieldAnalysis field_analysis(const Case& c, const mesh::Mesh& m,
                                       const std::vector<double>& activation_times) {
  return {m, case_file::cardiac_model(c), activation_times};
}

/// Velocity averaged to the cell centres, and pressure, of the whole box on the root.
report::BloodFields blood_fields(const heartbeat::Frame& frame) {
  const immersed::Model& model = frame.blood->model;
  const fluid::Grid& grid = model.grid();
  const fluid::FaceField& u = model.velocity();
  report::BloodFields blood{
      grid.lower, grid.spacing, grid.cells, {}, fluid::gather(frame.blood->pressure)};
  std::vector<double> mine;
  for (int k = 0; k < model.slab().planes.size(); ++k)
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
  BeatWriter(const Case& c, const anatomy::MeshResult& mesh,
             const std::vector<double>& activation_times, std::filesystem::path folder)
      : case_(c),
        mesh_(mesh),
        folder_(std::move(folder)),
        analysis_(field_analysis(c, mesh.mesh, activation_times)) {
    if (parallel::is_root())
      std::filesystem::create_directories(folder_ / "fields");
  }

  /// The first frame of a beat takes the place of those of the beat before it.
  void frame(const heartbeat::Frame& f) {
    if (f.number == 0 && parallel::is_root())
      clear();
    const auto cells = analysis_.fields(f.wall);
    const auto* ed = f.run.beat.find(heartbeat::end_diastole);
    if (ed != nullptr && (!end_diastole_ || end_diastole_time_ != ed->wall.time)) {
      end_diastole_ = analysis_.fields(ed->wall);
      end_diastole_time_ = ed->wall.time;
    }
    if (parallel::is_root())
      report::write_wall(folder_ / wall_file(f.number), mesh_.mesh, mesh_.regions, f.wall, cells,
                         end_diastole_.value_or(std::vector<analysis::CellFields>{}));
    if (f.blood && case_.output.blood) {
      const auto blood = blood_fields(f);
      if (parallel::is_root())
        report::write_blood(folder_ / blood_file(f.number), blood);
    }
    if (parallel::is_root())
      write_series(f.run, f.blood && case_.output.blood);
  }

  void curves(const heartbeat::RunState& run) const {
    if (!parallel::is_root())
      return;
    if (run.beat.cycle)
      write_cycle_tables(*run.beat.cycle, folder_);
    report::curves_table(run.beat.curves).write_csv(folder_ / "curves.csv");
    report::moments_table(run.beat.moments).write_csv(folder_ / "moments.csv");
  }

 private:
  void clear() const {
    for (const auto& entry : std::filesystem::directory_iterator(folder_ / "fields"))
      std::filesystem::remove(entry.path());
  }

  static std::string wall_file(int number) { return fmt::format("fields/wall_{:04d}.vtu", number); }
  static std::string blood_file(int number) {
    return fmt::format("fields/blood_{:04d}.vti", number);
  }

  void write_series(const heartbeat::RunState& run, bool with_blood) const {
    std::vector<report::TimedFile> wall;
    std::vector<report::TimedFile> blood;
    for (int n = 0; n < run.frames; ++n) {
      wall.push_back({run.frame_times[n], wall_file(n)});
      blood.push_back({run.frame_times[n], blood_file(n)});
    }
    report::write_pvd(folder_ / "wall.pvd", wall);
    if (with_blood)
      report::write_pvd(folder_ / "blood.pvd", blood);
  }

  const Case& case_;
  const anatomy::MeshResult& mesh_;
  std::filesystem::path folder_;
  analysis::FieldAnalysis analysis_;
  std::optional<std::vector<analysis::CellFields>> end_diastole_;  ///< once it is reached
  double end_diastole_time_ = 0.0;                                 ///< of it [s]
};

/// Whether the program knows that a parameter's value was measured: borders, images and volumes
/// that a case names.
bool is_measurement(const std::string& parameter) {
  return parameter == "protocol.cuff_systolic" || parameter == "calibrate.edv" ||
         parameter == "calibrate.esv" || parameter == "calibrate.strains" ||
         parameter == "calibrate.cuff_systolic" || parameter == "calibrate.cuff_diastolic" ||
         parameter.starts_with("strain.") || parameter == "segment.cine" ||
         parameter == "segment.series" || parameter == "segment.long_axis_cine" ||
         (parameter.starts_with("anatomy.") && parameter != "anatomy.source" &&
          !parameter.starts_with("anatomy.ellipsoid."));
}

/// Whether images show the infarct; otherwise it lies where somebody said.
bool scar_is_measured(const Case& c) {
  return c.scar.source == mesh::InfarctSource::labels || c.scar.source == mesh::InfarctSource::lge;
}

/// Where an infarct lies that no image shows.
geometry::Assumption assumed_scar(const Case& c, const mesh::Regions& regions) {
  if (c.scar.source == mesh::InfarctSource::strain)
    return {"infarct", scar::describe(c, scar::strain_verdicts(c, regions))};
  return {"infarct", "the infarct lies where the case says; no image shows it"};
}

/// What was measured, fitted and assumed.
void add_marks(const Case& c, report::RunFacts& facts) {
  facts.muscle_density = c.muscle_density;
  facts.shape = case_file::is_drawn(c) ? report::Mark::measured : report::Mark::assumed;
  facts.scar_is_measured = scar_is_measured(c);
  facts.fitted_parameters = fitted_names(c);
  for (const auto& [name, place] : c.origin)
    if (is_measurement(name))
      facts.measured_parameters.push_back(name);
}

report::RunFacts run_facts(const Case& c, const anatomy::MeshResult& mesh, const BeatResult& beat) {
  report::RunFacts facts;
  facts.case_name = c.name;
  facts.version = work::version();
  facts.engine = c.engine == case_file::EngineChoice::immersed ? "immersed" : "quasi-static";
  facts.ranks = beat.ranks;
  facts.nodes = static_cast<int>(mesh.mesh.nodes.size());
  facts.order = mesh.mesh.order;
  facts.elements = mesh.mesh.cell_count() / mesh::cells_per_element(mesh.mesh.order);
  if (c.engine == case_file::EngineChoice::immersed) {
    facts.grid = fmt::format("{} x {} x {}", c.box.cells[0], c.box.cells[1], c.box.cells[2]);
    facts.mesh_width = case_file::model_parameters(c, mesh.mesh).grid.spacing.minCoeff();
  }
  facts.wall_clock = beat.beat.wall_clock;
  if (beat.beat.cycle) {
    facts.warnings = cycle_warnings(c, *beat.beat.cycle);
    facts.pressure = report::Mark::computed;
  }
  for (const case_file::Parameter& p : case_file::parameters())
    facts.parameters.emplace_back(p.name, p.shown(c));
  for (const auto& [name, place] : c.origin)
    facts.origins.emplace_back(name, work::place_alone(c, place));
  add_marks(c, facts);
  facts.base_is_held = c.base.kind != solid::BasalSupport::Kind::elastic &&
                       c.base_motion.source == heartbeat::BaseMotionSource::none;
  for (const heartbeat::NamedMoment& m : beat.beat.moments)
    if (!m.by_criterion && !beat.beat.cycle)
      facts.warnings.push_back(
          fmt::format("{0} ended at protocol.{0}_longest before its criterion was met", m.phase));
  if (beat.beat.retries > 0)
    facts.warnings.push_back(
        fmt::format("{} steps were taken back and repeated smaller", beat.beat.retries));
  return facts;
}

/// What heartbeats were fitted to beside the last of them.
std::vector<report::FittedOfBeat> beside_beat(const std::vector<beating_wall::FittedDatum>& fitted,
                                              const heartbeat::Beat& beat, double tolerance) {
  std::vector<report::FittedOfBeat> all;
  if (!beat.cycle)
    return all;
  const std::vector<case_file::BeatDatum> data = case_file::beat_fit({}).data;
  for (const beating_wall::FittedDatum& d : fitted)
    for (const case_file::BeatDatum& of_beat : data)
      if (of_beat.name == d.name) {
        const double value = of_beat.shown(beat.cycle->beats.back().*of_beat.of_beat);
        all.push_back({d.name, d.unit, d.measured, d.model, value,
                       std::abs(value / d.measured - 1.0) <= tolerance});
      }
  return all;
}

/// The segments that the infarct touches.
std::vector<report::SegmentScar> scar_facts(const Case& c, const anatomy::MeshResult& mesh) {
  std::vector<report::SegmentScar> facts;
  for (const mesh::SegmentInfarct& s :
       mesh::infarct_by_segment(mesh.mesh, mesh.infarcted, mesh.regions, c.regions))
    if (s.infarct > 0.0)
      facts.push_back({mesh::aha_name(s.segment), s.infarct, c.muscle_density * s.infarct,
                       s.infarct / s.wall, s.transmurality});
  return facts;
}

/// The undeformed wall with the kernel's reach, three cells, must fit in the box.
void check_box(const Case& c, const mesh::Mesh& m) {
  const fluid::Grid grid = case_file::model_parameters(c, m).grid;
  const Vec3 wall = bounds(m.nodes).sizes();
  const Vec3 room = grid.upper() - grid.lower - 6.0 * grid.spacing;
  if ((wall.array() <= room.array()).all())
    return;
  throw InputError(case_file::place_of(c, "box.size"),
                   fmt::format("the wall measures {:.1f} x {:.1f} x {:.1f} mm and does not fit in "
                               "the box, which has room for {:.1f} x {:.1f} x {:.1f} mm with three "
                               "cells to spare on every side",
                               wall.x(), wall.y(), wall.z(), room.x(), room.y(), room.z()),
                   "Enlarge box.size; a filling ventricle grows by half, and blood needs space");
}

/// Nodal coupling needs nodes denser than the grid, else blood passes between them.
void check_spacing(const Case& c, const mesh::Mesh& m) {
  const double edge = mesh::quality(m).edge_length.mean;
  const double width = case_file::model_parameters(c, m).grid.spacing.minCoeff();
  if (c.coupling.kind != immersed::CouplingKind::nodal || edge <= width)
    return;
  throw InputError(
      case_file::place_of(c, c.anatomy.source == case_file::AnatomySource::mesh
                                 ? "anatomy.mesh.file"
                                 : "mesh.edge_length"),
      fmt::format("the mesh's edges are {:.2f} mm long in the mean, more than the box's mesh width "
                  "of {:.2f} mm; nodal coupling would let blood pass between the nodes",
                  edge, width),
      fmt::format("{}, take fewer box.cells, or set coupling.kind = \"quadrature\"",
                  c.anatomy.source == case_file::AnatomySource::mesh
                      ? fmt::format("Set anatomy.mesh.refinements = {:.0f}",
                                    std::ceil(std::log2(edge / width)) + c.anatomy.mesh.refinements)
                      : fmt::format("Set mesh.edge_length = \"{:.2g} mm\" or less", 0.9 * width)));
}

void draw(const Case& c, const mesh::Mesh& mesh, const heartbeat::Beat& beat,
          const analysis::BeatFields& fields, const drawing::Orientation& orientation,
          const std::filesystem::path& folder) {
  report::CurveFacts facts{
      c.engine == case_file::EngineChoice::quasi_static && !beat.cycle, beat.cycle.has_value(), {}};
  for (const heartbeat::NamedMoment& m : beat.moments)
    facts.moments.emplace_back(m.name, m.wall.time);
  interrupt::check();
  drawing::write(report::states_figure(mesh, beat, fields, orientation), folder / "states.png");
  interrupt::check();
  drawing::write(report::stress_figure(mesh, beat, fields, orientation), folder / "stress.png");
  drawing::write(report::curves_figure(report::curves_table(beat.curves), facts),
                 folder / "curves.png");
  if (beat.cycle)
    write_cycle(*beat.cycle, report::curves_table(beat.curves), folder);
}

/// What the model's strains come to beside measured ones, if there are any.
std::string beside_measured(const Case& c, const anatomy::MeshResult& mesh, const BeatResult& beat,
                            const analysis::BeatFields& fields,
                            const drawing::Orientation& orientation,
                            const std::filesystem::path& folder) {
  if (!c.strain.asked() && c.strain.measured.empty())
    return "";
  const auto strain =
      folder.parent_path() / stage_folder(static_cast<std::size_t>(case_file::Stage::strain));
  return "\n" + cine::compare_strain(
                    c, {mesh, beat.beat, fields, anatomy_beside(folder).frame, orientation}, strain,
                    folder);
}

/// How far the model's end-systolic surfaces are from drawn ones, if there are any.
std::string beside_drawn(const mesh::Mesh& mesh, const heartbeat::Beat& beat,
                         const std::filesystem::path& folder) {
  const anatomy::AnatomyRecord anatomy = anatomy_beside(folder);
  const heartbeat::NamedMoment* end = beat.find(heartbeat::end_systole);
  if (anatomy.end_systole.empty() || !anatomy.frame || end == nullptr)
    return "";
  const anatomy::ShapeDistance distance =
      anatomy::shape_distance(mesh, end->wall.positions, *anatomy.frame, anatomy.end_systole);
  anatomy::shape_distance_table(distance).write_csv(folder / "es_distance.csv");
  return anatomy::shape_distance_text(distance);
}

/// The case's passive muscle and what it is compared with.
std::vector<material::StressStretch> muscles(const Case& c) {
  auto curves = material::published_muscles();
  curves.insert(curves.begin(), material::pulled_along_fibre(
                                    "this case", case_file::cardiac_model(c).myocardium.passive));
  return curves;
}

/// The root's part of make_results.
std::string write_results(const Case& c, const anatomy::MeshResult& mesh, const BeatResult& beat,
                          const report::RunFacts& facts, const analysis::BeatFields& fields,
                          const std::filesystem::path& folder) {
  const analysis::Results results = analysis::results(mesh.mesh, mesh.regions, beat.beat, fields);
  write_file(folder / "summary.json", report::summary_json(facts, beat.beat, results));
  if (!scar::describe_infarct(c, mesh).empty())
    scar::infarct_table(c, mesh).write_csv(folder / "infarct.csv");
  report::regions_table(results).write_csv(folder / "regions.csv");
  const auto frames = page::frames_of(report::file_of(folder.parent_path(), "beat", "wall.pvd"));
  if (!frames.empty())
    page::segments_over_time(frames, beat.beat.at(heartbeat::end_diastole).time)
        .write_csv(folder / "segments_over_time.csv");
  report::rotation_table(results).write_csv(folder / "rotation.csv");
  report::stress_stretch_table(muscles(c)).write_csv(folder / "stress_stretch.csv");
  report::curves_table(beat.beat.curves).write_csv(folder / "curves.csv");
  for (const auto& [name, cells] : fields.moments)
    report::write_wall(folder / (name + ".vtu"), mesh.mesh, mesh.regions, beat.beat.at(name), cells,
                       fields.at(heartbeat::end_diastole));
  const drawing::Orientation orientation{c.regions.septum_angle, facts.assumed,
                                         facts.unloaded.has_value()};
  if (facts.contractility) {
    facts.contractility->write_csv(folder / contractility_name);
    drawing::write(report::contractility_figure(*facts.contractility, orientation),
                   folder / "contractility.png");
  }
  report::write_facts(orientation, folder);
  draw(c, mesh.mesh, beat.beat, fields, orientation, folder);
  drawing::write(report::segments_figure(report::regions_table(results), orientation),
                 folder / "segments.png");
  return report::summary_text(facts, beat.beat, results) +
         beside_drawn(mesh.mesh, beat.beat, folder) +
         beside_measured(c, mesh, beat, fields, orientation, folder);
}

}  // namespace

anatomy::AnatomyRecord anatomy_beside(const std::filesystem::path& folder) {
  const auto stage = stage_folder(static_cast<std::size_t>(case_file::Stage::anatomy));
  return anatomy::anatomy_record(folder.parent_path() / stage);
}

void check_room(const Case& c, const mesh::Mesh& mesh) {
  if (c.engine != case_file::EngineChoice::immersed)
    return;
  check_box(c, mesh);
  check_spacing(c, mesh);
}

anatomy::MeshResult make_mesh(const Case& c, const anatomy::Shape& shape) {
  anatomy::MeshResult result;
  result.mesh =
      shape.given ? *shape.given : mesh::wall_mesh(shape.wall, case_file::mesh_parameters(c));
  result.mesh.fibres.rule = c.fibres;
  scar::InfarctExtent infarct = scar::infarct_extent(c, shape, result.mesh);
  result.mesh.infarct = std::move(infarct.M);
  result.infarcted = std::move(infarct.part);
  result.slice_moves = std::move(infarct.slice_moves);
  if (c.engine == case_file::EngineChoice::immersed) {
    result.mesh.order = 1;  // the parts of a refined given mesh are its elements
  } else if (c.quasi_static.order == 2 && result.mesh.order == 1) {
    // each element of a given mesh becomes a quadratic one
    result.mesh = mesh::refine(result.mesh);
    result.infarcted = mesh::refine_numbers(result.infarcted);
  }
  result.regions = mesh::divide(result.mesh, c.regions);
  result.mesh.segment = result.regions.aha;
  return result;
}

void show_mesh(const anatomy::MeshResult& result, const Case& c,
               const std::filesystem::path& folder) {
  const mesh::Mesh& m = result.mesh;
  const auto undeformed = analysis::FieldAnalysis(m, {}).at_rest();  // directions
  parallel::on_root([&] {
    report::write_mesh(folder / "mesh.vtu", m, result.regions, undeformed);
    report::quality_table(mesh::quality(m)).write_csv(folder / "quality.csv");
    interrupt::check();
    drawing::Orientation orientation{c.regions.septum_angle, anatomy_beside(folder).assumed};
    const std::string infarct = scar::describe_infarct(c, result);
    Progress pictures("pictures of the mesh", infarct.empty() ? 2 : 3);
    drawing::write(report::mesh_figure(m, orientation), folder / "mesh.png");
    pictures.add();
    drawing::write(report::fibre_figure(m, undeformed, orientation), folder / "fibres.png");
    pictures.add();
    if (!infarct.empty()) {
      log::info("{}", infarct);
      scar::infarct_table(c, result).write_csv(folder / "infarct.csv");
      if (c.scar.source == mesh::InfarctSource::strain)
        scar::strain_infarct_table(c, scar::strain_verdicts(c, result.regions))
            .write_csv(folder / "infarct_strain.csv");
      if (!scar_is_measured(c))
        orientation.assumed.push_back(assumed_scar(c, result.regions));
      drawing::write(report::infarct_figure(m, orientation), folder / "infarct.png");
    }
  });
}

heartbeat::Beat make_beat(const Case& c, const anatomy::MeshResult& mesh,
                          const std::filesystem::path& folder) {
  const bool is_cycle = case_file::is_cycle(c);
  parallel::on_root([&] { report::write_facts(report::BeatFacts{is_cycle}, folder); });
  if (c.engine == case_file::EngineChoice::quasi_static && !is_cycle && parallel::is_root())
    std::filesystem::remove_all(folder / "fields");  // of a beat that was stopped: it starts anew
  const std::vector<double> activated =
      is_cycle ? beating_wall::activation_times(c, mesh) : std::vector<double>{};
  BeatWriter writer(c, mesh, activated, folder);
  const heartbeat::Observers observers{[&](const heartbeat::Frame& f) { writer.frame(f); },
                                       [&](const heartbeat::RunState& run) { writer.curves(run); }};
  if (is_cycle)
    return make_cycle(c, mesh.mesh, activated, folder, observers);
  if (c.engine == case_file::EngineChoice::quasi_static)
    return heartbeat::run_quasi_static_beat(
        {mesh.mesh, case_file::static_model(c), c.quasi_static.solver, c.protocol,
         c.output.frame_interval},
        observers);
  return heartbeat::run_immersed_beat(case_file::beat_setup(c, mesh.mesh), folder, observers);
}

std::string make_results(const Case& c, const anatomy::MeshResult& mesh, const BeatResult& beat,
                         const FitRecord& fitted,
                         const std::optional<report::UnloadedShape>& unloaded,
                         const std::filesystem::path& folder) {
  const analysis::FieldAnalysis analysis = field_analysis(c, mesh.mesh, beat.beat.activation_times);
  analysis::BeatFields fields{analysis.at_rest(), {}};
  for (const heartbeat::NamedMoment& m : beat.beat.moments) {
    fields.moments.push_back({m.name, analysis.fields(m.wall)});
    analysis::set_work_density(beat.beat.energy.work_density, fields.moments.back().cells);
  }
  std::string text;
  parallel::on_root([&] {
    report::RunFacts facts = run_facts(c, mesh, beat);
    anatomy::AnatomyRecord anatomy = anatomy_beside(folder);
    facts.warnings.insert(facts.warnings.begin(), anatomy.warnings.begin(), anatomy.warnings.end());
    facts.assumed = std::move(anatomy.assumed);
    facts.assumed.insert(facts.assumed.end(), fitted.assumed.begin(), fitted.assumed.end());
    if (c.scar.source == mesh::InfarctSource::strain)
      facts.assumed.push_back(assumed_scar(c, mesh.regions));
    facts.fitted = fitted.volumes;
    if (!fitted.segments.empty())
      facts.contractility = calibrate::contractility_table(fitted.segments);
    facts.klotz = fitted.klotz;
    facts.fitted_shape = fitted.shape;
    facts.fitted_beats = beside_beat(fitted.beats, beat.beat, c.calibration.tolerance);
    facts.unloaded = unloaded;
    if (unloaded)
      facts.warnings.insert(facts.warnings.end(), unloaded->warnings.begin(),
                            unloaded->warnings.end());
    facts.scar = scar_facts(c, mesh);
    text = write_results(c, mesh, beat, facts, fields, folder);
  });
  return text;
}

}  // namespace lv::pipeline
