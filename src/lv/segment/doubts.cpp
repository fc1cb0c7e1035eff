#include "lv/segment/doubts.hpp"

#include "lv/base/median.hpp"
#include "lv/geometry/contour_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace lv::segment {
namespace {

using image::Cine;
using Sentences = std::vector<std::string>;

/// "2, 5 to 7" of numbers in ascending order.
std::string ranges(const std::vector<std::size_t>& numbers) {
  std::string text;
  for (std::size_t a = 0; a < numbers.size();) {
    std::size_t b = a;
    while (b + 1 < numbers.size() && numbers[b + 1] == numbers[b] + 1)
      ++b;
    text += fmt::format("{}{}", text.empty() ? "" : ", ", numbers[a]);
    if (b > a)
      text += fmt::format(" to {}", numbers[b]);
    a = b + 1;
  }
  return text;
}

/// "phase 3" or "phases 1, 5 to 7" of frames in ascending order, counted from 0.
std::string phases_in_words(std::vector<std::size_t> frames) {
  for (std::size_t& frame : frames)
    ++frame;
  return fmt::format("phase{} {}", frames.size() == 1 ? "" : "s", ranges(frames));
}

const char* name_of(double FrameBorders::*side) {
  return side == &FrameBorders::endo_agrees ? "endocardium" : "epicardium";
}

void doubt_places(const Cine& cine, const std::vector<std::size_t>& slices,
                  const Segmentation& found, Sentences& doubts) {
  constexpr double farthest = 8.0;  // from the middle between the slices beside it [mm]
  const auto middle = [&](std::size_t s) {
    const Pixel& at = found.borders[s].centre;
    return cine.slices[s].frames.front().plane.point(at.x(), at.y());
  };
  for (std::size_t n = 1; n + 1 < slices.size(); ++n) {
    const Vec3 between = 0.5 * (middle(slices[n - 1]) + middle(slices[n + 1]));
    if (const double away = (middle(slices[n]) - between).norm(); away > farthest)
      doubts.push_back(fmt::format(
          "slice {} lies {:.0f} mm off the slices beside it: another breath, or not the ventricle",
          slices[n] + 1, away));
  }
}

double area_at_its_largest(const SliceBorders& slice) {
  double largest = 0.0;
  for (const FrameBorders& frame : slice.frames)
    largest = std::max(largest, area(frame.endo));
  return largest;
}

void warn_of_ends(const std::vector<std::size_t>& slices, const Segmentation& found,
                  Sentences& warnings) {
  const auto ends_stack = [&](std::size_t s) { return s == 0 || s + 1 == found.borders.size(); };
  if (ends_stack(slices.front()))
    warnings.push_back(fmt::format(
        "slice {} is the last image towards the base and shows the ventricle: whether more of it "
        "lies beyond is not seen, and volumes and masses would lack that",
        slices.front() + 1));
  double largest = 0.0;
  for (const std::size_t s : slices)
    largest = std::max(largest, area_at_its_largest(found.borders[s]));
  const double last = area_at_its_largest(found.borders[slices.back()]);
  if (ends_stack(slices.back()) && last > geometry::largest_tip * largest)
    warnings.push_back(fmt::format(
        "slice {} is the last image towards the tip, and its cavity has {:.0f}% of the largest "
        "slice's area: the tip is not shown, and volumes and masses lack it",
        slices.back() + 1, 100.0 * last / largest));
}

/// The part of a line that runs along the edge of its image or beyond.
double part_at_edge(const image::Plane& plane, const Pixel& centre, const Radii& radii) {
  constexpr double margin = 1.0;  // [pixels]
  const std::vector<Vec3> points = line(plane, centre, radii);
  const auto is_at_edge = [&](const Vec3& x) {
    const Vec3 at = plane.pixel(x);
    return at.x() < margin || at.x() > plane.columns - 1 - margin || at.y() < margin ||
           at.y() > plane.rows - 1 - margin;
  };
  return static_cast<double>(std::count_if(points.begin(), points.end(), is_at_edge)) /
         static_cast<double>(points.size());
}

void warn_of_image_edges(const Cine& cine, const Segmentation& found, Sentences& warnings) {
  constexpr double seen = 0.02;  // of the circumference
  std::vector<std::size_t> cut;
  double most = 0.0;
  for (std::size_t s = 0; s < found.borders.size(); ++s) {
    double part = 0.0;
    for (std::size_t t = 0; t < found.shows[s].size(); ++t)
      if (found.shows[s][t] != 0)
        part = std::max(part, part_at_edge(cine.slices[s].frames[t].plane, found.borders[s].centre,
                                           found.borders[s].frames[t].epi));
    if (part < seen)
      continue;
    cut.push_back(s + 1);
    most = std::max(most, part);
  }
  if (!cut.empty())
    warnings.push_back(
        fmt::format("slice{} {}: up to {:.0f}% of the epicardium lies at the edge of the image or "
                    "beyond, where "
                    "nothing is seen: the image cuts the ventricle off",
                    cut.size() == 1 ? "" : "s", ranges(cut), 100.0 * most));
}

void doubt_borders(const Segmentation& found, Sentences& doubts) {
  for (std::size_t s = 0; s < found.borders.size(); ++s)
    for (const auto side : {&FrameBorders::endo_agrees, &FrameBorders::epi_agrees}) {
      std::vector<std::size_t> frames;
      double least = 1.0;
      for (std::size_t t = 0; t < found.shows[s].size(); ++t)
        if (const double sure = found.borders[s].frames[t].*side;
            found.shows[s][t] != 0 && sure < doubtful) {
          frames.push_back(t);
          least = std::min(least, sure);
        }
      if (!frames.empty())
        doubts.push_back(
            fmt::format("slice {}: the {} is doubtful in {} (confidence {:.2f} and more)", s + 1,
                        name_of(side), phases_in_words(frames), least));
    }
}

void doubt_volumes(const Segmentation& found, Sentences& doubts) {
  for (const auto& [name, frame] : {std::pair("end-diastole", found.phases.end_diastole),
                                    {"end-systole", found.phases.end_systole}})
    if (const double part = doubtful_part(found, static_cast<std::size_t>(frame)); part > 0.0)
      doubts.push_back(fmt::format(
          "{:.0f}% of the cavity at {} (phase {}) lies in slices whose endocardium is doubtful: so "
          "are its volume and the ejection fraction",
          100.0 * part, name, frame + 1));
}

constexpr double muscle_may_change = 0.15;  // by what observers miss the epicardium, and its base

void warn_of_muscle_of_moments(const std::vector<double>& muscle, const image::Phases& phases,
                               Sentences& warnings) {
  const double diastolic = muscle[static_cast<std::size_t>(phases.end_diastole)];
  for (const auto& [name, frame] :
       {std::pair("end-systole", phases.end_systole), {"early diastole", phases.early_diastole}}) {
    const double change = muscle[static_cast<std::size_t>(frame)] / diastolic - 1.0;
    if (std::abs(change) > muscle_may_change)
      warnings.push_back(fmt::format(
          "the borders hold {:.0f} ml of muscle at {} (phase {}) and {:.0f} ml at end-diastole "
          "(phase {}), {:+.0f}%, where muscle keeps its volume and mass hangs on it: look at the "
          "epicardium of both, and whether the most basal slice still shows the ventricle",
          1e-3 * muscle[static_cast<std::size_t>(frame)], name, frame + 1, 1e-3 * diastolic,
          phases.end_diastole + 1, 100.0 * change));
  }
}

void warn_of_muscle(const Segmentation& found, Sentences& warnings) {
  std::vector<double> muscle;
  for (std::size_t t = 0; t < found.volumes.size(); ++t)
    muscle.push_back(muscle_volume(found, t));
  const double usual = median(muscle);
  if (!(usual > 0.0))
    return;
  std::vector<std::size_t> frames;
  for (std::size_t t = 0; t < muscle.size(); ++t)
    if (std::abs(muscle[t] / usual - 1.0) > muscle_may_change)
      frames.push_back(t);
  if (!frames.empty()) {
    const auto [least, most] = std::minmax_element(muscle.begin(), muscle.end());
    warnings.push_back(fmt::format(
        "the borders hold {:.0f} to {:.0f} ml of muscle, where muscle keeps its volume; more than "
        "{:.0f}% off the median of {:.0f} ml in {}",
        1e-3 * *least, 1e-3 * *most, 100.0 * muscle_may_change, 1e-3 * usual,
        phases_in_words(frames)));
  }
  warn_of_muscle_of_moments(muscle, found.phases, warnings);
}

void warn_of_motion(const Segmentation& found, Sentences& warnings) {
  constexpr double beats = 0.05;  // the least ejection fraction that tells end-systole
  const auto [least, most] = std::minmax_element(found.volumes.begin(), found.volumes.end());
  if (*least > (1.0 - beats) * *most) {
    warnings.push_back(fmt::format(
        "the cavity's volume changes by {:.1f}% over the cine: nothing is seen to beat, "
        "and end-diastole and end-systole are not told apart",
        100.0 * (1.0 - *least / *most)));
    return;
  }
  if (found.phases.early_diastole == found.phases.end_systole)
    warnings.push_back(fmt::format(
        "after end-systole (phase {}) no phase holds a tenth of the stroke volume more: the cine "
        "ends before the ventricle fills, and end-systole is taken for early diastole too",
        found.phases.end_systole + 1));
}

}  // namespace

std::vector<std::string> doubts_of_drawn(const Cine& cine, const std::vector<std::size_t>& slices,
                                         const Segmentation& found) {
  Sentences doubts;
  doubt_places(cine, slices, found, doubts);
  doubt_borders(found, doubts);
  doubt_volumes(found, doubts);
  return doubts;
}

std::vector<std::string> warnings_of_drawn(const Cine& cine, const std::vector<std::size_t>& slices,
                                           const Segmentation& found) {
  Sentences warnings;
  warn_of_ends(slices, found, warnings);
  warn_of_image_edges(cine, found, warnings);
  warn_of_muscle(found, warnings);
  warn_of_motion(found, warnings);
  return warnings;
}

}  // namespace lv::segment
