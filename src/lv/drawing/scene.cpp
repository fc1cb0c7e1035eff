#include "lv/drawing/scene.hpp"

#include "lv/base/check.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>

namespace lv::drawing {
namespace {

constexpr double ambient = 0.5;  // light on surfaces that the lamp does not reach

/// Above a cut plane by less than this is not cut: sections lie exactly in their plane [mm].
constexpr double cut_tolerance = 1e-6;

/// Columns of a rotation's transpose: right, down and away from the viewer.
Mat3 view_axes(const Camera& camera) {
  const Vec3 away = camera.view.normalized();
  const Vec3 right = away.cross(camera.up);
  LV_CHECK(right.norm() > 1e-9 * camera.up.norm());  // `up` must not be the viewing direction
  Mat3 axes;
  axes.row(0) = right.normalized();
  axes.row(1) = away.cross(right.normalized());
  axes.row(2) = away;
  return axes;
}

void check(const Item& item) {
  const Patch& patch = item.patch;
  LV_CHECK(patch.outlined.empty() || patch.outlined.size() == patch.triangles.size());
  if (const auto* faces = std::get_if<FaceColours>(&item.paint))
    LV_CHECK(faces->size() == patch.triangles.size());
  if (const auto* points = std::get_if<PointValues>(&item.paint))
    LV_CHECK(points->values.size() == patch.points.size());
  LV_CHECK(item.border.empty() || item.border.size() == patch.points.size());
}

/// From space to the grid of samples: x to the right, y down, z away from the viewer, in samples.
struct View {
  Mat3 axes;
  Vec3 centre;
  double scale;  ///< samples per mm
  int width, height;

  View(const Camera& camera, const Resolution& r)
      : axes(view_axes(camera)),
        centre(camera.centre),
        width(r.width * r.supersampling),
        height(r.height * r.supersampling) {
    scale = magnification(camera, width, height);
  }

  [[nodiscard]] Vec3 position(const Vec3& x) const {
    return scale * (axes * (x - centre)) + Vec3(0.5 * width, 0.5 * height, 0.0);
  }
};

/// Unit normals at points: the mean of the triangles around each, weighted by area.
std::vector<Vec3> point_normals(const Patch& patch, const Mat3& axes) {
  std::vector<Vec3> normals(patch.points.size(), Vec3::Zero());
  for (const auto& t : patch.triangles) {
    const Vec3& a = patch.points[t[0]];
    const Vec3 n = (patch.points[t[1]] - a).cross(patch.points[t[2]] - a);
    for (const int p : t)
      normals[p] += n;
  }
  for (Vec3& n : normals)
    n = axes * n.normalized();
  return normals;
}

/// A triangle on the grid of samples. All that varies over it is linear in s = (x, y, 1).
struct Flat {
  int item, triangle;
  Mat3 weights;     ///< barycentric coordinates: weights * s
  Vec3 depth;       ///< depth . s
  Vec3 height;      ///< above the cut plane: height . s
  bool seen_front;  ///< the side on which the corners turn anticlockwise
  int x0, x1, y0, y1;
};

class Rasteriser {
 public:
  Rasteriser(const Scene& scene, const View& view)
      : scene_(scene),
        view_(view),
        nearest_(static_cast<std::size_t>(view.width) * view.height,
                 std::numeric_limits<float>::infinity()),
        winner_(nearest_.size(), -1) {
    for (int i = 0; i < static_cast<int>(scene.items.size()); ++i)
      add(i);
  }

  /// The triangle nearest to the viewer at a sample; null where there is none.
  [[nodiscard]] const Flat* at(int x, int y) const {
    const int winner = winner_[static_cast<std::size_t>(y) * view_.width + x];
    return winner < 0 ? nullptr : &flats_[winner];
  }

 private:
  void add(int item) {
    const Patch& patch = scene_.items[item].patch;
    for (int t = 0; t < static_cast<int>(patch.triangles.size()); ++t) {
      const auto& corners = patch.triangles[t];
      Mat3 x;
      Vec3 height = Vec3::Constant(-1.0);
      for (int i = 0; i < 3; ++i) {
        const Vec3& point = patch.points[corners[i]];
        x.col(i) = view_.position(point);
        if (scene_.cut)
          height[i] = scene_.cut->height(point);
      }
      if (height.minCoeff() <= cut_tolerance)
        add(item, t, x, height);
    }
  }

  void add(int item, int triangle, const Mat3& x, const Vec3& height) {
    Mat3 corners = x;
    corners.row(2).setOnes();
    const double doubled_area = corners.determinant();
    if (!(std::abs(doubled_area) > 1e-12))
      return;
    Flat flat;
    flat.item = item;
    flat.triangle = triangle;
    flat.weights = corners.inverse();
    flat.depth = flat.weights.transpose() * x.row(2).transpose();
    flat.height = flat.weights.transpose() * height;
    flat.seen_front = doubled_area < 0.0;  // the y axis points down
    const auto sample = [](double at, int count) {
      return static_cast<int>(std::clamp(at, 0.0, static_cast<double>(count)));
    };
    flat.x0 = sample(std::ceil(x.row(0).minCoeff() - 0.5), view_.width);
    flat.x1 = sample(std::floor(x.row(0).maxCoeff() + 0.5), view_.width);
    flat.y0 = sample(std::ceil(x.row(1).minCoeff() - 0.5), view_.height);
    flat.y1 = sample(std::floor(x.row(1).maxCoeff() + 0.5), view_.height);
    cover(flat, static_cast<int>(flats_.size()));
    flats_.push_back(flat);
  }

  void cover(const Flat& flat, int index) {
    const Vec3 step = flat.weights.col(0);
    for (int y = flat.y0; y < flat.y1; ++y) {
      const Vec3 s(flat.x0 + 0.5, y + 0.5, 1.0);
      Vec3 w = flat.weights * s;
      double z = flat.depth.dot(s);
      double h = flat.height.dot(s);
      std::size_t k = static_cast<std::size_t>(y) * view_.width + flat.x0;
      for (int x = flat.x0; x < flat.x1; ++x, ++k) {
        if (w.minCoeff() >= -1e-9 && z < nearest_[k] && h <= cut_tolerance) {
          nearest_[k] = static_cast<float>(z);
          winner_[k] = index;
        }
        w += step;
        z += flat.depth[0];
        h += flat.height[0];
      }
    }
  }

  const Scene& scene_;
  const View& view_;
  std::vector<Flat> flats_;
  std::vector<float> nearest_;
  std::vector<int> winner_;
};

class Shader {
 public:
  Shader(const Scene& scene, const View& view, double samples_per_point)
      : scene_(scene), samples_per_point_(samples_per_point) {
    for (const Item& item : scene.items)
      normals_.push_back(item.shaded ? point_normals(item.patch, view.axes) : std::vector<Vec3>{});
  }

  [[nodiscard]] Colour colour(const Flat& flat, int x, int y) const {
    const Item& item = scene_.items[flat.item];
    const Vec3 w = flat.weights * Vec3(x + 0.5, y + 0.5, 1.0);
    if (on_outline(item, flat, w))
      return item.outline;
    if (const auto line = border(item, flat, w))
      return *line;
    const auto ground = paint(item, flat.triangle, w);
    const Colour c = ground ? *ground : missing(x, y);
    const double light = item.shaded ? brightness(flat, w) : 1.0;
    return {light * c.r, light * c.g, light * c.b};
  }

 private:
  /// A barycentric coordinate divided by its gradient is the distance from the opposite side.
  [[nodiscard]] bool on_outline(const Item& item, const Flat& flat, const Vec3& w) const {
    if (item.outline_width <= 0.0 || item.patch.outlined.empty())
      return false;
    const double half_width = 0.5 * item.outline_width * samples_per_point_;
    for (int side = 0; side < 3; ++side) {
      const int opposite = (side + 2) % 3;
      const double slope = flat.weights.row(opposite).head<2>().norm();
      if (item.patch.outlined[flat.triangle][side] && w[opposite] < half_width * slope)
        return true;
    }
    return false;
  }

  /// Where a number is 0.5; divided by its gradient, what it is off is the distance from there.
  [[nodiscard]] std::optional<Colour> border(const Item& item, const Flat& flat,
                                             const Vec3& w) const {
    constexpr double half_width = 0.8, rim = 1.0;  // [points]
    if (item.border.empty())
      return {};
    const auto& corners = item.patch.triangles[flat.triangle];
    const Vec3 M(item.border[corners[0]], item.border[corners[1]], item.border[corners[2]]);
    const double slope = (flat.weights.transpose() * M).head<2>().norm() * samples_per_point_;
    const double off = std::abs(w.dot(M) - 0.5);
    if (off < half_width * slope)
      return hex(0xffffff);
    return off < (half_width + rim) * slope ? std::optional(hex(0x1a1a1a)) : std::nullopt;
  }

  [[nodiscard]] static std::optional<Colour> paint(const Item& item, int triangle, const Vec3& w) {
    if (const auto* uniform = std::get_if<Colour>(&item.paint))
      return *uniform;
    if (const auto* faces = std::get_if<FaceColours>(&item.paint))
      return (*faces)[triangle];
    const auto& points = std::get<PointValues>(item.paint);
    const auto& corners = item.patch.triangles[triangle];
    return points.scale(w[0] * points.values[corners[0]] + w[1] * points.values[corners[1]] +
                        w[2] * points.values[corners[2]]);
  }

  [[nodiscard]] Colour missing(int x, int y) const {
    return std::fmod((x + y) / samples_per_point_, 5.0) < 1.5 ? missing_stripe : missing_ground;
  }

  /// Lambert's law for a lamp above the viewer's left shoulder; both sides of a surface are lit.
  [[nodiscard]] double brightness(const Flat& flat, const Vec3& w) const {
    static const Vec3 to_lamp = Vec3(-0.35, -0.45, -1.0).normalized();
    const auto& corners = scene_.items[flat.item].patch.triangles[flat.triangle];
    const auto& normals = normals_[flat.item];
    Vec3 n = w[0] * normals[corners[0]] + w[1] * normals[corners[1]] + w[2] * normals[corners[2]];
    if (!flat.seen_front)
      n = -n;
    return ambient + (1.0 - ambient) * std::max(0.0, n.normalized().dot(to_lamp));
  }

  const Scene& scene_;
  double samples_per_point_;
  std::vector<std::vector<Vec3>> normals_;
};

std::uint32_t pack(const Vec3& colour, double alpha) {
  const auto byte = [](double part) {
    return static_cast<std::uint32_t>(std::lround(255.0 * std::clamp(part, 0.0, 1.0)));
  };
  return byte(alpha) << 24U | byte(colour[0]) << 16U | byte(colour[1]) << 8U | byte(colour[2]);
}

/// The mean of a pixel's n x n samples.
std::uint32_t pixel(const Rasteriser& raster, const Shader& shader, int x, int y, int n) {
  Vec3 sum = Vec3::Zero();
  int covered = 0;
  for (int k = 0; k < n * n; ++k) {
    const int sx = n * x + k % n;
    const int sy = n * y + k / n;
    if (const Flat* flat = raster.at(sx, sy)) {
      const Colour c = shader.colour(*flat, sx, sy);
      sum += Vec3(c.r, c.g, c.b);
      ++covered;
    }
  }
  return pack(sum / (n * n), static_cast<double>(covered) / (n * n));
}

}  // namespace

double Image::opacity(int x, int y) const {
  return (argb[static_cast<std::size_t>(y) * width + x] >> 24U) / 255.0;
}

Colour Image::colour(int x, int y) const {
  const Colour c = hex(argb[static_cast<std::size_t>(y) * width + x] & 0xffffffU);
  const double white = 1.0 - opacity(x, y);
  return {c.r + white, c.g + white, c.b + white};
}

double magnification(const Camera& camera, double width, double height) {
  return std::min(width / camera.width, height / camera.height);
}

Vec3 seen(const Camera& camera, const Vec3& x) {
  return view_axes(camera) * (x - camera.centre);
}

Camera fitted(const Scene& scene, const Vec3& view, const Vec3& up,
              const std::vector<Vec3>& besides) {
  Camera camera{.view = view, .up = up};
  const Mat3 axes = view_axes(camera);
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity());
  Vec3 high = -low;
  const auto show = [&](const Vec3& point) {
    low = low.cwiseMin(axes * point);
    high = high.cwiseMax(axes * point);
  };
  for (const Item& item : scene.items)
    for (const Vec3& point : item.patch.points)
      if (point.allFinite() && !(scene.cut && scene.cut->height(point) > cut_tolerance))
        show(point);
  std::for_each(besides.begin(), besides.end(), show);
  if (!(low[0] <= high[0]))
    return camera;
  constexpr double margin = 1.03;
  camera.centre = axes.transpose() * (0.5 * (low + high));
  camera.width = margin * std::max(high[0] - low[0], 1e-9);
  camera.height = margin * std::max(high[1] - low[1], 1e-9);
  return camera;
}

Image render(const Scene& scene, const Camera& camera, const Resolution& resolution) {
  for (const Item& item : scene.items)
    check(item);
  const int n = resolution.supersampling;
  const View view(camera, resolution);
  const Rasteriser raster(scene, view);
  const Shader shader(scene, view, resolution.pixels_per_point * n);
  Image image{resolution.width, resolution.height, {}, n / view.scale};
  image.argb.reserve(static_cast<std::size_t>(image.width) * image.height);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      image.argb.push_back(pixel(raster, shader, x, y, n));
  return image;
}

}  // namespace lv::drawing
