#include "lv/segment/borders.hpp"

#include "lv/base/dense.hpp"
#include "lv/base/interrupt.hpp"
#include "lv/base/median.hpp"
#include "lv/image/volume.hpp"
#include "lv/segment/closed_path.hpp"
#include "lv/segment/coils.hpp"
#include "lv/segment/edge_width.hpp"
#include "lv/segment/fluid.hpp"
#include "lv/segment/grey_levels.hpp"
#include "lv/segment/kept_muscle.hpp"
#include "lv/segment/redraw_border.hpp"
#include "lv/segment/ring.hpp"
#include "lv/segment/smooth_border.hpp"
#include "lv/segment/steady_in_time.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <numbers>
#include <numeric>

namespace lv::segment {
namespace {

constexpr PolarGrid grid{};
constexpr double wall_of_cost = 1e3;  // forbids a radius
constexpr int epi_harmonics = 4;
constexpr double thinnest = 2.5;   // wall that is drawn [mm]
constexpr double agreement = 2.0;  // between what was found and what is drawn [mm]

Polar forbid(const Polar& distance, double low, double high) {
  return wall_of_cost * (distance < low || distance > high).cast<double>();
}

/// Mean of the values at offsets first..last along the radii; the ends go on.
Polar mean_at(const Polar& values, int first, int last) {
  Polar sum = Polar::Zero(values.rows(), values.cols());
  for (int offset = first; offset <= last; ++offset)
    for (Eigen::Index k = 0; k < values.cols(); ++k)
      sum.col(k) += values.col(std::clamp<Eigen::Index>(k + offset, 0, values.cols() - 1));
  return sum / (last - first + 1);
}

/// Integral from the first radius to each along every ray, by the trapezoidal rule [mm]: the least
/// lies at the radius nearest to where the values change sign.
Polar integral(const Polar& values) {
  Polar sum = Polar::Zero(values.rows(), values.cols());
  for (Eigen::Index k = 1; k < values.cols(); ++k)
    sum.col(k) = sum.col(k - 1) + 0.5 * grid.step * (values.col(k - 1) + values.col(k));
  return sum;
}

/// 0 at the blood's grey value, 1 at the muscle's and below.
Polar darkness(const Polar& values, const Levels& levels) {
  const Polar muscle = levels.muscle.replicate(1, grid.radii);
  return ((levels.blood - values) / (levels.blood - muscle)).max(0.0).min(1.0);
}

/// How unlike muscle a grey value is, 0 to 1: brighter by a part of the way to blood, or darker by
/// a part of the muscle's own.
Polar unlikeness(const Polar& values, const Levels& levels, double darker = 0.6,
                 double brighter = 0.35) {
  const Polar muscle = levels.muscle.replicate(1, grid.radii);
  return (values > muscle)
      .select((values - muscle) / (levels.blood - muscle) / brighter,
              (muscle - values) / muscle / darker)
      .min(1.0);
}

/// The way from muscle to blood, 0 to 1, as brightness of what is brighter than muscle.
Polar brightness(const Polar& values, const Levels& levels) {
  const Polar muscle = levels.muscle.replicate(1, grid.radii);
  return (values - muscle) / (levels.blood - muscle);
}

/// The same unlikeness, but where fluid lies outside the muscle no less than the way to it.
Polar with_fluid(Polar unlike, const Polar& values, const Levels& levels) {
  if (levels.fluid.size() == 0)
    return unlike;
  const Polar bright = brightness(values, levels);
  for (int i = 0; i < grid.rays; ++i)
    if (const double fluid = levels.fluid(i); fluid > 0.0)
      unlike.row(i) = unlike.row(i).max((bright.row(i) / fluid).min(1.0));
  return unlike;
}

constexpr double to_lung = 0.8;  // it is a fifth as bright: half unlike in the middle between

using Fixes = std::vector<Fixed>;

/// The edge of the blood, before muscle is known; within the first ring of muscle.
Radii blood_edge(const Polar& values, const Levels& guess, const Fixes& fixed = {}) {
  constexpr double region = 0.3;  // weight of a millimetre beside the edge's
  constexpr double edge_weight = 2.0;
  const Polar dark = darkness(values, guess);
  const Polar edge = mean_at(dark, 1, 4) - mean_at(dark, -4, -1);
  const Polar cost = region * integral(dark - 0.5) - edge_weight * edge.max(0.0);
  return path_within_ring(cost, dark, wall_of_cost, {.reach = 2, .stiffness = 0.05}, grid, fixed);
}

/// Forbids what lies less than `least` [mm] within points.
Polar forbid_outside(const Fixes& points, double least) {
  Polar cost = Polar::Zero(grid.rays, grid.radii);
  for (const Fixed& at : points)
    for (int k = 0; k < grid.radii; ++k)
      cost(at.ray, k) = grid.radius(k) > grid.radius(at.k) - least ? wall_of_cost : 0.0;
  return cost;
}

/// The line along which a band is most like muscle, not far from the blood and within points of the
/// epicardium.
Radii middle_of_wall(const Polar& values, const Radii& blood, const Levels& levels,
                     const Fixes& epi = {}) {
  constexpr int half_band = 2;     // radii
  constexpr double nearer = 0.02;  // a millimetre farther costs so much
  const Polar away = distance_from(blood, grid);
  const Polar cost = mean_at(unlikeness(values, levels, to_lung), -half_band, half_band) +
                     nearer * away.max(0.0) + forbid(away, 1.0, 16.0) + forbid_outside(epi, 1.5);
  return closed_path(cost, {.reach = 1, .stiffness = 0.1}, grid);
}

/// The values, but from a line outwards at least as much as what has been passed (the mean over
/// three radii).
Polar not_less_behind(Polar values, const Radii& line) {
  const Polar passed = mean_at(values, -1, 1);
  for (int i = 0; i < grid.rays; ++i) {
    double most = 0.0;
    for (int k = grid.index(line(i)); k < grid.radii; ++k) {
      most = std::max(most, passed(i, k));
      values(i, k) = std::max(values(i, k), most);
    }
  }
  return values;
}

/// What the epicardium costs: unlike muscle between it and the wall's middle, and no edge. Muscle
/// ends where it first does: liver and spleen, as bright as muscle behind the dark line between,
/// are none. An edge leads from muscle to what is less like it, and is measured on either side by
/// what there is: to lung by the muscle's grey value, of which blood may be five times as much.
Polar epicardial_cost(const Polar& values, const Radii& middle, const Levels& levels) {
  constexpr double region = 0.5;
  constexpr double strongest = 0.6;  // edge that counts
  constexpr double thickest = 28.0;  // from the wall's middle: hypertrophic hearts at end-systole
  const Polar unlike = with_fluid(unlikeness(values, levels, to_lung), values, levels);
  const Polar sum = integral(not_less_behind(unlike, middle) - 0.5);
  const Polar away = with_fluid(unlikeness(values, levels, 1.0, 1.0), values, levels);
  const Polar edge = mean_at(away, 1, 3) - mean_at(away, -3, -1);
  return region * sum - edge.max(0.0).min(strongest) +
         forbid(distance_from(middle, grid), 1.0, thickest);
}

constexpr PathRule epicardial_rule{.reach = 1, .stiffness = 0.15};

/// What it costs the epicardium to leave the place where it is expected.
Polar pull_to(const Radii& expected) {
  constexpr double pull = 0.02;  // [1/mm^2]
  constexpr double most = 50.0;  // [mm^2]
  return pull * distance_from(expected, grid).square().min(most);
}

/// The epicardium of all frames; the second and third time close to what the frames around it show.
std::vector<Radii> epicardium(const std::vector<Polar>& costs, const std::vector<double>& motion) {
  std::vector<Radii> lines;
  for (const Polar& cost : costs)
    lines.push_back(closed_path(cost, epicardial_rule, grid));
  for (int round = 0; round < 2; ++round) {
    const std::vector<Radii> usual = steady_in_time(lines, motion);
    for (std::size_t t = 0; t < costs.size(); ++t)
      lines[t] = closed_path(costs[t] + pull_to(harmonics_of(usual[t], epi_harmonics)),
                             epicardial_rule, grid);
  }
  return lines;
}

/// How much a grey value speaks for muscle, -1 (blood) to a part of 1. Bright is blood; dark may be
/// a papillary muscle or a trabecula, which belong to the cavity.
Polar evidence_of_muscle(const Polar& values, const Levels& levels, double fall) {
  // darkness in the cavity is not rare, brightness in the wall is
  constexpr double of_dark = 0.125;
  const Polar beyond = darkness(values, levels) - fall;
  return (beyond > 0.0).select(of_dark / (1.0 - fall) * beyond, beyond / fall);
}

/// Where the grey value has fallen by a part of the way to muscle, inside the middle of the wall:
/// first behind papillary muscles, then where the grey value says it within a band round this.
Radii endocardium(const Polar& values, const Radii& outside, const Levels& levels, double fall,
                  const Fixes& fixed = {}) {
  constexpr double band = 2.0;  // [mm]
  constexpr PathRule rule{.reach = 2, .stiffness = 0.2};
  const Polar within = wall_of_cost * (distance_from(outside, grid) > -2.0).cast<double>();
  const Polar exact = integral(darkness(values, levels) - fall) + within;
  const Radii behind = closed_path(
      0.5 * integral(evidence_of_muscle(values, levels, fall)) + within, rule, grid, fixed);
  return closed_path(exact + forbid(distance_from(behind, grid), -band, band), rule, grid, fixed);
}

/// How much muscle lies in a band of 3.5 mm outside a line, 0 to 1: next to it, or farther out by
/// `lean`, since a wall that leans in a thick slice is half blood before it is muscle. Lung behind
/// an atrium, whose grey value may have been learnt for muscle's, is too dark.
Radii wall_behind(const Polar& values, const Radii& line, Levels levels, double lean = 0.0) {
  constexpr double darkest = 0.65;  // of the slice's level
  constexpr double brightest = 1.5;
  levels.muscle = levels.muscle.max(darkest * levels.muscle_of_slice)
                      .min(brightest * levels.muscle_of_slice)
                      .eval();
  const Polar away = distance_from(line, grid);
  const Polar like = 1.0 - unlikeness(values, levels);
  const auto in_band = [&](double begins) {
    const Polar here = (away > begins && away < begins + 3.5).cast<double>();
    return Radii((like * here).rowwise().sum() / here.rowwise().sum().max(1.0));
  };
  return in_band(0.5).max(in_band(0.5 + lean));
}

/// One slice while its borders are looked for.
struct Work {
  std::vector<Polar> values;
  std::vector<Radii> blood, middle, epi, endo;
  std::vector<Radii> seen_epi;  ///< before muscle was asked to keep its volume
  std::vector<double> motion;   ///< of the blood's edge, see shared_motion
  Levels levels;
  double inside = 0.0;   ///< grey value of blood or, at the tip, of what is blood and muscle
  double fullest = 0.0;  ///< the same while it holds most blood
};

constexpr double faintest = 1.2;  // blood beside muscle; a slice without either is left out later

void find_middle(Work& work) {
  constexpr int rounds = 2;  // of levels along the rays
  const Radii usual = work.levels.muscle;
  for (int round = 0; round <= rounds; ++round) {
    if (round > 0)
      work.levels.muscle = muscle_along(work.values, work.middle, usual, grid);
    work.levels.blood = std::max(work.levels.blood, faintest * work.levels.muscle.maxCoeff());
    work.middle.clear();
    for (std::size_t t = 0; t < work.values.size(); ++t)
      work.middle.push_back(middle_of_wall(work.values[t], work.blood[t], work.levels));
  }
}

/// Sees in the blood's edges how far the motion stands off between frames.
void see_motion(std::vector<Work>& work) {
  std::vector<std::vector<double>> radii;
  for (const Work& slice : work) {
    radii.emplace_back();
    for (const Radii& blood : slice.blood)
      radii.back().push_back(blood.mean());
  }
  for (std::size_t s = 0; s < work.size(); ++s)
    work[s].motion = shared_motion(radii, s);
}

void find_epicardium(Work& work) {
  std::vector<Polar> costs;
  for (std::size_t t = 0; t < work.values.size(); ++t)
    costs.push_back(epicardial_cost(work.values[t], work.middle[t], work.levels));
  work.epi = epicardium(costs, work.motion);
}

void find_borders(Work& work, double fall) {
  find_epicardium(work);
  for (std::size_t t = 0; t < work.values.size(); ++t) {
    const Radii outside = harmonics_of(work.epi[t], epi_harmonics).min(work.middle[t] + 3.0);
    work.endo.push_back(endocardium(work.values[t], outside, work.levels, fall));
  }
}

/// How thick the wall is along a ray in a frame [mm]: the median of a slice and those beside it.
Radii usual_thickness(const std::vector<Work>& work, std::size_t s, std::size_t t) {
  const auto at = [&](std::size_t slice) { return work[slice].epi[t] - work[slice].endo[t]; };
  const Radii before = at(s - 1);
  const Radii own = at(s);
  const Radii behind = at(s + 1);
  Radii usual(own.size());
  for (Eigen::Index i = 0; i < own.size(); ++i)
    usual(i) = median({before(i), own(i), behind(i)});
  return usual;
}

/// The epicardium of a frame of a slice once more, close to where a wall as thick as in the slices
/// beside it ends.
Radii epicardium_beside(const std::vector<Work>& work, std::size_t s, std::size_t t) {
  const Work& own = work[s];
  const Radii expected = harmonics_of(own.endo[t] + usual_thickness(work, s, t), epi_harmonics);
  return closed_path(epicardial_cost(own.values[t], own.middle[t], own.levels) + pull_to(expected),
                     epicardial_rule, grid);
}

/// The same of all slices but the first and the last.
void steady_over_slices(std::vector<Work>& work) {
  std::vector<std::vector<Radii>> lines(work.size());
  for (std::size_t s = 1; s + 1 < work.size(); ++s) {
    interrupt::check();
    for (std::size_t t = 0; t < work[s].values.size(); ++t)
      lines[s].push_back(epicardium_beside(work, s, t));
  }
  for (std::size_t s = 1; s + 1 < work.size(); ++s)
    work[s].epi = std::move(lines[s]);
}

/// Whether a slice looks half as much like the heart as the one that does most.
bool looks_like_heart(const Heart& heart, std::size_t s) {
  constexpr double like_seed = 0.5;
  return heart.centres[s].likeness >= like_seed * heart.centres[heart.seed].likeness;
}

/// Fluid that the epicardium of a slice encloses; none unless it is seen round a part of the heart.
Radii fluid_round(const Work& work) {
  constexpr double least_part = 1.0 / 3.0;  // of the circumference
  std::vector<Polar> bright;
  for (const Polar& frame : work.values)
    bright.push_back(brightness(frame, work.levels));
  const Radii fluid = fluid_within(bright, work.endo, work.epi, grid);
  return (fluid > 0.0).cast<double>().mean() < least_part ? Radii(0.0 * fluid) : fluid;
}

/// Draws the epicardium once more, within the fluid, where several slices of the heart show some:
/// it lies round all of it.
void leave_fluid_out(const Heart& heart, std::vector<Work>& work) {
  constexpr std::size_t fewest = 3;
  std::vector<std::size_t> slices;
  std::vector<Radii> fluids;
  for (std::size_t s = 0; s < work.size(); ++s) {
    if (!looks_like_heart(heart, s))
      continue;
    interrupt::check();
    if (const Radii fluid = fluid_round(work[s]); (fluid > 0.0).any()) {
      slices.push_back(s);
      fluids.push_back(fluid);
    }
  }
  for (std::size_t n = 0; n < slices.size() && slices.size() >= fewest; ++n) {
    work[slices[n]].levels.fluid = fluids[n];
    find_epicardium(work[slices[n]]);
  }
}

/// How thick the wall of a slice is along each ray, as a part of its mean: the median over the
/// frames.
Radii shape_of_wall(const Work& work) {
  constexpr double thinnest_part = 0.3;
  Radii shape(grid.rays);
  for (int i = 0; i < grid.rays; ++i) {
    std::vector<double> parts;
    for (std::size_t t = 0; t < work.epi.size(); ++t)
      parts.push_back((work.epi[t](i) - work.endo[t](i)) / (work.epi[t] - work.endo[t]).mean());
    shape(i) = median(std::move(parts));
  }
  return harmonics_of(shape, epi_harmonics).max(thinnest_part);
}

/// The epicardium of a slice once more: as far as the slice is trusted close to where a wall of its
/// shape ends that holds what is expected of each frame, else close to where it is.
std::vector<Radii> epicardium_that_holds(const Work& work, const std::vector<double>& dark,
                                         double trust) {
  constexpr double pull = 3.0;  // of pull_to: at 3 mm as much as the strongest edge
  const Radii shape = shape_of_wall(work);
  std::vector<Radii> lines;
  for (std::size_t t = 0; t < dark.size(); ++t) {
    const Radii usual = shape * (work.epi[t] - work.endo[t]).mean();
    const Radii expected =
        line_that_holds(darkness(work.values[t], work.levels), work.endo[t], usual, dark[t], grid);
    const Polar cost = epicardial_cost(work.values[t], work.middle[t], work.levels) +
                       pull * trust * pull_to(harmonics_of(expected, epi_harmonics)) +
                       pull * (1.0 - trust) * pull_to(harmonics_of(work.epi[t], epi_harmonics));
    lines.push_back(closed_path(cost, epicardial_rule, grid));
  }
  return lines;
}

/// What a slice holds within its epicardium besides blood, per frame [mm^2].
std::vector<double> held_by(const Work& work) {
  std::vector<double> held;
  for (std::size_t t = 0; t < work.values.size(); ++t)
    held.push_back(dark_area(darkness(work.values[t], work.levels),
                             harmonics_of(work.epi[t], epi_harmonics), grid));
  return held;
}

/// The areas of a slice within the middle of its wall, per frame [mm^2].
std::vector<double> within_middle(const Work& work) {
  std::vector<double> areas;
  for (std::size_t t = 0; t < work.endo.size(); ++t)
    areas.push_back(0.5 * (area(work.endo[t]) + area(work.epi[t])));
  return areas;
}

/// The epicardium of slices that look like the heart, given that their muscle keeps its volume.
void keep_muscle(const Heart& heart, std::vector<Work>& work) {
  constexpr std::size_t fewest = 3;  // slices that tell what all do
  std::vector<std::size_t> slices;
  Areas held;
  Areas middles;
  for (std::size_t s = 0; s < work.size(); ++s)
    if (looks_like_heart(heart, s)) {
      slices.push_back(s);
      held.push_back(held_by(work[s]));
      middles.push_back(within_middle(work[s]));
    }
  if (slices.size() < fewest)
    return;
  const Kept kept = kept_areas(held, middles);
  for (std::size_t n = 0; n < slices.size(); ++n) {
    interrupt::check();
    Work& slice = work[slices[n]];
    slice.epi = epicardium_that_holds(slice, kept.areas[n], kept.agreement[n]);
  }
}

/// The shape of a line, as large as another where that one can be trusted.
Radii scaled_to(const Radii& shape, const Radii& seen, const Radii& trusted) {
  std::vector<double> ratios;
  for (Eigen::Index i = 0; i < seen.size(); ++i)
    if (trusted(i) > 0.5)
      ratios.push_back(seen(i) / shape(i));
  return 4 * ratios.size() < static_cast<std::size_t>(seen.size()) ? shape
                                                                   : Radii(median(ratios) * shape);
}

constexpr double walled = 0.5;  // of wall_behind: muscle is seen

/// How the endocardium is made smooth; `sees`: the part of each ray on which muscle is seen.
BorderFit endocardial_fit(const Radii& seen, const Radii& sees, const Radii& expected) {
  constexpr double unseen_weight = 0.05;
  constexpr double trust = 0.1;
  constexpr double unseen_trust = 0.3;
  return {.seen = seen,
          .weight = sees.max(unseen_weight),
          .expected = expected,
          .trust = sees * trust + (1.0 - sees) * unseen_trust,
          .harmonics = 3,
          .within = 0.1,
          .stiffness = 0.3};
}

/// Along which rays muscle is seen outside the endocardium of a frame, 1 or 0. On its way to the
/// larger slice before, half way to it, the wall leans.
Radii seen_wall(const Work& work, std::size_t t, const SliceBorders* inner) {
  const Radii& seen = work.endo[t];
  const double larger = inner == nullptr ? 0.0 : inner->frames[t].endo.mean() - seen.mean();
  const Radii wall = wall_behind(work.values[t], seen, work.levels, 0.5 * std::max(0.0, larger));
  return (wall > walled).cast<double>();
}

/// The endocardium of a slice as it is drawn; `sees`: see seen_wall; `inner` is the slice before
/// it, or null.
std::vector<Radii> drawn_endocardium(const Work& work, const std::vector<Radii>& sees,
                                     const SliceBorders* inner) {
  std::vector<Radii> lines;
  for (std::size_t t = 0; t < work.endo.size(); ++t) {
    const Radii& seen = work.endo[t];
    const Radii shape = inner == nullptr ? seen : scaled_to(inner->frames[t].endo, seen, sees[t]);
    const Radii expected = closed_straight(shape, seen, sees[t]);
    const Radii smooth = convex(fit_border(endocardial_fit(seen, sees[t], expected)));
    lines.push_back(closed_straight(smooth, smooth, sees[t]));  // where harmonics bulge
  }
  return steady_in_time(lines, work.motion);
}

double part_within(const Radii& a, const Radii& b, double most) {
  return ((a - b).abs() < most).cast<double>().mean();
}

SliceBorders finish(const Work& work, const Pixel& centre, const SliceBorders* inner) {
  constexpr double mostly_muscle = 0.5;
  constexpr double blurred = 1.0;  // [mm]
  std::vector<Radii> walls;
  for (std::size_t t = 0; t < work.endo.size(); ++t)
    walls.push_back(seen_wall(work, t, inner));
  const std::vector<Radii> endo = drawn_endocardium(work, walls, inner);
  const double muscle = work.levels.muscle.mean();
  SliceBorders slice{centre, (work.fullest - muscle) / muscle, 0.0, {}};
  if (work.levels.fluid.size() > 0)
    slice.fluid_part = (work.levels.fluid > 0.0).cast<double>().mean();
  for (std::size_t t = 0; t < endo.size(); ++t) {
    const Radii smooth = harmonics_of(work.epi[t], epi_harmonics);
    const Radii& sees = walls[t];
    const Polar dark = (darkness(work.values[t], work.levels) > mostly_muscle).cast<double>();
    slice.frames.push_back(
        {.endo = endo[t],
         .epi = smooth.max(endo[t] + thinnest),
         .wall_part = sees.mean(),
         .dark_within = dark_area(dark, endo[t] - blurred, grid),
         .endo_agrees = (sees * ((work.endo[t] - endo[t]).abs() < agreement).cast<double>()).mean(),
         .epi_agrees = part_within(work.seen_epi[t], smooth, agreement)});
  }
  return slice;
}

std::vector<Polar> sampled(const image::CineSlice& slice, const Pixel& centre) {
  std::vector<Polar> values;
  for (const image::Picture& frame : slice.frames)
    values.push_back(sample(frame, centre, grid));
  return values;
}

void even_out(std::vector<Polar>& values, const Polar& received) {
  for (Polar& frame : values)
    frame /= received;
}

/// Finds the blood's edge, given its grey value.
void find_blood(Work& work, double level) {
  work.levels.muscle *= level / work.levels.blood;
  work.levels.blood = level;
  work.blood.clear();
  for (const Polar& frame : work.values)
    work.blood.push_back(blood_edge(frame, work.levels));
}

/// The blood that a slice shows.
Work begin(std::vector<Polar> values, double radius) {
  Work work;
  work.values = std::move(values);
  work.levels = guess_levels(work.values, radius, grid);
  work.inside = work.levels.blood;
  work.fullest = fullest_blood(work.values, radius, grid);
  find_blood(work, work.inside);
  return work;
}

/// What all slices show as coils would that receive equally, by what the blood tells of them where
/// a slice looks like the heart.
std::vector<std::vector<Polar>> evened(const image::Cine& cine, const Heart& heart) {
  std::vector<std::vector<Polar>> values;
  for (std::size_t s = 0; s < cine.slices.size(); ++s)
    values.push_back(sampled(cine.slices[s], heart.centres[s].at));
  std::vector<BloodPool> pools;
  for (std::size_t s = 0; s < values.size(); ++s)
    if (looks_like_heart(heart, s))
      pools.push_back({values[s], surely_blood * heart.centres[s].radius});
  const Polar received = sensitivity(coil_gradient(pools, grid), grid);
  for (std::vector<Polar>& slice : values)
    even_out(slice, received);
  return values;
}

/// The grey values of blood and muscle in slices.
struct SeenLevels {
  std::vector<double> blood, muscle;
};

SeenLevels levels_of(const std::vector<Work>& all) {
  SeenLevels seen;
  std::vector<std::vector<double>> outside;
  for (const Work& work : all) {
    outside.push_back(around_blood(work.values, work.blood, grid));
    seen.blood.push_back(work.inside);
  }
  seen.muscle = muscle_levels(outside, seen.blood);
  return seen;
}

/// Slices as they would be with the usual contrast, and the levels that they have then.
SeenLevels to_usual_contrast(std::vector<Work>& all) {
  SeenLevels seen = levels_of(all);
  const Contrast contrast = contrast_of(seen.muscle, seen.blood);
  const auto usual = [&](double v) { return with_usual_contrast(v, contrast); };
  for (std::size_t s = 0; s < all.size(); ++s) {
    interrupt::check();
    for (Polar& frame : all[s].values)
      frame = frame.unaryExpr(usual).eval();
    for (double* level : {&all[s].inside, &all[s].fullest, &seen.blood[s], &seen.muscle[s]})
      *level = usual(*level);
  }
  return seen;
}

/// Learns the muscle's level along each ray from that of the slice.
void learn_round(Work& work, double muscle_of_slice) {
  work.levels.muscle_of_slice = muscle_of_slice;
  work.levels.muscle = muscle_round(work.values, work.blood, muscle_of_slice, grid);
}

std::vector<Work> begin_all(const image::Cine& cine, const Heart& heart) {
  std::vector<std::vector<Polar>> values = evened(cine, heart);
  std::vector<Work> all;
  for (std::size_t s = 0; s < values.size(); ++s) {
    interrupt::check();
    all.push_back(begin(std::move(values[s]), heart.centres[s].radius));
  }
  const SeenLevels seen = to_usual_contrast(all);
  const std::vector<double> whole = whole_blood(seen.blood, seen.muscle);
  for (std::size_t s = 0; s < all.size(); ++s) {
    find_blood(all[s], whole[s]);
    learn_round(all[s], seen.muscle[s]);
  }
  return all;
}

/// How much the blood's mean radius changes per height, in a frame, from the slice before to the
/// one behind.
double slope_at(const std::vector<Work>& work, std::size_t slice, std::size_t frame,
                double spacing) {
  const std::size_t before = slice > 0 ? slice - 1 : slice;
  const std::size_t behind = std::min(slice + 1, work.size() - 1);
  const double change = work[behind].blood[frame].mean() - work[before].blood[frame].mean();
  return std::abs(change) /
         (spacing * static_cast<double>(std::max<std::size_t>(behind - before, 1)));
}

/// The widths of all edges of a study where blood is seen in a wall, as darkness_at_border takes
/// them.
std::vector<double> relative_edge_widths(const image::Cine& cine, const std::vector<Work>& work) {
  constexpr double steepest = 0.5;  // beyond it lies the tip, or no ventricle
  constexpr double seen = 0.5;      // part of the rays with an edge
  const double spacing = image::spacing_of(cine);
  std::vector<double> all;
  for (std::size_t s = 0; s < work.size(); ++s) {
    Levels levels = work[s].levels;
    levels.blood = std::max(work[s].inside, faintest * levels.muscle.maxCoeff());
    for (std::size_t t = 0; t < work[s].values.size(); ++t) {
      const double slope = slope_at(work, s, t, spacing);
      const Radii widths =
          edge_widths(darkness(work[s].values[t], levels), work[s].middle[t], grid);
      if (slope > steepest || (widths > 0.0).cast<double>().mean() < seen)
        continue;
      const double sharp = sharp_width(cine.slices[s].frames[t].plane, grid, slope, spacing);
      for (const double width : widths)
        if (width > 0.0)
          all.push_back(width / sharp);
    }
  }
  return all;
}

/// The borders of slices whose grey levels and the middles of whose walls are known.
std::vector<SliceBorders> drawn_at(const Heart& heart, std::vector<Work> work, double fall) {
  for (Work& slice : work) {
    interrupt::check();
    find_borders(slice, fall);
  }
  leave_fluid_out(heart, work);
  steady_over_slices(work);
  for (Work& slice : work)
    slice.seen_epi = slice.epi;
  keep_muscle(heart, work);
  std::vector<SliceBorders> slices(work.size());
  const auto finish_slice = [&](std::size_t s, const SliceBorders* inner) {
    slices[s] = finish(work[s], heart.centres[s].at, inner);
  };
  finish_slice(heart.seed, nullptr);
  for (std::size_t s = heart.seed + 1; s < work.size(); ++s)
    finish_slice(s, &slices[s - 1]);
  for (std::size_t s = heart.seed; s-- > 0;)
    finish_slice(s, &slices[s + 1]);
  return slices;
}

/// A radius that a border must have on a ray [mm].
struct Held {
  int ray = 0;
  double radius = 0.0;
};

/// The radii of points on the rays nearest to them, in order of the rays; of several on a ray the
/// mean.
std::vector<Held> on_rays(const std::vector<PolarPoint>& points) {
  std::map<int, std::vector<double>> radii;
  for (const PolarPoint& p : points)
    radii[nearest_ray(p.angle, grid.rays)].push_back(p.radius);
  std::vector<Held> held;
  for (const auto& [ray, all] : radii)
    held.push_back(
        {ray, std::accumulate(all.begin(), all.end(), 0.0) / static_cast<double>(all.size())});
  return held;
}

Fixes on_grid(const std::vector<Held>& held) {
  Fixes fixed;
  for (const Held& at : held)
    fixed.push_back({at.ray, grid.index(at.radius)});
  return fixed;
}

double mean_radius(const std::vector<Held>& held) {
  double sum = 0.0;
  for (const Held& at : held)
    sum += at.radius;
  return sum / static_cast<double>(held.size());
}

/// A line bent so that it runs through points: what one asks for alone dies away with the angle phi
/// from it as (1 + a) exp(-a), a = phi/15 degrees, of which the half is left after 25 degrees.
Radii bent_through(const Radii& line, const std::vector<Held>& held) {
  constexpr double width = std::numbers::pi / 12.0;
  const auto n = static_cast<Eigen::Index>(held.size());
  const auto likeness = [&](Eigen::Index a, Eigen::Index b) {
    const Eigen::Index apart = std::abs(a - b);
    const double phi = ray_angle(std::min<Eigen::Index>(apart, grid.rays - apart), grid.rays);
    return (1.0 + phi / width) * std::exp(-phi / width);
  };
  Eigen::MatrixXd K(n, n);
  Eigen::VectorXd off(n);
  for (Eigen::Index a = 0; a < n; ++a) {
    const Held& at = held[static_cast<std::size_t>(a)];
    off(a) = at.radius - line(at.ray);
    for (Eigen::Index b = 0; b < n; ++b)
      K(a, b) = likeness(at.ray, held[static_cast<std::size_t>(b)].ray);
  }
  const Eigen::VectorXd weight = dense::solve_symmetric(K, off);
  Radii bent = line;
  for (Eigen::Index i = 0; i < bent.size(); ++i)
    for (Eigen::Index a = 0; a < n; ++a)
      bent(i) += weight(a) * likeness(i, held[static_cast<std::size_t>(a)].ray);
  return bent;
}

/// A slice whose grey levels are known, and a frame of it.
struct Frame {
  const Work& work;
  std::size_t t;

  [[nodiscard]] const Polar& values() const { return work.values[t]; }
};

Radii redrawn_endocardium(const Frame& frame, const Radii& expected, const std::vector<Held>& held,
                          double fall) {
  const Levels& levels = frame.work.levels;
  const Polar& values = frame.values();
  const Fixes fixed = on_grid(held);
  const Radii blood = blood_edge(values, levels, fixed);
  const Radii middle = middle_of_wall(values, blood, levels);
  const Radii outside =
      closed_path(epicardial_cost(values, middle, levels), epicardial_rule, grid).min(middle + 3.0);
  const Radii seen = endocardium(values, outside, levels, fall, fixed);
  const Radii sees = (wall_behind(values, seen, levels) > walled).cast<double>();
  return bent_through(convex(fit_border(endocardial_fit(seen, sees, expected))), held);
}

Radii redrawn_epicardium(const Frame& frame, const std::optional<Radii>& endo,
                         const Radii& expected, const std::vector<Held>& held) {
  const Levels& levels = frame.work.levels;
  const Polar& values = frame.values();
  const Fixes fixed = on_grid(held);
  const Radii blood = endo ? *endo : blood_edge(values, levels);
  const Radii middle = middle_of_wall(values, blood, levels, fixed);
  const Radii seen = closed_path(epicardial_cost(values, middle, levels) + pull_to(expected),
                                 epicardial_rule, grid, fixed);
  return bent_through(harmonics_of(seen, epi_harmonics), held);
}

}  // namespace

double area_of_wall(const FrameBorders& borders) {
  return area(borders.epi) - area(borders.endo);
}

Radii redraw_border(const image::CineSlice& slice, const Redrawing& asked, double fall) {
  std::vector<Polar> values = sampled(slice, asked.centre.at);
  even_out(values,
           sensitivity(coil_gradient({{values, surely_blood * asked.centre.radius}}, grid), grid));
  std::vector<Work> alone;
  alone.push_back(begin(std::move(values), asked.centre.radius));
  const SeenLevels seen = to_usual_contrast(alone);
  Work& work = alone.front();
  find_blood(work, seen.blood.front());
  learn_round(work, seen.muscle.front());
  find_middle(work);
  const Frame frame{work, asked.frame};
  const std::vector<Held> held = on_rays(asked.points);
  const bool inner = asked.side == geometry::Side::endo;
  const Radii stands =
      (inner ? asked.endo : asked.epi).value_or(Radii::Constant(grid.rays, mean_radius(held)));
  const Radii expected = bent_through(stands, held);
  const Radii drawn = inner ? redrawn_endocardium(frame, expected, held, fall)
                            : redrawn_epicardium(frame, asked.endo, expected, held);
  return drawn.max(grid.first);
}

Drawn draw_borders(const image::Cine& cine, const Heart& heart, const std::optional<double>& fall) {
  std::vector<Work> work = begin_all(cine, heart);
  for (Work& slice : work) {
    interrupt::check();
    find_middle(slice);
  }
  see_motion(work);
  const BorderDarkness border =
      fall ? BorderDarkness{*fall, *fall} : darkness_at_border(relative_edge_widths(cine, work));
  Drawn drawn{{}, border.likely, border.if_sharp, {}};
  if (border.likely <= edge_begins && border.if_sharp > border.likely)
    drawn.if_sharp = drawn_at(heart, work, border.if_sharp);
  drawn.slices = drawn_at(heart, std::move(work), border.likely);
  return drawn;
}

}  // namespace lv::segment
