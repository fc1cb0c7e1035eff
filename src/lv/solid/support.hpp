#pragma once

#include "lv/mesh/quadratic.hpp"
#include "lv/solid/base_motion.hpp"
#include "lv/solid/boundary.hpp"
#include "lv/solid/endocardial_surface.hpp"

#include <functional>
#include <span>
#include <vector>

namespace lv::solid {

/// How the strength of a support changes along the long axis: 1 at the apex and less towards the
/// base,
///
///   w(h) = at_base + (1 - at_base) s(h),  h from 0 at the surface's lowest node to 1 at its highest
///
///   even     s = 1
///   linear   s = 1 - h
///   sigmoid  s = 1/(1 + exp(steepness (h - middle))), with the constants of the program
///            pyansys-heart, whose pericardium holds the apical third
struct AxialWeight {
  enum class WeightShape { even, linear, sigmoid };

  WeightShape shape = WeightShape::even;
  double at_base = 0.0;                    ///< [-]
  double middle = 0.15, steepness = 25.0;  ///< of the sigmoid [-]

  [[nodiscard]] double at(double h) const;
};

/// Springs and dashpots per reference area of a surface, along its reference normal N and in the
/// plane across it.
struct Support {
  double normal_stiffness = 0.0, tangential_stiffness = 0.0;  ///< [kPa/mm]
  double normal_viscosity = 0.0, tangential_viscosity = 0.0;  ///< [kPa s/mm]
  AxialWeight weight = {};
  /// Mean of (n - N)(n - N)^T at a place X, where the normal springs and dashpots act along
  /// directions n that scatter about N, as the normals of flat facets do [-]; empty: along N.
  std::function<Mat3(const Vec3& X)> scatter = {};

  /// The same along all directions.
  [[nodiscard]] static Support in_all_directions(double stiffness, double viscosity) {
    return {stiffness, stiffness, viscosity, viscosity, {}, {}};
  }

  [[nodiscard]] bool is_none() const { return !has_springs() && !has_dashpots(); }
  [[nodiscard]] bool has_springs() const {
    return normal_stiffness != 0.0 || tangential_stiffness != 0.0;
  }
  [[nodiscard]] bool has_dashpots() const {
    return normal_viscosity != 0.0 || tangential_viscosity != 0.0;
  }
};

/// What holds a wall from outside, beside the springs at the base's nodes (BasalSupport).
struct Surroundings {
  Support epicardium = {}, base = {};

  [[nodiscard]] bool has_dashpots() const {
    return epicardium.has_dashpots() || base.has_dashpots();
  }

  /// The longest step dt of a leapfrog whose dashpots see the velocity of half a step before,
  /// around a mass m per area [kg/mm^2] that moves with the surfaces: (k/m) dt^2 + 2 (c/m) dt < 4
  /// with the largest k and c of both surfaces, which meet at the edge of the base [s]; infinite
  /// without supports.
  [[nodiscard]] double longest_step(double mass) const;
};

/// A supported surface. With u = x - X and the velocity v of its points,
///
///   F_a = -int phi_a w(h) {(N (x) N + S)(k_n u + c_n v) + (1 - N (x) N)(k_t u + c_t v)} dA   [mN]
///
/// with S the scatter of the normals, over the undeformed surface: linear in u and v, and
/// symmetric. A base that moves by U(X) has u - U for u, and v - dU/dt for v.
class SupportedSurface {
 public:
  SupportedSurface(const mesh::Mesh& mesh, const mesh::Surface& surface, const Support& support);

  /// Adds the forces of this rank's share of the sides. Velocities [mm/s] may be empty: at rest,
  /// with what holds the surface.
  void add_forces(std::span<const Vec3> positions, std::span<const Vec3> velocities,
                  std::span<Vec3> forces, const BasePlace& place = {}) const;

  /// -dF/dx where velocities change by `slope` [1/s] times positions: a block for each of this
  /// rank's sides.
  void add_stiffness(double slope, const EndocardialSurface::Block& add) const;

 private:
  struct Side {
    std::vector<int> nodes;
    Eigen::MatrixXd stiffness;  ///< [mN/mm]
    Eigen::MatrixXd viscosity;  ///< [mN s/mm]
    Eigen::VectorXd reference;  ///< X of the nodes [mm]
  };

  std::vector<Side> sides_;  ///< this rank's
};

/// All that holds a wall from outside, the same under both engines: the springs at the base's nodes
/// and the supported surfaces.
class Supports {
 public:
  Supports(const mesh::Mesh& mesh, const BasalSupport& base, const Surroundings& surroundings);

  /// Adds the forces of this rank's share, around a base that is held at a place. Velocities [mm/s]
  /// may be empty: at rest.
  void add_forces(std::span<const Vec3> positions, std::span<const Vec3> velocities,
                  std::span<Vec3> forces, const BasePlace& place = {}) const;

  /// Those at the base alone.
  void add_base_forces(std::span<const Vec3> positions, std::span<const Vec3> velocities,
                       std::span<Vec3> forces, const BasePlace& place) const;

  /// -dF/dx where velocities change by `slope` [1/s] times positions: a block for each side and
  /// node of this rank's share.
  void add_stiffness(double slope, const EndocardialSurface::Block& add) const;

 private:
  BasalPenalty springs_;
  SupportedSurface epicardium_, base_;
};

}  // namespace lv::solid
