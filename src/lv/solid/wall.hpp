#pragma once

#include "lv/material/myocardium.hpp"
#include "lv/mesh/fibres.hpp"
#include "lv/mesh/mesh.hpp"
#include "lv/solid/cell_stress.hpp"

#include <memory>
#include <span>
#include <vector>

namespace lv::solid {

/// Smallest and largest J over quadrature points.
struct VolumeRange {
  double min_J = 1.0;
  double max_J = 1.0;
};

/// Deformation and stress at one quadrature point, with tensors in the model frame.
struct PointSample {
  int cell = 0;
  double volume = 0.0;       ///< reference volume of the point [mm^3]
  Vec3 reference, position;  ///< [mm]
  double transmural = 0.0;
  double infarct = 0.0;  ///< M
  Mat3 F = Mat3::Identity();
  Mat3 fibre_frame = Mat3::Identity();  ///< columns f0, s0, n0
  mesh::WallAxes axes;  ///< circumferential, longitudinal, radial directions of the reference wall
  CellStress
      stress;  ///< its pressure is that of the volumetric penalty (2.20), without the fluid's
};

/// The wall as finite elements: the total-Lagrangian weak form (2.10) of all stresses. Every rank
/// knows all node positions and treats its share of the elements, several at once in the lanes of a
/// Pack.
class Wall {
 public:
  /// The mesh must outlive the wall. Throws InputError for an element that is inverted or
  /// collapsed, naming it.
  Wall(const mesh::Mesh& mesh, const material::Myocardium& material);
  ~Wall();
  Wall(Wall&&) noexcept;
  Wall& operator=(Wall&&) noexcept;

  /// Fibre stretch per node, int phi_a lambda dX / int phi_a dX; complete on every rank.
  void nodal_stretch(std::span<const Vec3> positions, std::span<double> stretch) const;

  /// Adds the nodal forces of this rank's elements, F_a = -int P : grad phi_a dX [mN], to `forces`.
  /// `tension` is the active tension per node [kPa], before the infarct's factor. Returns the range
  /// of J in these elements.
  // NOLINTNEXTLINE(modernize-use-nodiscard): the forces are what it is called for
  VolumeRange add_elastic_forces(std::span<const Vec3> positions, std::span<const double> tension,
                                 std::span<Vec3> forces) const;

  /// Reference volume that belongs to each node, int phi_a dX [mm^3]; complete on every rank.
  [[nodiscard]] std::span<const double> nodal_volumes() const;

  /// Every quadrature point of this rank's elements.
  [[nodiscard]] std::vector<PointSample> sample(std::span<const Vec3> positions,
                                                std::span<const double> tension) const;

  class Elements;  // the elements of one kind, in wall.cpp

 private:
  std::unique_ptr<Elements> elements_;
};

}  // namespace lv::solid
