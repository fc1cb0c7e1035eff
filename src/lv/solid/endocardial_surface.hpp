#pragma once

#include "lv/mesh/quadratic.hpp"
#include "lv/solid/shape_table.hpp"

#include <functional>
#include <span>
#include <vector>

namespace lv::solid {

/// The endocardium and the cavity that it encloses: sides of the mesh's order, n out of the wall,
/// so into the cavity. The cavity is closed at the base by the fan between the endocardium's edge
/// and the edge's centre c, the basal plane as long as the base stays plane:
///
///   V = -1/3 int (x - c).n da                                                        [mm^3]
///
/// A pressure p in it pushes the wall with the forces p dV/dx, and dV/dx changes by d2V/dx2. The
/// fan moves no node: dV is that of the endocardium alone,
///
///   dV/dx_a = -int phi_a n da                                                        [mm^2]
///
/// which is the whole dV of every motion that keeps the base in its plane. What the pressure does
/// on the fan it does on blood and valves, which no part of the wall carries.
class EndocardialSurface {
 public:
  explicit EndocardialSurface(const mesh::Mesh& mesh) : EndocardialSurface(mesh, mesh.endo) {}
  /// The same of another surface of the wall, which a pressure pushes likewise; it encloses
  /// nothing.
  EndocardialSurface(const mesh::Mesh& mesh, const mesh::Surface& surface);

  /// V [mm^3].
  [[nodiscard]] double volume(std::span<const Vec3> positions) const;

  /// Adds `factor` dV/dx of this rank's share of the sides.
  void add_gradient(double factor, std::span<const Vec3> positions, std::span<Vec3> to) const;

  /// Adds the derivative of volume(), the fan's share included, of this rank's share of the sides:
  /// how the cavity's volume follows a base that leaves its plane.
  void add_volume_gradient(std::span<const Vec3> positions, std::span<Vec3> to) const;

  /// Told a block of a matrix: the nodes it belongs to, three rows and columns for each.
  using Block = std::function<void(std::span<const int> nodes, const Eigen::MatrixXd& values)>;

  /// `factor` d2V/dx2, one block for each of this rank's sides.
  void add_hessian(double factor, std::span<const Vec3> positions, const Block& add) const;

 private:
  template <class Visit>
  void for_share(const Visit& visit) const;
  [[nodiscard]] Vec3 centre_of_edge(std::span<const Vec3> positions) const;

  mesh::ElementNodes sides_;
  ShapeTable shapes_;
  std::vector<int> edge_;  ///< nodes at the base
};

}  // namespace lv::solid
