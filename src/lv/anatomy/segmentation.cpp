#include "lv/anatomy/segmentation.hpp"

#include "lv/anatomy/long_axis_cine.hpp"
#include "lv/anatomy/proposals.hpp"
#include "lv/base/check.hpp"
#include "lv/base/formats.hpp"
#include "lv/base/interrupt.hpp"
#include "lv/base/table.hpp"
#include "lv/case_file/case_lines.hpp"
#include "lv/drawing/overlay.hpp"
#include "lv/geometry/contour_table.hpp"
#include "lv/image/dicom_study.hpp"
#include "lv/image/pixel_grid.hpp"
#include "lv/image/volume_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace lv::anatomy {
namespace {

using case_file::Case;
namespace fs = std::filesystem;
using geometry::Contour;
using segment::FrameBorders;
using segment::Segmentation;

constexpr const char* choices_name = "segmentation.csv";
constexpr const char* fall_name = "segment.fall";
constexpr const char* proposed = "proposed";  // by whom a landmark is set

constexpr drawing::Colour sure_colour = drawing::hex(0x56b4e9);
constexpr drawing::Colour doubtful_colour = drawing::hex(0xe69f00);

void require_said_of_borders(const Case& c, const std::optional<image::DicomStudy>& dicom) {
  const case_file::CineAnatomy& a = c.anatomy.cine;
  case_file::Missing missing;
  std::string found;
  if (a.images.empty())
    missing.add({"segment.cine", case_file::fill_in,
                 "the folder of the short-axis cine, or a file (NIfTI, NRRD, MetaImage)"});
  if (dicom && a.series.empty() && dicom->stacks.size() > 1) {
    missing.add(short_axis_line("segment.series", *dicom));
    found =
        fmt::format("{} holds{}", case_file::beside(c, a.images).string(), image::choices(*dicom));
  }
  missing.raise(c, case_file::place_of(c, a.images.empty() ? "anatomy.source" : "segment.cine"),
                found);
}

Table quality_table(const Segmentation& found) {
  Table table({"slice", "phase", "cavity_area_mm2", "wall_area_mm2", "endo_confidence",
               "epi_confidence", "doubtful"});
  const auto number = [](double x) { return fmt::format("{:.2f}", x); };
  for (std::size_t s = 0; s < found.borders.size(); ++s)
    for (std::size_t t = 0; t < found.volumes.size(); ++t) {
      if (found.shows[s][t] == 0)
        continue;
      const FrameBorders& drawn = found.borders[s].frames[t];
      table.add_row(
          {std::to_string(s + 1), std::to_string(t + 1), number(segment::area(drawn.endo)),
           number(segment::area_of_wall(drawn)), number(drawn.endo_agrees),
           number(drawn.epi_agrees),
           std::min(drawn.endo_agrees, drawn.epi_agrees) < segment::doubtful ? "yes" : "no"});
    }
  return table;
}

Table volumes_table(const Segmentation& found) {
  Table table({"phase", "cavity_volume_ml", "wall_volume_ml", "slices", "doubtful_part"});
  for (std::size_t t = 0; t < found.volumes.size(); ++t) {
    const auto slices =
        std::count_if(found.shows.begin(), found.shows.end(),
                      [&](const std::vector<char>& shows) { return shows[t] != 0; });
    table.add_row({std::to_string(t + 1), Table::number(1e-3 * found.volumes[t], 5),
                   Table::number(1e-3 * segment::muscle_volume(found, t), 5),
                   std::to_string(slices),
                   fmt::format("{:.2f}", segment::doubtful_part(found, t))});
  }
  return table;
}

Table choices_table(const Segmentation& found) {
  Table table({"quantity", "value"});
  for (const auto& [name, frame] : {std::pair("end_diastole", found.phases.end_diastole),
                                    {"end_systole", found.phases.end_systole},
                                    {"early_diastole", found.phases.early_diastole}})
    table.add_row({name, std::to_string(frame + 1)});
  table.add_row({fall_name, Table::number(found.fall, 6)});
  return table;
}

Table ends_table(const segment::LongAxisEnds& ends) {
  Table table({"long_axis", "phase", "end", "x_mm", "y_mm", "z_mm", "confidence", "doubtful"});
  const auto add = [&](std::size_t view, std::size_t t, const char* end,
                       const std::optional<segment::FoundPoint>& point) {
    if (!point)
      return;
    const auto mm = [](double x) { return fmt::format("{:.3f}", x); };
    table.add_row({std::to_string(view + 1), std::to_string(t + 1), end, mm(point->at.x()),
                   mm(point->at.y()), mm(point->at.z()), fmt::format("{:.2f}", point->confidence),
                   point->confidence < segment::doubtful ? "yes" : "no"});
  };
  for (std::size_t view = 0; view < ends.views.size(); ++view)
    for (std::size_t t = 0; t < ends.views[view].size(); ++t) {
      const segment::LongAxisMarks& marks = ends.views[view][t];
      add(view, t, "apex_endo", marks.apex);
      add(view, t, "annulus_a", marks.annulus[0]);
      add(view, t, "annulus_b", marks.annulus[1]);
    }
  return table;
}

/// A cross on an image.
void add_cross(const image::Plane& plane, const segment::FoundPoint& point,
               std::vector<drawing::OverlayLine>& lines) {
  constexpr double arm = 4.0;  // [mm]
  const drawing::Colour colour =
      point.confidence < segment::doubtful ? doubtful_colour : sure_colour;
  for (const Vec3& way : {plane.along_row, plane.along_column})
    lines.push_back({{point.at - arm * way, point.at + arm * way}, colour});
}

/// The long axes of a phase with the ends that were found on them.
void add_long_axes(const CineSegmentation& s, std::size_t t,
                   std::vector<drawing::Overlay>& overlays) {
  for (std::size_t v = 0; v < s.long_axis.size(); ++v) {
    const segment::LongAxisMarks& marks = s.ends.views[v][t];
    const image::Picture& picture =
        s.long_axis[v].frames[segment::picture_of(s.long_axis[v], t, s.found.volumes.size())];
    drawing::Overlay overlay{fmt::format("long axis {}, phase {}", v + 1, t + 1), &picture, {}};
    for (const auto* end : {&marks.annulus[0], &marks.annulus[1], &marks.apex})
      if (*end)
        add_cross(picture.plane, **end, overlay.lines);
    if (!overlay.lines.empty())
      overlays.push_back(std::move(overlay));
  }
}

/// The slices of a phase that show the ventricle, with their borders.
void draw(const CineSegmentation& s, std::size_t t, const std::vector<Contour>& loops,
          const fs::path& file) {
  std::vector<drawing::Overlay> overlays;
  for (const Contour& loop : loops) {
    const auto slice = static_cast<std::size_t>(loop.slice - 1);
    if (loop.side == geometry::Side::endo)
      overlays.push_back({fmt::format("slice {}, phase {}", loop.slice, t + 1),
                          &s.cine.slices[slice].frames[t],
                          {}});
    const FrameBorders& sure = s.found.borders[slice].frames[t];
    const double own = loop.side == geometry::Side::endo ? sure.endo_agrees : sure.epi_agrees;
    overlays.back().lines.push_back(
        {loop.points, own < segment::doubtful ? doubtful_colour : sure_colour, true, false});
  }
  add_long_axes(s, t, overlays);
  drawing::write_overlays(overlays, "Borders drawn by the program; doubtful ones orange", file);
}

image::Cine read_short_axis(const Case& c, const std::optional<image::DicomStudy>& dicom) {
  const case_file::CineAnatomy& a = c.anatomy.cine;
  const fs::path file = case_file::beside(c, a.images);
  if (!dicom) {
    if (!a.series.empty())
      throw InputError(case_file::place_of(c, "segment.series"),
                       fmt::format("a single file has no series \"{}\"", a.series),
                       "Leave segment.series out, or name a folder of DICOM files");
    return image::read_volume_cine(file);
  }
  std::vector<std::string> names;
  if (!a.series.empty())
    names.push_back(a.series);
  image::Cine cine =
      image::read_pixels(image::choose_stack(*dicom, names, file.string(), "segment.series"));
  image::require_one_grid(cine, file.string(), "segment.series");
  return cine;
}

/// Throws InputError for a long axis that lies as short-axis slices do.
void require_across(const Case& c, const std::string& name, const image::CineSlice& view,
                    const image::CineSlice& slice) {
  constexpr double least = 45.0;  // between the planes [degrees]
  const double cosine =
      std::abs(view.frames.front().plane.normal().dot(slice.frames.front().plane.normal()));
  const double angle = std::acos(std::min(cosine, 1.0)) * 180.0 / std::numbers::pi;
  if (angle < least)
    throw InputError(
        case_file::place_of(c, "segment.long_axis_cine"),
        fmt::format("\"{}\" lies {:.0f} degrees from the short-axis slices", name, angle),
        "Name long-axis images, which stand across the slices");
}

}  // namespace

Cines read_cines(const Case& c) {
  const case_file::CineAnatomy& a = c.anatomy.cine;
  require_said_of_borders(c, {});
  std::optional<image::DicomStudy> dicom;
  if (!image::is_volume_name(a.images)) {
    const fs::path folder = case_file::beside(c, a.images);
    dicom = image::read_dicom_study(std::array{folder});
    image::require_images(*dicom, folder.string());
    require_said_of_borders(c, dicom);
  }
  if (a.long_axis.size() > most_long_axes)
    throw InputError(
        case_file::place_of(c, "segment.long_axis_cine"),
        fmt::format("names {} long axes", a.long_axis.size()),
        fmt::format("Name at most {}: landmarks have names for these", most_long_axes));
  Cines cines{read_short_axis(c, dicom), {}};
  for (const std::string& name : a.long_axis) {
    image::Cine view =
        read_long_axis_cine(c, {"segment.long_axis_cine", "segment.cine", a.images}, dicom, name);
    require_across(c, name, view.slices.front(), cines.short_axis.slices.front());
    cines.short_axis.notes.insert(cines.short_axis.notes.end(), view.notes.begin(),
                                  view.notes.end());
    cines.long_axis.push_back(std::move(view.slices.front()));
  }
  return cines;
}

CineSegmentation segment_cines(Cines cines, const segment::SegmentParameters& parameters,
                               const std::string& where) {
  CineSegmentation result{std::move(cines.short_axis), {}, std::move(cines.long_axis), {}};
  result.found = segment::segment(result.cine, parameters, where);
  result.ends = segment::find_ends(result.cine, result.found, result.long_axis);
  return result;
}

std::vector<geometry::Landmark> proposed_landmarks(const CineSegmentation& segmentation,
                                                   std::size_t frame) {
  std::vector<geometry::Landmark> landmarks;
  const auto number_of_view = [&](std::size_t view) {
    return static_cast<int>(segmentation.cine.slices.size() + view) + 1;
  };
  if (const auto apex = segment::apex_at(segmentation.ends, frame)) {
    const image::Plane& plane = segmentation.long_axis[apex->view].frames.front().plane;
    const Vec3 on_it = apex->at - plane.pixel(apex->at).z() * plane.normal();
    landmarks.push_back({"apex_endo", number_of_view(apex->view), on_it, proposed, ""});
  }
  for (const segment::AnnulusPoint& point : segment::annulus_at(segmentation.ends, frame))
    landmarks.push_back({fmt::format("annulus_{}", 2 * point.view + point.side + 1),
                         number_of_view(point.view), point.at, proposed, ""});
  return landmarks;
}

CineSegmentation segment_cine(const Case& c) {
  return segment_cines(read_cines(c), c.anatomy.cine.segmentation,
                       case_file::beside(c, c.anatomy.cine.images).string());
}

std::size_t shape_frame(const Case& c, const CineSegmentation& segmentation) {
  const image::Phases& phases = segmentation.found.phases;
  return static_cast<std::size_t>(c.anatomy.cine.moment == case_file::ShapeMoment::end_diastole
                                      ? phases.end_diastole
                                      : phases.early_diastole);
}

namespace {

/// ", 40% of it in slices whose endocardium is doubtful"; empty where none is.
std::string within_doubtful(const Segmentation& found, int frame) {
  const double part = segment::doubtful_part(found, static_cast<std::size_t>(frame));
  return part > 0.0
             ? fmt::format(", {:.0f}% of it in slices whose endocardium is doubtful", 100.0 * part)
             : "";
}

}  // namespace

std::string describe(const CineSegmentation& segmentation) {
  const Segmentation& found = segmentation.found;
  const auto moment = [&](const char* name, int frame) {
    return fmt::format("{}: phase {}, cavity {:.1f} ml{}\n", name, frame + 1,
                       1e-3 * found.volumes[static_cast<std::size_t>(frame)],
                       within_doubtful(found, frame));
  };
  std::string text =
      moment("end-diastole", found.phases.end_diastole) +
      moment("end-systole", found.phases.end_systole) +
      moment("early diastole", found.phases.early_diastole) +
      fmt::format("segment.fall: {:.3f} of the way from blood to muscle\n", found.fall);
  for (const auto* notes :
       {&segmentation.cine.notes, &found.warnings, &found.doubts, &segmentation.ends.doubts})
    for (const std::string& note : *notes)
      text += fmt::format("note: {}\n", note);
  return text;
}

void write_segmentation(const CineSegmentation& segmentation, const fs::path& folder) {
  fs::create_directories(folder / "contours");
  fs::create_directories(folder / "pictures");
  if (!segmentation.long_axis.empty())
    fs::create_directories(folder / "landmarks");
  for (std::size_t t = 0; t < segmentation.found.volumes.size(); ++t) {
    interrupt::check();
    const std::string name = fmt::format("phase_{:02d}", t + 1);
    const std::vector<Contour> loops =
        segment::contours_at(segmentation.cine, segmentation.found, t).short_axis;
    geometry::contour_table(loops).write_csv(folder / "contours" / (name + ".csv"));
    draw(segmentation, t, loops, folder / "pictures" / (name + ".png"));
    if (!segmentation.long_axis.empty())
      geometry::write_landmarks(proposed_landmarks(segmentation, t), landmarks_file(folder, t));
  }
  if (!segmentation.long_axis.empty())
    ends_table(segmentation.ends).write_csv(folder / "long_axis.csv");
  quality_table(segmentation.found).write_csv(folder / "quality.csv");
  volumes_table(segmentation.found).write_csv(folder / "volumes.csv");
  choices_table(segmentation.found).write_csv(folder / choices_name);
  write_file(folder / "segmentation.txt", describe(segmentation));
}

void keep_segmentation(const CineSegmentation& segmentation, const fs::path& folder) {
  const fs::path whole = folder.has_filename() ? folder : folder.parent_path();
  fs::path unfinished = whole;
  unfinished += ".part";
  fs::remove_all(unfinished);
  write_segmentation(segmentation, unfinished);
  fs::rename(unfinished, whole);
}

fs::path landmarks_file(const fs::path& folder, std::size_t frame) {
  return folder / "landmarks" / fmt::format("phase_{:02d}.csv", frame + 1);
}

std::optional<double> kept_fall(const fs::path& folder) {
  if (!fs::exists(folder / choices_name))
    return {};
  const Table table = Table::read_csv(folder / choices_name);
  const auto names = table.words("quantity");
  const auto values = table.numbers("value");
  for (std::size_t i = 0; i < names.size(); ++i)
    if (names[i] == fall_name)
      return values[i];
  return {};
}

std::string segment_case(const Case& c, const fs::path& folder) {
  if (c.anatomy.source != case_file::AnatomySource::cine)
    throw InputError(case_file::place_of(c, "anatomy.source"),
                     "anatomy.source names no cine to draw borders in",
                     "Set anatomy.source = \"cine\" and segment.cine");
  if (fs::exists(fs::symlink_status(folder)))
    throw InputError(folder.string(), "exists already, and its contours may have been corrected",
                     "Choose another folder with --to");
  const CineSegmentation segmentation = segment_cine(c);
  keep_segmentation(segmentation, folder);
  return describe(segmentation) + fmt::format("borders in {}\n", folder.string());
}

}  // namespace lv::anatomy
