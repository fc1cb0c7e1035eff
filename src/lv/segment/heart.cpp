#include "lv/segment/heart.hpp"

#include "lv/base/interrupt.hpp"
#include "lv/base/median.hpp"
#include "lv/image/volume.hpp"
#include "lv/segment/closed_path.hpp"
#include "lv/segment/ring.hpp"

#include <algorithm>
#include <cmath>
#include <complex>

namespace lv::segment {
namespace {

using image::CineSlice;
using image::Picture;
using image::Plane;

constexpr PolarGrid rough_grid{.rays = 48, .radii = 40, .first = 4.0, .step = 1.0};
constexpr double seed_step = 6.0;    // between places that are tried first [mm]
constexpr double follow_step = 4.0;  // between places tried near the slice before [mm]
constexpr double follow_reach = 12.0;

/// Fall of the grey value over 4 mm outwards, as a part of the blood's; beyond half of it more
/// hardly counts. It grows everywhere: among equal edges rounding would choose the path.
Polar steepness(const Polar& values) {
  constexpr double whole = 0.5;
  const auto n = values.cols();
  Polar fall = Polar::Zero(values.rows(), n);
  fall.middleCols(1, n - 2) = 2.0 * (values.leftCols(n - 2) - values.rightCols(n - 2));
  return (fall / whole).tanh();
}

/// The parts of likeness that a closed path round a place has.
struct Ring {
  double muscle = 0.0, blood = 0.0;
};

/// The closed path along which grey values, parts of the blood's, fall most; within the first ring
/// of muscle, if what is bright outside that has a steeper edge.
Radii steepest_path(const Polar& values, const Polar& edge) {
  constexpr double between = 0.65;  // blood and muscle
  constexpr PathRule rule{.reach = 1, .stiffness = 0.1};
  return path_within_ring(1.0 - edge, (values < between).cast<double>(), 1.0, rule, rough_grid);
}

Ring ring_of(const Polar& values, const Radii& path) {
  constexpr double same_muscle = 0.15;  // parts of the blood's grey value
  constexpr double same_blood = 0.3;
  constexpr double darkest_muscle = 0.12;  // lung round an atrium or a vessel is darker
  const int last = static_cast<int>(values.cols());
  std::vector<double> around;
  double blood = 0.0;
  for (Eigen::Index i = 0; i < values.rows(); ++i) {
    const int k = rough_grid.index(path(i));
    const int near = std::min(k + 3, last - 1);
    around.push_back(values.row(i).segment(near, std::min(k + 7, last) - near).mean());
    const int inside = std::max(k - 2, 1);
    blood += ((values.row(i).head(inside) - 1.0).abs() < same_blood).cast<double>().mean();
  }
  const double level = median(around);
  const auto alike = std::count_if(around.begin(), around.end(), [&](double v) {
    return std::abs(v - level) < same_muscle && v > darkest_muscle;
  });
  const auto rays = static_cast<double>(values.rows());
  return {static_cast<double>(alike) / rays, blood / rays};
}

double roundness(const Radii& r) {
  const double deviation = std::sqrt((r - r.mean()).square().mean());
  return std::max(0.0, 1.0 - 2.0 * deviation / r.mean());
}

Centre judge_one(const Picture& picture, const Pixel& place) {
  Polar values = sample(picture, place, rough_grid);
  std::vector<double> middle;
  for (const double v : values.leftCols(3).reshaped())
    middle.push_back(v);
  const double blood = median(std::move(middle));
  if (!(blood > 0.0))
    return {place, 0.0, 0.0};
  values /= blood;
  const Polar edge = steepness(values);
  const Radii r = steepest_path(values, edge);
  double steep = 0.0;
  for (int i = 0; i < rough_grid.rays; ++i)
    steep += edge(i, rough_grid.index(r(i))) / rough_grid.rays;
  const Ring ring = ring_of(values, r);
  const Eigen::Vector2d moved = centroid(r);
  const Plane& plane = picture.plane;
  return {place + Pixel(moved.x() / plane.spacing_i, moved.y() / plane.spacing_j),
          steep * ring.muscle * ring.blood * roundness(r), r.mean()};
}

std::vector<const Picture*> frames_of(const CineSlice& slice, std::size_t count) {
  std::vector<const Picture*> frames;
  for (std::size_t n = 0; n < count; ++n)
    frames.push_back(&slice.frames[n * slice.frames.size() / count]);
  return frames;
}

/// The factors of the first harmonic over the cycle, exp(-2 pi i t/n).
std::vector<std::complex<double>> first_harmonic(std::size_t frames) {
  std::vector<std::complex<double>> turns;
  const auto n = static_cast<double>(frames);
  for (std::size_t t = 0; t < frames; ++t)
    turns.push_back(std::polar(1.0, -2.0 * std::numbers::pi * static_cast<double>(t) / n));
  return turns;
}

/// Twice the amplitude of that harmonic at a pixel.
double motion_at(const CineSlice& slice, const std::vector<std::complex<double>>& turns, int i,
                 int j) {
  std::complex<double> sum = 0.0;
  for (std::size_t t = 0; t < turns.size(); ++t)
    sum += static_cast<double>(slice.frames[t].at(i, j)) * turns[t];
  return 2.0 * std::abs(sum) / static_cast<double>(turns.size());
}

/// A place that may be the heart's and how much moves round it.
struct Place {
  std::size_t slice;
  Pixel at;
  double motion = 0.0;
};

/// Places on a grid, each with the motion of its own square.
std::vector<Place> squares(const CineSlice& slice, std::size_t number) {
  const Plane& plane = slice.frames.front().plane;
  const int across = std::max(1, static_cast<int>(std::lround(seed_step / plane.spacing_i)));
  const int down = std::max(1, static_cast<int>(std::lround(seed_step / plane.spacing_j)));
  const auto turns = first_harmonic(slice.frames.size());
  std::vector<Place> places;
  for (int j = 0; j + down <= plane.rows; j += down)
    for (int i = 0; i + across <= plane.columns; i += across) {
      double sum = 0.0;
      for (int v = j; v < j + down; ++v)
        for (int u = i; u < i + across; ++u)
          sum += motion_at(slice, turns, u, v);
      places.push_back(
          {number, Pixel(i + 0.5 * (across - 1), j + 0.5 * (down - 1)), sum / (across * down)});
    }
  return places;
}

/// The mean motion of the squares as near as a border is looked for: the middle of a large
/// ventricle is still, and the border that moves far away.
double motion_around(const Place& place, const std::vector<Place>& squares, const Plane& plane) {
  constexpr double reach = rough_grid.first + rough_grid.step * (rough_grid.radii - 1);
  double sum = 0.0;
  int count = 0;
  for (const Place& other : squares) {
    const double down = (other.at.y() - place.at.y()) * plane.spacing_j;
    if (std::abs(down) >= reach ||  // most are, and cost nothing more
        std::hypot((other.at.x() - place.at.x()) * plane.spacing_i, down) >= reach)
      continue;
    sum += other.motion;
    ++count;
  }
  return sum / count;
}

std::vector<Place> moving_places(const image::Cine& cine) {
  constexpr double part = 0.3;  // of the largest motion
  std::vector<Place> places;
  double most = 0.0;
  for (std::size_t s = 0; s < cine.slices.size(); ++s) {
    const std::vector<Place> own = squares(cine.slices[s], s);
    for (Place place : own) {
      place.motion = motion_around(place, own, cine.slices[s].frames.front().plane);
      most = std::max(most, place.motion);
      places.push_back(place);
    }
  }
  std::erase_if(places, [&](const Place& place) { return place.motion < part * most; });
  return places;
}

Centre better(const Centre& a, const Centre& b) {
  return b.likeness > a.likeness ? b : a;
}

/// The likeliest place near another.
Centre search_near(const CineSlice& slice, const Pixel& from) {
  const std::vector<const Picture*> frames = frames_of(slice, 4);
  const Plane& plane = slice.frames.front().plane;
  Centre best{from, -1.0, 0.0};
  const int steps = static_cast<int>(follow_reach / follow_step);
  const Pixel step(follow_step / plane.spacing_i, follow_step / plane.spacing_j);
  for (int y = -steps; y <= steps; ++y)
    for (int x = -steps; x <= steps; ++x)
      best = better(best, judge(frames, from + Pixel(x * step.x(), y * step.y())));
  return best;
}

const Plane& plane_of(const image::Cine& cine, std::size_t slice) {
  return cine.slices[slice].frames.front().plane;
}

/// The slice nearest to a point and its place there.
Place given_place(const image::Cine& cine, const Vec3& point) {
  const std::size_t nearest = image::nearest_slice(cine, point);
  return {nearest, plane_of(cine, nearest).pixel(point).head<2>()};
}

/// Where each slice looks most like the heart; with a likeness of 0 where nothing moves.
std::vector<Centre> likeliest_places(const image::Cine& cine) {
  std::vector<Centre> best(cine.slices.size());
  for (const Place& place : moving_places(cine)) {
    interrupt::check();
    Centre& own = best[place.slice];
    own = better(own, judge(frames_of(cine.slices[place.slice], 2), place.at));
  }
  return best;
}

/// The place that looks most like the heart of those above and below which most others do: a
/// ventricle goes through a stack, and what single slices show that looks like it does not.
Place likeliest_place(const image::Cine& cine) {
  constexpr double above = 20.0;  // across the slices [mm]
  const std::vector<Centre> places = likeliest_places(cine);
  const auto point = [&](std::size_t s) {
    return plane_of(cine, s).point(places[s].at.x(), places[s].at.y());
  };
  const auto lies_above = [&](std::size_t a, std::size_t b) {
    const Eigen::Vector2d pixels = plane_of(cine, b).pixel(point(a)).head<2>() - places[b].at;
    return std::hypot(pixels.x() * plane_of(cine, b).spacing_i,
                      pixels.y() * plane_of(cine, b).spacing_j) < above;
  };
  std::vector<double> votes(places.size(), 0.0);
  for (std::size_t a = 0; a < places.size(); ++a)
    for (std::size_t b = 0; b < places.size(); ++b)
      votes[a] += lies_above(a, b) ? places[b].likeness : 0.0;
  const auto most =
      static_cast<std::size_t>(std::max_element(votes.begin(), votes.end()) - votes.begin());
  std::size_t seed = most;
  for (std::size_t s = 0; s < places.size(); ++s)
    if (lies_above(s, most) && places[s].likeness > places[seed].likeness)
      seed = s;
  return {seed, places[seed].at};
}

}  // namespace

Centre judge(const std::vector<const Picture*>& frames, const Pixel& place) {
  Centre mean;
  for (const Picture* frame : frames) {
    const Centre one = judge_one(*frame, place);
    mean.at += one.at;
    mean.likeness += one.likeness;
    mean.radius += one.radius;
  }
  const auto n = static_cast<double>(frames.size());
  return {mean.at / n, mean.likeness / n, mean.radius / n};
}

Heart find_heart(const image::Cine& cine, const std::optional<Vec3>& given) {
  const Place seed = given ? given_place(cine, *given) : likeliest_place(cine);
  Heart heart{std::vector<Centre>(cine.slices.size()), seed.slice};
  heart.centres[seed.slice] = search_near(cine.slices[seed.slice], seed.at);
  const auto follow = [&](std::size_t slice, std::size_t before) {
    const Pixel& at = heart.centres[before].at;
    const Vec3 point = plane_of(cine, before).point(at.x(), at.y());
    heart.centres[slice] =
        search_near(cine.slices[slice], plane_of(cine, slice).pixel(point).head<2>());
  };
  for (std::size_t s = seed.slice + 1; s < cine.slices.size(); ++s)
    follow(s, s - 1);
  for (std::size_t s = seed.slice; s-- > 0;)
    follow(s, s + 1);
  return heart;
}

}  // namespace lv::segment
