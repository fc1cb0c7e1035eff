#include "lv/anatomy/anatomy.hpp"

#include "lv/anatomy/drawn.hpp"
#include "lv/anatomy/heart_size.hpp"
#include "lv/base/json_file.hpp"
#include "lv/base/table.hpp"
#include "lv/case_file/case_lines.hpp"
#include "lv/case_file/parameters.hpp"
#include "lv/geometry/contour_table.hpp"
#include "lv/geometry/drawn_wall.hpp"
#include "lv/geometry/lie_in_patient.hpp"
#include "lv/heartbeat/archive.hpp"
#include "lv/mesh/fibres.hpp"
#include "lv/mesh/quality.hpp"
#include "lv/mesh/refine.hpp"
#include "lv/mesh_io/foreign_mesh.hpp"
#include "lv/mesh_io/import.hpp"
#include "lv/report/fields_vtk.hpp"
#include "lv/report/tables_csv.hpp"
#include "lv/solid/endocardial_surface.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace lv::anatomy {
namespace {

using case_file::Case;
using heartbeat::Archive;
namespace fs = std::filesystem;

constexpr const char* frame_name = "frame.json";
constexpr const char* record_name = "anatomy.bin";
constexpr const char* es_contours_name = "es_contours.csv";
constexpr const char* origin_name = "origin_in_image_space_mm";

constexpr const char* assumed_septum =
    "the septum is assumed at the first point of the basal endocardial loop: regions bear the "
    "wrong names if it is elsewhere (set anatomy.contours.septum_point)";
constexpr const char* assumed_septum_of_mesh =
    "the septum is assumed on the mesh's x axis: regions bear the wrong names if it is elsewhere "
    "(set regions.septum_angle)";
constexpr const char* assumed_moment =
    "the shape is taken as that of early diastole, free of stress: nothing says at which moment it "
    "was seen (set unloaded.pressure if it bears a pressure)";

geometry::BaseAt base_at(const Case& c, const Drawn& drawn) {
  switch (c.anatomy.contours.base_at) {
    case case_file::BaseChoice::slice:
      return geometry::BaseAt::slice;
    case case_file::BaseChoice::slab:
      return geometry::BaseAt::slab;
    case case_file::BaseChoice::annulus:
      return geometry::BaseAt::annulus;
    default:
      return drawn.usual_base;
  }
}

/// A shape that is filled, or may be, is taken as free of stress; warnings of what was read go
/// first.
void assume_moment(const Case& c, const std::vector<geometry::Assumption>& warnings, bool is_known,
                   Shape& shape) {
  shape.warnings.insert(shape.warnings.end(), warnings.begin(), warnings.end());
  if (!case_file::is_loaded(c) && !is_known)
    shape.assumed.push_back({"early diastole", assumed_moment});
}

/// How the wall lies in the patient. A septum_angle says where the septum is too.
geometry::Lie lie_of(const Case& c, const geometry::Frame& frame, bool septum_is_shown) {
  geometry::Lie lie{-frame.axes.col(2), {}};
  const double angle = c.regions.septum_angle;
  if (septum_is_shown || case_file::is_set(c, "regions.septum_angle", case_file::Stage::anatomy))
    lie.septum = std::cos(angle) * frame.axes.col(0) + std::sin(angle) * frame.axes.col(1);
  return lie;
}

/// Warns where the wall lies in the patient as no heart does. A header that mirrors the image does
/// this, or an export in other axes, and exchanges the names of regions.
void check_orientation(const Case& c, bool septum_is_shown, Shape& shape) {
  using case_file::AnatomySource;
  const std::string odd = geometry::oddity(lie_of(c, shape.frame, septum_is_shown));
  if (odd.empty())
    return;
  const AnatomySource source = c.anatomy.source;
  const bool from_image = source == AnatomySource::labels || source == AnatomySource::cine ||
                          source == AnatomySource::sunnybrook;
  shape.warnings.push_back(
      {"orientation",
       fmt::format("in the coordinates of the {} {}; {}", from_image ? "image" : "contours", odd,
                   from_image ? "check how its header lays it in space"
                              : "they must be LPS as in DICOM: x to the left, y to the back, z to "
                                "the head")});
}

/// Warns of contours that the wall passes by: of a point that slipped, or an image that lies
/// elsewhere.
void check_contours_met(const geometry::FitReport& fit, Shape& shape) {
  constexpr double far = 6.0;  // [mm]; breath-holds are moved back from less, or told
  std::vector<std::string> where;
  const auto add = [&](const std::string& image, const auto& endo, const auto& epi) {
    for (const auto& [side, distance] : {std::pair("endo", endo), {"epi", epi}})
      if (distance && distance->max > far)
        where.push_back(fmt::format("{} {} ({:.1f} mm)", image, side, distance->max));
  };
  for (const geometry::ImageReport& image : fit.short_axis)
    add(fmt::format("slice {}", image.slice), image.endo, image.epi);
  for (const geometry::ImageReport& image : fit.long_axis)
    add(fmt::format("long axis {}", image.slice), image.endo, image.epi);
  add("apex", fit.apex_endo, fit.apex_epi);
  if (!where.empty())
    shape.warnings.push_back(
        {"contours", fmt::format("the wall passes the contours by: {}; a point of them slipped, or "
                                 "the image lies elsewhere: look at fit.csv, and redraw it",
                                 fmt::join(where, ", "))});
}

/// Warns of a size that no human heart has: of a wrong voxel size or unit.
void check_size(double cavity, double wall, std::optional<double> thickness, Shape& shape) {
  if (std::string odd = odd_size(cavity, wall, thickness); !odd.empty())
    shape.warnings.push_back({"size", std::move(odd)});
}

/// Throws InputError for a point of the septum that lies far outside of the wall.
void check_septum_point(const Case& c, const Shape& shape) {
  constexpr double most = 40.0;  // [mm]; the right ventricle's insertions lie on the epicardium
  constexpr int angles = 72;
  const auto& septum = c.anatomy.contours.fit.frame.septum;
  if (!septum)
    return;
  const Vec3 x = shape.frame.to_model(Vec3(septum->data()));
  double nearest = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= angles; ++i)
    for (int j = 0; j < angles; ++j)
      nearest = std::min(nearest, (shape.wall(static_cast<double>(i) / angles,
                                              2.0 * std::numbers::pi * j / angles, 1.0) -
                                   x)
                                      .norm());
  if (nearest > most)
    throw InputError(case_file::place_of(c, "anatomy.contours.septum_point"),
                     fmt::format("anatomy.contours.septum_point lies {:.0f} mm from the wall: no "
                                 "point of its septum",
                                 nearest),
                     "Give a point of the septum, in the coordinates and the unit of the contours");
}

/// Warnings are assumptions and notes too.
void collect_remarks(Shape& shape) {
  shape.assumed.insert(shape.assumed.begin(), shape.warnings.begin(), shape.warnings.end());
  for (const geometry::Assumption& a : shape.warnings)
    shape.notes.push_back(a.text);
}

std::string base_rule(const std::string& height, geometry::BasePlane direction) {
  return fmt::format("{}, {}", height,
                     direction == geometry::BasePlane::long_axis ? "across the long axis"
                                                                 : "parallel to that slice");
}

/// Loops of a breath-hold lie where those of the shape on the same slice do.
std::vector<geometry::Contour> moved_with_slices(std::vector<geometry::Contour> loops,
                                                 const geometry::FitReport& report) {
  for (geometry::Contour& loop : loops)
    for (const geometry::ImageReport& image : report.short_axis)
      if (image.slice == loop.slice)
        for (Vec3& x : loop.points)
          x += image.shift;
  return loops;
}

Shape from_drawn(const Case& c) {
  Drawn drawn = read_drawn(c);
  geometry::SplineFitParameters fit = c.anatomy.contours.fit;
  fit.frame.base_at = base_at(c, drawn);
  if (!fit.frame.septum)
    fit.frame.septum = drawn.septum;
  const geometry::MayMove may_move{
      .base = c.anatomy.contours.base_at == case_file::BaseChoice::automatic,
      .slices = !case_file::is_set(c, "anatomy.contours.align_slices", case_file::Stage::anatomy)};
  geometry::DrawnWall found = geometry::fit_drawn_wall(drawn.contours, fit, may_move);
  const auto wall = std::make_shared<const geometry::SplineWall>(std::move(found.wall));
  Shape shape;
  shape.wall = [wall](double u, double theta, double t) { return wall->point(u, theta, t); };
  shape.frame = wall->frame();
  if (drawn.end_systole)
    shape.end_systole = moved_with_slices(std::move(drawn.end_systole->short_axis), wall->report());
  shape.notes = std::move(drawn.notes);
  for (const auto& notes : {wall->report().notes, found.notes})
    shape.notes.insert(shape.notes.end(), notes.begin(), notes.end());
  shape.segmentation = std::move(drawn.segmentation);
  shape.warnings = std::move(found.warnings);
  if (!fit.frame.septum && !case_file::is_set(c, "regions.septum_angle", case_file::Stage::anatomy))
    shape.warnings.push_back({"septum", assumed_septum});
  check_septum_point(c, shape);
  check_contours_met(wall->report(), shape);
  const double wall_volume = wall->report().volume_wall;
  check_size(wall->report().volume_cavity, wall_volume, mean_thickness(shape.wall, wall_volume),
             shape);
  check_orientation(c, fit.frame.septum.has_value(), shape);
  shape.assumed = wall->report().assumed;
  assume_moment(c, drawn.warnings, drawn.moment_is_known, shape);
  collect_remarks(shape);
  shape.quality = report::QualitySheet{
      wall->report(),     drawn.source,       base_rule(found.base, fit.frame.base_plane),
      drawn.label_cavity, drawn.label_muscle, shape.notes};
  return shape;
}

/// Warns of fibres that lead through the wall: an array of sheets or normals that was named in
/// their place, or another axis than the heart's.
void check_fibres(Shape& shape) {
  constexpr double most = 25.0;  // [degrees]; directions at random have 33, fibres less than 15
  const mesh::Mesh& m = *shape.given;
  if (m.fibres.given.f0.empty())
    return;
  const std::vector<Vec3> radial = mesh::radial_directions(m);
  const auto out_of_wall = [](const Vec3& f, const Vec3& r) {
    return std::asin(std::min(1.0, std::abs(f.dot(r)))) * 180.0 / std::numbers::pi;
  };
  double sum = 0.0;
  for (std::size_t i = 0; i < m.fibres.given.f0.size(); ++i) {
    Vec3 r = Vec3::Zero();
    if (m.fibres.given.at == mesh::GivenFibres::At::nodes)
      r = radial[i];
    else
      for (const int node : m.cell(static_cast<int>(i)))
        r += radial[node];
    sum += out_of_wall(m.fibres.given.f0[i], r.normalized());
  }
  const double mean = sum / static_cast<double>(m.fibres.given.f0.size());
  if (mean > most)
    shape.warnings.push_back(
        {"fibres", fmt::format("the fibres of anatomy.mesh.fibres lead out of the wall's surface, "
                               "by {:.0f} degrees in the mean: muscle fibres run along it; is it "
                               "the array of sheets or normals, or are its axes other ones?",
                               mean)});
}

/// Warns of an infarct in the mesh's file that the case does not read.
void warn_of_unread_infarct(const mesh_io::UnreadInfarct& unread, Shape& shape) {
  const std::string name = printable(unread.name);
  shape.warnings.push_back(
      {"scar",
       fmt::format(
           "the mesh's \"{}\" ({}) is not read, so that the wall has no infarct: with {} it "
           "is; infarct.source = \"none\" says that none is meant",
           name, unread.at_points ? "numbers at points" : "a set or array of elements",
           unread.at_points
               ? fmt::format("the line infarct_array = \"{}\" under [anatomy.mesh]", name)
               : fmt::format("the lines source = \"elements\" under [infarct] and set = "
                             "\"{}\" under [infarct.elements]",
                             name))});
}

/// Sides and directions of fibres may be files beside the mesh's.
constexpr std::array perhaps_files{&mesh::ImportParameters::endo, &mesh::ImportParameters::epi,
                                   &mesh::ImportParameters::base, &mesh::ImportParameters::fibres,
                                   &mesh::ImportParameters::sheets};

Shape from_mesh(const Case& c) {
  mesh::ImportParameters import = c.anatomy.mesh.import;
  if (import.file.empty()) {
    case_file::Missing missing;
    missing.add({"anatomy.mesh.file", case_file::fill_in, "the mesh: .inp, .msh, .vtk or .vtu"});
    missing.raise(c, case_file::place_of(c, "anatomy.source"));
  }
  import.file = case_file::beside(c, import.file).string();
  for (const auto name : perhaps_files)
    if (mesh_io::names_file(import.*name))
      import.*name = case_file::beside(c, import.*name).string();
  if (c.scar.source == mesh::InfarctSource::elements)
    import.infarct_set = c.scar.set;
  mesh_io::ImportedMesh imported = mesh_io::import_mesh(import);
  for (int i = 0; i < c.anatomy.mesh.refinements; ++i) {
    imported.mesh = mesh::refine(imported.mesh);
    imported.infarcted = mesh::refine_flags(imported.infarcted);
  }
  Shape shape;
  shape.infarcted = std::move(imported.infarcted);
  shape.given = std::move(imported.mesh);
  shape.frame = imported.frame;
  shape.notes = imported.notes;
  for (const std::string& warning : imported.warnings)
    shape.warnings.push_back({"wall", warning});
  if (!case_file::is_set(c, "regions.septum_angle", case_file::Stage::anatomy))
    shape.warnings.push_back({"septum", assumed_septum_of_mesh});
  check_fibres(shape);
  if (imported.unread && c.scar.source == mesh::InfarctSource::mesh)
    warn_of_unread_infarct(*imported.unread, shape);
  check_size(solid::EndocardialSurface(*shape.given).volume(shape.given->nodes),
             mesh::quality(*shape.given).wall_volume, {}, shape);
  assume_moment(c, {}, false, shape);
  collect_remarks(shape);
  return shape;
}

Shape read_shape(const Case& c) {
  if (case_file::is_drawn(c))
    return from_drawn(c);
  if (c.anatomy.source == case_file::AnatomySource::mesh)
    return from_mesh(c);
  Shape shape;
  shape.is_in_images = false;
  shape.wall = [e = c.anatomy.ellipsoid](double u, double theta, double t) {
    return e.point(u, theta, t);
  };
  return shape;
}

std::vector<double> numbers(const Vec3& v) {
  return {v.x(), v.y(), v.z()};
}

nlohmann::ordered_json json_of(const std::vector<geometry::Assumption>& list) {
  auto json = nlohmann::ordered_json::array();
  for (const geometry::Assumption& a : list)
    json.push_back({{"part", a.part}, {"text", a.text}});
  return json;
}

void store(const std::vector<geometry::Assumption>& list, const std::string& name,
           Archive& archive) {
  std::vector<std::string> parts;
  std::vector<std::string> texts;
  for (const geometry::Assumption& a : list) {
    parts.push_back(a.part);
    texts.push_back(printable_lines(a.text));  // it may quote files and names, and will be shown
  }
  archive.set_words(name + ".parts", parts);
  archive.set_words(name + ".texts", texts);
}

std::vector<geometry::Assumption> load_assumptions(const Archive& archive,
                                                   const std::string& name) {
  const auto parts = archive.get_words(name + ".parts");
  const auto texts = archive.get_words(name + ".texts");
  if (parts.size() != texts.size())
    archive.refuse(fmt::format("it has not a text for everything '{}'", name));
  std::vector<geometry::Assumption> list;
  for (std::size_t i = 0; i < parts.size(); ++i)
    list.push_back({parts[i], texts[i]});
  return list;
}

/// What later stages read; the frame's origin, then its axes.
void write_record(const Shape& shape, const fs::path& file) {
  Archive archive;
  const Mat3& axes = shape.frame.axes;
  const std::array<Vec3, 4> frame{shape.frame.origin, axes.col(0), axes.col(1), axes.col(2)};
  archive.set("frame", shape.is_in_images ? heartbeat::flat(frame) : std::vector<double>{});
  store(shape.assumed, "assumed", archive);
  store(shape.warnings, "warnings", archive);
  archive.write(file);
}

}  // namespace

Shape make_anatomy(const Case& c) {
  Shape shape = read_shape(c);
  const NamesAlone names =
      case_file::names_alone(c);  // notes may name files: they are kept and shown
  for (std::string& text : shape.notes)
    text = names(text);
  for (auto* list : {&shape.assumed, &shape.warnings})
    for (geometry::Assumption& a : *list)
      a.text = names(a.text);
  if (shape.quality)
    shape.quality->notes = shape.notes;
  return shape;
}

void write_anatomy(const Shape& shape, const fs::path& folder) {
  if (shape.given)
    report::write_surfaces(folder / "surfaces.vtu", *shape.given);
  else
    report::write_surfaces(folder / "surfaces.vtu", shape.wall);
  const Mat3& axes = shape.frame.axes;
  nlohmann::ordered_json frame;
  if (shape.is_in_images)
    frame = {{origin_name, numbers(shape.frame.origin)},
             {"x_axis_in_image_space", numbers(axes.col(0))},
             {"y_axis_in_image_space", numbers(axes.col(1))},
             {"z_axis_in_image_space", numbers(axes.col(2))}};
  frame["notes"] = shape.notes;
  frame["assumed"] = json_of(shape.assumed);
  frame["warnings"] = json_of(shape.warnings);
  write_file(folder / frame_name, json_text(frame) + "\n");
  write_record(shape, folder / record_name);
  if (!shape.end_systole.empty())
    geometry::contour_table(shape.end_systole).write_csv(folder / es_contours_name);
  if (shape.segmentation)
    write_segmentation(*shape.segmentation, folder / "segmentation");
  if (!shape.quality)
    return;
  report::fit_table(shape.quality->fit).write_csv(folder / "fit.csv");
  report::quality_table(*shape.quality).write_csv(folder / "quality.csv");
  write_file(folder / "quality.json", report::quality_json(*shape.quality));
  write_file(folder / "quality.txt", report::quality_text(*shape.quality));
}

AnatomyRecord anatomy_record(const fs::path& folder) {
  const Archive archive = Archive::read(folder / record_name);
  AnatomyRecord record;
  if (!archive.get("frame").empty()) {
    const auto vectors = heartbeat::vectors(archive.get_rows("frame", 3, 4));
    record.frame.emplace().origin = vectors[0];
    record.frame->axes << vectors[1], vectors[2], vectors[3];
  }
  record.assumed = load_assumptions(archive, "assumed");
  for (geometry::Assumption& a : load_assumptions(archive, "warnings"))
    record.warnings.push_back(std::move(a.text));
  if (fs::exists(folder / es_contours_name))
    record.end_systole = geometry::read_curves(folder / es_contours_name);
  return record;
}

}  // namespace lv::anatomy
