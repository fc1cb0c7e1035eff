#include "lv/solid/rate_filter.hpp"

#include <array>
#include <cmath>
#include <numeric>

namespace lv::solid {

/// Points `width` apart that cover the wall.
struct RateFilter::Lattice {
  Lattice(const Vec3& lower_corner, const Vec3& upper_corner, double width)
      : lower(lower_corner), inverse_width(1.0 / width) {
    for (int d = 0; d < 3; ++d)
      points[d] = static_cast<int>((upper_corner[d] - lower_corner[d]) * inverse_width) + 2;
  }

  [[nodiscard]] std::size_t size() const {
    return static_cast<std::size_t>(points[0]) * points[1] * points[2];
  }

  /// Calls corner(index, hat) for the eight lattice points around X.
  template <class Corner>
  void for_corners(const Vec3& X, const Corner& corner) const {
    const Vec3 s = (X - lower) * inverse_width;
    const std::array<int, 3> cell{static_cast<int>(s[0]), static_cast<int>(s[1]),
                                  static_cast<int>(s[2])};
    const Vec3 high = s - Vec3(cell[0], cell[1], cell[2]);
    const Vec3 low = Vec3::Ones() - high;
    for (int i = 0; i < 8; ++i) {
      const int x = i & 1;
      const int y = (i >> 1) & 1;
      const int z = i >> 2;
      const double hat = (x ? high[0] : low[0]) * (y ? high[1] : low[1]) * (z ? high[2] : low[2]);
      corner((static_cast<std::size_t>(cell[2] + z) * points[1] + cell[1] + y) * points[0] +
                 cell[0] + x,
             hat);
    }
  }

  Vec3 lower;
  double inverse_width;
  std::array<int, 3> points{};
};

RateFilter::RateFilter(std::span<const Vec3> nodes, std::span<const double> volumes)
    : nodes_(nodes.begin(), nodes.end()),
      volumes_(volumes.begin(), volumes.end()),
      lower_(nodes_.front()),
      upper_(nodes_.front()) {
  const double volume = std::accumulate(volumes.begin(), volumes.end(), 0.0);
  narrowest_ = 0.5 * std::cbrt(volume / static_cast<double>(nodes.size()));
  for (const Vec3& X : nodes_) {
    lower_ = lower_.cwiseMin(X);
    upper_ = upper_.cwiseMax(X);
  }
}

void RateFilter::smooth(std::span<const double> stiffness, double width, std::span<double> rates) {
  if (!(width >= narrowest_))  // nor where an unstable step has made it no number
    return;
  const Lattice lattice(lower_, upper_, width);
  weighted_rate_.assign(lattice.size(), 0.0);
  weight_.assign(lattice.size(), 0.0);
  for (std::size_t a = 0; a < nodes_.size(); ++a) {
    const double w = volumes_[a] * stiffness[a];
    lattice.for_corners(nodes_[a], [&](std::size_t c, double hat) {
      weighted_rate_[c] += hat * w * rates[a];
      weight_[c] += hat * w;
    });
  }
  for (std::size_t c = 0; c < weight_.size(); ++c)
    weighted_rate_[c] = weight_[c] > 0.0 ? weighted_rate_[c] / weight_[c] : 0.0;
  for (std::size_t a = 0; a < nodes_.size(); ++a) {
    double rate = 0.0;
    lattice.for_corners(nodes_[a],
                        [&](std::size_t c, double hat) { rate += hat * weighted_rate_[c]; });
    rates[a] = rate;
  }
}

double RateFilter::stable_width(double wave_speed, double dt) {
  constexpr double safety = 0.75;  // of the limit omega dt = 2 with omega = 0.724 c/H
  return 0.724 * wave_speed * dt / (2.0 * safety);
}

}  // namespace lv::solid
