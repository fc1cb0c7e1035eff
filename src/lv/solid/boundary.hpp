#pragma once

#include "lv/mesh/mesh.hpp"

#include <span>
#include <vector>

namespace lv::solid {

/// Adds the nodal forces of a pressure [kPa] on this rank's share of a surface, as a follower load:
/// F_a = -p int phi_a n da over the deformed faces, n out of the wall [mN].
void add_pressure_forces(const mesh::Surface& surface, double pressure,
                         std::span<const Vec3> positions, std::span<Vec3> forces);

/// The penalty that holds the basal plane (section 2.4): per reference area, springs against axial
/// and circumferential displacement; radial motion is free.
///
///   F_a = -kappa A_a { [(x - X).e_z] e_z + [(x - X).e_theta(X)] e_theta(X) }   [mN]
///
/// with e_theta about the long axis and A_a the node's share of the basal area [mm^2].
class BasalPenalty {
 public:
  /// `stiffness` is kappa [kPa/mm].
  BasalPenalty(const mesh::Mesh& mesh, double stiffness);

  void add_forces(std::span<const Vec3> positions, std::span<Vec3> forces) const;

  /// Largest axial displacement of the base [mm].
  [[nodiscard]] double largest_axial_displacement(std::span<const Vec3> positions) const;

 private:
  struct Spring {
    int node;
    double stiffness;  ///< kappa A_a [mN/mm]
    Vec3 reference;
    Vec3 circumferential;
  };
  std::vector<Spring> springs_;
};

}  // namespace lv::solid
