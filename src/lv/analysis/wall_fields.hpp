#pragma once

#include "lv/heartbeat/beat.hpp"
#include "lv/solid/cardiac_model.hpp"
#include "lv/solid/wall.hpp"

#include <limits>
#include <span>
#include <vector>

namespace lv::analysis {

/// Means over the quadrature points of one element, at one time; tensors in the model frame. Fibre
/// stress is not what the mean tensors and f0 give: fibres turn by tens of degrees within a large
/// element.
struct CellFields : solid::CellStress {
  double volume = 0.0;            ///< of the undeformed element, with its curve [mm^3]
  Vec3 reference = Vec3::Zero();  ///< centre, undeformed [mm]
  Vec3 position = Vec3::Zero();   ///< centre, deformed [mm]
  double transmural = 0.0;
  double infarct = 0.0;  ///< M
  double J = 1.0;        ///< deformed over undeformed volume of the element
  double fibre_stretch = 1.0;
  /// When it is activated, after the calcium of the beat begins [s]; not a number: at once with the
  /// others.
  double activation_time = std::numeric_limits<double>::quiet_NaN();
  /// Factor of the tension; not a number: the muscle is the same everywhere.
  double contractility = std::numeric_limits<double>::quiet_NaN();
  /// What its muscle did over the last heartbeat, by its volume [kPa]; not a number: not known.
  double work_density = std::numeric_limits<double>::quiet_NaN();
  Mat3 F = Mat3::Identity();
  Mat3 fibre_frame = Mat3::Identity();  ///< columns f0, s0, n0
  mesh::WallAxes axes;                  ///< of the undeformed wall

  /// sigma = sigma^p + sigma^a - p (2.6), without the small viscous part [kPa].
  [[nodiscard]] Mat3 cauchy_total() const {
    return cauchy_passive + cauchy_active - pressure * Mat3::Identity();
  }

  /// f.sigma f of the whole sigma [kPa].
  [[nodiscard]] double fibre_stress() const {
    return fibre_stress_passive + fibre_stress_active - pressure;
  }
};

/// All elements of a snapshot on the root, in the mesh's order; empty on other ranks. Of each
/// element, `volumes` are those of mesh::cell_volumes, `pressure` is p on the root; empty: 0.
/// Collective.
[[nodiscard]] std::vector<CellFields> cell_fields(const solid::Wall& wall,
                                                  const heartbeat::Snapshot& snapshot,
                                                  std::span<const double> volumes,
                                                  std::span<const double> pressure);

/// The fields of a shape without tension and pressure: enough for strains. Collective.
[[nodiscard]] std::vector<CellFields> shape_fields(const solid::Wall& wall,
                                                   std::span<const double> volumes,
                                                   const std::vector<Vec3>& positions);

/// Turns a wall's snapshots into fields, with the stresses and p that the snapshot brings or else
/// those of its nodes' tension and the p that balances its forces (wall_pressure.hpp).
/// All is collective; fields are on the root, empty on other ranks.
class FieldAnalysis {
 public:
  /// The mesh must outlive the analysis. `activation_times`: of the nodes [s]; empty: all at once.
  FieldAnalysis(const mesh::Mesh& mesh, const solid::CardiacModel& model,
                std::vector<double> activation_times = {});

  [[nodiscard]] std::vector<CellFields> fields(const heartbeat::Snapshot& snapshot) const;

  /// Of the undeformed wall.
  [[nodiscard]] std::vector<CellFields> at_rest() const;

 private:
  /// With what is known of the nodes besides.
  [[nodiscard]] std::vector<CellFields> completed(std::vector<CellFields> cells) const;

  const mesh::Mesh& mesh_;
  std::vector<double> activation_times_;
  std::vector<double> contractility_;  ///< per node; may be empty
  std::vector<double> volumes_;        ///< undeformed, per element [mm^3]
  solid::Wall wall_;                   ///< without volumetric penalty: p stands for it
  solid::Supports supports_;
};

/// Gives every cell the work density of the finite element that it is a part of [kPa]; leaves them
/// where there is none.
void set_work_density(std::span<const double> of_elements, std::vector<CellFields>& cells);

/// Green-Lagrange strain of an element between two states, E = (F^T F - 1)/2 with F = F_now
/// F_then^-1, in the wall's own directions at the earlier state.
struct CellStrain {
  double fibre = 0.0;
  double circumferential = 0.0, radial = 0.0, longitudinal = 0.0;
  double circumferential_radial = 0.0, circumferential_longitudinal = 0.0,
         radial_longitudinal = 0.0;
  double thickening = 0.0;  ///< stretch of the wall's thickness minus 1
};

/// Strain from the undeformed wall (early diastole).
[[nodiscard]] CellStrain strain(const CellFields& now);

/// Strain from an earlier state: the paper's systolic strain is from end-diastole. The directions
/// follow the rule of mesh::wall_axes on the wall as it was then.
[[nodiscard]] CellStrain strain(const CellFields& now, const CellFields& then);

}  // namespace lv::analysis
