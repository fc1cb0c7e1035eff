#include "lv/anatomy/drawn.hpp"

#include "lv/anatomy/named_points.hpp"
#include "lv/anatomy/proposals.hpp"
#include "lv/base/check.hpp"
#include "lv/base/units.hpp"
#include "lv/geometry/contour_checks.hpp"
#include "lv/geometry/contour_measures.hpp"
#include "lv/geometry/long_axis.hpp"
#include "lv/image/close_walls.hpp"
#include "lv/image/dicom_study.hpp"
#include "lv/image/foreign_contours.hpp"
#include "lv/image/guide_points.hpp"
#include "lv/image/label_contours.hpp"
#include "lv/image/label_meaning.hpp"
#include "lv/image/lookup.hpp"
#include "lv/image/volume_file.hpp"
#include "lv/mesh_io/cut_surfaces.hpp"
#include "lv/mesh_io/triangles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <utility>

namespace lv::anatomy {
namespace {

using case_file::Case;
namespace fs = std::filesystem;

/// A file or folder that must be named.
struct Name {
  const char* parameter;
  const std::string& said;
  const char* what;
};

/// Throws InputError unless all are.
void require_names(const Case& c, const std::vector<Name>& names) {
  case_file::Missing missing;
  for (const Name& name : names)
    if (name.said.empty())
      missing.add({name.parameter, case_file::fill_in, name.what});
  missing.raise(c, case_file::place_of(c, "anatomy.source"));
}

geometry::ContourFiles contour_files(const Case& c) {
  const case_file::ContourAnatomy& a = c.anatomy.contours;
  require_names(
      c, {{"anatomy.contours.short_axis", a.short_axis, "the CSV file of the short-axis loops"}});
  geometry::ContourFiles files{
      .short_axis = case_file::beside(c, a.short_axis), .long_axis = {}, .apex = {}};
  if (!a.long_axis.empty())
    files.long_axis = case_file::beside(c, a.long_axis);
  for (const std::string& apex : {a.apex_endo, a.apex_epi})
    if (!apex.empty())
      files.apex.push_back(case_file::beside(c, apex));
  return files;
}

/// The moment with the smallest cavity, unless it is that of the shape; none of one moment alone.
std::optional<int> other_end_systole(const Moments& m, int chosen) {
  if (m.numbers.size() < 2 || m.end_systole == chosen)
    return {};
  return m.end_systole;
}

Drawn from_csv(const Case& c) {
  Drawn drawn;
  drawn.contours = geometry::read_contours(contour_files(c));
  const std::string& es = c.anatomy.contours.es_short_axis;
  if (!es.empty())
    drawn.end_systole = geometry::read_contours({case_file::beside(c, es), {}, {}});
  drawn.source = "contours";
  return drawn;
}

/// Throws InputError unless the case says what the labels mean and, of several frames, which.
void require_choices(const Case& c, const image::Volume& map) {
  const case_file::LabelAnatomy& a = c.anatomy.labels;
  const bool frame_open = map.frames > 1 && a.frame == 0;
  if (!a.cavity.empty() && !a.muscle.empty() && !frame_open)
    return;
  case_file::Missing missing;
  for (case_file::CaseLine& line : label_lines(map, a))
    if (line.parameter != "anatomy.labels.right_ventricle")
      missing.add(std::move(line));
  std::string found = fmt::format("{} has the labels {}", map.file,
                                  image::describe(image::label_volumes(map), map.names));
  if (frame_open)
    found +=
        fmt::format(" and {} frames\n{}", map.frames,
                    describe_volume_curve(image::volume_curve(
                        map, a.cavity.empty() ? image::propose_meaning(map).cavity : a.cavity)));
  missing.raise(c, case_file::place_of(c, "anatomy.labels.file"), found);
}

/// A label cannot mean two things.
void check_meaning(const Case& c) {
  const case_file::LabelAnatomy& a = c.anatomy.labels;
  std::map<int, std::string> meaning;
  const auto add = [&](const std::string& parameter, std::vector<int> labels) {
    std::sort(labels.begin(), labels.end());
    labels.erase(std::unique(labels.begin(), labels.end()), labels.end());
    for (const int label : labels)
      if (const auto [other, fresh] = meaning.emplace(label, parameter); !fresh)
        throw InputError(case_file::place_of(c, parameter),
                         fmt::format("the label {} is listed under {} and under {}", label,
                                     other->second, parameter),
                         "List every label under one meaning");
  };
  add("anatomy.labels.cavity", a.cavity);
  add("anatomy.labels.muscle", a.muscle);
  add("anatomy.labels.right_ventricle", a.right_ventricle);
}

void warn(const char* part, const std::string& warning, Drawn& drawn) {
  if (!warning.empty())
    drawn.warnings.push_back({part, warning});
}

void warn_of_moment(const std::string& warning, Drawn& drawn) {
  warn("early diastole", warning, drawn);
}

/// Labels of which the case says nothing: a scar that is drawn by itself is muscle too.
void note_unnamed(const std::map<int, double>& found, const case_file::LabelAnatomy& a,
                  std::vector<std::string>& notes) {
  for (const auto& [label, volume] : found)
    if (label != 0 && !image::is_one_of(label, a.cavity) && !image::is_one_of(label, a.muscle) &&
        !image::is_one_of(label, a.right_ventricle))
      notes.push_back(fmt::format(
          "label {} ({:.2f} ml) is neither cavity nor muscle in the case; if it is muscle, as a "
          "scar is, add it to anatomy.labels.muscle",
          label, volume / units::ml));
}

Drawn from_labels(const Case& c) {
  const case_file::LabelAnatomy& a = c.anatomy.labels;
  require_names(c, {{"anatomy.labels.file", a.file, "the label map"}});
  const image::Volume volume = image::read_labels(case_file::beside(c, a.file));
  check_meaning(c);
  require_choices(c, volume);
  const int frame = std::max(a.frame, 1) - 1;
  const auto require = [&](const char* parameter, const std::vector<int>& labels,
                           const char* remedy) {
    image::require_labels(volume, frame, labels, case_file::place_of(c, parameter), parameter,
                          remedy);
  };
  constexpr const char* as_there = "Name the labels as this file has them";
  require("anatomy.labels.cavity", a.cavity, as_there);
  require("anatomy.labels.muscle", a.muscle, as_there);
  require("anatomy.labels.right_ventricle", a.right_ventricle,
          "Name the labels as this file has them, or leave this line out and set "
          "anatomy.contours.septum_point");
  image::LabelContours traced =
      image::trace_labels(volume, {a.cavity, a.muscle, a.right_ventricle}, frame);
  Drawn drawn;
  drawn.contours = std::move(traced.contours);
  drawn.source = fmt::format("labels, frame {}", frame + 1);
  drawn.label_cavity = traced.cavity;
  drawn.label_muscle = traced.muscle;
  drawn.septum = traced.septum;
  drawn.usual_base = geometry::BaseAt::slab;
  drawn.notes = std::move(traced.notes);
  warn("slices", traced.alike, drawn);
  warn("cut base", traced.cut_base, drawn);
  warn("scar", unsaid_scar(c, volume), drawn);
  note_unnamed(image::label_volumes(volume, frame), a, drawn.notes);
  drawn.moment_is_known = volume.frames > 1;
  const Moments moments = moments_of(volume, a.cavity);
  warn_of_moment(end_diastole_note(c, moments, frame + 1), drawn);
  if (const auto es = other_end_systole(moments, frame + 1))
    try {
      drawn.end_systole =
          image::trace_labels(volume, {a.cavity, a.muscle, a.right_ventricle}, *es - 1).contours;
    } catch (const InputError& failure) {  // they are only compared with
      drawn.notes.push_back(
          fmt::format("no contours of end-systole (frame {}): {}", *es, failure.what()));
    }
  return drawn;
}

Drawn from_sunnybrook(const Case& c) {
  const case_file::SunnybrookAnatomy& a = c.anatomy.sunnybrook;
  require_names(c, {{"anatomy.sunnybrook.contours", a.contours, "the folder of contour files"},
                    {"anatomy.sunnybrook.dicom", a.dicom, "the folder of their DICOM files"}});
  const fs::path dicom = case_file::beside(c, a.dicom);
  const image::DicomStudy study = image::read_dicom_study(std::array{dicom});
  image::require_images(study, dicom.string());
  SunnybrookChoice chosen = sunnybrook_choice(case_file::beside(c, a.contours), study, a);
  case_file::Missing missing;
  for (case_file::CaseLine& line : chosen.lines)
    missing.add(std::move(line));
  std::string found = fmt::format("{} holds{}", dicom.string(), image::choices(study));
  if (!chosen.read.phases.empty())
    found += fmt::format("\nthere are contours of\n{}", describe_phases(chosen.read.phases));
  missing.raise(c, case_file::place_of(c, "anatomy.sunnybrook.dicom"), found);
  if (!chosen.read.phases.contains(a.phase))
    throw InputError(case_file::place_of(c, "anatomy.sunnybrook.phase"),
                     fmt::format("there are none of phase {}; there are contours of\n{}", a.phase,
                                 describe_phases(chosen.read.phases)),
                     "Choose a phase, counted from 1 in order of time");
  Drawn drawn;
  drawn.source = fmt::format("contours in pixels, phase {}", a.phase);
  drawn.usual_base = geometry::BaseAt::slab;
  drawn.notes = image::remarks(chosen.stack);
  drawn.notes.insert(drawn.notes.end(), chosen.read.notes.begin(), chosen.read.notes.end());
  drawn.moment_is_known = chosen.read.phases.size() > 1;
  const Moments moments = moments_of(chosen.read.phases);
  warn_of_moment(end_diastole_note(c, moments, a.phase), drawn);
  if (const auto es = other_end_systole(moments, a.phase))
    drawn.end_systole = chosen.read.phases.at(*es);
  drawn.contours = std::move(chosen.read.phases.at(a.phase));
  return drawn;
}

Drawn from_guide_points(const Case& c) {
  const case_file::GuidePointAnatomy& a = c.anatomy.guide_points;
  require_names(c, {{"anatomy.guide_points.file", a.file, "the list of points"}});
  const fs::path file = case_file::beside(c, a.file);
  Drawn drawn;
  if (image::guide_point_frames(file).size() > 1) {
    const auto frames = image::guide_point_contours(file, a.apex_point);
    if (a.frame < 0) {
      case_file::Missing missing;
      missing.add(choice("anatomy.guide_points.frame", moments_of(frames)));
      missing.raise(c, case_file::place_of(c, "anatomy.guide_points.file"),
                    fmt::format("{} has\n{}", file.string(), describe_phases(frames, "frame")));
    }
    drawn.moment_is_known = true;
    const Moments moments = moments_of(frames);
    warn_of_moment(end_diastole_note(c, moments, a.frame), drawn);
    if (const auto es = other_end_systole(moments, a.frame))
      drawn.end_systole = frames.at(*es);
  }
  image::GuidePoints read = image::read_guide_points(
      file, a.frame < 0 ? std::nullopt : std::optional(a.frame), a.apex_point);
  drawn.contours = std::move(read.contours);
  drawn.source = "guide points";
  drawn.septum = read.septum;
  const bool base_is_shown = !drawn.contours.annulus.empty() || !drawn.contours.long_axis.empty();
  drawn.usual_base = base_is_shown ? geometry::BaseAt::annulus : geometry::BaseAt::slab;
  drawn.notes.insert(drawn.notes.end(), read.notes.begin(), read.notes.end());
  return drawn;
}

/// The images that contours were drawn on, if the case names them.
std::optional<image::DicomStack> images_of(const Case& c) {
  const case_file::ContourFileAnatomy& a = c.anatomy.contour_file;
  if (a.images.empty())
    return std::nullopt;
  const fs::path folder = case_file::beside(c, a.images);
  const image::DicomStudy study = image::read_dicom_study(std::array{folder});
  image::require_images(study, folder.string());
  return image::choose_stack(study, a.series, folder.string(), "anatomy.contour_file.series");
}

/// Throws InputError unless the case says what the file does not.
void require_said_of_contours(const Case& c, const image::ForeignContours& drawn) {
  case_file::Missing missing;
  for (case_file::CaseLine& line : contour_file_lines(drawn, c.anatomy.contour_file))
    missing.add(std::move(line));
  missing.raise(c, case_file::place_of(c, "anatomy.contour_file.file"),
                fmt::format("{} has\n{}", drawn.file, image::describe(drawn)));
}

Drawn from_contour_file(const Case& c) {
  const case_file::ContourFileAnatomy& a = c.anatomy.contour_file;
  require_names(c, {{"anatomy.contour_file.file", a.file, "the file of contours"}});
  const image::ForeignContours file = image::read_contours(case_file::beside(c, a.file));
  require_said_of_contours(c, file);
  const std::optional<image::DicomStack> images = images_of(c);
  image::DrawnPhases read =
      image::arranged(file, a.endo.empty() ? file.endo : a.endo, a.epi.empty() ? file.epi : a.epi,
                      images ? &*images : nullptr);
  const Moments moments = moments_of(read.phases);
  const std::string found = fmt::format(
      "{} has\n{}{}", file.file, describe_phases(read.phases),
      read.notes.empty() ? "" : "\n  " + fmt::format("{}", fmt::join(read.notes, "\n  ")));
  case_file::Missing missing;
  if (read.phases.size() > 1 && a.phase == 0)
    missing.add(choice("anatomy.contour_file.phase", moments));
  missing.raise(c, case_file::place_of(c, "anatomy.contour_file.file"), found);
  const int phase = a.phase == 0 ? read.phases.begin()->first : a.phase;
  if (!read.phases.contains(phase))
    throw InputError(case_file::place_of(c, "anatomy.contour_file.phase"),
                     fmt::format("there are no contours of phase {}; {}", phase, found),
                     "Choose a phase, counted from 1 in order of time");
  Drawn drawn;
  drawn.source = fmt::format("{}, phase {}", file.format, phase);
  drawn.usual_base = geometry::BaseAt::slab;
  if (images)
    drawn.notes = image::remarks(*images);
  drawn.notes.insert(drawn.notes.end(), read.notes.begin(), read.notes.end());
  const bool is_marked = read.phases.size() == 1 && file.end_diastole == phase;
  drawn.moment_is_known = read.phases.size() > 1 || is_marked;
  warn_of_moment(is_marked
                     ? end_diastole_note(c, fmt::format("time {} is end-diastole, as {} marks it",
                                                        phase, c.anatomy.contour_file.file))
                     : end_diastole_note(c, moments, phase),
                 drawn);
  drawn.contours = std::move(read.phases.at(phase));
  return drawn;
}

/// One of the two surfaces; a space that the case gives must not contradict the file's.
mesh_io::Triangles read_surface(const Case& c, const std::string& name) {
  const case_file::SurfaceAnatomy& a = c.anatomy.surfaces;
  const std::string file = case_file::beside(c, name).string();
  const std::string stated = mesh_io::stated_space(file);
  const std::string said = a.space == case_file::SurfaceSpace::RAS   ? "RAS"
                           : a.space == case_file::SurfaceSpace::LPS ? "LPS"
                                                                     : "";
  if (!said.empty() && !stated.empty() && said != stated)
    throw InputError(
        case_file::place_of(c, "anatomy.surfaces.space"),
        fmt::format("anatomy.surfaces.space is \"{}\", but {} says SPACE={}", said, file, stated),
        "Leave anatomy.surfaces.space out: the file's own word is believed");
  case_file::Missing missing;
  if (said.empty() && stated.empty())
    missing.add({"anatomy.surfaces.space", case_file::fill_in,
                 "\"LPS\" (DICOM, ITK) or \"RAS\" (3D Slicer's scene, NIfTI)"});
  if (!(a.unit > 0.0))
    missing.add({"anatomy.surfaces.length_unit", case_file::quoted("1 mm"),
                 "no such file states its unit: \"1 mm\", \"10 mm\" or \"1000 mm\""});
  missing.raise(c, case_file::place_of(c, "anatomy.surfaces.endo"),
                said.empty() && stated.empty()
                    ? fmt::format("{} does not state the space of its coordinates", file)
                    : "");
  return mesh_io::read_triangles(file, a.unit, said);
}

Drawn from_surfaces(const Case& c) {
  const case_file::SurfaceAnatomy& a = c.anatomy.surfaces;
  require_names(c, {{"anatomy.surfaces.endo", a.endo, "the surface of the endocardium"},
                    {"anatomy.surfaces.epi", a.epi, "the surface of the epicardium"}});
  mesh_io::CutSurfaces cut = mesh_io::cut_across(read_surface(c, a.endo), read_surface(c, a.epi));
  Drawn drawn;
  drawn.contours = std::move(cut.contours);
  drawn.source = "surfaces of endocardium and epicardium";
  drawn.usual_base = geometry::BaseAt::slice;
  drawn.notes = std::move(cut.notes);
  warn("cut cavity", cut.warning, drawn);
  return drawn;
}

/// Phases count from 1.
Moments moments_of(const segment::Segmentation& found) {
  Moments m;
  m.numbers.resize(found.volumes.size());
  std::iota(m.numbers.begin(), m.numbers.end(), 1);
  m.volumes = found.volumes;
  m.end_diastole = found.phases.end_diastole + 1;
  m.end_systole = found.phases.end_systole + 1;
  m.early_diastole = found.phases.early_diastole + 1;
  return m;
}

Drawn from_cine(const Case& c) {
  auto found = std::make_shared<const CineSegmentation>(segment_cine(c));
  const std::size_t frame = shape_frame(c, *found);
  Drawn drawn;
  drawn.contours = segment::contours_at(found->cine, found->found, frame);
  drawn.source = fmt::format("borders drawn by the program in a cine, phase {}", frame + 1);
  drawn.usual_base = geometry::BaseAt::slab;
  drawn.notes = found->cine.notes;
  for (const std::string& warning : found->found.warnings)
    drawn.warnings.push_back({"borders", warning});
  for (const auto* doubts : {&found->found.doubts, &found->ends.doubts})
    drawn.notes.insert(drawn.notes.end(), doubts->begin(), doubts->end());
  drawn.moment_is_known = true;
  const Moments moments = moments_of(found->found);
  const int chosen = static_cast<int>(frame) + 1;
  warn_of_moment(end_diastole_note(c, moments, chosen), drawn);
  if (const auto es = other_end_systole(moments, chosen))
    drawn.end_systole =
        segment::contours_at(found->cine, found->found, static_cast<std::size_t>(*es - 1));
  drawn.segmentation = std::move(found);
  return drawn;
}

/// The annulus and the tip that the long axes of a cine show, where no landmark names them.
void add_ends_of_long_axes(std::size_t frame, Drawn& drawn) {
  const segment::LongAxisEnds& ends = drawn.segmentation->ends;
  geometry::Contours& contours = drawn.contours;
  if (contours.annulus.empty())
    for (const segment::AnnulusPoint& point : segment::annulus_at(ends, frame)) {
      contours.annulus.push_back(point.at);
      drawn.usual_base = geometry::BaseAt::annulus;
    }
  const auto apex = segment::apex_at(ends, frame);
  if (apex && !geometry::shows_apex(contours, geometry::Side::endo)) {
    const int number = static_cast<int>(drawn.segmentation->cine.slices.size() + apex->view) + 1;
    contours.apex.push_back({number, geometry::Side::endo, {apex->at}, "the long axes", {}});
  }
}

Drawn read_source(const Case& c) {
  switch (c.anatomy.source) {
    case case_file::AnatomySource::labels:
      return from_labels(c);
    case case_file::AnatomySource::sunnybrook:
      return from_sunnybrook(c);
    case case_file::AnatomySource::guide_points:
      return from_guide_points(c);
    case case_file::AnatomySource::cine:
      return from_cine(c);
    case case_file::AnatomySource::contour_file:
      return from_contour_file(c);
    case case_file::AnatomySource::surfaces:
      return from_surfaces(c);
    default:
      return from_csv(c);
  }
}

}  // namespace

double volume_of(const geometry::Contours& contours) {
  const auto endo = std::count_if(contours.short_axis.begin(), contours.short_axis.end(),
                                  [](const auto& c) { return c.side == geometry::Side::endo; });
  return endo < 2 ? 0.0 : geometry::slab_volumes(contours).cavity;
}

Drawn read_drawn(const Case& c) {
  Drawn drawn = read_source(c);
  add_landmarks(c, drawn);
  if (drawn.segmentation)
    add_ends_of_long_axes(shape_frame(c, *drawn.segmentation), drawn);
  const double thinnest = c.anatomy.contours.fit.thinnest_wall;
  const bool mended = c.anatomy.source != case_file::AnatomySource::contours &&
                      c.anatomy.source != case_file::AnatomySource::surfaces;
  if (mended)
    image::drop_strays(drawn.contours, drawn.notes);
  image::drop_open_base(drawn.contours, drawn.notes);
  if (mended)
    image::close_walls(drawn.contours, thinnest, drawn.notes);
  geometry::check_contours(drawn.contours);
  const bool says_itself = c.anatomy.source == case_file::AnatomySource::cine ||
                           c.anatomy.source == case_file::AnatomySource::surfaces;
  if (!says_itself)
    warn("tip", geometry::hidden_tip(drawn.contours), drawn);
  for (const auto& notes :
       {geometry::notes_on_spacing(drawn.contours), geometry::notes_on_gaps(drawn.contours)})
    drawn.notes.insert(drawn.notes.end(), notes.begin(), notes.end());
  if (drawn.end_systole) {
    std::vector<std::string> of_comparison;  // says nothing of the wall
    if (mended)
      image::drop_strays(*drawn.end_systole, of_comparison);
    image::drop_open_base(*drawn.end_systole, of_comparison);
  }
  return drawn;
}

std::string describe_phases(const std::map<int, geometry::Contours>& phases,
                            const std::string& called) {
  std::string text;
  std::vector<int> numbers;
  std::vector<double> volumes;
  for (const auto& [phase, contours] : phases) {
    const auto endo = std::count_if(contours.short_axis.begin(), contours.short_axis.end(),
                                    [](const auto& c) { return c.side == geometry::Side::endo; });
    numbers.push_back(phase);
    volumes.push_back(volume_of(contours));
    text += fmt::format(
        "  {} {}: {} endocardial and {} epicardial loops, cavity {:.2f} ml\n", called, phase, endo,
        static_cast<std::ptrdiff_t>(contours.short_axis.size()) - endo, 1e-3 * volumes.back());
  }
  if (std::none_of(volumes.begin(), volumes.end(), [](double v) { return v > 0.0; }))
    return text + "  proposed: none, for none shows the cavity on two slices";
  const image::Phases p = image::propose_phases(volumes);
  return text + fmt::format("  proposed: end-diastole {}, end-systole {}", numbers[p.end_diastole],
                            numbers[p.end_systole]);
}

std::string describe_volume_curve(const std::vector<double>& volumes) {
  std::string text;
  std::size_t without = 0;
  for (std::size_t f = 0; f < volumes.size(); ++f) {
    without += volumes[f] > 0.0 ? 0 : 1;
    if (volumes[f] > 0.0)
      text += fmt::format("  frame {}: cavity {:.2f} ml\n", f + 1, 1e-3 * volumes[f]);
  }
  if (without > 0)
    text += fmt::format("  {} of {} frames show no cavity\n", without, volumes.size());
  const image::Phases p = image::propose_phases(volumes);
  if (volumes.size() - without < 2)
    return text + "  proposed: no phases, for less than two frames show the cavity";
  text += fmt::format("  proposed: end-diastole {}, end-systole {}", p.end_diastole + 1,
                      p.end_systole + 1);
  return p.early_diastole == p.end_systole
             ? text + "; no frame after it shows early diastole"
             : text + fmt::format(", early diastole {}", p.early_diastole + 1);
}

}  // namespace lv::anatomy
