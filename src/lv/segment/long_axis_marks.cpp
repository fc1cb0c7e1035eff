#include "lv/segment/long_axis_marks.hpp"

#include "lv/base/median.hpp"
#include "lv/segment/closed_path.hpp"
#include "lv/segment/polar.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lv::segment {
namespace {

using geometry::Contour;
using geometry::Side;

constexpr double along_step = 0.75;        // between rows, and places in them [mm]
constexpr double most_spacings_off = 2.2;  // that the wall may end from the most basal loop
constexpr double below_end = 12.0;         // where the wall is looked at [mm]
constexpr double above_end = 8.0;

/// Where the short-axis loops of a slice cut the plane, on either side of the axis.
struct Cut {
  double height = 0.0;           ///< along the axis [mm]
  std::array<double, 2> endo{};  ///< distances from the axis [mm]
  std::array<double, 2> epi{};
};

/// A point of the image by its height along the axis and its distance from it on a side.
struct AxisInPlane {
  Vec3 origin, up, side;

  [[nodiscard]] Vec3 point(double height, int of, double distance) const {
    return origin + height * up + (of == 0 ? -distance : distance) * side;
  }
};

AxisInPlane axis_in(const image::Plane& plane, const geometry::LongAxis& axis) {
  const Vec3 n = plane.normal();
  AxisInPlane flat;
  flat.up = (axis.up - axis.up.dot(n) * n).normalized();
  flat.side = flat.up.cross(n);
  flat.origin = axis.point - plane.pixel(axis.point).z() * n;
  return flat;
}

/// The outermost points on either side where a loop crosses the plane.
struct Crossing {
  double height;
  std::array<double, 2> distance;
};

std::optional<Crossing> crossing_of(const Contour& loop, const image::Plane& plane,
                                    const AxisInPlane& axis) {
  Crossing found{0.0, {-1.0, -1.0}};
  int count = 0;
  for (std::size_t i = 0, j = loop.points.size() - 1; i < loop.points.size(); j = i++) {
    const double a = plane.pixel(loop.points[j]).z();
    const double b = plane.pixel(loop.points[i]).z();
    if ((a < 0.0) == (b < 0.0))
      continue;
    const Vec3 x = loop.points[j] + a / (a - b) * (loop.points[i] - loop.points[j]) - axis.origin;
    const double s = x.dot(axis.side);
    double& distance = found.distance.at(s < 0.0 ? 0 : 1);
    distance = std::max(distance, std::abs(s));
    found.height += x.dot(axis.up);
    ++count;
  }
  if (count == 0 || found.distance[0] <= 0.0 || found.distance[1] <= 0.0)
    return {};
  found.height /= count;
  return found;
}

/// From the base to the apex.
std::vector<Cut> cuts_of(const geometry::Contours& loops, const image::Plane& plane,
                         const AxisInPlane& axis) {
  std::vector<Cut> cuts;
  for (const Contour& loop : loops.short_axis) {
    const Contour* outer = geometry::find(loops.short_axis, loop.slice, Side::epi);
    if (loop.side != Side::endo || outer == nullptr)
      continue;
    const auto endo = crossing_of(loop, plane, axis);
    const auto epi = crossing_of(*outer, plane, axis);
    if (endo && epi)
      cuts.push_back({endo->height, endo->distance, epi->distance});
  }
  std::sort(cuts.begin(), cuts.end(),
            [](const Cut& a, const Cut& b) { return a.height > b.height; });
  return cuts;
}

/// Straight between the cuts, the same beyond the ends.
Cut cut_at(const std::vector<Cut>& cuts, double height) {
  if (height >= cuts.front().height || height <= cuts.back().height)
    return height >= cuts.front().height ? cuts.front() : cuts.back();
  const auto below =
      std::find_if(cuts.begin(), cuts.end(), [&](const Cut& cut) { return cut.height <= height; });
  const Cut& a = *below;
  const Cut& b = *std::prev(below);
  const double w = (height - a.height) / (b.height - a.height);
  Cut between{height, {}, {}};
  for (std::size_t side = 0; side < 2; ++side) {
    between.endo[side] = (1.0 - w) * a.endo[side] + w * b.endo[side];
    between.epi[side] = (1.0 - w) * a.epi[side] + w * b.epi[side];
  }
  return between;
}

/// One long-axis image while its marks are looked for.
struct LongAxisImage {
  const image::Picture* picture;
  AxisInPlane axis;
  std::vector<Cut> cuts;
  double fall = 0.5;  ///< part of the way from blood to muscle at which the endocardium lies
  double blood = 0.0;
  std::array<double, 2> muscle{};

  [[nodiscard]] double grey(double height, int side, double distance) const {
    const Vec3 pixel = picture->plane.pixel(axis.point(height, side, distance));
    return grey_at(*picture, pixel.head<2>());
  }
  /// 0 in blood, 1 in muscle of that side.
  [[nodiscard]] double darkness(double height, int side, double distance) const {
    const std::size_t of = (side == 0) == (distance >= 0.0) ? 0 : 1;
    return (blood - grey(height, side, distance)) / (blood - muscle.at(of));
  }
  /// Whether blood and muscle are told apart.
  [[nodiscard]] bool told() const {
    constexpr double most = 0.7;  // of the blood's grey value
    return std::max(muscle[0], muscle[1]) < most * blood;
  }
};

/// Learns the grey values from the middle of the cavity and of the wall, but for the end slices,
/// which may show an atrium or a tip.
void learn_levels(LongAxisImage& image) {
  constexpr double inner = 0.5;
  constexpr double from = 0.3;  // of the wall's thickness
  constexpr double to = 0.7;
  const std::size_t spare = image.cuts.size() >= 5 ? 1 : 0;
  const double low = image.cuts[image.cuts.size() - 1 - spare].height;
  const double high = image.cuts[spare].height;
  std::vector<double> blood;
  for (int side = 0; side < 2; ++side) {
    std::vector<double> muscle;
    for (double h = low; h <= high; h += along_step) {
      const Cut cut = cut_at(image.cuts, h);
      const double endo = cut.endo.at(side);
      const double wall = cut.epi.at(side) - endo;
      for (double x = 0.0; x < inner * endo; x += along_step)
        blood.push_back(image.grey(h, side, x));
      for (double part = from; part <= to; part += 0.1)
        muscle.push_back(image.grey(h, side, endo + part * wall));
    }
    image.muscle.at(side) = median(std::move(muscle));
  }
  image.blood = median(std::move(blood));
}

/// How much a place speaks for the wall, -1 (blood) to a part of 1, changing its sign where the
/// endocardium lies: dark may be a papillary muscle or a trabecula.
double speaks_for_wall(double darkness, double fall) {
  constexpr double of_dark = 0.25;
  const double beyond = std::clamp(darkness, 0.0, 1.0) - fall;
  return beyond > 0.0 ? of_dark / (1.0 - fall) * beyond : beyond / fall;
}

/// Where values along a line pass a level upwards, nearest to a place and
/// within 2.5 mm of it; none if they do not.
template <class Value>
std::optional<double> passes(double level, double near, const Value& value) {
  constexpr double reach = 2.5;  // [mm]
  constexpr double step = 0.25;
  std::optional<double> best;
  double before = value(near - reach);
  for (double x = near - reach; x < near + reach; x += step) {
    const double after = value(x + step);
    if (before < level && after >= level) {
      const double at = x + step * (level - before) / (after - before);
      if (!best || std::abs(at - near) < std::abs(*best - near))
        best = at;
    }
    before = after;
  }
  return best;
}

/// The blood's edge on a side, as a distance from the axis on every row.
struct EdgeOfBlood {
  double lowest;                 ///< height of the first row
  std::vector<double> distance;  ///< one per row, upwards

  [[nodiscard]] double height(std::size_t row) const {
    return lowest + along_step * static_cast<double>(row);
  }
  [[nodiscard]] std::size_t row(double h) const {
    const double last = static_cast<double>(distance.size()) - 1.0;
    return static_cast<std::size_t>(std::clamp(std::round((h - lowest) / along_step), 0.0, last));
  }
};

/// What it costs the blood's edge to lie so far from where the loops have it on a row: no edge,
/// dark within, and the way. Beside brightness all round, as where the right ventricle or fat meets
/// the atrium, all places cost alike, so that rows without an edge do not draw the others along.
Eigen::ArrayXd cost_of_row(const LongAxisImage& image, int side, double height, double expected,
                           const Eigen::ArrayXd& off) {
  constexpr int beside = 4;            // places that an edge is seen over, 3 mm
  constexpr double edge_weight = 4.0;  // of a whole fall from blood to muscle beside a millimetre
  constexpr double pull = 0.004;       // [1/mm]: breath-holds move slices by some mm
  const auto n = off.size();
  Eigen::ArrayXd dark(n + 2 * beside);
  for (Eigen::Index k = 0; k < dark.size(); ++k) {
    const double x = expected + off(0) + along_step * static_cast<double>(k - beside);
    dark(k) = std::clamp(image.darkness(height, side, x), 0.0, 1.0);
  }
  Eigen::ArrayXd cost = pull * off.square();
  double within = 0.0;
  for (Eigen::Index k = 0; k < n; ++k) {
    const Eigen::Index at = k + beside;
    within += along_step * std::max(speaks_for_wall(dark(at), image.fall), 0.0);
    const double fall =
        dark.segment(at + 1, beside).mean() - dark.segment(at - beside, beside).mean();
    cost(k) += within - edge_weight * std::max(fall, 0.0);
  }
  return cost;
}

EdgeOfBlood edge_of_blood(const LongAxisImage& image, int side, double lowest, double highest) {
  constexpr double inwards = 10.0;  // from where the loops have it [mm]
  constexpr double outwards = 6.0;  // less than a wall, behind which lies the right ventricle
  constexpr PathRule rule{.reach = 1, .stiffness = 0.4};
  const auto rows = static_cast<Eigen::Index>((highest - lowest) / along_step) + 1;
  const auto places = static_cast<Eigen::Index>((inwards + outwards) / along_step) + 1;
  const Eigen::ArrayXd off = Eigen::ArrayXd::LinSpaced(
      places, -inwards, -inwards + along_step * static_cast<double>(places - 1));
  EdgeOfBlood edge{lowest, {}};
  Polar cost(rows, places);
  for (Eigen::Index i = 0; i < rows; ++i) {
    const double h = lowest + along_step * static_cast<double>(i);
    const double expected = cut_at(image.cuts, h).endo.at(side);
    edge.distance.push_back(expected);
    cost.row(i) = cost_of_row(image, side, h, expected, off).transpose();
  }
  const std::vector<int> path = open_path(cost, rule);
  for (std::size_t i = 0; i < path.size(); ++i) {
    double& distance = edge.distance[i];
    distance += off(path[i]);
    const double h = edge.height(i);
    distance = passes(image.fall, distance, [&](double x) {
                 return image.darkness(h, side, x);
               }).value_or(distance);
  }
  return edge;
}

/// How unlike muscle the image is outside an edge, 0 to 1, on every row: brighter by half of the
/// way to blood, or darker by four fifths of the muscle's own, as lung is.
std::vector<double> unlike_muscle(const LongAxisImage& image, int side, const EdgeOfBlood& edge) {
  constexpr double begins = 1.5;  // beyond the blurred edge [mm]
  constexpr double part = 0.65;   // of the wall's thickness
  constexpr double least = 3.5;   // [mm]
  constexpr double brighter = 0.5;
  constexpr double darker = 0.8;
  const double muscle = image.muscle.at(side);
  std::vector<double> unlike;
  for (std::size_t row = 0; row < edge.distance.size(); ++row) {
    const double h = edge.height(row);
    const Cut cut = cut_at(image.cuts, h);
    const double ends = std::max(least, part * (cut.epi.at(side) - cut.endo.at(side)));
    double sum = 0.0;
    int n = 0;
    for (double x = begins; x <= ends; x += 0.5 * along_step, ++n)
      sum += image.grey(h, side, edge.distance[row] + x);
    const double mean = sum / n;
    unlike.push_back(std::min(1.0, mean > muscle
                                       ? (mean - muscle) / (image.blood - muscle) / brighter
                                       : (muscle - mean) / muscle / darker));
  }
  return unlike;
}

/// The height at which the rows change from muscle to something else, between two rows, and the
/// part of the rows near it that agree; none where it lies at the end of the search.
struct EndOfWall {
  double height, confidence;
};

std::optional<EndOfWall> end_of_wall(const std::vector<double>& unlike, const EdgeOfBlood& edge,
                                     double first, double last) {
  const auto rows = [](double mm) { return static_cast<std::size_t>(mm / along_step); };
  const std::size_t from = std::max(edge.row(first), rows(below_end));
  const std::size_t to = std::min(edge.row(last), unlike.size() - 1 - rows(above_end));
  std::size_t best = from;
  double least = 1e9;
  for (std::size_t row = from; row <= to; ++row) {  // the wall ends below this row
    double sum = 0.0;
    for (std::size_t k = row - rows(below_end); k < row; ++k)
      sum += unlike[k];
    for (std::size_t k = row; k < row + rows(above_end); ++k)
      sum += 1.0 - unlike[k];
    if (sum < least) {
      least = sum;
      best = row;
    }
  }
  if (best == from || best >= to)
    return {};
  double agree = 0.0;
  const std::size_t near = rows(above_end);
  for (std::size_t k = 0; k < near; ++k)
    agree += static_cast<double>(unlike[best - 1 - k] < 0.5) +
             static_cast<double>(unlike[best + k] > 0.5);
  // where a half is passed between the rows beside the change
  const double a = unlike[best - 1];
  const double b = unlike[best];
  const double w = b > a ? std::clamp((0.5 - a) / (b - a), 0.0, 1.0) : 0.5;
  return EndOfWall{edge.height(best - 1) + w * along_step, agree / static_cast<double>(2 * near)};
}

std::optional<FoundPoint> annulus_on(const LongAxisImage& image, int side, double spacing) {
  constexpr std::size_t rows_of_edge = 5;
  const double top = image.cuts.front().height;
  const double off = most_spacings_off * spacing;
  const double lowest = std::min(image.cuts[image.cuts.size() / 2].height, top - off - below_end);
  const EdgeOfBlood edge = edge_of_blood(image, side, lowest, top + off + above_end + 1.0);
  const auto end = end_of_wall(unlike_muscle(image, side, edge), edge, top - off, top + off);
  if (!end)
    return {};
  const std::size_t row = edge.row(end->height);
  std::vector<double> near;
  for (std::size_t k = 0; k < rows_of_edge; ++k)
    near.push_back(edge.distance[row - k]);
  return FoundPoint{image.axis.point(end->height, side, median(std::move(near))), end->confidence};
}

/// A fan of rays about the direction to the apex.
struct Fan {
  static constexpr int rays = 41, middle = rays / 2;
  static constexpr double turn = 3.0 * std::numbers::pi / 180.0;
  double height, centre;  ///< where it begins: along the axis, towards side 1 [mm]
  int radii;

  [[nodiscard]] double angle(int ray) const { return turn * (ray - middle); }
  [[nodiscard]] Eigen::Vector2d place(int ray, double radius) const {  // towards side 1, height
    return {centre + radius * std::sin(angle(ray)), height - radius * std::cos(angle(ray))};
  }
};

Fan fan_of(const LongAxisImage& image, double spacing) {
  constexpr double above = 12.0;  // the most apical loop [mm]
  const double last = image.cuts.back().height;
  const Cut cut = cut_at(image.cuts, last + above);
  return {last + above, 0.5 * (cut.endo[1] - cut.endo[0]),
          static_cast<int>((above + 2.0 * spacing) / along_step)};
}

/// Darkness on the rays of a fan.
Polar fan_darkness(const LongAxisImage& image, const Fan& fan) {
  Polar dark(Fan::rays, fan.radii);
  for (int i = 0; i < Fan::rays; ++i)
    for (int k = 0; k < fan.radii; ++k) {
      const Eigen::Vector2d at = fan.place(i, along_step * (k + 1));
      dark(i, k) = image.darkness(at.y(), 1, at.x());
    }
  return dark;
}

/// The path of least cost: dark within counts a quarter, blood within 7 mm outside it wholly.
std::vector<int> edge_in_fan(const Polar& dark, double fall) {
  constexpr int beyond = 9;  // radii
  constexpr PathRule rule{.reach = 2, .stiffness = 0.1};
  Polar cost(dark.rows(), dark.cols());
  for (Eigen::Index i = 0; i < dark.rows(); ++i)
    for (Eigen::Index k = 0; k < dark.cols(); ++k) {
      double sum = 0.0;
      for (Eigen::Index n = 0; n <= k; ++n)
        sum += std::max(speaks_for_wall(dark(i, n), fall), 0.0);
      for (Eigen::Index n = k + 1; n <= std::min(k + beyond, dark.cols() - 1); ++n)
        sum -= std::min(speaks_for_wall(dark(i, n), fall), 0.0);
      cost(i, k) = along_step * sum;
    }
  return open_path(cost, rule);
}

/// The part of the rays round the axis with blood within the path and muscle outside.
double agreement_in_fan(const Polar& dark, const std::vector<int>& path) {
  constexpr int near = 10;  // rays either way
  constexpr int reach = 4;  // radii
  int agree = 0;
  for (int i = Fan::rays / 2 - near; i <= Fan::rays / 2 + near; ++i) {
    const int k = path[static_cast<std::size_t>(i)];
    const int inside = std::max(0, k - reach);
    const int outside = std::min(static_cast<int>(dark.cols()) - 1, k + reach);
    agree += static_cast<int>(dark(i, inside) < 0.4 && dark(i, outside) > 0.6);
  }
  return static_cast<double>(agree) / (2 * near + 1);
}

/// The lowest point of the parabola y = a + b x + c x^2 of least squares through the points within
/// 8 mm beside the lowest; that one itself where the parabola is no bowl.
Eigen::Vector2d lowest_of(const std::vector<Eigen::Vector2d>& edge) {
  constexpr double beside = 8.0;
  const Eigen::Vector2d low = *std::min_element(
      edge.begin(), edge.end(), [](const auto& a, const auto& b) { return a.y() < b.y(); });
  Mat3 normal = Mat3::Zero();
  Vec3 right = Vec3::Zero();
  for (const Eigen::Vector2d& p : edge) {
    const double x = p.x() - low.x();
    if (std::abs(x) > beside)
      continue;
    const Vec3 row(1.0, x, x * x);
    normal += row * row.transpose();
    right += p.y() * row;
  }
  const Vec3 c = normal.ldlt().solve(right);
  const double x = c(2) > 1e-6 ? -0.5 * c(1) / c(2) : beside;
  return std::abs(x) < beside ? Eigen::Vector2d(low.x() + x, c(0) + c(1) * x + c(2) * x * x) : low;
}

std::optional<FoundPoint> apex_on(const LongAxisImage& image, double spacing) {
  const Fan fan = fan_of(image, spacing);
  const Polar dark = fan_darkness(image, fan);
  const std::vector<int> path = edge_in_fan(dark, image.fall);
  std::vector<Eigen::Vector2d> edge;
  for (int i = 0; i < Fan::rays; ++i) {
    const double radius = along_step * (path[static_cast<std::size_t>(i)] + 1);
    const auto exact = passes(image.fall, radius, [&](double r) {
      const Eigen::Vector2d at = fan.place(i, r);
      return image.darkness(at.y(), 1, at.x());
    });
    edge.push_back(fan.place(i, exact.value_or(radius)));
  }
  if (path[Fan::rays / 2] >= fan.radii - 2)
    return {};
  const Eigen::Vector2d tip = lowest_of(edge);
  return FoundPoint{image.axis.point(tip.y(), 1, tip.x()), agreement_in_fan(dark, path)};
}

}  // namespace

LongAxisMarks find_marks(const image::Picture& picture, const geometry::Contours& loops,
                         const StackOfLoops& stack) {
  constexpr std::size_t fewest = 3;
  LongAxisImage image{
      &picture, axis_in(picture.plane, geometry::long_axis(loops)), {}, stack.fall, 0.0, {}};
  image.cuts = cuts_of(loops, picture.plane, image.axis);
  if (image.cuts.size() < fewest)
    return {};
  learn_levels(image);
  if (!image.told())
    return {};
  return {{annulus_on(image, 0, stack.spacing), annulus_on(image, 1, stack.spacing)},
          apex_on(image, stack.spacing)};
}

Vec3 side_of(const image::Plane& plane, const geometry::LongAxis& axis) {
  return axis_in(plane, axis).side;
}

std::vector<Vec3> outline_of_wall(const image::Plane& plane, const geometry::Contours& loops,
                                  const LongAxisMarks& marks) {
  constexpr double beyond = 5.0;  // the annulus, so that the end of the wall is looked at [mm]
  constexpr double wall_at_tip = 8.0;
  const AxisInPlane axis = axis_in(plane, geometry::long_axis(loops));
  const std::vector<Cut> cuts = cuts_of(loops, plane, axis);
  std::vector<Vec3> outline;
  if (cuts.empty())
    return outline;
  const auto height = [&](const FoundPoint& x) { return (x.at - axis.origin).dot(axis.up); };
  const auto add_top = [&](int side) {
    const auto& end = marks.annulus.at(side);
    const double top = std::max(cuts.front().height, end ? height(*end) : -1e9) + beyond;
    outline.push_back(axis.point(top, side, cuts.front().epi.at(side)));
  };
  add_top(0);
  for (const Cut& cut : cuts)
    outline.push_back(axis.point(cut.height, 0, cut.epi[0]));
  const double last = cuts.back().height;
  const double tip = (marks.apex ? std::min(last, height(*marks.apex)) : last) - wall_at_tip;
  outline.push_back(axis.point(tip, 0, 0.0));
  for (auto cut = cuts.rbegin(); cut != cuts.rend(); ++cut)
    outline.push_back(axis.point(cut->height, 1, cut->epi[1]));
  add_top(1);
  return outline;
}

}  // namespace lv::segment
