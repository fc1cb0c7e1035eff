#include "lv/job/anatomy.hpp"

#include "lv/base/check.hpp"
#include "lv/base/table.hpp"
#include "lv/mesh/abaqus_blocks.hpp"
#include "lv/mesh/import.hpp"
#include "lv/mesh/refine.hpp"
#include "lv/report/fields_vtk.hpp"
#include "lv/report/tables_csv.hpp"

#include <nlohmann/json.hpp>

#include <memory>

namespace lv::job {
namespace {

namespace fs = std::filesystem;

geometry::ContourFiles contour_files(const Case& c) {
  const ContourAnatomy& a = c.anatomy.contours;
  if (a.short_axis.empty())
    throw InputError(c.file.string(), "anatomy.contours.short_axis is not set",
                     "Name the CSV file of the short-axis loops");
  geometry::ContourFiles files{.short_axis = beside(c, a.short_axis), .long_axis = {}, .apex = {}};
  if (!a.long_axis.empty())
    files.long_axis = beside(c, a.long_axis);
  for (const std::string& apex : {a.apex_endo, a.apex_epi})
    if (!apex.empty())
      files.apex.push_back(beside(c, apex));
  return files;
}

Shape from_contours(const Case& c) {
  const auto wall = std::make_shared<const geometry::SplineWall>(
      geometry::fit_spline_wall(geometry::read_contours(contour_files(c)), c.anatomy.contours.fit));
  Shape shape;
  shape.wall = [wall](double u, double theta, double t) { return wall->point(u, theta, t); };
  shape.frame = wall->frame();
  shape.fit = wall->report();
  shape.notes = wall->report().notes;
  return shape;
}

Shape from_mesh(const Case& c) {
  mesh::ImportParameters import = c.anatomy.mesh.import;
  if (import.file.empty())
    throw InputError(c.file.string(), "anatomy.mesh.file is not set", "Name the mesh's file");
  import.file = beside(c, import.file).string();
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
  return shape;
}

std::vector<double> numbers(const Vec3& v) {
  return {v.x(), v.y(), v.z()};
}

}  // namespace

std::string septum_note(const Case& c) {
  const bool said = c.origin.contains("regions.septum_angle") ||
                    c.origin.contains("anatomy.contours.septum_point");
  if (said || c.anatomy.source == AnatomySource::ellipsoid)
    return "";
  return c.anatomy.source == AnatomySource::contours
             ? "the septum is assumed at the first point of the basal endocardial loop: regions "
               "bear the wrong names if it is elsewhere (set anatomy.contours.septum_point)"
             : "the septum is assumed on the mesh's x axis: regions bear the wrong names if it is "
               "elsewhere (set regions.septum_angle)";
}

Shape make_anatomy(const Case& c) {
  if (c.anatomy.source != AnatomySource::ellipsoid) {
    Shape shape = c.anatomy.source == AnatomySource::contours ? from_contours(c) : from_mesh(c);
    if (const std::string note = septum_note(c); !note.empty())
      shape.notes.push_back(note);
    return shape;
  }
  Shape shape;
  shape.wall = [e = c.anatomy.ellipsoid](double u, double theta, double t) {
    return e.point(u, theta, t);
  };
  return shape;
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
                                     {"notes", shape.notes}};
  write_file(folder / "frame.json", frame.dump(2) + "\n");
  if (shape.fit)
    report::fit_table(*shape.fit).write_csv(folder / "fit.csv");
}

Ingredients anatomy_files(const Case& c) {
  Ingredients files;
  const auto add = [&](const std::string& parameter, const std::string& name) {
    if (!name.empty())
      files["contents of " + parameter] = fingerprint_of_file(beside(c, name));
  };
  if (c.anatomy.source == AnatomySource::contours) {
    add("anatomy.contours.short_axis", c.anatomy.contours.short_axis);
    add("anatomy.contours.long_axis", c.anatomy.contours.long_axis);
    add("anatomy.contours.apex_endo", c.anatomy.contours.apex_endo);
    add("anatomy.contours.apex_epi", c.anatomy.contours.apex_epi);
  }
  if (c.anatomy.source == AnatomySource::mesh) {
    add("anatomy.mesh.file", c.anatomy.mesh.import.file);
    const fs::path file = beside(c, c.anatomy.mesh.import.file);
    if (file.extension() == ".inp" && fs::exists(file))
      for (const std::string& included : mesh::read_abaqus_blocks(file.string()).files)
        files["contents of " + included] = fingerprint_of_file(included);
  }
  return files;
}

}  // namespace lv::job
