#pragma once

#include "lv/mesh/mesh.hpp"
#include "lv/solid/base_motion.hpp"

#include <map>
#include <span>
#include <vector>

namespace lv::solid {

/// How the basal plane is held (section 2.4).
struct BasalSupport {
  enum class Kind {
    sliding,  ///< against axial and circumferential displacement; radial motion is free
    fixed,    ///< against all displacement
    elastic   ///< by springs and dashpots of its own (Surroundings::base) alone
  };
  Kind kind = Kind::sliding;
  double stiffness = 300.0;  ///< kappa, of springs per reference area, unless elastic [kPa/mm]
};

/// The nodes of a surface and their shares of its undeformed area, faces being flat or bilinear
/// [mm^2].
[[nodiscard]] std::map<int, double> nodal_areas(const mesh::Mesh& mesh,
                                                const mesh::Surface& surface);

/// The springs that hold the base:
///
///   F_a = -kappa A_a { [(x - X).e_z] e_z + [(x - X).e_theta(X)] e_theta(X) }   [mN]
///
/// with e_theta about the long axis and A_a the node's share of the basal area [mm^2]; a fixed base
/// has a spring along e_r(X) too, an elastic one none of these. Of a moving base X + U(X) stands
/// for the X that x is taken from, the directions stay.
class BasalPenalty {
 public:
  struct Spring {
    int node;
    Mat3 stiffness;  ///< -dF/dx [mN/mm]
    Vec3 reference;
  };

  BasalPenalty(const mesh::Mesh& mesh, const BasalSupport& support);

  void add_forces(std::span<const Vec3> positions, std::span<Vec3> forces,
                  const AffineField& displacement = {}) const;

  /// One per node of the base; none of an elastic one.
  [[nodiscard]] const std::vector<Spring>& springs() const { return springs_; }

 private:
  std::vector<Spring> springs_;
};

}  // namespace lv::solid
