#include "lv/cine/strain.hpp"

#include "lv/base/log.hpp"
#include "lv/base/table.hpp"
#include "lv/base/units.hpp"
#include "lv/cine/cine.hpp"
#include "lv/cine/through_plane.hpp"
#include "lv/drawing/overlay.hpp"
#include "lv/geometry/contour_table.hpp"
#include "lv/strain/measures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace lv::cine {
namespace {

using case_file::Case;
namespace fs = std::filesystem;
using geometry::Contour;
using geometry::Side;
using strain::TrackedSlice;

constexpr double missing = std::numeric_limits<double>::quiet_NaN();
constexpr drawing::Colour drawn_colour = drawing::hex(0x56b4e9);
constexpr drawing::Colour carried_colour = drawing::hex(0xe69f00);
constexpr drawing::Colour given_colour = drawing::hex(0x009e73);

std::string number(double value) {
  return Table::number(value, 5);
}

/// A slice whose map folds, or nearly, was not followed: its muscle has left the plane.
bool was_followed(const TrackedSlice& slice) {
  constexpr double folded = 0.1;
  return slice.smallest_J > folded;
}

/// Position in a slice's series of a phase.
std::size_t at_phase(const TrackedSlice& slice, int phase) {
  const auto& phases = slice.series.phases;
  return static_cast<std::size_t>(std::find(phases.begin(), phases.end(), phase) - phases.begin());
}

/// Cavity volume at a phase, from areas times spacing [mm^3].
double volume_at(const std::vector<TrackedSlice>& slices, double spacing, int phase) {
  double area = 0.0;
  for (const TrackedSlice& s : slices) {
    const std::size_t k = at_phase(s, phase);
    area += k < s.cavity_areas.size() ? s.cavity_areas[k] : missing;
  }
  return spacing * area;
}

int end_systole(const Case& c, const std::vector<TrackedSlice>& slices) {
  const std::vector<int>& phases = slices.front().series.phases;
  if (c.strain.end_systole > 0)
    return c.strain.end_systole;
  const auto volume = [&](int phase) {
    const double v = volume_at(slices, 1.0, phase);
    return std::isnan(v) ? std::numeric_limits<double>::infinity() : v;
  };
  return *std::min_element(phases.begin(), phases.end(),
                           [&](int a, int b) { return volume(a) < volume(b); });
}

/// How a slice agrees with a loop drawn at end-systole.
struct Check {
  double dice = missing, mean = missing, largest = missing, area = missing;
};

Check check(const CineStudy& study, const TrackedSlice& slice, int phase) {
  const Contour* given = geometry::find(study.systolic, slice.series.slice, Side::endo);
  if (given == nullptr)
    return {};
  const std::vector<Vec3>& carried = slice.endo[at_phase(slice, phase)].points;
  const strain::Distance d = strain::distance(given->points, {carried}, true);
  return {strain::dice(carried, given->points), d.mean, d.largest,
          strain::loop_area(given->points)};
}

/// Residuals and least J are those of the muscle's strain, contours those of the images' planes.
Table slices_table(const CineStudy& study, const std::vector<TrackedSlice>& slices,
                   const std::vector<TrackedSlice>& muscle, int systole) {
  Table table({"slice", "third", "followed", "residual_es", "largest_residual", "smallest_J",
               "cavity_area_ed_mm2", "cavity_area_es_mm2", "given_area_es_mm2", "dice_es",
               "mean_distance_es_mm", "largest_distance_es_mm"});
  for (std::size_t i = 0; i < slices.size(); ++i) {
    const TrackedSlice& s = slices[i];
    const TrackedSlice& m = muscle[i];
    const std::size_t k = at_phase(s, systole);
    double largest = 0.0;
    for (const strain::Match& match : m.matches)
      largest = std::max(largest, match.residual);
    const Check given = check(study, s, systole);
    static constexpr std::array<const char*, 3> thirds{"basal", "middle", "apical"};
    table.add_row({std::to_string(s.series.slice), thirds.at(s.series.third),
                   was_followed(m) ? "yes" : "no", number(m.matches.at(k).residual),
                   number(largest), number(m.smallest_J), number(s.cavity_areas.front()),
                   number(s.cavity_areas.at(k)), number(given.area), number(given.dice),
                   number(given.mean), number(given.largest)});
  }
  return table;
}

Table volumes_table(const std::vector<TrackedSlice>& slices, double spacing) {
  Table table({"phase", "cavity_volume_ml"});
  for (const int phase : slices.front().series.phases)
    table.add_row({std::to_string(phase), number(1e-3 * volume_at(slices, spacing, phase))});
  return table;
}

/// The loops of all slices at a phase.
std::vector<Contour> loops_at(const std::vector<TrackedSlice>& slices, int phase) {
  std::vector<Contour> loops;
  for (const TrackedSlice& s : slices)
    for (const auto* side : {&s.endo, &s.epi})
      loops.push_back((*side)[at_phase(s, phase)]);
  return loops;
}

void draw(const CineStudy& study, const std::vector<strain::SliceTask>& tasks,
          const std::vector<TrackedSlice>& slices, int phase, bool systole, const fs::path& file) {
  std::vector<drawing::Overlay> overlays;
  for (std::size_t i = 0; i < slices.size(); ++i) {
    const TrackedSlice& s = slices[i];
    const std::size_t k = at_phase(s, phase);
    drawing::Overlay overlay{fmt::format("slice {}, phase {}", s.series.slice, phase),
                             &tasks[i].cine->frames.at(phase - 1),
                             {}};
    const drawing::Colour colour = systole ? carried_colour : drawn_colour;
    overlay.lines.push_back({s.endo[k].points, colour, true, false});
    overlay.lines.push_back({s.epi[k].points, colour, true, false});
    if (const Contour* given = geometry::find(study.systolic, s.series.slice, Side::endo);
        systole && given != nullptr)
      overlay.lines.push_back({given->points, given_colour, true, true});
    overlays.push_back(std::move(overlay));
  }
  drawing::write_overlays(
      overlays,
      systole ? "Contours carried from end-diastole (solid) and drawn at end-systole (dashed)"
              : "Contours drawn at end-diastole",
      file);
}

std::vector<strain::SliceSeries> series_of(const std::vector<TrackedSlice>& slices, bool all) {
  std::vector<strain::SliceSeries> series;
  for (const TrackedSlice& s : slices)
    if (all || was_followed(s))
      series.push_back(s.series);
  return series;
}

/// Strain of every slice; of regions of several slices without those that were not followed.
std::vector<strain::SegmentStrain> all_segments(const std::vector<TrackedSlice>& slices) {
  std::vector<strain::SegmentStrain> rows = strain::segments(series_of(slices, true));
  std::erase_if(rows, [](const strain::SegmentStrain& row) { return row.slice == 0; });
  for (const strain::SegmentStrain& row : strain::segments(series_of(slices, false)))
    if (row.slice == 0)
      rows.push_back(row);
  return rows;
}

/// The rotation of the slice next to the base of those that were followed, at every image after
/// end-diastole; of none if no slice was [rad].
std::vector<double> base_rotation(const ThroughPlane& through,
                                  const std::vector<TrackedSlice>& muscle) {
  const TrackedSlice* next_to_base = nullptr;
  double height = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < muscle.size(); ++i)
    if (was_followed(muscle[i]) && through.slices[i].height > height) {
      next_to_base = &muscle[i];
      height = through.slices[i].height;
    }
  std::vector<double> rotation(muscle.front().series.phases.size(), 0.0);
  if (next_to_base != nullptr)
    for (std::size_t k = 0; k < rotation.size(); ++k)
      rotation[k] = next_to_base->series.motion[k].rotation;
  return rotation;
}

/// What was found of strain and of motion through the planes.
std::string words_of_muscle(const std::vector<TrackedSlice>& muscle,
                            const std::optional<ThroughPlane>& through, int systole,
                            const std::vector<strain::SegmentStrain>& rows) {
  std::string text = through ? words_of(*through, systole)
                             : "note: motion through the short-axis planes was not followed, for "
                               "strain.long_axis_cine names no images: on a phantom that shortens "
                               "by 12% along its axis this costs 0.036 rms of segments' "
                               "circumferential strain and 2 degrees of rotation\n";
  for (const TrackedSlice& s : muscle)
    if (!was_followed(s))
      text += fmt::format(
          "slice {} was not followed everywhere: the map folds in its wall (least J {:.2f}), as "
          "when muscle leaves the plane or images are far apart in time; it is left out of the AHA "
          "segments and the whole wall\n",
          s.series.slice, s.smallest_J);
  for (const strain::SegmentStrain& row : rows)
    if (row.scheme == "whole" && row.phase == systole)
      text += fmt::format(
          "whole wall at end-systole: circumferential strain {:.3f}, radial {:.3f} "
          "(Green-Lagrange); mid-wall line {:.1f}%, thickness {:+.1f}%\n",
          row.strain.circumferential, row.strain.radial, 100.0 * row.strain.shortening,
          100.0 * row.strain.thickening);
  return text;
}

std::string words(const CineStudy& study, const std::vector<TrackedSlice>& slices, int diastole,
                  int systole) {
  std::string text;
  for (const std::string& note : study.notes)
    text += fmt::format("note: {}\n", note);
  text +=
      fmt::format("end-diastole: phase {}, cavity {:.1f} ml; end-systole: phase {}, {:.1f} ml\n",
                  diastole, 1e-3 * volume_at(slices, study.spacing, diastole), systole,
                  1e-3 * volume_at(slices, study.spacing, systole));
  double given = 0.0;
  double carried = 0.0;
  for (const TrackedSlice& s : slices) {
    const Check c = check(study, s, systole);
    if (std::isnan(c.area))
      continue;
    given += c.area;
    carried += s.cavity_areas[at_phase(s, systole)];
    text += fmt::format(
        "slice {}: Dice with the loop drawn at end-systole {:.3f}, distance {:.1f} mm in the mean, "
        "{:.1f} mm at most\n",
        s.series.slice, c.dice, c.mean, c.largest);
  }
  if (given > 0.0)
    text +=
        fmt::format("slices drawn at end-systole: {:.1f} ml carried, {:.1f} ml drawn ({:+.1f}%)\n",
                    1e-3 * study.spacing * carried, 1e-3 * study.spacing * given,
                    100.0 * (carried / given - 1.0));
  return text;
}

}  // namespace

std::string check_strain(const Case& c) {
  std::string text;
  if (c.strain.asked()) {
    const CineStudy study = read_cine_study(c);
    const std::vector<strain::SliceTask> tasks = slice_tasks(c, study);
    text += fmt::format("  strain: {} slices of {} images to follow, {} long-axis views\n",
                        tasks.size(), tasks.front().cine->frames.size(), study.long_axis.size());
    for (const std::string& note : study.notes)
      text += fmt::format("  note: {}\n", note);
  }
  if (!c.strain.measured.empty())
    text += fmt::format("  {} measured strains to compare with\n", measured_strains(c).size());
  return text;
}

void make_strain(const Case& c, const fs::path& folder) {
  const CineStudy study = read_cine_study(c);
  const std::vector<strain::SliceTask> tasks = slice_tasks(c, study);
  log::info("following {} slices of {} images", tasks.size(), tasks.front().cine->frames.size());
  const std::vector<TrackedSlice> slices =
      strain::track(tasks, study.orientation, c.strain.registration);
  const int systole = end_systole(c, slices);
  const std::optional<ThroughPlane> through = follow_through_planes(c, study, tasks);
  const std::vector<TrackedSlice> muscle =
      through ? strain::track(through->tasks, study.orientation, c.strain.registration) : slices;
  const std::vector<strain::SegmentStrain> rows = all_segments(muscle);
  strain::segments_table(rows).write_csv(folder / "segments.csv");
  strain::rotation_table(series_of(muscle, true)).write_csv(folder / "rotation.csv");
  if (through) {
    axial_table(*through).write_csv(folder / "axial_motion.csv");
    base_motion_table(*through, study.orientation, base_rotation(*through, muscle))
        .write_csv(folder / base_motion_name);
  }
  slices_table(study, slices, muscle, systole).write_csv(folder / "slices.csv");
  volumes_table(slices, study.spacing).write_csv(folder / "volumes.csv");
  geometry::contour_table(loops_at(slices, systole)).write_csv(folder / "contours_es.csv");
  draw(study, tasks, slices, c.strain.end_diastole, false, folder / "end_diastole.png");
  draw(study, tasks, slices, systole, true, folder / "end_systole.png");
  write_phases({c.strain.end_diastole, systole}, folder);
  write_file(folder / "phases.json", fmt::format("{{\"end_diastole\": {}, \"end_systole\": {}}}\n",
                                                 c.strain.end_diastole, systole));
  write_file(folder / "strain.txt", words(study, slices, c.strain.end_diastole, systole) +
                                        words_of_muscle(muscle, through, systole, rows));
}

}  // namespace lv::cine
