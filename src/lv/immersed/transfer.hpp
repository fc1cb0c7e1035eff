#pragma once

#include "lv/fluid/field.hpp"
#include "lv/immersed/delta.hpp"

namespace lv::immersed {

/// Moves values between points in space and the staggered grid of one slab through a regularised
/// delta function. Spreading and interpolation are adjoint: sum_grid f.u h^3 = sum_points F.U.
class Transfer {
 public:
  Transfer(const fluid::Grid& grid, const fluid::Slab& slab, Kernel kernel);

  /// Adds F delta_h(x - X) of one point force F [mN] to the force density [mN/mm^3] on this slab's
  /// planes.
  void spread(const Vec3& X, const Vec3& F, fluid::FaceField& force) const;

  /// The velocity at X, sum_x u(x) delta_h(x - X) h^3. X must lie in this slab (see `owns`); ghosts
  /// must be filled.
  [[nodiscard]] Vec3 interpolate(const fluid::FaceField& velocity, const Vec3& X) const;

  /// Whether X lies between the lower and upper side of this slab.
  [[nodiscard]] bool owns(const Vec3& X) const;

  /// Whether spreading from any point between these heights reaches this slab.
  [[nodiscard]] bool reaches(double z_min, double z_max) const;

  /// Whether X lies far enough from the sides of the box for its kernel to fit in. False for NaN.
  [[nodiscard]] bool inside(const Vec3& X) const;

 private:
  /// Weights along each axis for points on faces (0) and at cell centres (1) of that axis; z is
  /// counted in this slab.
  struct Stencil {
    std::array<AxisWeights, 3> face;
    std::array<AxisWeights, 3> centre;
  };
  [[nodiscard]] Stencil stencil(const Vec3& X) const;

  fluid::Grid grid_;
  fluid::Slab slab_;
  Kernel kernel_;
  Vec3 inverse_spacing_;
  double inverse_volume_;
};

}  // namespace lv::immersed
