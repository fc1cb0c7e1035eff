#include "lv/image/label_contours.hpp"

#include "lv/base/check.hpp"
#include "lv/base/median.hpp"
#include "lv/image/cut_base.hpp"
#include "lv/image/lookup.hpp"
#include "lv/image/plane_mask.hpp"
#include "lv/image/short_axis_labels.hpp"

#include <Eigen/Eigenvalues>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <utility>

namespace lv::image {
namespace {

using geometry::Contour;
using geometry::Side;
using Vec2 = Eigen::Vector2d;

constexpr double largest_island = 0.2;          // of the largest part
constexpr double largest_hole = 0.3;            // of the filled cavity
constexpr double largest_enclosed_right = 0.5;  // of a slice's right ventricle, within the wall
constexpr double least_enclosed = 0.05;         // of the cavity: less is a slip of the brush
constexpr std::size_t least_border_points = 8;  // of a border
constexpr double noted_angle = 15.0;            // of the slices' normal to the long axis [degrees]
constexpr double largest_obliqueness = 25.0;
constexpr double distinct = 1.25;  // spread along a long axis to that across it

/// "label 3" or "labels 0, 3": those that a part of a slice has.
std::string labels_in(const Picture& picture, const PlaneMask& part) {
  std::set<int> found;
  for (std::size_t p = 0; p < part.inside.size(); ++p)
    if (part.inside[p] != 0)
      found.insert(static_cast<int>(picture.values[p]));
  return fmt::format("label{} {}", found.size() == 1 ? "" : "s", fmt::join(found, ", "));
}

PlaneMask united(const PlaneMask& a, const PlaneMask& b) {
  PlaneMask both = a;
  for (std::size_t p = 0; p < both.inside.size(); ++p)
    both.inside[p] |= b.inside[p];
  return both;
}

/// Moments of points in space, about the origin.
struct Moments {
  double zeroth = 0.0;
  Vec3 first = Vec3::Zero();
  Mat3 second = Mat3::Zero();

  void add(const Moments& other) {
    zeroth += other.zeroth;
    first += other.first;
    second += other.second;
  }
  [[nodiscard]] Mat3 covariance() const {
    const Vec3 mean = first / zeroth;
    return second / zeroth - mean * mean.transpose();
  }
};

/// The moments of the same points, moved until their middle lies at x.
Moments moved_to(const Moments& m, const Vec3& x) {
  return {m.zeroth, m.zeroth * x, m.zeroth * (m.covariance() + x * x.transpose())};
}

Moments moments(const PlaneMask& mask, const Plane& plane) {
  Moments m;
  for (int j = 0; j < mask.rows; ++j)
    for (int i = 0; i < mask.columns; ++i)
      if (mask.at(i, j)) {
        const Vec3 x = plane.point(i, j);
        m.add({1.0, x, x * x.transpose()});
      }
  return m;
}

bool touches_edge(const PlaneMask& mask) {
  for (int j = 0; j < mask.rows; ++j)
    for (int i = 0; i < mask.columns; ++i)
      if ((i == 0 || j == 0 || i == mask.columns - 1 || j == mask.rows - 1) && mask.at(i, j))
        return true;
  return false;
}

/// One slice while its borders are drawn.
struct Slice {
  int number = 0;
  Plane plane;
  PixelLoop endo, epi;
  Moments cavity;

  [[nodiscard]] double pixel_area() const { return plane.spacing_i * plane.spacing_j; }
};

/// Draws the borders of one slice.
class Tracer {
 public:
  Tracer(const Volume& volume, const LabelMeaning& meaning, std::vector<std::string>& notes)
      : volume_(volume), meaning_(meaning), notes_(notes) {}

  Slice trace(const Picture& picture, int number) {
    Slice slice{number, picture.plane, {}, {}, {}};
    const PlaneMask cavity = trace_cavity(picture, slice);
    slice.cavity = moments(cavity, slice.plane);
    trace_body(picture, cavity, slice);
    return slice;
  }

 private:
  [[noreturn]] void refuse(const Slice& slice, const std::string& what, const char* remedy) const {
    throw InputError(volume_.file, fmt::format("slice {}: {}", slice.number, what), remedy);
  }

  void note(const Slice& slice, const std::string& what) {
    notes_.push_back(fmt::format("slice {}: {}", slice.number, what));
  }

  /// The largest part; the others are dropped or refused.
  PlaneMask largest(const PlaneMask& mask, const Slice& slice, const char* of) {
    std::vector<PlaneMask> found = parts(mask);
    if (found.empty())
      return mask;
    if (found.size() > 1) {
      const double second = static_cast<double>(found[1].count()) * slice.pixel_area();
      const double first = static_cast<double>(found[0].count()) * slice.pixel_area();
      if (second >= largest_island * first && outline(found[0]).size() >= least_border_points)
        refuse(slice,
               fmt::format("{} is in {} parts, the largest of {:.0f} and {:.0f} mm2", of,
                           found.size(), first, second),
               "One left ventricle hangs together: correct the label map there");
      note(slice,
           fmt::format("{} island{} of {}, {:.0f} mm2 in all, dropped", found.size() - 1,
                       found.size() == 2 ? "" : "s", of,
                       static_cast<double>(mask.count() - found[0].count()) * slice.pixel_area()));
    }
    return std::move(found.front());
  }

  PlaneMask trace_cavity(const Picture& picture, Slice& slice) {
    PlaneMask labelled = mask_of(picture, meaning_.cavity);
    if (labelled.count() == 0)
      return labelled;
    const PlaneMask part = largest(labelled, slice, "the cavity");
    PlaneMask cavity = filled(part);
    const auto enclosed = static_cast<double>(cavity.count() - part.count());
    const auto whole = static_cast<double>(cavity.count());
    if (enclosed > largest_hole * whole)
      refuse(
          slice,
          fmt::format("{:.0f}% of what the cavity encloses is not cavity", 100 * enclosed / whole),
          "The labels of cavity and muscle seem swapped");
    if (enclosed > 0.0)
      note(slice,
           fmt::format("{:.0f} mm2 inside the cavity (papillary muscles or holes) count to it",
                       enclosed * slice.pixel_area()));
    slice.endo = outline(cavity);
    if (slice.endo.size() >= least_border_points)
      return cavity;
    note(slice, fmt::format("a cavity of {:.0f} mm2 is too small for a border: left out",
                            whole * slice.pixel_area()));
    slice.endo.clear();
    return cavity;
  }

  /// Refuses labels by which muscle surrounds the right ventricle and not the cavity.
  void refuse_exchanged(const Picture& picture, const PlaneMask& right, const PlaneMask& cavity,
                        const Slice& slice) const {
    constexpr double all_round = 0.8;  // of the edge
    constexpr double in_part = 0.6;
    const PlaneMask muscle = mask_of(picture, meaning_.muscle);
    if (part_of_edge_on(muscle, right) > all_round && part_of_edge_on(muscle, cavity) < in_part)
      refuse(slice,
             fmt::format("muscle surrounds what anatomy.labels.right_ventricle names ({}), and not "
                         "what anatomy.labels.cavity names",
                         labels_in(picture, right)),
             "The labels of cavity and right ventricle seem exchanged");
  }

  /// What the wall encloses belongs to it, but for a right ventricle, whose own wall closes round
  /// it, and for holes too large to be slips of the brush.
  void fill_holes(const Picture& picture, const PlaneMask& body, const PlaneMask& part,
                  const PlaneMask& cavity, const Slice& slice) {
    PlaneMask hole = body;
    for (std::size_t p = 0; p < hole.inside.size(); ++p)
      if (part.inside[p] != 0)
        hole.inside[p] = 0;
    const PlaneMask right = mask_of(picture, meaning_.right_ventricle);
    PlaneMask enclosed = right;
    for (std::size_t p = 0; p < enclosed.inside.size(); ++p)
      enclosed.inside[p] &= hole.inside[p];
    const std::size_t of_right = enclosed.count();
    const auto mm2 = [&](std::size_t pixels) {
      return static_cast<double>(pixels) * slice.pixel_area();
    };
    const auto share = [](std::size_t pixels, std::size_t of) {
      return static_cast<double>(pixels) / static_cast<double>(std::max<std::size_t>(of, 1));
    };
    if (share(of_right, right.count()) > largest_enclosed_right &&
        share(of_right, cavity.count()) > least_enclosed) {
      refuse_exchanged(picture, right, cavity, slice);
      refuse(slice,
             fmt::format("the wall encloses {:.0f} mm2 of what anatomy.labels.right_ventricle "
                         "names ({}): they would count to the wall",
                         mm2(of_right), labels_in(picture, enclosed)),
             "anatomy.labels.muscle seems to hold the right ventricle's muscle: list that of the "
             "left ventricle alone");
    }
    if (cavity.count() > 0 && share(hole.count(), body.count()) >= largest_island)
      refuse(slice,
             fmt::format("the wall encloses a hole of {:.0f} mm2, {:.0f}% of all within the "
                         "epicardium ({}): it would count to the wall",
                         mm2(hole.count()), 100.0 * share(hole.count(), body.count()),
                         labels_in(picture, hole)),
             "If it is muscle, as a scar is, list its label under anatomy.labels.muscle; if it is "
             "the right ventricle, list the left one's muscle alone");
    note(slice,
         fmt::format("holes of {:.0f} mm2 in the wall filled{}", mm2(hole.count()),
                     of_right == 0 ? ""
                                   : fmt::format(", {:.0f} mm2 of them labelled as right "
                                                 "ventricle ({})",
                                                 mm2(of_right), labels_in(picture, enclosed))));
  }

  void trace_body(const Picture& picture, const PlaneMask& cavity, Slice& slice) {
    const PlaneMask muscle = mask_of(picture, meaning_.muscle);
    if (muscle.count() == 0) {
      if (!slice.endo.empty())
        note(slice, "no muscle is labelled: no epicardium");
      return;
    }
    const PlaneMask part = largest(united(cavity, muscle), slice, "the wall");
    const PlaneMask body = filled(part);
    if (touches_edge(body))
      note(slice, "the wall reaches the edge of the image; what lies beyond is missing");
    if (body.count() > part.count())
      fill_holes(picture, body, part, cavity, slice);
    slice.epi = outline(body);
    if (slice.epi.size() < least_border_points)
      slice.epi.clear();
  }

  const Volume& volume_;
  const LabelMeaning& meaning_;
  std::vector<std::string>& notes_;
};

/// A run of neighbouring slices with a cavity, [first, last].
struct Run {
  std::size_t first, last;
  double area;
};

std::vector<Run> runs_of(const std::vector<Slice>& slices) {
  std::vector<Run> runs;
  for (std::size_t s = 0; s < slices.size(); ++s) {
    if (slices[s].endo.empty())
      continue;
    constexpr std::size_t bridged = 2;  // one slice between
    if (runs.empty() || s - runs.back().last > bridged)
      runs.push_back({s, s, 0.0});
    runs.back().last = s;
    runs.back().area += area(slices[s].endo);
  }
  return runs;
}

/// The slices of the cavity; smaller parts far from it are dropped.
Run main_run(std::vector<Slice>& slices, const std::string& file, std::vector<std::string>& notes) {
  const std::vector<Run> runs = runs_of(slices);
  if (runs.empty())
    throw InputError(file, "no slice shows a cavity", "Check the labels and the frame");
  const Run main = *std::max_element(runs.begin(), runs.end(),
                                     [](const Run& a, const Run& b) { return a.area < b.area; });
  for (const Run& run : runs) {
    if (run.first == main.first)
      continue;
    const std::string where = fmt::format("slices {} to {}", run.first + 1, run.last + 1);
    if (run.area >= largest_island * main.area)
      throw InputError(file,
                       fmt::format("the cavity is in parts: slices {} to {} and {} are more than "
                                   "one slice apart",
                                   main.first + 1, main.last + 1, where),
                       "Label the slices between, or remove the part that is not the ventricle");
    notes.push_back(fmt::format("{}: a part of the cavity apart from the rest dropped", where));
    for (std::size_t s = run.first; s <= run.last; ++s)
      slices[s].endo.clear();
  }
  for (std::size_t s = main.first; s <= main.last; ++s)
    if (slices[s].endo.empty()) {
      notes.push_back(fmt::format("slice {}: no cavity between slices with one: left out", s + 1));
      slices[s].epi.clear();
    }
  return main;
}

/// How the middle of the cavity moves along one direction per step along another: the median over
/// all pairs of slices (H. Theil 1950, P.K. Sen 1968), which one jump of the breath does not turn.
double usual_slope(const std::vector<Vec3>& middles, const Vec3& direction, const Vec3& normal) {
  std::vector<double> slopes;
  for (std::size_t i = 0; i < middles.size(); ++i)
    for (std::size_t j = i + 1; j < middles.size(); ++j) {
      const Vec3 step = middles[j] - middles[i];
      slopes.push_back(step.dot(direction) / step.dot(normal));
    }
  return median(std::move(slopes));
}

/// The moments of the cavity with each slice moved in its plane onto the line that the middles of
/// most follow.
Moments moments_on_line(const std::vector<Slice>& slices) {
  const Plane& plane = slices.front().plane;
  const Vec3 normal = plane.normal();
  std::vector<Vec3> middles;
  for (const Slice& slice : slices)
    middles.emplace_back(slice.cavity.first / slice.cavity.zeroth);
  const Vec3 along = normal + usual_slope(middles, plane.along_row, normal) * plane.along_row +
                     usual_slope(middles, plane.along_column, normal) * plane.along_column;
  Moments all;
  for (std::size_t s = 0; s < slices.size(); ++s) {
    const Vec3 on_line = middles.front() + (middles[s] - middles.front()).dot(normal) * along;
    all.add(moved_to(slices[s].cavity, on_line));
  }
  return all;
}

/// The angle [degrees] between a direction and that in which points spread most, where they are
/// clearly longer than wide and nearly round across: of a stack of a few slices nothing can be
/// said.
std::optional<double> angle_to_spread(const Moments& points, const Vec3& direction) {
  const Eigen::SelfAdjointEigenSolver<Mat3> axes(points.covariance());
  const Vec3 spread = axes.eigenvalues().cwiseMax(0.0).cwiseSqrt();
  if (spread[2] < distinct * spread[1] || spread[2] * spread[0] < spread[1] * spread[1])
    return {};
  const double cosine = std::abs(axes.eigenvectors().col(2).dot(direction));
  return std::acos(std::min(1.0, cosine)) * 180.0 / std::numbers::pi;
}

/// The cavity of a slice that the base cuts, before it was made whole or left out.
struct Cut {
  std::size_t slice;
  Moments cavity;
};

/// The slices of the run that show a cavity, and those that the base cuts, as they were drawn.
std::vector<Slice> shown_of(std::vector<Slice> slices, const Run& run,
                            const std::vector<Cut>& cut) {
  std::vector<bool> counts(slices.size(), false);
  for (std::size_t s = run.first; s <= run.last; ++s)
    counts[s] = true;
  for (const Cut& c : cut) {
    slices[c.slice].cavity = c.cavity;
    counts[c.slice] = true;
  }
  std::vector<Slice> shown;
  for (std::size_t s = 0; s < slices.size(); ++s)
    if (counts[s] && slices[s].cavity.zeroth > 0.0)
      shown.push_back(slices[s]);
  return shown;
}

/// Notes or refuses slices that do not lie across the long axis, which is taken as the direction in
/// which the cavity spreads most: as it is, or with its slices on one line if that is less oblique,
/// since a jump of the breath turns the former and a slice cut by the base's edge the latter.
void check_across(const std::vector<Slice>& shown, const std::string& file,
                  std::vector<std::string>& notes) {
  if (shown.size() < 2)
    return;
  const Vec3 normal = shown.front().plane.normal();
  Moments as_it_is;
  for (const Slice& slice : shown)
    as_it_is.add(slice.cavity);
  const auto seen = angle_to_spread(as_it_is, normal);
  if (!seen)
    return;
  const double angle =
      std::min(*seen, angle_to_spread(moments_on_line(shown), normal).value_or(*seen));
  const std::string what = fmt::format(
      "the normal of the slices lies {:.0f} degrees from the long axis of the cavity", angle);
  if (angle > largest_obliqueness)
    throw InputError(file, fmt::format("{}; at most {:g} are allowed", what, largest_obliqueness),
                     "Resample the label map to slices across the long axis of the ventricle");
  if (angle > noted_angle)
    notes.push_back(what +
                    ": base, apex and regions are the less certain; resample the label map "
                    "to slices across the long axis");
}

/// Keeps the epicardium of slices without a cavity only where they continue the apex.
void keep_apical_muscle(std::vector<Slice>& slices, const Run& run,
                        std::vector<std::string>& notes) {
  const bool apex_first = area(slices[run.first].endo) < area(slices[run.last].endo);
  const auto last = static_cast<std::ptrdiff_t>(slices.size()) - 1;
  std::ptrdiff_t s = apex_first ? static_cast<std::ptrdiff_t>(run.first) - 1
                                : static_cast<std::ptrdiff_t>(run.last) + 1;
  std::vector<bool> keep(slices.size(), false);
  for (; s >= 0 && s <= last && !slices[s].epi.empty(); s += apex_first ? -1 : 1)
    keep[s] = true;
  for (std::size_t k = 0; k < slices.size(); ++k)
    if ((k < run.first || k > run.last) && !keep[k] && !slices[k].epi.empty()) {
      notes.push_back(
          fmt::format("slice {}: muscle without cavity away from the apex: left out", k + 1));
      slices[k].epi.clear();
    } else if (keep[k]) {
      notes.push_back(fmt::format("slice {}: muscle without cavity: beyond the apex", k + 1));
    }
}

Contour contour_of(const Slice& slice, Side side, const std::string& file) {
  Contour contour{slice.number, side, {}, file, {}};
  for (const Vec2& x : side == Side::endo ? slice.endo : slice.epi)
    contour.points.push_back(slice.plane.point(x.x(), x.y()));
  return contour;
}

/// The middle of some labels' voxels.
std::optional<std::array<double, 3>> middle_of(const Volume& volume, const std::vector<int>& labels,
                                               int frame) {
  Vec3 sum = Vec3::Zero();
  double count = 0.0;
  for (int k = 0; k < volume.size[2]; ++k)
    for (int j = 0; j < volume.size[1]; ++j)
      for (int i = 0; i < volume.size[0]; ++i)
        if (is_one_of(volume.at(i, j, k, frame), labels)) {
          sum += Vec3(i, j, k);
          count += 1.0;
        }
  if (count == 0.0)
    return std::nullopt;
  const Vec3 x = volume.point(sum / count);
  return std::array{x.x(), x.y(), x.z()};
}

/// What each pixel of a slice is to the ventricle.
struct Meant {
  PlaneMask cavity, muscle;
};

/// Neighbouring slices with cavity and muscle: how many pairs there are, and which of them are the
/// same, by the number of the first. Two tips may be one stamp of the same brush.
struct Neighbours {
  int pairs = 0;
  std::vector<int> same;
};

Neighbours neighbours_of(const std::vector<Meant>& slices) {
  Neighbours found;
  for (std::size_t s = 0; s + 1 < slices.size(); ++s) {
    const Meant& a = slices[s];
    const Meant& b = slices[s + 1];
    const auto lacks = [](const Meant& m) {
      return m.cavity.count() == 0 || m.muscle.count() == 0;
    };
    if (lacks(a) || lacks(b))
      continue;
    ++found.pairs;
    if (a.muscle.inside == b.muscle.inside && a.cavity.inside == b.cavity.inside)
      found.same.push_back(static_cast<int>(s) + 1);
  }
  return found;
}

/// A slice that was put in twice, or over another, makes a wall that nobody drew. Nobody draws two
/// slices alike to the voxel, but resampling to thinner slices makes them.
void check_alike(const Volume& stack, const std::vector<Picture>& pictures,
                 const LabelMeaning& meaning, LabelContours& traced) {
  constexpr double thin = 3.0;     // [mm]; thinner slices than are drawn on
  constexpr int of_resampled = 4;  // of so many neighbours one is the same, or more
  const double spacing = stack.spacing[slice_axis(stack)];
  if (spacing < thin)
    return;
  std::vector<Meant> slices;
  for (const Picture& picture : pictures)
    slices.push_back({mask_of(picture, meaning.cavity), mask_of(picture, meaning.muscle)});
  const Neighbours found = neighbours_of(slices);
  const auto same = static_cast<int>(found.same.size());
  if (same == 0)
    return;
  if (same > std::max(1, found.pairs / of_resampled)) {
    traced.notes.push_back(
        fmt::format("{} of {} neighbouring slices are the same as the next, voxel for "
                    "voxel: the map seems to be resampled from thicker slices, and the wall has "
                    "their steps; give the slices as they were drawn",
                    same, found.pairs));
    return;
  }
  std::vector<std::string> which;
  double cavity = 0.0;
  for (const int first : found.same) {
    which.push_back(fmt::format("{} and {}", first, first + 1));
    cavity += static_cast<double>(slices[static_cast<std::size_t>(first)].cavity.count()) *
              stack.voxel_volume();
  }
  traced.alike = fmt::format(
      "slices {} of {} are the same, voxel for voxel, as no two slices are drawn: one stands in "
      "another's place, or is in twice, which makes the ventricle {:.1f} mm longer and the cavity "
      "{:.1f} ml larger; look at them in the label map",
      fmt::join(which, ", "), stack.file, spacing * same, 1e-3 * cavity);
}

double volume_of(const Volume& volume, const std::vector<int>& labels, int frame) {
  const std::size_t n = volume.voxels();
  std::size_t count = 0;
  for (std::size_t v = n * frame; v < n * (frame + 1); ++v)
    count += is_one_of(volume.values[v], labels) ? 1 : 0;
  return static_cast<double>(count) * volume.voxel_volume();
}

/// Slices that a base tilted to them cuts, as they were before: the cavity that they show tells
/// where the long axis lies.
std::vector<Cut> mend_base(const Volume& stack, const LabelMeaning& meaning, int frame,
                           std::vector<Picture>& pictures, LabelContours& traced) {
  constexpr double much = 0.05;  // of the cavity
  const double whole = volume_of(stack, meaning.cavity, frame);
  const std::vector<Picture> drawn = pictures;
  const CutBase cut =
      mend_cut_base(pictures, meaning.cavity, meaning.muscle, stack.spacing[slice_axis(stack)]);
  traced.notes.insert(traced.notes.end(), cut.notes.begin(), cut.notes.end());
  if (cut.left_out > much * whole)
    traced.cut_base = fmt::format(
        "the base is tilted to the slices of {}: those that it cuts by more than half are left "
        "out, with {:.1f} ml ({:.0f}%) of the cavity's voxels, and where it cuts others {:.1f} ml "
        "are added; look at the most basal slices",
        stack.file, 1e-3 * cut.left_out, 100.0 * cut.left_out / whole, 1e-3 * cut.added);
  std::vector<Cut> before;
  for (const std::size_t s : cut.slices)
    before.push_back({s, moments(filled(mask_of(drawn[s], meaning.cavity)), drawn[s].plane)});
  return before;
}

}  // namespace

LabelContours trace_labels(const Volume& volume, const LabelMeaning& meaning, int frame) {
  const std::optional<Volume> resampled =
      on_short_axis(volume, meaning.cavity, meaning.muscle, frame);
  const Volume& stack = resampled ? *resampled : volume;
  LabelContours traced;
  traced.notes = stack.notes;
  Tracer tracer(stack, meaning, traced.notes);
  std::vector<Slice> traces;
  int number = 0;
  const int drawn = resampled ? 0 : frame;
  std::vector<Picture> pictures = slices(stack, slice_axis(stack), drawn);
  if (!resampled)
    check_alike(stack, pictures, meaning, traced);
  const std::vector<Cut> cut = mend_base(stack, meaning, drawn, pictures, traced);
  for (const Picture& picture : pictures)
    traces.push_back(tracer.trace(picture, ++number));
  const Run run = main_run(traces, volume.file, traced.notes);
  check_across(shown_of(traces, run, cut), volume.file, traced.notes);
  keep_apical_muscle(traces, run, traced.notes);
  for (const Slice& slice : traces) {
    if (!slice.endo.empty())
      traced.contours.short_axis.push_back(contour_of(slice, Side::endo, volume.file));
    if (!slice.epi.empty())
      traced.contours.short_axis.push_back(contour_of(slice, Side::epi, volume.file));
  }
  traced.cavity = volume_of(volume, meaning.cavity, frame);
  traced.muscle = volume_of(volume, meaning.muscle, frame);
  if (!meaning.right_ventricle.empty())
    traced.septum = middle_of(volume, meaning.right_ventricle, frame);
  return traced;
}

std::vector<double> volume_curve(const Volume& volume, const std::vector<int>& cavity) {
  std::vector<double> volumes;
  for (int f = 0; f < volume.frames; ++f)
    volumes.push_back(volume_of(volume, cavity, f));
  return volumes;
}

Phases propose_phases(const std::vector<double>& volumes) {
  constexpr double grown = 0.1;  // of the stroke volume
  std::vector<int> shown;        // frames without labels say nothing of the heart
  for (std::size_t f = 0; f < volumes.size(); ++f)
    if (volumes[f] > 0.0)
      shown.push_back(static_cast<int>(f));
  if (shown.empty())
    return {};
  const auto smaller = [&](int a, int b) { return volumes[a] < volumes[b]; };
  const auto systole = std::min_element(shown.begin(), shown.end(), smaller);
  Phases phases;
  phases.end_diastole = *std::max_element(shown.begin(), shown.end(), smaller);
  phases.end_systole = *systole;
  phases.early_diastole = *systole;
  const double stroke = volumes[phases.end_diastole] - volumes[phases.end_systole];
  std::rotate(shown.begin(), systole, shown.end());
  for (const int at : shown) {
    if (at == phases.end_diastole)
      break;
    if (at != phases.end_systole && volumes[at] >= volumes[phases.end_systole] + grown * stroke) {
      phases.early_diastole = at;
      break;
    }
  }
  return phases;
}

}  // namespace lv::image
