#include "lv/immersed/transfer.hpp"

#include <algorithm>

namespace lv::immersed {

Transfer::Transfer(const fluid::Grid& grid, const fluid::Slab& slab, Kernel kernel)
    : grid_(grid),
      slab_(slab),
      kernel_(kernel),
      inverse_spacing_(grid.spacing.cwiseInverse()),
      inverse_volume_(1.0 / grid.cell_volume()) {}

Transfer::Stencil Transfer::stencil(const Vec3& X) const {
  const Vec3 s =
      (X - grid_.lower).cwiseProduct(inverse_spacing_) - Vec3(0.0, 0.0, slab_.planes.begin);
  Stencil result;
  for (int d = 0; d < 3; ++d) {
    result.face[d] = axis_weights(kernel_, s[d], true);
    result.centre[d] = axis_weights(kernel_, s[d] - 0.5, false);
  }
  return result;
}

void Transfer::spread(const Vec3& X, const Vec3& F, fluid::FaceField& force) const {
  const Stencil s = stencil(X);
  for (int c = 0; c < 3; ++c) {
    fluid::Component& f = force.component[c];
    const AxisWeights& x = c == 0 ? s.face[0] : s.centre[0];
    const AxisWeights& y = c == 1 ? s.face[1] : s.centre[1];
    const AxisWeights& z = c == 2 ? s.face[2] : s.centre[2];
    const double density = F[c] * inverse_volume_;
    for (int k = std::max(0, -z.first); k < std::min(4, f.nz() - z.first); ++k) {
      for (int j = 0; j < 4; ++j) {
        double* row = f.row(y.first + j, z.first + k) + x.first;
        const double w = density * z.weight[k] * y.weight[j];
        for (int i = 0; i < 4; ++i)
          row[i] += w * x.weight[i];
      }
    }
  }
}

Vec3 Transfer::interpolate(const fluid::FaceField& velocity, const Vec3& X) const {
  const Stencil s = stencil(X);
  Vec3 U;
  for (int c = 0; c < 3; ++c) {
    const fluid::Component& u = velocity.component[c];
    const AxisWeights& x = c == 0 ? s.face[0] : s.centre[0];
    const AxisWeights& y = c == 1 ? s.face[1] : s.centre[1];
    const AxisWeights& z = c == 2 ? s.face[2] : s.centre[2];
    std::array<double, 4> sum{};
    for (int k = 0; k < 4; ++k) {
      for (int j = 0; j < 4; ++j) {
        const double* row = u.row(y.first + j, z.first + k) + x.first;
        const double w = z.weight[k] * y.weight[j];
        for (int i = 0; i < 4; ++i)
          sum[i] += w * row[i];
      }
    }
    U[c] =
        sum[0] * x.weight[0] + sum[1] * x.weight[1] + sum[2] * x.weight[2] + sum[3] * x.weight[3];
  }
  return U;
}

bool Transfer::owns(const Vec3& X) const {
  const double plane = (X.z() - grid_.lower.z()) * inverse_spacing_.z();
  return plane >= slab_.planes.begin && plane < slab_.planes.end;
}

bool Transfer::reaches(double z_min, double z_max) const {
  constexpr double reach =
      3.0;  // cells: the kernel's 2 and the half cell of staggering, rounded up
  const double low = (z_min - grid_.lower.z()) * inverse_spacing_.z();
  const double high = (z_max - grid_.lower.z()) * inverse_spacing_.z();
  return high > slab_.planes.begin - reach && low < slab_.planes.end + reach;
}

bool Transfer::inside(const Vec3& X) const {
  constexpr double margin = 3.0;  // cells
  for (int d = 0; d < 3; ++d) {
    const double s = (X[d] - grid_.lower[d]) * inverse_spacing_[d];
    if (!(s >= margin && s <= grid_.cells[d] - margin))
      return false;
  }
  return true;
}

}  // namespace lv::immersed
