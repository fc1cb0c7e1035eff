#include "lv/mesh/distance.hpp"

#include "lv/base/check.hpp"
#include "lv/mesh/surface.hpp"

#include <Eigen/Geometry>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <boost/geometry/strategies/strategies.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace lv::mesh {
namespace {

namespace bg = boost::geometry;
using Point = bg::model::point<double, 3, bg::cs::cartesian>;
using Box = bg::model::box<Point>;
using Triangle = std::array<Vec3, 3>;

Point to_point(const Vec3& x) {
  return {x.x(), x.y(), x.z()};
}

Box bounding_box(const Triangle& t) {
  return {to_point(t[0].cwiseMin(t[1]).cwiseMin(t[2])),
          to_point(t[0].cwiseMax(t[1]).cwiseMax(t[2]))};
}

double square(double x) {
  return x * x;
}

double squared_distance_to_segment(const Vec3& x, const Vec3& a, const Vec3& b) {
  const Vec3 ab = b - a;
  const double length2 = ab.squaredNorm();
  const double s = length2 > 0.0 ? std::clamp((x - a).dot(ab) / length2, 0.0, 1.0) : 0.0;
  return (x - a - s * ab).squaredNorm();
}

/// To the plane where the foot of the perpendicular lies inside all three edges, else to the
/// nearest edge.
double squared_distance(const Vec3& x, const Triangle& t) {
  const Vec3 n = (t[1] - t[0]).cross(t[2] - t[0]);
  bool inside = n.squaredNorm() > 0.0;
  double nearest = std::numeric_limits<double>::max();
  for (int i = 0; i < 3; ++i) {
    const Vec3& a = t[i];
    const Vec3& b = t[(i + 1) % 3];
    inside = inside && n.dot((b - a).cross(x - a)) >= 0.0;
    nearest = std::min(nearest, squared_distance_to_segment(x, a, b));
  }
  return inside ? square(n.dot(x - t[0])) / n.squaredNorm() : nearest;
}

}  // namespace

double largest_distance(std::span<const Vec3> a, std::span<const Vec3> b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i)
    largest = std::max(largest, (a[i] - b[i]).norm());
  return largest;
}

class SurfaceDistance::Tree {
 public:
  Tree(std::span<const Vec3> nodes, const Surface& surface) {
    std::vector<Point> corners;
    std::vector<Entry> entries;
    for (int f = 0; f < surface.size(); ++f) {
      for (const int node : surface.face(f))
        corners.push_back(to_point(nodes[node]));
      for_triangles(surface.face(f), [&](int a, int b, int c) {
        entries.emplace_back(bounding_box({nodes[a], nodes[b], nodes[c]}),
                             static_cast<int>(triangles_.size()));
        triangles_.push_back({nodes[a], nodes[b], nodes[c]});
      });
    }
    corners_ = decltype(corners_)(corners);
    boxes_ = decltype(boxes_)(entries);
  }

  /// The nearest corner bounds the distance; only triangles within that bound are measured. The
  /// sign is that of the nearest of them.
  [[nodiscard]] double signed_distance(const Vec3& x) const {
    double nearest = squared_distance_to_corner(x);
    bool is_behind = false;
    const Vec3 reach = Vec3::Constant(std::sqrt(nearest));
    const Box near(to_point(x - reach), to_point(x + reach));
    for (auto entry = boxes_.qbegin(bg::index::intersects(near)); entry != boxes_.qend(); ++entry) {
      const Triangle& t = triangles_[entry->second];
      if (const double d = squared_distance(x, t); d <= nearest) {
        nearest = d;
        is_behind = (t[1] - t[0]).cross(t[2] - t[0]).dot(x - t[0]) < 0.0;
      }
    }
    return is_behind ? -std::sqrt(nearest) : std::sqrt(nearest);
  }

 private:
  using Entry = std::pair<Box, int>;

  [[nodiscard]] double squared_distance_to_corner(const Vec3& x) const {
    const Point corner = *corners_.qbegin(bg::index::nearest(to_point(x), 1));
    return (Vec3(bg::get<0>(corner), bg::get<1>(corner), bg::get<2>(corner)) - x).squaredNorm();
  }

  std::vector<Triangle> triangles_;
  bg::index::rtree<Point, bg::index::rstar<8>> corners_;
  bg::index::rtree<Entry, bg::index::rstar<8>> boxes_;
};

SurfaceDistance::SurfaceDistance(std::span<const Vec3> nodes, const Surface& surface)
    : tree_(std::make_unique<Tree>(nodes, surface)) {
  LV_CHECK(surface.size() > 0);
}
SurfaceDistance::~SurfaceDistance() = default;
SurfaceDistance::SurfaceDistance(SurfaceDistance&&) noexcept = default;
SurfaceDistance& SurfaceDistance::operator=(SurfaceDistance&&) noexcept = default;

double SurfaceDistance::operator()(const Vec3& x) const {
  return std::abs(tree_->signed_distance(x));
}

double SurfaceDistance::signed_distance(const Vec3& x) const {
  return tree_->signed_distance(x);
}

}  // namespace lv::mesh
