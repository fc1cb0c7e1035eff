#include "lv/job/anatomy.hpp"

#include "lv/base/json_file.hpp"
#include "lv/base/table.hpp"
#include "lv/geometry/drawn_wall.hpp"
#include "lv/job/case_lines.hpp"
#include "lv/job/drawn.hpp"
#include "lv/job/parameters.hpp"
#include "lv/mesh/foreign_mesh.hpp"
#include "lv/mesh/import.hpp"
#include "lv/mesh/refine.hpp"
#include "lv/report/fields_vtk.hpp"
#include "lv/report/tables_csv.hpp"
#include "lv/solid/endocardial_surface.hpp"

#include <fmt/format.h>

#include <array>
#include <memory>

namespace lv::job {
namespace {

namespace fs = std::filesystem;

constexpr const char* frame_name = "frame.json";

constexpr const char* assumed_septum =
    "the septum is assumed at the first point of the basal endocardial loop: regions bear the "
    "wrong names if it is elsewhere (set anatomy.contours.septum_point)";
constexpr const char* assumed_septum_of_mesh =
    "the septum is assumed on the mesh's x axis: regions bear the wrong names if it is elsewhere "
    "(set regions.septum_angle)";

geometry::BaseAt base_at(const Case& c, const Drawn& drawn) {
  switch (c.anatomy.contours.base_at) {
    case BaseChoice::slice:
      return geometry::BaseAt::slice;
    case BaseChoice::slab:
      return geometry::BaseAt::slab;
    case BaseChoice::annulus:
      return geometry::BaseAt::annulus;
    default:
      return drawn.usual_base;
  }
}

std::string base_rule(geometry::BaseAt at, geometry::BasePlane direction) {
  const char* height = at == geometry::BaseAt::slice ? "through the most basal slice"
                       : at == geometry::BaseAt::slab
                           ? "half a slice spacing above the most basal slice, where its slab ends"
                           : "through the mitral annulus";
  return fmt::format("{}, {}", height,
                     direction == geometry::BasePlane::long_axis ? "across the long axis"
                                                                 : "parallel to that slice");
}

Shape from_drawn(const Case& c) {
  Drawn drawn = read_drawn(c);
  geometry::SplineFitParameters fit = c.anatomy.contours.fit;
  fit.frame.base_at = base_at(c, drawn);
  if (!fit.frame.septum)
    fit.frame.septum = drawn.septum;
  const bool base_may_move = c.anatomy.contours.base_at == BaseChoice::automatic;
  geometry::DrawnWall found = geometry::fit_drawn_wall(drawn.contours, fit, base_may_move);
  const auto wall = std::make_shared<const geometry::SplineWall>(std::move(found.wall));
  Shape shape;
  shape.wall = [wall](double u, double theta, double t) { return wall->point(u, theta, t); };
  shape.frame = wall->frame();
  shape.notes = std::move(drawn.notes);
  for (const auto& notes : {wall->report().notes, found.notes})
    shape.notes.insert(shape.notes.end(), notes.begin(), notes.end());
  shape.warnings = std::move(drawn.warnings);
  shape.segmentation = std::move(drawn.segmentation);
  if (!fit.frame.septum && !c.origin.contains("regions.septum_angle"))
    shape.warnings.emplace_back(assumed_septum);
  shape.notes.insert(shape.notes.end(), shape.warnings.begin(), shape.warnings.end());
  shape.quality = report::QualitySheet{
      wall->report(),     drawn.source,       base_rule(found.base_at, fit.frame.base_plane),
      drawn.label_cavity, drawn.label_muscle, shape.notes};
  return shape;
}

/// Sides and directions of fibres may be files beside the mesh's.
constexpr std::array perhaps_files{&mesh::ImportParameters::endo, &mesh::ImportParameters::epi,
                                   &mesh::ImportParameters::base, &mesh::ImportParameters::fibres,
                                   &mesh::ImportParameters::sheets};

Shape from_mesh(const Case& c) {
  mesh::ImportParameters import = c.anatomy.mesh.import;
  if (import.file.empty()) {
    Missing missing;
    missing.add({"anatomy.mesh.file", fill_in, "the mesh: .inp, .msh, .vtk or .vtu"});
    missing.raise(c, place_of(c, "anatomy.source"));
  }
  import.file = beside(c, import.file).string();
  for (const auto name : perhaps_files)
    if (mesh::names_file(import.*name))
      import.*name = beside(c, import.*name).string();
  if (c.scar.source == mesh::InfarctSource::elements)
    import.infarct_set = c.scar.set;
  mesh::ImportedMesh imported = mesh::import_mesh(import);
  for (int i = 0; i < c.anatomy.mesh.refinements; ++i) {
    imported.mesh = mesh::refine(imported.mesh);
    imported.infarcted = mesh::refine_flags(imported.infarcted);
  }
  Shape shape;
  shape.infarcted = std::move(imported.infarcted);
  shape.given = std::move(imported.mesh);
  shape.frame = imported.frame;
  shape.notes = imported.notes;
  if (!c.origin.contains("regions.septum_angle"))
    shape.warnings.emplace_back(assumed_septum_of_mesh);
  shape.notes.insert(shape.notes.end(), shape.warnings.begin(), shape.warnings.end());
  return shape;
}

Shape read_shape(const Case& c) {
  if (is_drawn(c))
    return from_drawn(c);
  if (c.anatomy.source == AnatomySource::mesh)
    return from_mesh(c);
  Shape shape;
  shape.wall = [e = c.anatomy.ellipsoid](double u, double theta, double t) {
    return e.point(u, theta, t);
  };
  return shape;
}

std::vector<double> numbers(const Vec3& v) {
  return {v.x(), v.y(), v.z()};
}

}  // namespace

Shape make_anatomy(const Case& c) {
  Shape shape = read_shape(c);
  const NamesAlone names = names_alone(c);  // notes may name files: they are kept and shown
  for (auto* texts : {&shape.notes, &shape.warnings})
    for (std::string& text : *texts)
      text = names(text);
  if (shape.quality)
    shape.quality->notes = shape.notes;
  return shape;
}

double cavity_of(const Shape& shape) {
  constexpr double edge_length = 3.0;  // of quadratic elements: right to a thousandth [mm]
  const mesh::Mesh wall =
      shape.given ? *shape.given
                  : mesh::wall_mesh(shape.wall, {.edge_length = edge_length, .order = 2});
  return solid::EndocardialSurface(wall).volume(wall.nodes);
}

void write_anatomy(const Shape& shape, const fs::path& folder) {
  if (shape.given)
    report::write_surfaces(folder / "surfaces.vtu", *shape.given);
  else
    report::write_surfaces(folder / "surfaces.vtu", shape.wall);
  const Mat3& axes = shape.frame.axes;
  const nlohmann::ordered_json frame{{"origin_in_image_space_mm", numbers(shape.frame.origin)},
                                     {"x_axis_in_image_space", numbers(axes.col(0))},
                                     {"y_axis_in_image_space", numbers(axes.col(1))},
                                     {"z_axis_in_image_space", numbers(axes.col(2))},
                                     {"notes", shape.notes},
                                     {"warnings", shape.warnings}};
  write_file(folder / frame_name, json_text(frame) + "\n");
  if (shape.segmentation)
    write_segmentation(*shape.segmentation, folder / "segmentation");
  if (!shape.quality)
    return;
  report::fit_table(shape.quality->fit).write_csv(folder / "fit.csv");
  report::quality_table(*shape.quality).write_csv(folder / "quality.csv");
  write_file(folder / "quality.json", report::quality_json(*shape.quality));
  write_file(folder / "quality.txt", report::quality_text(*shape.quality));
}

std::vector<std::string> anatomy_warnings(const fs::path& folder) {
  return from_json_file(folder / frame_name, [](const nlohmann::ordered_json& json) {
    return json.at("warnings").get<std::vector<std::string>>();
  });
}

}  // namespace lv::job
