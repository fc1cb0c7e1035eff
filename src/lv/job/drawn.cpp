#include "lv/job/drawn.hpp"

#include "lv/base/check.hpp"
#include "lv/geometry/contour_checks.hpp"
#include "lv/geometry/contour_measures.hpp"
#include "lv/geometry/fit_report.hpp"
#include "lv/image/close_walls.hpp"
#include "lv/image/dicom_study.hpp"
#include "lv/image/guide_points.hpp"
#include "lv/image/label_contours.hpp"
#include "lv/image/nifti.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace lv::job {
namespace {

namespace fs = std::filesystem;

/// A file or folder that must be named.
fs::path named(const Case& c, const std::string& parameter, const std::string& name,
               const char* what) {
  if (name.empty())
    throw InputError(place_of(c, "anatomy.source"), fmt::format("{} is not set", parameter),
                     fmt::format("Name {}", what));
  return beside(c, name);
}

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

Drawn from_csv(const Case& c) {
  Drawn drawn;
  drawn.contours = geometry::read_contours(contour_files(c));
  drawn.source = "contours";
  return drawn;
}

int chosen_frame(const Case& c, const image::Volume& volume) {
  const LabelAnatomy& a = c.anatomy.labels;
  if (a.frame > 0 || volume.frames == 1)
    return std::max(a.frame, 1) - 1;
  throw InputError(
      place_of(c, "anatomy.labels.file"),
      fmt::format("{} has {} frames and anatomy.labels.frame is not set.\n{}", volume.file,
                  volume.frames, describe_volume_curve(image::volume_curve(volume, a.cavity))),
      "Choose a frame");
}

/// A label cannot mean two things.
void check_meaning(const Case& c) {
  const LabelAnatomy& a = c.anatomy.labels;
  std::map<int, std::string> meaning;
  const auto add = [&](const std::string& parameter, std::vector<int> labels) {
    std::sort(labels.begin(), labels.end());
    labels.erase(std::unique(labels.begin(), labels.end()), labels.end());
    for (const int label : labels)
      if (const auto [other, fresh] = meaning.emplace(label, parameter); !fresh)
        throw InputError(place_of(c, parameter),
                         fmt::format("the label {} is listed under {} and under {}", label,
                                     other->second, parameter),
                         "List every label under one meaning");
  };
  add("anatomy.labels.cavity", a.cavity);
  add("anatomy.labels.muscle", a.muscle);
  add("anatomy.labels.right_ventricle", a.right_ventricle);
}

Drawn from_labels(const Case& c) {
  const LabelAnatomy& a = c.anatomy.labels;
  const fs::path file = named(c, "anatomy.labels.file", a.file, "the NIfTI label map");
  const image::Volume volume = image::read_nifti(file);
  for (const auto& [parameter, labels] :
       {std::pair("anatomy.labels.cavity", a.cavity), {"anatomy.labels.muscle", a.muscle}})
    if (labels.empty())
      throw InputError(place_of(c, "anatomy.labels.file"),
                       fmt::format("{} is not set; {} has the labels {}", parameter, volume.file,
                                   image::describe(image::label_volumes(volume))),
                       "Say which labels mean it");
  check_meaning(c);
  const int frame = chosen_frame(c, volume);
  const auto require = [&](const char* parameter, const std::vector<int>& labels) {
    image::require_labels(volume, frame, labels, place_of(c, parameter), parameter);
  };
  require("anatomy.labels.cavity", a.cavity);
  require("anatomy.labels.muscle", a.muscle);
  require("anatomy.labels.right_ventricle", a.right_ventricle);
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
  return drawn;
}

Drawn from_sunnybrook(const Case& c) {
  const SunnybrookAnatomy& a = c.anatomy.sunnybrook;
  const fs::path folder =
      named(c, "anatomy.sunnybrook.contours", a.contours, "the folder of contour files");
  const fs::path dicom = named(c, "anatomy.sunnybrook.dicom", a.dicom, "the folder of DICOM files");
  const image::DicomStack stack =
      image::choose_stack(image::read_dicom_study(std::array{dicom}), a.series, dicom.string(),
                          "anatomy.sunnybrook.series");
  image::DrawnPhases read = image::read_sunnybrook(folder, stack, a.pixel_origin, a.drawn_by);
  if (!read.phases.contains(a.phase))
    throw InputError(place_of(c, "anatomy.sunnybrook.phase"),
                     fmt::format("{}; there are contours of\n{}",
                                 a.phase == 0 ? "anatomy.sunnybrook.phase is not set"
                                              : fmt::format("there are none of phase {}", a.phase),
                                 describe_phases(read.phases)),
                     "Choose a phase, counted from 1 in order of time");
  Drawn drawn;
  drawn.contours = std::move(read.phases.at(a.phase));
  drawn.source = fmt::format("contours in pixels, phase {}", a.phase);
  drawn.usual_base = geometry::BaseAt::slab;
  drawn.notes = image::remarks(stack);
  drawn.notes.insert(drawn.notes.end(), read.notes.begin(), read.notes.end());
  return drawn;
}

Drawn from_guide_points(const Case& c) {
  const GuidePointAnatomy& a = c.anatomy.guide_points;
  image::GuidePoints read =
      image::read_guide_points(named(c, "anatomy.guide_points.file", a.file, "the list of points"),
                               a.frame < 0 ? std::nullopt : std::optional(a.frame), a.apex_point);
  Drawn drawn;
  drawn.contours = std::move(read.contours);
  drawn.source = "guide points";
  drawn.septum = read.septum;
  drawn.usual_base =
      drawn.contours.annulus.empty() ? geometry::BaseAt::slab : geometry::BaseAt::annulus;
  drawn.notes = std::move(read.notes);
  return drawn;
}

Drawn read_source(const Case& c) {
  switch (c.anatomy.source) {
    case AnatomySource::labels:
      return from_labels(c);
    case AnatomySource::sunnybrook:
      return from_sunnybrook(c);
    case AnatomySource::guide_points:
      return from_guide_points(c);
    default:
      return from_csv(c);
  }
}

/// Volume of the loops of one phase [mm^3]; 0 where it cannot be told.
double volume_of(const geometry::Contours& contours) {
  const auto endo = std::count_if(contours.short_axis.begin(), contours.short_axis.end(),
                                  [](const auto& c) { return c.side == geometry::Side::endo; });
  return endo < 2 ? 0.0 : geometry::slab_volumes(contours).cavity;
}

}  // namespace

bool is_drawn(const Case& c) {
  return c.anatomy.source != AnatomySource::ellipsoid && c.anatomy.source != AnatomySource::mesh;
}

Drawn read_drawn(const Case& c) {
  Drawn drawn = read_source(c);
  const double thinnest = c.anatomy.contours.fit.thinnest_wall;
  const bool mended = c.anatomy.source != AnatomySource::contours;
  if (mended)
    image::drop_strays(drawn.contours, drawn.notes);
  image::drop_open_base(drawn.contours, thinnest, drawn.notes);
  if (mended)
    image::close_walls(drawn.contours, thinnest, drawn.notes);
  geometry::check_contours(drawn.contours);
  return drawn;
}

std::string describe_phases(const std::map<int, geometry::Contours>& phases) {
  std::string text;
  std::vector<int> numbers;
  std::vector<double> volumes;
  for (const auto& [phase, contours] : phases) {
    const auto endo = std::count_if(contours.short_axis.begin(), contours.short_axis.end(),
                                    [](const auto& c) { return c.side == geometry::Side::endo; });
    numbers.push_back(phase);
    volumes.push_back(volume_of(contours));
    text += fmt::format("  phase {}: {} endocardial and {} epicardial loops, cavity {:.2f} ml\n",
                        phase, endo, static_cast<std::ptrdiff_t>(contours.short_axis.size()) - endo,
                        1e-3 * volumes.back());
  }
  if (std::none_of(volumes.begin(), volumes.end(), [](double v) { return v > 0.0; }))
    return text + "  proposed: none, for no phase shows the cavity on two slices";
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

}  // namespace lv::job
