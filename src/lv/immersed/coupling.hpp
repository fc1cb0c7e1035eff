#pragma once

#include "lv/immersed/transfer.hpp"
#include "lv/mesh/mesh.hpp"

#include <memory>
#include <span>

namespace lv::immersed {

/// How the wall's finite elements meet the grid.
enum class CouplingKind {
  /// Forces are spread from the nodes and velocities interpolated to them (lumped weights).
  nodal,
  /// The paper's scheme: dynamically generated Gauss points, forces and velocities projected on the
  /// finite elements.
  quadrature
};

/// The discrete form of (2.9) and (2.4): nodal forces to the grid, grid velocity to the nodes,
/// adjoint to each other. Every rank knows all nodes and serves its own slab.
class Coupling {
 public:
  virtual ~Coupling() = default;

  /// Adds the force density of the nodal forces [mN] of a wall at `positions`.
  virtual void spread(std::span<const Vec3> positions, std::span<const Vec3> forces,
                      fluid::FaceField& force) const = 0;

  /// Nodal velocities at `positions`, complete on every rank.
  virtual void interpolate(const fluid::FaceField& velocity, std::span<const Vec3> positions,
                           std::span<Vec3> velocities) const = 0;
};

struct CouplingParameters {
  CouplingKind kind = CouplingKind::nodal;
  Kernel kernel = Kernel::peskin4;
  double points_per_cell =
      2.0;  ///< least density of Gauss points per mesh width (quadrature coupling)
};

[[nodiscard]] std::unique_ptr<Coupling> make_coupling(const CouplingParameters& parameters,
                                                      const mesh::Mesh& mesh,
                                                      const fluid::Grid& grid,
                                                      const fluid::Slab& slab);

}  // namespace lv::immersed
