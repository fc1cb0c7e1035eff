#include "lv/cine/cine.hpp"

#include "lv/anatomy/long_axis_cine.hpp"
#include "lv/anatomy/named_points.hpp"
#include "lv/anatomy/proposals.hpp"
#include "lv/base/check.hpp"
#include "lv/case_file/case_lines.hpp"
#include "lv/case_file/parameters.hpp"
#include "lv/geometry/contour_checks.hpp"
#include "lv/geometry/contour_measures.hpp"
#include "lv/geometry/long_axis.hpp"
#include "lv/geometry/spline_wall.hpp"
#include "lv/image/close_walls.hpp"
#include "lv/image/dicom_study.hpp"
#include "lv/image/sunnybrook.hpp"
#include "lv/image/volume.hpp"
#include "lv/image/volume_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <system_error>

namespace lv::cine {
namespace {

using case_file::Case;
using geometry::Contour;
using geometry::Side;

image::DicomStack choose(const Case& c, const image::DicomStudy& dicom, const std::string& series,
                         const std::string& parameter) {
  std::vector<std::string> names;
  if (!series.empty())
    names.push_back(series);
  return image::choose_stack(dicom, names, case_file::beside(c, c.strain.cine).string(), parameter);
}

/// Loops in the Sunnybrook form: of the phase that is followed, and of end-systole if that is said.
void read_sunnybrook(const Case& c, const image::DicomStack& stack, CineStudy& study) {
  constexpr double thinnest_wall = 2.0;  // of loops that cross [mm]
  const std::filesystem::path folder = case_file::beside(c, c.strain.contours);
  image::DrawnPhases drawn =
      image::read_sunnybrook(folder, stack, image::PixelOrigin::corner, image::DrawnBy::manual);
  study.notes.insert(study.notes.end(), drawn.notes.begin(), drawn.notes.end());
  const auto diastole = drawn.phases.find(c.strain.end_diastole);
  if (diastole == drawn.phases.end())
    throw InputError(folder.string(),
                     fmt::format("no contours are drawn on images number {} of the slices",
                                 c.strain.end_diastole),
                     "Set strain.end_diastole to the number, in order of time, of those that are");
  study.drawn = diastole->second;
  if (!c.strain.long_axis.empty())
    study.drawn.long_axis = geometry::read_curves(case_file::beside(c, c.strain.long_axis));
  image::drop_strays(study.drawn, study.notes);
  image::close_walls(study.drawn, thinnest_wall, study.notes);
  geometry::check_contours(study.drawn);
  if (const auto systole = drawn.phases.find(c.strain.end_systole); systole != drawn.phases.end())
    study.systolic = systole->second.short_axis;
}

geometry::Contours read_drawn(const Case& c, const std::string& parameter,
                              const std::string& file) {
  geometry::ContourFiles files{
      .short_axis = case_file::beside(c, file), .long_axis = {}, .apex = {}};
  if (!c.strain.long_axis.empty() && parameter == "strain.contours")
    files.long_axis = case_file::beside(c, c.strain.long_axis);
  return geometry::read_contours(files);
}

/// Throws InputError for all that [strain] does not name and must.
void require_said_of_strain(const Case& c, const std::optional<image::DicomStudy>& dicom) {
  const case_file::StrainStudy& s = c.strain;
  case_file::Missing missing;
  std::string found;
  if (dicom && s.series.empty() && dicom->stacks.size() > 1) {
    missing.add(anatomy::short_axis_line("strain.series", *dicom));
    found =
        fmt::format("{} holds{}", case_file::beside(c, s.cine).string(), image::choices(*dicom));
  }
  if (s.contours.empty())
    missing.add({"strain.contours", case_file::fill_in,
                 "the CSV file of the short-axis loops drawn at end-diastole, or their folder"});
  if (!s.long_axis_cine.empty() && s.long_axis.empty())
    missing.add({"strain.long_axis", case_file::fill_in,
                 "the CSV file of the curves drawn on long_axis_cine at end-diastole"});
  missing.raise(c, case_file::place_of(c, "strain.cine"), found);
}

void check_inside(const Contour& line, const image::CineSlice& slice) {
  const image::Plane& plane = slice.frames.front().plane;
  for (const Vec3& x : line.points) {
    const Vec3 ij = plane.pixel(x);
    if (!(ij.x() >= -0.5 && ij.y() >= -0.5 && ij.x() <= plane.columns - 0.5 &&
          ij.y() <= plane.rows - 0.5))
      throw InputError(
          line.where(),
          fmt::format("{}: the point ({:.1f}, {:.1f}, {:.1f}) mm lies outside the image of {}",
                      geometry::label(line), x.x(), x.y(), x.z(), slice.name),
          "Give the contours that were drawn on these images, in scanner coordinates");
  }
}

/// A long-axis cine with the curves that lie on it.
LongAxisView read_view(const Case& c, const std::optional<image::DicomStudy>& dicom,
                       const std::string& name, const std::vector<Contour>& curves) {
  constexpr double farthest = 1.0;  // [mm]
  LongAxisView view;
  view.cine = anatomy::read_long_axis_cine(
      c, {"strain.long_axis_cine", "strain.cine", c.strain.cine}, dicom, name);
  (void)drawn_frame(c, view.cine.slices.front());
  const image::Plane& plane = view.cine.slices.front().frames.front().plane;
  const auto lies_on = [&](const Contour& curve) {
    return std::all_of(curve.points.begin(), curve.points.end(),
                       [&](const Vec3& x) { return std::abs(plane.pixel(x).z()) < farthest; });
  };
  for (const Contour& curve : curves)
    if (lies_on(curve))
      (curve.side == Side::endo ? view.endo : view.epi) = curve;
  if (view.endo.points.empty() || view.epi.points.empty())
    throw InputError(case_file::place_of(c, "strain.long_axis_cine"),
                     fmt::format("no curves of endocardium and epicardium lie on \"{}\"", name),
                     "Give the curves drawn on it at end-diastole in strain.long_axis");
  for (const Contour* curve : {&view.endo, &view.epi})
    check_inside(*curve, view.cine.slices.front());
  return view;
}

/// The slice whose plane holds a loop.
std::size_t slice_with(const image::Cine& cine, const Contour& loop) {
  constexpr double farthest = 1.0;  // [mm]
  const Vec3 middle = geometry::mean_of(loop.points);
  const std::size_t best = image::nearest_slice(cine, middle);
  const double least = std::abs(cine.slices[best].frames.front().plane.pixel(middle).z());
  if (least > farthest)
    throw InputError(loop.where(),
                     fmt::format("{} lies {:.1f} mm from the nearest image of the cine",
                                 geometry::label(loop), least),
                     "Give the contours that were drawn on these images, and all their slices");
  check_inside(loop, cine.slices[best]);
  return best;
}

[[noreturn]] void refuse_septum(const Case& c, const std::string& parameter,
                                const std::string& what) {
  throw InputError(case_file::place_of(c, parameter),
                   fmt::format("{} {}: no point of the septum", parameter, what),
                   "Give a point of the septum, in the coordinates of the images in mm");
}

/// Throws InputError for strain.septum_point far from all loops. Whether that of the anatomy lies
/// on its wall is the anatomy's to judge; here its direction counts.
void check_near_contours(const Case& c, const Vec3& septum, const CineStudy& study) {
  constexpr double most = 40.0;  // [mm]; the septum is a part of their wall
  double nearest = std::numeric_limits<double>::infinity();
  for (const Contour& loop : study.drawn.short_axis)
    for (const Vec3& x : loop.points)
      nearest = std::min(nearest, (x - septum).norm());
  if (nearest > most)
    refuse_septum(c, "strain.septum_point",
                  fmt::format("lies {:.0f} mm from the contours", nearest));
}

/// Throws InputError for a point so near to the axis that it shows no direction.
void check_off_axis(const Case& c, const std::string& parameter, const Vec3& septum,
                    const geometry::LongAxis& axis, const CineStudy& study) {
  constexpr double least = 0.25;  // of the basal cavity's radius
  const Vec3 from_axis = septum - axis.point;
  const double off = (from_axis - from_axis.dot(axis.up) * axis.up).norm();
  const int basal = geometry::slices_from_base(study.drawn).front();
  const Contour* cavity = geometry::find(study.drawn.short_axis, basal, Side::endo);
  if (off < least * geometry::mean_radius(*cavity))
    refuse_septum(c, parameter, fmt::format("lies {:.1f} mm from the long axis", off));
}

/// The direction about the long axis that sectors are counted from.
Vec3 septum_point(const Case& c, const geometry::LongAxis& axis, CineStudy& study) {
  const auto& own = c.strain.septum_point;
  const auto& anatomy = c.anatomy.contours.fit.frame.septum;
  if (own || anatomy) {
    Vec3 septum((own ? own : anatomy)->data());
    if (own)
      check_near_contours(c, septum, study);
    check_off_axis(c, own ? "strain.septum_point" : "anatomy.contours.septum_point", septum, axis,
                   study);
    return septum;
  }
  if (const auto named = anatomy::named_septum(c, study.drawn, study.notes))
    return *named;
  study.notes.emplace_back(
      "the septum is assumed towards the patient's right: sectors bear the wrong names if it is "
      "elsewhere (set strain.septum_point)");
  const Vec3 right = -Vec3::UnitX();
  return axis.point + 30.0 * (right - right.dot(axis.up) * axis.up).normalized();
}

strain::Orientation orientation(const Case& c, CineStudy& study) {
  const geometry::LongAxis axis = geometry::long_axis(study.drawn);
  strain::Orientation o;
  o.up = axis.up;
  const int basal = geometry::slices_from_base(study.drawn).front();
  o.base = geometry::mean_of(geometry::find(study.drawn.short_axis, basal, Side::endo)->points) +
           0.5 * study.spacing * axis.up;
  o.apex = geometry::endo_apex(study.drawn);
  o.septum = septum_point(c, axis, study);
  return o;
}

/// Muscle is followed from slice to slice: their pixels must lie one above the other.
void check_stack(const Case& c, const CineStudy& study) {
  constexpr double same = 0.01;  // [pixel]
  const image::CineSlice& first = study.cine.slices[study.slice_of.front()];
  const image::Plane& plane = first.frames.front().plane;
  for (const std::size_t s : study.slice_of) {
    const image::CineSlice& slice = study.cine.slices[s];
    const image::Plane& other = slice.frames.front().plane;
    const Vec3 origin = plane.pixel(other.origin);
    const Vec3 end = plane.pixel(other.point(plane.columns - 1, plane.rows - 1));
    const strain::Vec2 corner(plane.columns - 1, plane.rows - 1);
    if (other.columns != plane.columns || other.rows != plane.rows ||
        origin.head<2>().norm() > same || (end.head<2>() - corner).norm() > same)
      throw InputError(
          case_file::place_of(c, "strain.long_axis_cine"),
          fmt::format("the pixels of {} do not lie above those of {}", slice.name, first.name),
          "Leave strain.long_axis_cine out, or give slices of one stack");
  }
}

/// How the slices have to move in their planes to agree with the long axes.
std::map<int, Vec3> breath_hold_shifts(const Case& c, const CineStudy& study) {
  geometry::SplineFitParameters fit = c.anatomy.contours.fit;
  fit.frame.base_at = geometry::BaseAt::slice;
  const Vec3& septum = study.orientation.septum;
  fit.frame.septum = {septum.x(), septum.y(), septum.z()};
  const std::vector<int> slices = geometry::slices_from_base(study.drawn);
  const std::vector<Vec3> shifts = geometry::slice_shifts(study.drawn, fit);
  std::map<int, Vec3> shift_of;
  for (std::size_t k = 0; k < slices.size(); ++k)
    shift_of[slices[k]] = shifts[k];
  return shift_of;
}

}  // namespace

std::size_t drawn_frame(const Case& c, const image::CineSlice& slice) {
  const int phase = c.strain.end_diastole;
  if (phase > static_cast<int>(slice.frames.size()))
    throw InputError(case_file::place_of(c, "strain.end_diastole"),
                     fmt::format("strain.end_diastole is {}, but {} has {} images", phase,
                                 slice.name, slice.frames.size()),
                     "Give the number, in order of time, of the images with the contours");
  return static_cast<std::size_t>(phase - 1);
}

CineStudy read_cine_study(const Case& c) {
  CineStudy study;
  std::optional<image::DicomStudy> dicom;
  std::optional<image::DicomStack> stack;
  if (!image::is_volume_name(c.strain.cine)) {
    const std::array<std::filesystem::path, 1> where{case_file::beside(c, c.strain.cine)};
    dicom = image::read_dicom_study(where);
    require_said_of_strain(c, dicom);
    stack = choose(c, *dicom, c.strain.series, "strain.series");
  } else if (!c.strain.series.empty()) {
    throw InputError(case_file::place_of(c, "strain.series"),
                     fmt::format("a single file has no series \"{}\"", c.strain.series),
                     "Leave strain.series out, or name a folder of DICOM files");
  }
  require_said_of_strain(c, {});
  study.cine = stack ? image::read_pixels(*stack)
                     : image::read_volume_cine(case_file::beside(c, c.strain.cine));
  study.notes = study.cine.notes;
  study.spacing = image::spacing_of(study.cine);
  std::error_code failed;
  if (stack && std::filesystem::is_directory(case_file::beside(c, c.strain.contours), failed))
    read_sunnybrook(c, *stack, study);
  else
    study.drawn = read_drawn(c, "strain.contours", c.strain.contours);
  for (const Contour& loop : study.drawn.short_axis)
    study.slice_of.push_back(slice_with(study.cine, loop));
  if (!c.strain.es_contours.empty())
    study.systolic = read_drawn(c, "strain.es_contours", c.strain.es_contours).short_axis;
  study.orientation = orientation(c, study);
  for (const std::string& name : c.strain.long_axis_cine)
    study.long_axis.push_back(read_view(c, dicom, name, study.drawn.long_axis));
  if (!study.long_axis.empty()) {
    check_stack(c, study);
    study.shift_of = breath_hold_shifts(c, study);
  }
  const NamesAlone names =
      case_file::names_alone(c);  // notes may name files: they are kept and shown
  for (std::string& note : study.notes)
    note = names(note);
  return study;
}

namespace {

/// What is followed is a number of images, as many in every slice.
void check_images(const Case& c, const std::vector<strain::SliceTask>& tasks) {
  const image::CineSlice& first = *tasks.front().cine;
  const std::size_t images = first.frames.size();
  if (images < 2)
    throw InputError(
        case_file::place_of(c, "strain.cine"),
        fmt::format("{} has one image a slice; strain needs two or more", c.strain.cine),
        "Name a cine: images of every slice over time");
  for (const strain::SliceTask& task : tasks)
    if (task.cine->frames.size() != images)
      throw InputError(case_file::beside(c, c.strain.cine).string(),
                       fmt::format("{} has {} images and {} has {}", first.name, images,
                                   task.cine->name, task.cine->frames.size()),
                       "Give all images of the slices with contours, or leave out the contours of "
                       "a slice that lacks some");
  if (c.strain.end_systole > static_cast<int>(images))
    throw InputError(case_file::place_of(c, "strain.end_systole"),
                     fmt::format("strain.end_systole is {}, but the cine has {} images a slice",
                                 c.strain.end_systole, images),
                     "Give the number of an image in order of time, or 0");
  if (c.strain.end_systole == c.strain.end_diastole)
    throw InputError(
        case_file::place_of(c, "strain.end_systole"),
        fmt::format("strain.end_systole and strain.end_diastole are both {}", c.strain.end_systole),
        "Give the number of another image in order of time, or 0");
}

}  // namespace

std::vector<strain::SliceTask> slice_tasks(const Case& c, const CineStudy& study) {
  std::vector<strain::SliceTask> tasks;
  const auto& loops = study.drawn.short_axis;
  for (std::size_t i = 0; i < loops.size(); ++i) {
    const Contour* epi = geometry::find(loops, loops[i].slice, Side::epi);
    if (loops[i].side != Side::endo || epi == nullptr)
      continue;
    const image::CineSlice& slice = study.cine.slices[study.slice_of[i]];
    strain::SliceTask task{&slice, {}, static_cast<int>(drawn_frame(c, slice)), loops[i], *epi};
    for (std::size_t k = 0; k < slice.frames.size(); ++k)
      task.phases.push_back(static_cast<int>(k) + 1);
    tasks.push_back(std::move(task));
  }
  if (tasks.empty())
    throw InputError(case_file::beside(c, c.strain.contours).string(),
                     "no slice has both an endocardial and an epicardial loop",
                     "Strain needs both, drawn at end-diastole");
  check_images(c, tasks);
  return tasks;
}

}  // namespace lv::cine
