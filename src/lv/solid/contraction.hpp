#pragma once

#include "lv/material/law.hpp"
#include "lv/material/muscle_states.hpp"
#include "lv/mesh/mesh.hpp"
#include "lv/solid/rate_filter.hpp"

#include <span>
#include <vector>

namespace lv::solid {

/// The nodes of a contracting wall: positions in the undeformed wall [mm], the volume around each
/// [mm^3], the strength of contraction left by an infarct, 1 - M (2.24), and the factor of the
/// tension where segments differ (empty: 1).
struct ContractingNodes {
  std::span<const Vec3> positions;
  std::span<const double> volumes;
  std::span<const double> strength;
  std::span<const double> contractility = {};
};

/// The strength per node of an infarcted wall.
[[nodiscard]] std::vector<double> strength(const mesh::Mesh& mesh,
                                           const material::InfarctScaling& infarct);

/// The contractile state of the wall, kept at its nodes; between them the tension is interpolated
/// by the finite elements.
///
/// The fibre stretch of a node is the mean over the elements around it, lambda_a = int phi_a lambda
/// dX / int phi_a dX. Stretch and tension so pass through transposed operators, and the stiffness
/// dT/dlambda of the fading memory (some 25 MPa) stays symmetric. The stretch rate that enters the
/// fading memory is smoothed by a RateFilter. What the filter takes away, r - r~, meets a viscous
/// tension 0.3 rho h^2/dt (r - r~) instead: the fading memory also damps, and without any damping
/// short waves grow by the delayed rise of tension after a stretch (A.4)-(A.5). Both vanish with
/// the step and in a steady state.
///
/// Every rank knows and advances all nodes.
class Contraction {
 public:
  /// `density` of the muscle [kg/mm^3]; `shortest_wave` h, the grid's spacing [mm].
  /// A law without kinetics leaves the tension to prescribe().
  Contraction(const material::ActiveLaw& law, const ContractingNodes& nodes, double density,
              double shortest_wave);

  /// Brings every node to its steady state at this calcium [uM] and a stretch of 1.
  void relax(double Ca);

  /// The same at a stretch of its own at each node.
  void relax(double Ca, std::span<const double> stretch);

  /// Calcium before and after a step, of each node or a single number for all [uM].
  struct CalciumStep {
    std::span<const double> before, after;
  };

  /// Advances by dt [s] to the given nodal stretches.
  void advance(std::span<const double> stretch, const CalciumStep& calcium, double dt);

  /// The same with the same calcium everywhere.
  void advance(std::span<const double> stretch, double Ca_before, double Ca_after, double dt) {
    advance(stretch, {{&Ca_before, 1}, {&Ca_after, 1}}, dt);
  }

  /// The same tension at every node instead, times its factor [kPa].
  void prescribe(double tension);

  /// Speed of the fastest fibre wave, sqrt(max dT/dlambda / rho), with the stiffness that a sudden
  /// stretch meets: (1+a) sum A_i T_0 of Niederer, Hunter and Smith [mm/s].
  [[nodiscard]] double wave_speed() const;

  /// Tension per node, with the damping of short waves, which is zero in a steady state, and
  /// without the infarct's factor, which the wall's elements apply [kPa].
  [[nodiscard]] std::span<const double> tension() const { return tension_; }

  /// The state as numbers, those of the law at each node and the filter's width, and back: for
  /// checkpoints.
  [[nodiscard]] std::vector<double> state() const;
  void set_state(std::span<const double> numbers);

 private:
  void damp_what_is_smoothed_away(double dt);
  void publish_tension();

  material::MuscleStates<Pack> muscle_;  ///< at the nodes
  double density_;
  double shortest_wave_;
  RateFilter filter_;
  double filter_width_ = 0.0;  ///< changes in steps: a lattice that moves with every breath of T_0
                               ///< would make noise [mm]
  std::vector<double> tension_;
  std::vector<double> strength_;
  std::vector<double> contractility_;
  std::vector<double> stiffness_;  ///< of a sudden stretch, with the infarct's factor [kPa]
  std::vector<double> stretch_rate_;
  std::vector<double> damping_;
};

}  // namespace lv::solid
