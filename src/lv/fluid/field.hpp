#pragma once

#include "lv/fluid/grid.hpp"

#include <xsimd/xsimd.hpp>

#include <array>
#include <span>
#include <vector>

namespace lv::fluid {

/// Layers of points kept around the own part of a field: what the 4-point kernel and the convection
/// scheme reach.
inline constexpr int ghost_layers = 2;

/// Doubles per cache line. Rows of fields start on one, so that no load or store of a SIMD unit
/// needs two.
inline constexpr int line_of_cache = 8;

/// Numbers that start on a cache line.
using AlignedValues =
    std::vector<double, xsimd::aligned_allocator<double, line_of_cache * sizeof(double)>>;

/// Values of one component at the points of one slab, with ghost layers on all sides. x runs
/// fastest.
class Component {
 public:
  Component(int nx, int ny, int nz);

  [[nodiscard]] double* row(int j, int k) {
    return values_.data() + origin_ + k * stride_z_ + j * stride_y_;
  }
  [[nodiscard]] const double* row(int j, int k) const {
    return values_.data() + origin_ + k * stride_z_ + j * stride_y_;
  }
  [[nodiscard]] double& at(int i, int j, int k) { return row(j, k)[i]; }
  [[nodiscard]] double at(int i, int j, int k) const { return row(j, k)[i]; }

  [[nodiscard]] int nx() const { return nx_; }
  [[nodiscard]] int ny() const { return ny_; }
  [[nodiscard]] int nz() const { return nz_; }
  [[nodiscard]] std::ptrdiff_t stride_y() const { return stride_y_; }
  [[nodiscard]] std::ptrdiff_t stride_z() const { return stride_z_; }

  /// A whole plane with its ghosts in x and y, as one run of numbers.
  [[nodiscard]] std::span<double> plane(int k);

  [[nodiscard]] AlignedValues& values() { return values_; }
  [[nodiscard]] const AlignedValues& values() const { return values_; }

 private:
  int nx_, ny_, nz_;
  std::ptrdiff_t stride_y_, stride_z_, origin_;
  AlignedValues values_;
};

/// A vector field on the faces of one slab (velocity, force density), component d on the faces
/// normal to axis d.
struct FaceField {
  FaceField(const Grid& grid, const Slab& slab);

  void set_zero();

  std::array<Component, 3> component;
};

/// Fills the ghost points of a velocity: from the neighbouring slabs, and at the box's sides by the
/// reflections that its boundary condition means (section 2.4: zero normal traction and zero
/// tangential velocity, hence for an incompressible fluid u_t odd and u_n even about the side).
void fill_ghosts(FaceField& velocity, const Slab& slab);

/// The same for a cell-centred pressure, zero on the sides.
void fill_ghosts(Component& pressure, const Slab& slab);

/// The values of a component over the whole box on the root, x fastest; empty on other ranks.
[[nodiscard]] std::vector<double> gather(const Component& component);

/// The reverse of `gather`: each rank takes the planes of its slab from the root's values.
void scatter(std::span<const double> values, Component& component);

/// Kinetic energy rho/2 int u^2 dx [mN mm] and largest speed component [mm/s] over all ranks.
struct Motion {
  double kinetic_energy = 0.0;
  double largest_velocity = 0.0;
};
[[nodiscard]] Motion motion(const FaceField& velocity, const Grid& grid, double density);

}  // namespace lv::fluid
