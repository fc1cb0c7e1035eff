#include "lv/proposal/propose_case.hpp"

#include "lv/anatomy/drawn.hpp"
#include "lv/anatomy/proposals.hpp"
#include "lv/base/check.hpp"
#include "lv/base/ending.hpp"
#include "lv/base/files.hpp"
#include "lv/base/formats.hpp"
#include "lv/base/lines.hpp"
#include "lv/base/units.hpp"
#include "lv/geometry/contours.hpp"
#include "lv/image/dicom_file.hpp"
#include "lv/image/dicom_segmentation.hpp"
#include "lv/image/foreign_contours.hpp"
#include "lv/image/guide_points.hpp"
#include "lv/image/label_meaning.hpp"
#include "lv/image/volume_file.hpp"
#include "lv/mesh_io/import.hpp"
#include "lv/mesh_io/triangles.hpp"
#include "lv/proposal/what_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace lv::proposal {
namespace {

using case_file::CaseLine;
namespace fs = std::filesystem;

constexpr const char* septum_comment =
    "a point of the middle of the septum: without it regions may bear wrong names";

bool has_ending(const fs::path& file, std::initializer_list<const char*> endings) {
  const std::string ending = ending_of(file);
  return std::find(endings.begin(), endings.end(), ending) != endings.end();
}

/// The first line of a text, in small letters; empty for other files.
std::string first_line(const fs::path& file) {
  LineReader lines(file, Columns::any);
  return lines.is_open() && lines.next() ? lower_case(std::string(lines.text())) : "";
}

CaseLine septum_line() {
  return {"anatomy.contours.septum_point", R"(["0 mm", "0 mm", "0 mm"])", septum_comment, false};
}

CaseLine source_line(const char* source, const std::string& comment = "") {
  return {"anatomy.source", case_file::quoted(source), comment};
}

/// The pressures, which no image shows; left out, so that a run names its defaults as assumed.
std::vector<CaseLine> pressure_lines() {
  const heartbeat::Protocol p;
  const auto line = [](const char* parameter, double pressure) {
    return CaseLine{parameter, case_file::quoted(fmt::format("{:g} mmHg", pressure / units::mmHg)),
                    "assumed unless the person's own stands here", false};
  };
  return {line("protocol.ed_pressure", p.ed_pressure),
          line("protocol.es_pressure", p.es_pressure),
          {"protocol.cuff_systolic", case_file::quoted("120 mmHg"),
           "of a cuff on the arm, in place of es_pressure", false}};
}

/// A fit to the volumes that the source shows, to be uncommented.
std::vector<CaseLine> calibration_lines(const anatomy::Moments& m) {
  const CaseLine klotz{"calibrate.passive", case_file::quoted("klotz"),
                       "fit the stiffness to Klotz's curve through this shape and its pressure",
                       false};
  if (m.numbers.size() < 2)
    return {klotz};
  const auto ml = [&](int number) {
    return case_file::quoted(fmt::format("{:.1f} ml", 1e-3 * m.volume(number)));
  };
  std::vector<CaseLine> lines;
  if (m.early_diastole) {
    lines.push_back({"calibrate.passive", case_file::quoted("C_a"),
                     "fit the stiffness to these volumes", false});
    lines.push_back({"calibrate.edv", ml(m.end_diastole), "", false});
  } else {
    lines.push_back(klotz);
  }
  lines.push_back({"calibrate.active", "true", "fit the contractility", false});
  lines.push_back({"calibrate.esv", ml(m.end_systole), "", false});
  return lines;
}

/// The lines that belong to a moment of the beat: of a loaded shape, and of the volumes.
std::vector<CaseLine> lines_of_moment(const anatomy::Moments& m) {
  std::vector<CaseLine> lines;
  if (m.numbers.size() > 1 && !m.early_diastole)
    lines.push_back(
        anatomy::unloading_line("the shape is that of end-diastole and bears this pressure"));
  if (m.numbers.size() < 2)
    lines.push_back(anatomy::unloading_line(
        "taken for end-diastole, at which single shapes are drawn mostly; leave "
        "this line out for early diastole"));
  const auto fit = calibration_lines(m);
  lines.insert(lines.end(), fit.begin(), fit.end());
  return lines;
}

void append(std::vector<CaseLine>& lines, const std::vector<CaseLine>& more) {
  lines.insert(lines.end(), more.begin(), more.end());
}

/// A cine on which nothing is drawn yet, in which the program draws the borders.
std::vector<CaseLine> cine_lines(const std::string& name) {
  return {source_line("cine",
                      "borders drawn by the program: look at them with `ventricle segment`, "
                      "correct them with `ventricle draw`; or name what was drawn elsewhere"),
          {"segment.cine", case_file::quoted(name), ""}};
}

/// Strain from images, to be uncommented.
std::vector<CaseLine> strain_lines(const std::string& name) {
  return {{"strain.cine", case_file::quoted(name), "strain from these images", false},
          {"strain.contours", case_file::fill_in, "loops drawn at end-diastole", false}};
}

/// Grey values of one moment show no wall: it must be drawn first.
Proposal of_grey_image(const image::Volume& image, const std::string& name) {
  if (image.frames > 1) {
    Proposal p{fmt::format("{}: an image over time, no labels", image.file), cine_lines(name)};
    append(p.lines, strain_lines(name));
    return p;
  }
  return {
      fmt::format("{}: an image, no labels", image.file),
      {source_line("labels", "or contours, guide_points, mesh: what was drawn on the images"),
       {"anatomy.labels.file", case_file::fill_in,
        "the label map, drawn on these images elsewhere"},
       {"anatomy.labels.cavity", case_file::fill_in, "its labels of the left ventricle's blood"},
       {"anatomy.labels.muscle", case_file::fill_in, "its labels of the left ventricle's muscle"},
       {"infarct.source", case_file::quoted("lge"), "if it is late enhancement", false},
       {"infarct.lge.image", case_file::quoted(name), "", false},
       {"infarct.lge.remote", case_file::fill_in, "AHA segments of healthy muscle", false}}};
}

Proposal of_volume(const fs::path& source, const std::string& name) {
  const image::Volume map = image::read_labels(source);
  if (!image::seems_labels(map))
    return of_grey_image(map, name);
  Proposal p{fmt::format("{}: a label map of {} frame{}", map.file, map.frames,
                         map.frames == 1 ? "" : "s"),
             {source_line("labels"), {"anatomy.labels.file", case_file::quoted(name), ""}}};
  append(p.lines, anatomy::label_lines(map, {}));
  const image::LabelMeaning seen = image::propose_meaning(map);
  if (seen.right_ventricle.empty())
    p.lines.push_back(septum_line());
  const anatomy::Moments moments = anatomy::moments_of(map, seen.cavity);
  const int frame = moments.early_diastole.value_or(std::max(moments.end_diastole, 1));
  append(p.lines, anatomy::scar_lines(map, name, seen.muscle, frame));
  append(p.lines, lines_of_moment(moments));
  return p;
}

Proposal of_contours(const fs::path& source, const std::string& name) {
  const geometry::Contours drawn = geometry::read_contours({source, {}, {}});
  Proposal p{
      fmt::format("{}: short-axis contours, {} loops", source.string(), drawn.short_axis.size()),
      {source_line("contours"), {"anatomy.contours.short_axis", case_file::quoted(name), ""}}};
  constexpr std::string_view shown = "short_axis";
  for (const char* other : {"long_axis", "apex_endo", "apex_epi"}) {
    const auto beside = [&](std::string text) {
      if (const auto at = text.rfind(shown); at != std::string::npos)
        text.replace(at, shown.size(), other);
      return text;
    };
    const std::string file = source.filename().string();
    if (beside(file) != file && fs::is_regular_file(source.parent_path() / beside(file)))
      p.lines.push_back({fmt::format("anatomy.contours.{}", other),
                         case_file::quoted((fs::path(name).parent_path() / beside(file)).string()),
                         "beside it"});
  }
  p.lines.push_back(septum_line());
  append(p.lines, lines_of_moment({}));
  return p;
}

Proposal of_guide_points(const fs::path& source, const std::string& name) {
  const auto frames = image::guide_point_contours(source, geometry::Side::epi);
  Proposal p{
      fmt::format("{}: guide points\n{}", source.string(),
                  anatomy::describe_phases(frames, "frame")),
      {source_line("guide_points"), {"anatomy.guide_points.file", case_file::quoted(name), ""}}};
  const anatomy::Moments m = anatomy::moments_of(frames);
  if (image::guide_point_frames(source).size() > 1)
    p.lines.push_back(choice("anatomy.guide_points.frame", m));
  append(p.lines, lines_of_moment(m));
  return p;
}

Proposal of_contour_file(const fs::path& source, const std::string& name) {
  const image::ForeignContours drawn = image::read_contours(source);
  Proposal p{
      fmt::format("{}: {}\n{}", source.string(), drawn.format, image::describe(drawn)),
      {source_line("contour_file"), {"anatomy.contour_file.file", case_file::quoted(name), ""}}};
  for (const std::string& note : drawn.notes)
    p.what += fmt::format("  note: {}\n", note);
  append(p.lines, anatomy::contour_file_lines(drawn, {}));
  anatomy::Moments moments;
  if (!drawn.endo.empty() && !drawn.in_pixels) {
    const image::DrawnPhases read = image::arranged(drawn, drawn.endo, drawn.epi, nullptr);
    p.what += anatomy::describe_phases(read.phases);
    moments = anatomy::moments_of(read.phases);
    if (read.phases.size() > 1)
      p.lines.push_back(choice("anatomy.contour_file.phase", moments));
  }
  p.lines.push_back(septum_line());
  append(p.lines, lines_of_moment(moments));
  return p;
}

/// What a surface is: size in its own unit, and the space that it states.
std::string describe_surface(const fs::path& source, const std::string& space) {
  const mesh_io::Triangles t = mesh_io::read_triangles(source.string(), 1.0, "LPS");
  Eigen::AlignedBox3d box;
  for (const Vec3& x : t.nodes)
    box.extend(x);
  const Vec3 size = box.sizes();
  return fmt::format(
      "{}: a surface of {} triangles, {:.4g} x {:.4g} x {:.4g} in its unit, which it does not "
      "state; coordinates in {}",
      source.string(), t.faces.size(), size.x(), size.y(), size.z(),
      space.empty() ? "a space that it does not state" : space);
}

/// A surface may be a side of the wall, or enclose an infarct: the lines are left to uncomment.
Proposal of_surface(const fs::path& source, const std::string& name) {
  if (has_ending(source, {".vti"}))
    return {fmt::format("{}: a labelled volume, which can show an infarct", source.string()),
            {{"infarct.source", case_file::quoted("labels"), ""},
             {"infarct.labels.file", case_file::quoted(name), ""}}};
  const std::string space = mesh_io::stated_space(source.string());
  Proposal p{describe_surface(source, space), {}};
  p.lines = {
      {"anatomy.source", case_file::quoted("surfaces"), "if it is a side of the wall", false},
      {"anatomy.surfaces.endo", case_file::quoted(name), "if it is the endocardium", false},
      {"anatomy.surfaces.epi", case_file::quoted(name), "if it is the epicardium", false},
      {"anatomy.surfaces.length_unit", case_file::fill_in, "\"1 mm\", \"10 mm\" or \"1000 mm\"",
       false}};
  if (space.empty())
    p.lines.push_back({"anatomy.surfaces.space", case_file::fill_in, "\"LPS\" or \"RAS\"", false});
  append(p.lines,
         {{"infarct.source", case_file::quoted("surface"), "if it encloses an infarct", false},
          {"infarct.surface.file", case_file::quoted(name), "", false}});
  return p;
}

/// The series with a name of late enhancement.
const image::DicomStack* late_enhancement(const image::DicomStudy& study) {
  constexpr std::array names{"late", "lge", "psir", "delayed", "enhanc", "viab", "tfi_de", "_de_"};
  const auto is_named = [&](const std::string& description) {
    return std::any_of(names.begin(), names.end(), [&](const char* name) {
      return description.find(name) != std::string::npos;
    });
  };
  for (const image::DicomStack& stack : study.stacks)
    if (stack.slices.size() > 2 && stack.slices.front().images.size() == 1 &&
        is_named(lower_case(stack.description)))
      return &stack;
  return nullptr;
}

std::vector<CaseLine> lines_without_contours(const image::DicomStudy& study,
                                             const std::string& name,
                                             const image::DicomStack* cine) {
  if (cine == nullptr)
    return {
        source_line("sunnybrook", "or what else was drawn on the images"),
        {"anatomy.sunnybrook.dicom", case_file::quoted(name), ""},
        {"anatomy.sunnybrook.contours", case_file::fill_in, "the folder of contours drawn on it"},
        {"anatomy.sunnybrook.phase", "0", "0: `ventricle validate` lists what there is"}};
  std::vector<CaseLine> lines = cine_lines(name);
  lines.push_back({"segment.series", case_file::quoted(cine->key), "seems the short-axis cine"});
  append(lines, anatomy::long_axis_lines("segment.long_axis_cine", study, *cine));
  return lines;
}

std::vector<CaseLine> lines_with_contours(const image::DicomStudy& study, const std::string& name,
                                          const fs::path& contours,
                                          const std::string& contours_name) {
  std::vector<CaseLine> lines{
      source_line("sunnybrook"),
      {"anatomy.sunnybrook.dicom", case_file::quoted(name), ""},
      {"anatomy.sunnybrook.contours", case_file::quoted(contours_name), ""}};
  const anatomy::SunnybrookChoice chosen = anatomy::sunnybrook_choice(contours, study, {});
  append(lines, chosen.lines);
  append(lines, lines_of_moment(anatomy::moments_of(chosen.read.phases)));
  return lines;
}

/// Reads a mesh with the first unit in which it has the size of a ventricle. Throws InputError of
/// the first where there is none.
mesh_io::ImportedMesh in_some_unit(mesh::ImportParameters& parameters) {
  std::exception_ptr first;
  for (const double unit : {1.0, 10.0, 1000.0, 0.001}) {
    parameters.unit = unit;
    try {
      return mesh_io::import_mesh(parameters);
    } catch (const InputError&) {
      first = first ? first : std::current_exception();
    }
  }
  std::rethrow_exception(first);
}

/// With the sides named by tags if the file has those of the defaults, else found by geometry.
mesh_io::ImportedMesh read_mesh(mesh::ImportParameters& parameters) {
  try {
    return in_some_unit(parameters);
  } catch (const InputError& with_tags) {
    parameters.sides = mesh::SideSource::geometry;
    try {
      return in_some_unit(parameters);
    } catch (const InputError&) {
      throw with_tags;
    }
  }
}

/// What the file has of an infarct that is not read by itself.
std::vector<CaseLine> infarct_lines(const mesh_io::UnreadInfarct& unread) {
  constexpr const char* by_name = "seems the infarct by its name";
  if (unread.at_points)
    return {{"anatomy.mesh.infarct_array", case_file::quoted(unread.name), by_name}};
  return {{"infarct.source", case_file::quoted("elements"), ""},
          {"infarct.elements.set", case_file::quoted(unread.name), by_name}};
}

Proposal of_mesh_file(const fs::path& source, const std::string& name) {
  mesh::ImportParameters parameters;
  parameters.file = source.string();
  const mesh_io::ImportedMesh read = read_mesh(parameters);
  Proposal p{
      fmt::format("{}: a mesh of {} {} and {} nodes", source.string(), read.mesh.cell_count(),
                  read.mesh.kind == mesh::CellKind::hexahedron ? "hexahedra" : "tetrahedra",
                  read.mesh.nodes.size()),
      {source_line("mesh"), {"anatomy.mesh.file", case_file::quoted(name), ""}}};
  if (parameters.unit != 1.0)
    p.lines.push_back({"anatomy.mesh.length_unit",
                       case_file::quoted(fmt::format("{:g} mm", parameters.unit)),
                       "in which it has the size of a ventricle"});
  if (parameters.sides == mesh::SideSource::geometry)
    p.lines.push_back({"anatomy.mesh.sides", case_file::quoted("geometry"),
                       "the file has no tags endo, epi and base"});
  if (read.unread)
    append(p.lines, infarct_lines(*read.unread));
  p.lines.push_back(
      {"regions.septum_angle", case_file::quoted("0 deg"),
       "direction of the middle of the septum: without it regions may bear wrong names", false});
  append(p.lines, lines_of_moment({}));
  return p;
}

}  // namespace

SourceKind kind_of(const fs::path& source) {
  std::error_code failed;
  if (fs::is_directory(source, failed))
    return image::has_sunnybrook_names(source) ? SourceKind::sunnybrook : SourceKind::dicom;
  require_readable(source, "Name a folder or a file");
  if (image::is_volume_name(source) || image::holds_volume(source))
    return SourceKind::volume;
  if (has_ending(source, {".inp", ".msh", ".vtk", ".vtu"}))
    return SourceKind::mesh;
  if (has_ending(source, {".stl", ".ply", ".obj", ".vtp", ".vti"}))
    return SourceKind::surface;
  if (has_ending(source, {".toml"}))
    return SourceKind::case_file;
  if (image::holds_dicom_segmentation(source))
    return SourceKind::volume;
  if (image::holds_contours(source))
    return SourceKind::contour_file;
  if (image::looks_like_dicom(source))
    return SourceKind::dicom;
  const std::string line = begins_as_text(source) ? first_line(source) : "";
  if (line.find("type") != std::string::npos && line.find('x') != std::string::npos)
    return SourceKind::guide_points;
  if (line.find("x_mm") != std::string::npos && line.find("contour") != std::string::npos)
    return SourceKind::contours;
  throw InputError(source.string(), fmt::format("is {}", what_is(source)), formats::sources);
}

Proposal propose(const image::DicomStudy& study, const std::string& name, const fs::path& contours,
                 const std::string& contours_name) {
  const image::DicomStack* cine = anatomy::short_axis_cine(study);
  Proposal p{image::describe(study),
             contours.empty() ? lines_without_contours(study, name, cine)
                              : lines_with_contours(study, name, contours, contours_name)};
  p.lines.push_back(septum_line());
  if (cine != nullptr) {
    append(p.lines, strain_lines(name));
    p.lines.push_back({"strain.series", case_file::quoted(cine->key), "", false});
  }
  if (const image::DicomStack* scar = late_enhancement(study); scar != nullptr)
    append(p.lines,
           {{"infarct.source", case_file::quoted("lge"), "", false},
            {"infarct.lge.image", case_file::quoted(name), "", false},
            {"infarct.lge.series", fmt::format("[{}]", case_file::quoted(scar->key)), "", false},
            {"infarct.lge.remote", case_file::fill_in, "AHA segments of healthy muscle", false}});
  return p;
}

/// A folder of contours, with the images they were drawn on if those are below it too.
static Proposal propose_contours(const fs::path& source, const std::string& name) {
  const image::DicomStudy study = image::read_dicom_study(std::array{source});
  if (!study.stacks.empty())
    return propose(study, name, source, name);
  return {fmt::format("{}: contours in pixels (Sunnybrook)", source.string()),
          {source_line("sunnybrook"),
           {"anatomy.sunnybrook.contours", case_file::quoted(name), ""},
           {"anatomy.sunnybrook.dicom", case_file::fill_in,
            "the folder of the images they were drawn on"},
           {"anatomy.sunnybrook.phase", "0", "0: `ventricle validate` lists what there is"},
           septum_line()}};
}

Proposal propose(const fs::path& source, const std::string& name) {
  switch (kind_of(source)) {
    case SourceKind::volume:
      return of_volume(source, name);
    case SourceKind::dicom: {
      const image::DicomStudy study = image::read_dicom_study(std::array{source});
      image::require_images(study, source.string());
      return propose(study, name);
    }
    case SourceKind::sunnybrook:
      return propose_contours(source, name);
    case SourceKind::contours:
      return of_contours(source, name);
    case SourceKind::guide_points:
      return of_guide_points(source, name);
    case SourceKind::mesh:
      return of_mesh_file(source, name);
    case SourceKind::contour_file:
      return of_contour_file(source, name);
    case SourceKind::surface:
      return of_surface(source, name);
    case SourceKind::case_file:
      return {fmt::format("{}: a case file; see `ventricle validate`", source.string()), {}};
  }
  return {};
}

std::string proposed_case(const fs::path& source, const fs::path& file) {
  const SourceKind kind = kind_of(source);
  if (kind == SourceKind::case_file)
    throw InputError(source.string(), "shows no wall of a ventricle", formats::sources);
  if (kind == SourceKind::surface)
    throw InputError(source.string(), "is one surface, and a wall has two",
                     "`ventricle images` shows the lines by which a case names both "
                     "(anatomy.surfaces), or one that encloses an infarct");
  const std::string name =
      fs::proximate(fs::absolute(source).lexically_normal(), fs::absolute(file).parent_path())
          .string();
  Proposal p = propose(source, name);
  append(p.lines, pressure_lines());
  return fmt::format(
             "# A case of ventricle, proposed from {}: check what it says. Every quantity\n"
             "# carries its unit; what is not set has its default (`ventricle parameters`).\n"
             "# \"FILL IN\" stands for what only you know; lines behind # may be uncommented.\n\n",
             name) +
         case_file::first_lines(file.stem().string()) + "\n" + case_file::case_lines(p.lines);
}

}  // namespace lv::proposal
