#include "lv/segment/segment.hpp"

#include "lv/base/check.hpp"
#include "lv/base/median.hpp"
#include "lv/image/volume.hpp"
#include "lv/segment/doubts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <utility>

namespace lv::segment {
namespace {

using geometry::Contour;
using geometry::Side;
using image::Cine;

constexpr std::size_t fewest_frames = 5;
constexpr std::size_t fewest_slices = 3;
constexpr double surrounded = 0.5;  // part of the circumference with muscle

/// First and last slice of the ventricle, both included.
struct Run {
  std::size_t first, last;
};

std::vector<std::size_t> all_frames(const SliceBorders& slice) {
  std::vector<std::size_t> frames(slice.frames.size());
  std::iota(frames.begin(), frames.end(), std::size_t{0});
  return frames;
}

double usual_wall(const SliceBorders& slice, const std::vector<std::size_t>& frames) {
  std::vector<double> parts;
  for (const std::size_t t : frames)
    parts.push_back(slice.frames[t].wall_part);
  return median(std::move(parts));
}

double usual_contrast(const std::vector<SliceBorders>& borders) {
  std::vector<double> contrasts;
  for (const SliceBorders& slice : borders)
    contrasts.push_back(slice.contrast);
  return median(std::move(contrasts));
}

constexpr double told = 0.5;  // of the usual contrast, from which on blood is told from muscle

/// Why a slice by itself shows no ventricle; empty if it may show it.
std::string shows_none(const SliceBorders& slice, double usual) {
  if (const double wall = usual_wall(slice, all_frames(slice)); wall < surrounded)
    return fmt::format(
        "muscle surrounds {:.0f}% of its blood; an atrium, the outflow tract or beyond the tip",
        100.0 * wall);
  if (slice.contrast < told * usual)
    return fmt::format(
        "blood is not told from muscle, they differ by {:.0f}% of what they do in most slices; the "
        "tip, or beyond it",
        100.0 * std::max(0.0, slice.contrast) / usual);
  return {};
}

/// The slices round the seed that muscle surrounds and whose blood is told from it.
Run walled_run(const std::vector<SliceBorders>& borders, std::size_t seed) {
  const double usual = usual_contrast(borders);
  const auto belongs = [&](std::size_t s) { return shows_none(borders[s], usual).empty(); };
  Run run{seed, seed};
  while (run.first > 0 && belongs(run.first - 1))
    --run.first;
  while (run.last + 1 < borders.size() && belongs(run.last + 1))
    ++run.last;
  return run;
}

std::vector<double> areas_of(const SliceBorders& slice) {
  std::vector<double> areas;
  for (const FrameBorders& frame : slice.frames)
    areas.push_back(area(frame.endo));
  return areas;
}

/// Adds a multiple of values to a sum of equally many.
void add(const std::vector<double>& values, double factor, std::vector<double>& sum) {
  for (std::size_t i = 0; i < values.size(); ++i)
    sum[i] += factor * values[i];
}

double mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double v : values)
    sum += v;
  return sum / static_cast<double>(values.size());
}

/// By what part of its mean a changes where b changes by all of its own: the slope of least squares
/// over the frames.
double shared_change(const std::vector<double>& a, const std::vector<double>& b) {
  const double mean_a = mean(a);
  const double mean_b = mean(b);
  double common = 0.0;
  double own = 0.0;
  for (std::size_t t = 0; t < a.size(); ++t) {
    common += (a[t] / mean_a - 1.0) * (b[t] / mean_b - 1.0);
    own += std::pow(b[t] / mean_b - 1.0, 2);
  }
  return own > 0.0 ? common / own : 1.0;
}

/// Whether the base lies at the run's first slices.
bool base_is_first(const std::vector<SliceBorders>& borders, const Run& run) {
  const std::size_t third = std::max<std::size_t>(1, (run.last - run.first + 1) / 3);
  double first = 0.0;
  double last = 0.0;
  for (std::size_t n = 0; n < third; ++n) {
    first += mean(areas_of(borders[run.first + n]));
    last += mean(areas_of(borders[run.last - n]));
  }
  return first >= last;
}

/// Slices in order from the base.
std::vector<std::size_t> from_base(const Run& run, bool base_first) {
  std::vector<std::size_t> slices;
  for (std::size_t s = run.first; s <= run.last; ++s)
    slices.push_back(s);
  if (!base_first)
    std::reverse(slices.begin(), slices.end());
  return slices;
}

/// The sum of the slices' areas per frame.
std::vector<double> blood_in(const std::vector<SliceBorders>& borders,
                             const std::vector<std::size_t>& slices) {
  std::vector<double> blood(borders.front().frames.size(), 0.0);
  for (const std::size_t s : slices)
    add(areas_of(borders[s]), 1.0, blood);
  return blood;
}

/// Of slices in order from the base, those of the lower half.
std::vector<std::size_t> lower_half(const std::vector<std::size_t>& slices) {
  return {slices.begin() + static_cast<std::ptrdiff_t>(slices.size() / 2), slices.end()};
}

void drop_first(std::size_t count, std::vector<std::size_t>& slices) {
  slices.erase(slices.begin(), slices.begin() + static_cast<std::ptrdiff_t>(count));
}

/// How many times as much blood a slice shows as another: the median over frames.
double times_as_much(const SliceBorders& slice, const SliceBorders& other,
                     const std::vector<std::size_t>& frames) {
  std::vector<double> ratios;
  for (const std::size_t t : frames)
    ratios.push_back(area(slice.frames[t].endo) / area(other.frames[t].endo));
  return median(std::move(ratios));
}

/// From one slice to the next towards the base a ventricle does not grow by more; what does has
/// blood of its neighbours within its border, across the thin walls of an atrium or outflow tract.
constexpr double largest_leap = 1.5;

/// The quarter of the frames in which slices hold most blood.
std::vector<std::size_t> fullest_frames(const std::vector<SliceBorders>& borders,
                                        const std::vector<std::size_t>& slices) {
  const std::vector<double> blood = blood_in(borders, slices);
  std::vector<std::size_t> frames = all_frames(borders.front());
  std::stable_sort(frames.begin(), frames.end(),
                   [&](std::size_t a, std::size_t b) { return blood[a] > blood[b]; });
  frames.resize(std::max<std::size_t>(1, frames.size() / 4));
  return frames;
}

/// Drops slices at the base, of the upper half, from the last on that shows much more blood than
/// the next while the others hold most.
void drop_leap(const std::vector<SliceBorders>& borders, std::vector<std::size_t>& slices) {
  const auto frames = fullest_frames(borders, lower_half(slices));
  for (std::size_t n = slices.size() / 2; n-- > 0;)
    if (times_as_much(borders[slices[n]], borders[slices[n + 1]], frames) > largest_leap) {
      drop_first(n + 1, slices);
      return;
    }
}

/// Drops slices at the base, of the upper half, whose blood does not shrink with the others': a
/// ventricle's does by about as much, that of an atrium grows, and a slice that the base passes
/// stays between.
void drop_atrium(const std::vector<SliceBorders>& borders, std::vector<std::size_t>& slices) {
  constexpr double ventricle = 0.5;  // part of the others' relative change
  const std::vector<double> lower = blood_in(borders, lower_half(slices));
  std::size_t drop = 0;
  while (drop < slices.size() / 2 &&
         shared_change(areas_of(borders[slices[drop]]), lower) < ventricle)
    ++drop;
  drop_first(drop, slices);
}

/// Adds slices beyond the base of a run that muscle surrounds round end-diastole alone: the base
/// moves by more than a slice's thickness, and leaves them to the atrium for most of the cycle.
void add_end_diastolic(const std::vector<SliceBorders>& borders, bool base_first,
                       std::vector<std::size_t>& slices) {
  constexpr double surely = 0.75;  // of the circumference
  const std::vector<std::size_t> frames = fullest_frames(borders, slices);
  const double usual = usual_contrast(borders);
  while (slices.front() != (base_first ? 0 : borders.size() - 1)) {
    const std::size_t next = base_first ? slices.front() - 1 : slices.front() + 1;
    if (usual_wall(borders[next], frames) < surely || borders[next].contrast < told * usual ||
        times_as_much(borders[next], borders[slices.front()], frames) > largest_leap)
      return;
    slices.insert(slices.begin(), next);
  }
}

/// The frames within a tenth of the cycle: a base that comes and goes does so in less.
std::vector<std::size_t> frames_round(std::size_t frame, std::size_t n) {
  const std::size_t reach = std::max<std::size_t>(1, n / 10);
  std::vector<std::size_t> near;
  for (std::size_t d = 0; d <= 2 * reach; ++d)
    near.push_back((frame + n + d - reach) % n);
  return near;
}

/// Whether slices hold more than the middle of what they do over the frames, per frame.
std::vector<bool> is_fuller(const std::vector<SliceBorders>& borders,
                            const std::vector<std::size_t>& slices) {
  const std::vector<double> blood = blood_in(borders, slices);
  const auto [least, most] = std::minmax_element(blood.begin(), blood.end());
  std::vector<bool> fuller;
  for (const double area : blood)
    fuller.push_back(area > 0.5 * (*least + *most));
  return fuller;
}

/// Marks, per slice and frame, what shows the ventricle; the first so many slices only while the
/// others hold more than the middle of what they do.
void mark(const std::vector<std::size_t>& slices, std::size_t end_diastolic, Segmentation& found) {
  constexpr double least_radius = 3.0;  // [mm]
  const auto others = slices.begin() + static_cast<std::ptrdiff_t>(end_diastolic);
  const std::vector<bool> fuller = is_fuller(found.borders, {others, slices.end()});
  const std::size_t frames = found.borders.front().frames.size();
  for (std::size_t t = 0; t < frames; ++t) {
    auto begin = fuller[t] ? slices.begin() : others;
    auto end = slices.end();
    const std::vector<std::size_t> near = frames_round(t, frames);
    const auto is_atrium = [&](auto slice) {
      return usual_wall(found.borders[*slice], near) < surrounded ||
             (slice + 1 != end && times_as_much(found.borders[*slice], found.borders[*(slice + 1)],
                                                near) > largest_leap);
    };
    while (begin != end && is_atrium(begin))
      ++begin;
    while (begin != end && found.borders[*(end - 1)].frames[t].endo.mean() < least_radius)
      --end;
    for (auto s = begin; s != end; ++s)
      found.shows[*s][t] = 1;
  }
}

/// Volume per frame of the slices for which `counts` holds.
template <class Counts>
std::vector<double> volumes_of(const Segmentation& found, const Counts& counts) {
  std::vector<double> volumes(found.borders.front().frames.size(), 0.0);
  for (std::size_t s = 0; s < found.borders.size(); ++s)
    for (std::size_t t = 0; t < volumes.size(); ++t)
      if (counts(s, t))
        volumes[t] += found.spacing * area(found.borders[s].frames[t].endo);
  return volumes;
}

/// Of what shows the ventricle.
std::vector<double> volumes_of_shown(const Segmentation& found) {
  return volumes_of(found, [&](std::size_t s, std::size_t t) { return found.shows[s][t] != 0; });
}

bool always(const std::vector<char>& shows) {
  return std::all_of(shows.begin(), shows.end(), [](char c) { return c != 0; });
}

/// From the slices that show the ventricle in all frames, if there are any: what comes and goes at
/// the base would shift the extremes.
image::Phases phases_of(const Segmentation& found) {
  const std::vector<double> core =
      volumes_of(found, [&](std::size_t s, std::size_t) { return always(found.shows[s]); });
  return image::propose_phases(core.front() > 0.0 ? core : found.volumes);
}

/// Why a slice is left out: by itself, or for where it lies.
std::string why_left_out(const std::vector<SliceBorders>& borders, const Run& run, std::size_t s) {
  if (s >= run.first && s <= run.last)
    return "its blood does not shrink with that of the others, or is much more than that of the "
           "next; an atrium or the outflow tract";
  const std::string by_itself = shows_none(borders[s], usual_contrast(borders));
  return by_itself.empty() ? fmt::format("it lies beyond slice {}, which shows no ventricle",
                                         s < run.first ? run.first : run.last + 2)
                           : by_itself;
}

/// The first slice from the base that shows the ventricle in a frame; none if no slice does.
std::optional<std::size_t> most_basal(const std::vector<std::size_t>& slices,
                                      const Segmentation& found, std::size_t frame) {
  const auto basal = std::find_if(slices.begin(), slices.end(),
                                  [&](std::size_t s) { return found.shows[s][frame] != 0; });
  return basal == slices.end() ? std::nullopt : std::optional(*basal);
}

/// "4.1 ml of 60.2": half of what the most basal slice of a frame holds, and the whole volume.
std::string half_of_base(const std::vector<std::size_t>& slices, const Segmentation& found,
                         int frame) {
  const auto t = static_cast<std::size_t>(frame);
  const auto basal = most_basal(slices, found, t);
  const double held = basal ? found.spacing * area(found.borders[*basal].frames[t].endo) : 0.0;
  return fmt::format("{:.1f} ml of {:.1f}", 0.5e-3 * held, 1e-3 * found.volumes[t]);
}

void doubt_ends(const Run& run, const std::vector<std::size_t>& slices, Segmentation& found) {
  for (std::size_t s = 0; s < found.borders.size(); ++s)
    if (std::find(slices.begin(), slices.end(), s) == slices.end())
      found.doubts.push_back(
          fmt::format("slice {} is left out: {}", s + 1, why_left_out(found.borders, run, s)));
  found.doubts.push_back(fmt::format(
      "slice {} is taken for the most basal one and slice {} for the most apical one, by rule: "
      "look "
      "whether a valve, an atrium or the tip is missed or taken in; half of the most basal slice "
      "is "
      "{} at end-diastole and {} at end-systole, and no better is known where the base lies",
      slices.front() + 1, slices.back() + 1, half_of_base(slices, found, found.phases.end_diastole),
      half_of_base(slices, found, found.phases.end_systole)));
}

/// What one may do whose ventricle was not found.
std::string how_else(bool centre_is_given) {
  return fmt::format(
      "{}raw the contours and take anatomy.source = \"contours\", if the images show the ventricle "
      "across its axis",
      centre_is_given ? "D" : "Set segment.centre to a point in the left ventricle's blood, or d");
}

/// What end-diastole would hold with the slice before its most basal one, where that was left out
/// though some wall is seen round its blood, or other blood lies within its border: as much as the
/// next slice at most.
void doubt_base(bool base_first, const std::vector<std::size_t>& slices, Segmentation& found) {
  constexpr double some = 0.25;  // of the circumference with muscle
  const auto diastole = static_cast<std::size_t>(found.phases.end_diastole);
  const auto shown = most_basal(slices, found, diastole);
  if (!shown || *shown == (base_first ? 0 : found.borders.size() - 1))
    return;
  const std::size_t next = base_first ? *shown - 1 : *shown + 1;
  const auto near = frames_round(diastole, found.volumes.size());
  const bool leaps = times_as_much(found.borders[next], found.borders[*shown], near) > largest_leap;
  if (!leaps && usual_wall(found.borders[next], near) < some)
    return;
  const auto area_in = [&](std::size_t s) { return area(found.borders[s].frames[diastole].endo); };
  const double whole = found.volumes[diastole];
  const double more = found.spacing * std::min(area_in(next), area_in(*shown));
  found.doubts.push_back(fmt::format(
      "slice {} is left out at end-diastole (phase {}), taken for the atrium or the outflow tract: "
      "with it the cavity would hold {:.1f} ml instead of {:.1f} ({:+.0f}%); if it shows the "
      "ventricle there, draw its borders in ventricle draw",
      next + 1, diastole + 1, 1e-3 * (whole + more), 1e-3 * whole, 100.0 * more / whole));
}

/// Slices that always show the ventricle and whose blood grows while that of all others shrinks.
void doubt_times(const std::vector<std::size_t>& slices, Segmentation& found) {
  std::vector<std::size_t> shown;
  std::copy_if(slices.begin(), slices.end(), std::back_inserter(shown),
               [&](std::size_t s) { return always(found.shows[s]); });
  const std::vector<double> all = blood_in(found.borders, shown);
  for (const std::size_t s : shown) {
    const std::vector<double> own = areas_of(found.borders[s]);
    std::vector<double> others = all;
    add(own, -1.0, others);
    if (shared_change(own, others) < 0.0)
      found.doubts.push_back(
          fmt::format("slice {}: its blood grows while that of the other slices shrinks: its wall "
                      "bulges, or its images begin at another time of the cycle",
                      s + 1));
  }
}

/// How much larger the cavity would be if trabeculae, and not blur, made even the sharpest edges
/// wider than pixels do. Where a part of their width was taken for trabeculae already, these are in
/// the cavity, and nothing is said.
void doubt_blur(std::vector<SliceBorders> if_sharp, double fall_if_sharp, Segmentation& found) {
  constexpr double counts = 0.05;  // of a volume
  if (if_sharp.empty())
    return;
  Segmentation sharp = found;
  sharp.borders = std::move(if_sharp);
  const std::vector<double> volumes = volumes_of_shown(sharp);
  const auto grows = [&](int frame) {
    const auto t = static_cast<std::size_t>(frame);
    return volumes[t] / found.volumes[t] - 1.0;
  };
  const double diastolic = grows(found.phases.end_diastole);
  const double systolic = grows(found.phases.end_systole);
  if (std::max(std::abs(diastolic), std::abs(systolic)) < counts)
    return;
  found.doubts.push_back(fmt::format(
      "even the sharpest edges between blood and muscle are wider than the pixels make them, and "
      "blur is not told from trabeculae all round: blur is taken for the cause, and of blur "
      "alone the borders are right; if it is all trabeculae, the cavity holds {:+.0f}% at "
      "end-diastole and {:+.0f}% at end-systole, if both, something between: where the pictures "
      "show trabeculae within the wall, set segment.fall = {:.2f}, or less",
      100.0 * diastolic, 100.0 * systolic, fall_if_sharp));
}

/// Of too few slices that show the ventricle, with why the next one beside them does not.
[[noreturn]] void refuse_few(const std::vector<SliceBorders>& borders, const Run& run,
                             std::size_t shown, bool centre_is_given, const std::string& where) {
  std::string why;
  if (const std::size_t next = run.first > 0 ? run.first - 1 : run.last + 1; next < borders.size())
    why = fmt::format("; in slice {}, {}", next + 1, why_left_out(borders, run, next));
  throw InputError(where,
                   fmt::format("only {} slice{} a ring of muscle round blood{}", shown,
                               shown == 1 ? " shows" : "s show", why),
                   how_else(centre_is_given));
}

/// Throws InputError for a slice whose images show nothing: all of their grey values are one.
void require_signal(const Cine& cine, const std::string& where) {
  for (const image::CineSlice& slice : cine.slices) {
    const float first = slice.frames.front().values.front();
    const auto is_first = [&](float value) { return value == first; };
    if (std::all_of(slice.frames.begin(), slice.frames.end(), [&](const image::Picture& picture) {
          return std::all_of(picture.values.begin(), picture.values.end(), is_first);
        }))
      throw InputError(
          where,
          fmt::format("the images of {} show nothing: every grey value is {:g}", slice.name, first),
          "Export the images again, or leave that slice out");
  }
}

Contour loop_of(const Cine& cine, const Segmentation& found, std::size_t s, std::size_t frame,
                Side side) {
  const FrameBorders& borders = found.borders[s].frames[frame];
  Contour loop;
  loop.slice = static_cast<int>(s) + 1;
  loop.side = side;
  loop.points = line(cine.slices[s].frames[frame].plane, found.borders[s].centre,
                     side == Side::endo ? borders.endo : borders.epi);
  loop.file = cine.slices[s].name;
  return loop;
}

}  // namespace

void require_cine(const Cine& cine, const std::string& where) {
  const auto& slices = cine.slices;
  if (slices.size() < fewest_slices)
    throw InputError(where, fmt::format("{} short-axis slices", slices.size()),
                     fmt::format("Give a stack of {} or more", fewest_slices));
  const std::size_t frames = slices.front().frames.size();
  const std::string remedy = fmt::format(
      "Give a cine: images over the heart's cycle, equally many of every slice and at least {}",
      fewest_frames);
  if (frames < fewest_frames)
    throw InputError(where, fmt::format("{} images of {}", frames, slices.front().name), remedy);
  for (const image::CineSlice& slice : slices)
    if (slice.frames.size() != frames)
      throw InputError(where,
                       fmt::format("{} has {} images and {} has {}", slices.front().name, frames,
                                   slice.name, slice.frames.size()),
                       remedy);
}

Segmentation segment(const Cine& cine, const SegmentParameters& parameters,
                     const std::string& where) {
  require_cine(cine, where);
  require_signal(cine, where);
  std::optional<Vec3> given;
  if (parameters.centre)
    given = Vec3(parameters.centre->data());
  const Heart heart = find_heart(cine, given);
  Segmentation found;
  const double set = parameters.fall;
  Drawn drawn = draw_borders(cine, heart, set == 0.0 ? std::nullopt : std::optional(set));
  found.borders = std::move(drawn.slices);
  found.fall = drawn.fall;
  found.spacing = image::spacing_of(cine);
  found.shows.assign(cine.slices.size(), std::vector<char>(cine.slices.front().frames.size(), 0));
  const Run run = walled_run(found.borders, heart.seed);
  const bool base_first = base_is_first(found.borders, run);
  std::vector<std::size_t> slices = from_base(run, base_first);
  drop_atrium(found.borders, slices);
  drop_leap(found.borders, slices);
  if (slices.size() < fewest_slices)
    refuse_few(found.borders, run, slices.size(), parameters.centre.has_value(), where);
  const std::size_t always_there = slices.size();
  add_end_diastolic(found.borders, base_first, slices);
  mark(slices, slices.size() - always_there, found);
  found.volumes = volumes_of_shown(found);
  found.phases = phases_of(found);
  require_emptying(found, where, how_else(given.has_value()));
  doubt_ends(run, slices, found);
  doubt_base(base_first, slices, found);
  doubt_times(slices, found);
  doubt_blur(std::move(drawn.if_sharp), drawn.fall_if_sharp, found);
  for (std::string& doubt : doubts_of_drawn(cine, slices, found))
    found.doubts.push_back(std::move(doubt));
  found.warnings = warnings_of_drawn(cine, slices, found);
  return found;
}

double muscle_volume(const Segmentation& found, std::size_t frame) {
  double area = 0.0;
  for (std::size_t s = 0; s < found.borders.size(); ++s)
    if (found.shows[s][frame] != 0)
      area += area_of_wall(found.borders[s].frames[frame]);
  return found.spacing * area;
}

double doubtful_part(const Segmentation& found, std::size_t frame) {
  if (!(found.volumes[frame] > 0.0))
    return 0.0;
  const std::vector<double> doubted = volumes_of(found, [&](std::size_t s, std::size_t t) {
    return found.shows[s][t] != 0 && found.borders[s].frames[t].endo_agrees < doubtful;
  });
  return doubted[frame] / found.volumes[frame];
}

geometry::Contours contours_at(const Cine& cine, const Segmentation& found, std::size_t frame) {
  geometry::Contours contours;
  for (std::size_t s = 0; s < found.borders.size(); ++s)
    if (found.shows[s][frame] != 0)
      for (const Side side : {Side::endo, Side::epi})
        contours.short_axis.push_back(loop_of(cine, found, s, frame, side));
  return contours;
}

}  // namespace lv::segment
