#include "lv/image/cut_base.hpp"

#include "lv/image/plane_mask.hpp"

#include <Eigen/Core>
#include <fmt/format.h>

#include <algorithm>
#include <numeric>

namespace lv::image {
namespace {

using Vec2 = Eigen::Vector2d;

constexpr double noticed = 0.1;       // of the cavity below: less is how it narrows, and a breath
constexpr double most_lost = 0.5;     // of it: the plane base then lies above the slice
constexpr double least_open = 0.15;   // of the cavity's edge: a cut at a tenth leaves 24%
constexpr double least_within = 0.8;  // of the cavity, within the ventricle below
constexpr double speck = 0.05;        // of the cavity below
constexpr std::ptrdiff_t least_left = 3;  // slices
constexpr float nothing = -1.0F;          // no label

/// What the pixels of a slice are.
struct LabelledSlice {
  PlaneMask cavity;  ///< with what it encloses
  PlaneMask muscle;

  [[nodiscard]] bool is_rest(std::size_t p) const {
    return cavity.inside[p] == 0 && muscle.inside[p] == 0;
  }
};

/// The cavity below that is neither cavity nor muscle here.
PlaneMask lost_from(const LabelledSlice& below, const LabelledSlice& here) {
  PlaneMask lost = below.cavity;
  for (std::size_t p = 0; p < lost.inside.size(); ++p)
    lost.inside[p] &= here.is_rest(p) ? 1 : 0;
  return lost;
}

double share(std::size_t pixels, std::size_t of) {
  return of == 0 ? 0.0 : static_cast<double>(pixels) / static_cast<double>(of);
}

/// Whether a slice may be one that a plane has cut.
bool is_open_part_of(const LabelledSlice& here, const LabelledSlice& below) {
  std::size_t within = 0;
  for (std::size_t p = 0; p < here.cavity.inside.size(); ++p)
    within += here.cavity.inside[p] != 0 && !below.is_rest(p) ? 1 : 0;
  return here.muscle.count() > 0 && 1.0 - part_of_edge_on(here.muscle, here.cavity) >= least_open &&
         share(within, here.cavity.count()) >= least_within;
}

Vec2 place_of_pixel(const PlaneMask& mask, std::size_t p) {
  const auto columns = static_cast<std::size_t>(mask.columns);
  const std::size_t row = p / columns;
  return {static_cast<double>(p % columns), static_cast<double>(row)};
}

Vec2 middle_pixel(const PlaneMask& mask) {
  Vec2 sum = Vec2::Zero();
  for (std::size_t p = 0; p < mask.inside.size(); ++p)
    if (mask.inside[p] != 0)
      sum += place_of_pixel(mask, p);
  return sum / static_cast<double>(mask.count());
}

/// A slice as it would be without the cut: what is lost of the cavity, and the muscle below that
/// lies beyond the line across the middle of both which has as much of the cavity below beyond it.
LabelledSlice made_whole(const LabelledSlice& here, const LabelledSlice& below,
                         const PlaneMask& lost) {
  LabelledSlice whole = here;
  if (lost.count() == 0)
    return whole;
  PlaneMask kept = below.cavity;
  for (std::size_t p = 0; p < kept.inside.size(); ++p)
    kept.inside[p] &= 1 - lost.inside[p];
  const Vec2 beyond = middle_pixel(lost) - middle_pixel(kept);
  std::vector<double> reach;
  for (std::size_t p = 0; p < below.cavity.inside.size(); ++p)
    if (below.cavity.inside[p] != 0)
      reach.push_back(place_of_pixel(lost, p).dot(beyond));
  const auto line = reach.end() - static_cast<std::ptrdiff_t>(lost.count());
  std::nth_element(reach.begin(), line, reach.end());
  for (std::size_t p = 0; p < lost.inside.size(); ++p) {
    whole.cavity.inside[p] |= lost.inside[p];
    if (here.is_rest(p) && below.muscle.inside[p] != 0 &&
        place_of_pixel(lost, p).dot(beyond) >= *line)
      whole.muscle.inside[p] = 1;
  }
  return whole;
}

/// A slice that the base cuts.
struct CutSlice {
  std::size_t slice;
  double lost;          ///< of the cavity below
  LabelledSlice whole;  ///< without the cut
};

/// Slices with a cavity from the apex to the base.
std::vector<std::size_t> towards_base(const std::vector<LabelledSlice>& slices) {
  std::vector<std::size_t> shown;
  for (std::size_t s = 0; s < slices.size(); ++s)
    if (slices[s].cavity.count() > 0)
      shown.push_back(s);
  const auto half = static_cast<std::ptrdiff_t>(shown.size() / 2);
  const auto sum = [&](auto first, auto last) {
    return std::accumulate(first, last, std::size_t{0}, [&](std::size_t total, std::size_t s) {
      return total + slices[s].cavity.count();
    });
  };
  if (sum(shown.begin(), shown.begin() + half) > sum(shown.end() - half, shown.end()))
    std::reverse(shown.begin(), shown.end());
  return shown;
}

/// Those at the end of a row from apex to base, which a plane base cuts one after another.
std::vector<CutSlice> cut_slices(const std::vector<LabelledSlice>& slices,
                                 const std::vector<std::size_t>& row) {
  std::vector<CutSlice> cut;
  const std::size_t first = row.size() / 2;
  LabelledSlice below = slices[row[first]];
  for (std::size_t n = first + 1; n < row.size(); ++n) {
    const LabelledSlice& here = slices[row[n]];
    if (!is_open_part_of(here, below)) {
      if (share(here.cavity.count(), below.cavity.count()) < speck)
        break;
      cut.clear();
      below = here;
      continue;
    }
    const PlaneMask lost = lost_from(below, here);
    const double part = share(lost.count(), below.cavity.count());
    LabelledSlice whole = made_whole(here, below, lost);
    below = whole;
    if (part >= noticed)
      cut.push_back({row[n], part, std::move(whole)});
    else
      cut.clear();
  }
  return cut;
}

}  // namespace

CutBase mend_cut_base(std::vector<Picture>& pictures, const std::vector<int>& cavity,
                      const std::vector<int>& muscle, double slab) {
  std::vector<LabelledSlice> slices;
  for (const Picture& picture : pictures)
    slices.push_back({filled(mask_of(picture, cavity)), mask_of(picture, muscle)});
  const std::vector<std::size_t> row = towards_base(slices);
  CutBase found;
  if (static_cast<std::ptrdiff_t>(row.size()) <= least_left)
    return found;
  const std::vector<CutSlice> cut = cut_slices(slices, row);
  if (static_cast<std::ptrdiff_t>(row.size() - cut.size()) < least_left)
    return found;
  for (const CutSlice& c : cut) {
    found.slices.push_back(c.slice);
    Picture& picture = pictures[c.slice];
    const LabelledSlice& here = slices[c.slice];
    const double voxel = picture.plane.spacing_i * picture.plane.spacing_j * slab;
    const auto ml = [&](std::size_t pixels) { return 1e-3 * voxel * static_cast<double>(pixels); };
    const std::string what = fmt::format(
        "slice {}: the base cuts it: where {:.0f}% of the cavity below lies there is neither "
        "cavity nor muscle",
        c.slice + 1, 100.0 * c.lost);
    if (c.lost > most_lost) {
      found.left_out += 1e3 * ml(here.cavity.count());
      found.notes.push_back(
          fmt::format("{}: left out, with {:.1f} ml of cavity and {:.1f} ml of muscle", what,
                      ml(here.cavity.count()), ml(here.muscle.count())));
      for (std::size_t p = 0; p < picture.values.size(); ++p)
        if (!here.is_rest(p))
          picture.values[p] = nothing;
      continue;
    }
    const std::size_t more = c.whole.cavity.count() - here.cavity.count();
    found.added += 1e3 * ml(more);
    found.notes.push_back(
        fmt::format("{}: the wall is taken as on the slices below there, {:.1f} ml of cavity and "
                    "{:.1f} ml of muscle more",
                    what, ml(more), ml(c.whole.muscle.count() - here.muscle.count())));
    for (std::size_t p = 0; p < picture.values.size(); ++p)
      if (here.is_rest(p) && !c.whole.is_rest(p))
        picture.values[p] =
            static_cast<float>(c.whole.cavity.inside[p] != 0 ? cavity.front() : muscle.front());
  }
  return found;
}

}  // namespace lv::image
