#pragma once

#include "lv/geometry/star_surface.hpp"

#include <vector>

namespace lv::geometry {

/// The coordinate u from the apex (0) to the base plane (1) on a star-shaped surface:
///
///   mu(u, theta) = m(u) (b + (b(theta) - b) u^2)
///
/// where b(theta) is the meridian's angle mu at the base plane, b its mean over theta, and m(u)
/// goes from 0 to 1. u^2 keeps the map smooth at the pole.
class MeridianMap {
 public:
  /// `fractions`: m at equal steps of u.
  MeridianMap(StarSurface surface, std::vector<double> fractions);

  [[nodiscard]] Vec3 point(double u, double theta) const;
  [[nodiscard]] const StarSurface& surface() const { return surface_; }

 private:
  StarSurface surface_;
  double mean_base_angle_;
  std::vector<double> fractions_;
};

struct MeridianMaps {
  MeridianMap endo, epi;
};

/// Coordinates u on both surfaces of a wall such that the lines between points of equal u cross the
/// wall as squarely as they can: on the mean meridians, which both end at the axis and at the base
/// plane, they minimise the integral of cos^2 of the angle between such a line and the curve of
/// their middles. Equal steps of u are equal lengths of that curve.
[[nodiscard]] MeridianMaps matched_meridians(const StarSurface& endo, const StarSurface& epi);

}  // namespace lv::geometry
