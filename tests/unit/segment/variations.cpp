#include "segment/variations.hpp"

#include "lv/phantom/random.hpp"
#include "lv/segment/polar.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace lv::test {
namespace {

using image::CineSlice;
using image::Picture;
using image::Plane;

using Change = std::function<void(Picture&)>;

/// Changes every image by itself.
void each(KnownCine& known, const Change& change) {
  for (CineSlice& slice : known.cine.slices)
    for (Picture& picture : slice.frames)
      change(picture);
}

/// The image whose pixel (i, j) is what `value` makes of its place in an old one.
template <class Value>
Picture drawn(const Plane& plane, const Value& value) {
  Picture picture;
  picture.plane = plane;
  for (int j = 0; j < plane.rows; ++j)
    for (int i = 0; i < plane.columns; ++i)
      picture.values.push_back(static_cast<float>(value(i, j)));
  return picture;
}

/// Rows become columns: the same places, stored otherwise.
void transpose(Picture& old) {
  Plane plane = old.plane;
  std::swap(plane.along_row, plane.along_column);
  std::swap(plane.spacing_i, plane.spacing_j);
  std::swap(plane.rows, plane.columns);
  old = drawn(plane, [&](int i, int j) { return old.at(j, i); });
}

void mirror_rows(Picture& old) {
  Plane plane = old.plane;
  plane.origin = plane.point(plane.columns - 1, 0);
  plane.along_row = -plane.along_row;
  old = drawn(plane, [&](int i, int j) { return old.at(plane.columns - 1 - i, j); });
}

void reverse_slices(KnownCine& known) {
  std::reverse(known.cine.slices.begin(), known.cine.slices.end());
  const int slices = static_cast<int>(known.cine.slices.size());
  for (auto& [frame, contours] : known.truth)
    for (geometry::Contour& loop : contours.short_axis)
      loop.slice = slices + 1 - loop.slice;
}

/// The cine with other frames: number n shows what was at `place(n)` of the old ones, between two
/// a mean.
void retime(KnownCine& known, int frames, double first) {
  const int old = static_cast<int>(known.cine.slices.front().frames.size());
  const auto place = [&](int n) {
    return std::fmod(first + n * static_cast<double>(old) / frames + old, old);
  };
  for (CineSlice& slice : known.cine.slices) {
    std::vector<Picture> shown;
    std::vector<double> times;
    for (int n = 0; n < frames; ++n) {
      const int before = static_cast<int>(place(n));
      const double part = place(n) - before;
      Picture picture = slice.frames[before];
      const Picture& after = slice.frames[(before + 1) % old];
      for (std::size_t k = 0; k < picture.values.size(); ++k)
        picture.values[k] += static_cast<float>(part) * (after.values[k] - picture.values[k]);
      shown.push_back(std::move(picture));
      if (!slice.times.empty())
        times.push_back(slice.times.front() + n * slice.times[1] * old / frames);
    }
    slice.frames = std::move(shown);
    slice.times = std::move(times);
  }
  const auto nearest = [&](int frame) {
    int best = 0;
    const auto away = [&](int n) { return std::abs(std::remainder(place(n) - frame, old)); };
    for (int n = 1; n < frames; ++n)
      best = away(n) < away(best) ? n : best;
    return best;
  };
  std::map<int, geometry::Contours> truth;
  for (auto& [frame, contours] : known.truth)
    truth[nearest(frame)] = contours;
  known.truth = std::move(truth);
  known.end_diastole = nearest(known.end_diastole);
  known.end_systole = nearest(known.end_systole);
}

/// Means of squares of `factor` pixels a side, or interpolated ones where it is below 1.
void resample(Picture& old, double factor) {
  Plane plane = old.plane;
  plane.spacing_i *= factor;
  plane.spacing_j *= factor;
  plane.columns = static_cast<int>(plane.columns / factor);
  plane.rows = static_cast<int>(plane.rows / factor);
  const double corner = 0.5 * (factor - 1.0);
  plane.origin = old.plane.point(corner, corner);
  constexpr int points = 4;
  old = drawn(plane, [&](int i, int j) {
    double sum = 0.0;
    for (int v = 0; v < points; ++v)
      for (int u = 0; u < points; ++u) {
        const double x = (u + 0.5) / points - 0.5;
        const double y = (v + 0.5) / points - 0.5;
        sum += segment::grey_at(old, {factor * (i + (factor > 1.0 ? x : 0.0)) + corner,
                                      factor * (j + (factor > 1.0 ? y : 0.0)) + corner});
      }
    return sum / (points * points);
  });
}

/// A rectangle of pixels of the old image, beyond its edge `outside`.
void frame_of(Picture& old, int i0, int j0, int columns, int rows, float outside) {
  Plane plane = old.plane;
  plane.origin = plane.point(i0, j0);
  plane.columns = columns;
  plane.rows = rows;
  old = drawn(plane, [&](int i, int j) {
    const bool within =
        i + i0 >= 0 && j + j0 >= 0 && i + i0 < old.plane.columns && j + j0 < old.plane.rows;
    return within ? old.at(i + i0, j + j0) : outside;
  });
}

/// Where the truth's loops lie [pixels]: the first and last column and row.
struct Box {
  double i0 = 1e9, i1 = -1e9, j0 = 1e9, j1 = -1e9;
};

Box box_of(const KnownCine& known) {
  Box box;
  const Plane& plane = known.cine.slices.front().frames.front().plane;
  for (const auto& [frame, contours] : known.truth)
    for (const geometry::Contour& loop : contours.short_axis)
      for (const Vec3& x : loop.points) {
        const Vec3 p = plane.pixel(x);
        box.i0 = std::min(box.i0, p.x());
        box.i1 = std::max(box.i1, p.x());
        box.j0 = std::min(box.j0, p.y());
        box.j1 = std::max(box.j1, p.y());
      }
  return box;
}

/// Only so much round the loops is left [mm].
void crop(KnownCine& known, double margin) {
  const Box box = box_of(known);
  each(known, [&](Picture& picture) {
    const Plane& plane = picture.plane;
    const int i0 = std::max(0, static_cast<int>(box.i0 - margin / plane.spacing_i));
    const int j0 = std::max(0, static_cast<int>(box.j0 - margin / plane.spacing_j));
    const int i1 = std::min(plane.columns - 1, static_cast<int>(box.i1 + margin / plane.spacing_i));
    const int j1 = std::min(plane.rows - 1, static_cast<int>(box.j1 + margin / plane.spacing_j));
    frame_of(picture, i0, j0, i1 - i0 + 1, j1 - j0 + 1, 0.0F);
  });
}

/// The part of the image beyond a narrower field of view lies on its other side.
void wrap(Picture& picture, double part) {
  const Picture old = picture;
  const int columns = static_cast<int>(part * old.plane.columns);
  const int left = (old.plane.columns - columns) / 2;
  frame_of(picture, left, 0, columns, old.plane.rows, 0.0F);
  for (int j = 0; j < old.plane.rows; ++j)
    for (int i = 0; i < old.plane.columns; ++i)
      if (const int at = i - left; at < 0 || at >= columns)
        picture
            .values[static_cast<std::size_t>(j) * columns + (at % columns + columns) % columns] +=
            old.at(i, j);
}

/// The sensitivity of a round surface coil of this radius R on its axis, (1 + (d/R)^2)^(-3/2), with
/// the heart's middle at a depth d of 60 mm: it falls by a factor of two over 100 mm for a radius
/// of 150 mm, of three for 100 mm.
void coil(KnownCine& known, double angle, double radius) {
  constexpr double depth = 60.0;
  const Box box = box_of(known);
  const Plane& first = known.cine.slices.front().frames.front().plane;
  const Vec3 middle = first.point(0.5 * (box.i0 + box.i1), 0.5 * (box.j0 + box.j1));
  each(known, [&](Picture& picture) {
    const Plane plane = picture.plane;
    const Vec3 inwards = std::cos(angle) * plane.along_row + std::sin(angle) * plane.along_column;
    for (int j = 0; j < plane.rows; ++j)
      for (int i = 0; i < plane.columns; ++i) {
        const double d = std::max(0.0, depth + (plane.point(i, j) - middle).dot(inwards));
        picture.values[static_cast<std::size_t>(j) * plane.columns + i] *=
            static_cast<float>(std::pow(1.0 + d * d / (radius * radius), -1.5));
      }
  });
}

float brightest(const KnownCine& known) {
  std::vector<float> all;
  for (const CineSlice& slice : known.cine.slices)
    all.insert(all.end(), slice.frames.front().values.begin(), slice.frames.front().values.end());
  const auto at = all.begin() + static_cast<std::ptrdiff_t>(all.size() * 99 / 100);
  std::nth_element(all.begin(), at, all.end());
  return *at;
}

void grey(KnownCine& known, const std::function<double(double)>& curve) {
  const float most = brightest(known);
  each(known, [&](Picture& picture) {
    for (float& v : picture.values)
      v = static_cast<float>(most * curve(v / most));
  });
}

/// Rician noise of this deviation, as a part of the image's brightest.
void noise(KnownCine& known, double deviation) {
  phantom::Random random(7);
  const double sigma = deviation * brightest(known);
  each(known, [&](Picture& picture) {
    for (float& v : picture.values)
      v = static_cast<float>(std::hypot(v + sigma * random.normal(), sigma * random.normal()));
  });
}

/// Every second slice.
void half_of_slices(KnownCine& known) {
  std::vector<CineSlice> kept;
  for (std::size_t s = 0; s < known.cine.slices.size(); s += 2)
    kept.push_back(known.cine.slices[s]);
  known.cine.slices = std::move(kept);
  for (auto& [frame, contours] : known.truth) {
    std::erase_if(contours.short_axis, [](const auto& loop) { return loop.slice % 2 == 0; });
    for (geometry::Contour& loop : contours.short_axis)
      loop.slice = (loop.slice + 1) / 2;
  }
}

/// Images beyond both ends, as localisers planned by others have them: copies of the last ones
/// without anything that moves are no ventricle; here air.
void black_ends(KnownCine& known) {
  auto& slices = known.cine.slices;
  const auto step = [](const CineSlice& a, const CineSlice& b) {
    return Vec3(b.frames.front().plane.origin - a.frames.front().plane.origin);
  };
  const auto beyond = [](CineSlice slice, const Vec3& by) {
    for (Picture& picture : slice.frames) {
      picture.plane.origin += by;
      std::fill(picture.values.begin(), picture.values.end(), 0.0F);
    }
    return slice;
  };
  const Vec3 by = step(slices[0], slices[1]);
  slices.insert(slices.begin(), beyond(slices.front(), -by));
  slices.push_back(beyond(slices.back(), by));
  for (auto& [frame, contours] : known.truth)
    for (geometry::Contour& loop : contours.short_axis)
      ++loop.slice;
}

Variation of_each(const std::string& name, const Change& change) {
  return {name, [change](KnownCine& known) { each(known, change); }};
}

/// Weights of a Gaussian at whole distances from -reach to reach; their sum is 1.
std::vector<double> gaussian(double deviation) {
  const int reach = static_cast<int>(std::ceil(3.0 * deviation));
  std::vector<double> weights;
  for (int d = -reach; d <= reach; ++d)
    weights.push_back(std::exp(-0.5 * d * d / (deviation * deviation)));
  const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
  for (double& weight : weights)
    weight /= sum;
  return weights;
}

/// The value of a picture, or of its edge beyond it, weighted along its rows or columns.
double convolved(const image::Picture& picture, int i, int j, bool along_row,
                 const std::vector<double>& weights) {
  const int reach = static_cast<int>(weights.size()) / 2;
  double sum = 0.0;
  for (int d = -reach; d <= reach; ++d) {
    const int x = std::clamp(along_row ? i + d : i, 0, picture.plane.columns - 1);
    const int y = std::clamp(along_row ? j : j + d, 0, picture.plane.rows - 1);
    sum += weights[d + reach] * picture.at(x, y);
  }
  return sum;
}

/// Convolves a picture with a Gaussian of this deviation [mm].
void blur(image::Picture& picture, double deviation) {
  const image::Plane plane = picture.plane;
  for (const bool along_row : {true, false}) {
    const image::Picture sharp = picture;
    const auto weights = gaussian(deviation / (along_row ? plane.spacing_i : plane.spacing_j));
    for (int j = 0; j < plane.rows; ++j)
      for (int i = 0; i < plane.columns; ++i)
        picture.values[static_cast<std::size_t>(j) * plane.columns + i] =
            static_cast<float>(convolved(sharp, i, j, along_row, weights));
  }
}

}  // namespace

std::vector<Variation> other_storage() {
  return {
      of_each("transposed", transpose),
      of_each("mirrored", mirror_rows),
      {"slices reversed", reverse_slices},
      {"1000 times as bright", [](KnownCine& k) { grey(k, [](double v) { return 1000.0 * v; }); }},
      {"begins in mid-cycle",
       [](KnownCine& k) { retime(k, static_cast<int>(k.cine.slices.front().frames.size()), 3.0); }},
  };
}

std::vector<Variation> other_images() {
  std::vector<Variation> all;
  for (const double radius : {150.0, 100.0})
    for (const int quarter : {0, 1, 2, 3})
      all.push_back({fmt::format("coil of {} mm, side {}", radius, quarter + 1),
                     [=](KnownCine& k) { coil(k, 0.5 * std::numbers::pi * quarter, radius); }});
  for (const double g : {0.6, 0.8, 1.25, 1.6})
    all.push_back({fmt::format("gamma {}", g), [=](KnownCine& k) {
                     grey(k, [=](double v) { return v > 0.0 ? std::pow(v, g) : 0.0; });
                   }});
  for (const double b : {0.05, 0.1, 0.2})
    all.push_back({fmt::format("offset {}", b),
                   [=](KnownCine& k) { grey(k, [=](double v) { return v + b; }); }});
  all.push_back(
      {"clipped at 0.6", [](KnownCine& k) { grey(k, [](double v) { return std::min(v, 0.6); }); }});
  for (const double factor : {0.5, 1.3, 1.6, 2.0})
    all.push_back(
        of_each(fmt::format("pixels times {}", factor), [=](Picture& p) { resample(p, factor); }));
  for (const double sigma : {0.02, 0.05, 0.1})
    all.push_back({fmt::format("noise {}", sigma), [=](KnownCine& k) { noise(k, sigma); }});
  for (const double margin : {25.0, 10.0, 5.0})
    all.push_back(
        {fmt::format("cropped to {} mm", margin), [=](KnownCine& k) { crop(k, margin); }});
  all.push_back(of_each("padded with 0", [](Picture& p) {
    frame_of(p, -40, -20, p.plane.columns + 80, p.plane.rows + 40, 0.0F);
  }));
  all.push_back(of_each("padded with -2000", [](Picture& p) {
    frame_of(p, -40, -20, p.plane.columns + 80, p.plane.rows + 40, -2000.0F);
  }));
  all.push_back(of_each("padded with 32767", [](Picture& p) {
    frame_of(p, -40, -20, p.plane.columns + 80, p.plane.rows + 40, 32767.0F);
  }));
  all.push_back(of_each("wrapped to 0.75", [](Picture& p) { wrap(p, 0.75); }));
  all.push_back(of_each("wrapped to 0.6", [](Picture& p) { wrap(p, 0.6); }));
  for (const int frames : {8, 12, 30})
    all.push_back(
        {fmt::format("{} phases", frames), [=](KnownCine& k) { retime(k, frames, 0.0); }});
  all.push_back({"every second slice", half_of_slices});
  all.push_back({"air beyond both ends", black_ends});
  return all;
}

void blur(image::Cine& cine, double deviation) {
  for (image::CineSlice& slice : cine.slices)
    for (image::Picture& picture : slice.frames)
      blur(picture, deviation);
}

}  // namespace lv::test
