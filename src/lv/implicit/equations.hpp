#pragma once

#include "lv/implicit/contractility.hpp"
#include "lv/implicit/motion.hpp"
#include "lv/implicit/reference_wall.hpp"
#include "lv/implicit/sparse.hpp"
#include "lv/material/compressibility.hpp"
#include "lv/solid/cardiac_model.hpp"
#include "lv/solid/cell_stress.hpp"
#include "lv/solid/endocardial_surface.hpp"
#include "lv/solid/loads.hpp"
#include "lv/solid/support.hpp"

#include <functional>
#include <vector>

namespace lv::implicit {

using solid::Loads;

/// Active tension without the infarct's factor, at a fibre stretch, of a quadrature point: the
/// element's place among this rank's, and the point's in it.
using TensionAt = std::function<Tension(std::size_t element, std::size_t point, double stretch)>;

/// Springs that yield by micrometres under the pressures of a ventricle [kPa/mm].
inline constexpr double rigid_base = 1e6;

/// Volumetric stiffness at every quadrature point, beside the pressures' weaker constraint. Zero at
/// J = 1, so no solution sees it, but it holds the deformations inside an element that change
/// volume here and there and not in the mean: under what acts there as a pressure they would
/// buckle. That is p, and in muscle of Holzapfel and Ogden's law a exp[b(I1-3)] of (2.18), which
/// grows without bound as stiff muscle is filled. So what is `usual` for the paper's muscle (a_0,
/// b_0) is grown by
///
///   max(1, a exp(b x)/[a_0 exp(b_0 x)]),  x = 0.25,
///
/// x being I1 - 3 at end-diastole, of the endocardium of steep muscle and of the mean of other
/// walls, where muscle is stretched by some 1.16 along and across its fibres. Much more than the
/// muscle's own stiffness at rest (some 300 a) lets Newton's method take short steps only, for any
/// change of shape changes volumes at points to second order (docs/method.md). Of quadratic
/// elements only: linear ones would lock.
[[nodiscard]] material::Volumetric held_against_buckling(const material::AnyPassiveLaw& passive,
                                                         const material::Volumetric& usual);

/// A cardiac model as the implicit engine sees it. Viscosity, density and dashpots count in a
/// motion alone.
struct StaticModel {
  /// Of the paper's muscle and softer one (held_against_buckling).
  static constexpr material::Volumetric default_stabilisation{.beta_s = 10.0};
  /// Where less has failed: more than the pressure p of contracted muscle, up to 50 kPa.
  static constexpr material::Volumetric firm_stabilisation{.beta_s = 100.0};

  // NOLINTNEXTLINE(google-explicit-constructor): it is the same model
  StaticModel(const solid::CardiacModel& model, const material::Calcium& calcium = {},
              const material::Volumetric& at_points = default_stabilisation)
      : heart(model),
        contractility(heart.myocardium.active, calcium),
        stabilisation(held_against_buckling(heart.myocardium.passive, at_points)) {}

  solid::CardiacModel heart;  ///< its volumetric penalty is not used: the wall is incompressible
  Contractility contractility;
  material::Volumetric stabilisation;
  material::Compressibility compressibility = {};
  double density = 0.0;  ///< of the wall [kg/mm^3]; 0: without inertia

  /// Whether its forces depend on rates.
  [[nodiscard]] bool has_rates() const {
    return density > 0.0 || heart.myocardium.viscosity.eta > 0.0 ||
           heart.surroundings.has_dashpots();
  }
};

/// Positions of the nodes [mm] and pressures of the elements [kPa]: all unknowns, on every rank.
/// The cavity's pressure is one of them where the cavity's volume is given instead.
struct State {
  std::vector<Vec3> positions;
  std::vector<double> pressures;
  double cavity_pressure = 0.0;  ///< [kPa]
};

/// The unknowns of one element.
struct ElementState {
  Eigen::Matrix3Xd x;  ///< of its nodes [mm]
  Eigen::VectorXd p;   ///< its pressures [kPa]
};

[[nodiscard]] ElementState element_state(const ReferenceWall& wall, int element,
                                         const State& state);

/// Equilibrium of the incompressible wall in weak form, for all test functions phi_a and q_m:
///
///   R_a = int [P_passive(F) + P_active(F) + P_stabilisation(F) + p cof F] grad phi_a dX
///         - p_endo dV/dx_a + K_base (x_a - X_a)         = 0                                [mN]
///   R_m = int q_m (J - 1) dX                            = 0                                [mm^3]
///
/// with P_passive from (2.18) and (2.23), P_active from (2.21) and (2.24), V of the cavity. p is
/// the tension that holds J = 1: the Cauchy stress is sigma^p + sigma^a + p 1, so -p is the p of
/// (2.6). Unknowns are numbered 3 a + i for the positions, then the pressures.
///
/// A wall that resists changes of volume with a finite modulus has J - J(p) for J - 1. Supports of
/// the epicardium and the base add their forces to R_a, and a motion its rates:
///
///   R_a += int rho phi_a sum_b phi_b a_b dX + int F S_viscous grad phi_a dX - F_support(x, v)
class Equations {
 public:
  /// The mesh must outlive the equations.
  Equations(const mesh::Mesh& mesh, const StaticModel& model);

  /// Other muscle on the same mesh, with the same fibres.
  void set_model(const StaticModel& model);

  /// Undeformed, without pressures.
  [[nodiscard]] State rest() const;

  [[nodiscard]] int size() const { return 3 * node_count() + wall_.pressure_count; }
  [[nodiscard]] int node_count() const { return static_cast<int>(mesh_.nodes.size()); }

  /// The nodes' places before any load [mm].
  [[nodiscard]] std::span<const Vec3> undeformed() const { return mesh_.nodes; }

  [[nodiscard]] const solid::EndocardialSurface& endocardium() const { return endocardium_; }
  [[nodiscard]] const StaticModel& model() const { return model_; }

  /// Which unknowns the tangent joins.
  [[nodiscard]] Pattern pattern() const;

  /// The steady tension of an activation, with the factors of the model's segments.
  [[nodiscard]] TensionAt steady(double activation) const;

  /// These factors at the quadrature points of this rank's elements, one after the other; empty
  /// where all are 1.
  [[nodiscard]] std::span<const double> contractility() const { return contractility_; }

  /// R under a pressure in the cavity [kPa], complete on every rank; empty when an element is
  /// turned inside out at some point of any rank. The base is held at a place, which the tangent
  /// does not depend on.
  [[nodiscard]] std::vector<double> residual(const State& state, double pressure,
                                             const TensionAt& tension,
                                             const Motion* motion = nullptr,
                                             const solid::BasePlace& base = {}) const;

  /// The same under loads, with steady tension.
  [[nodiscard]] std::vector<double> residual(const State& state, const Loads& loads) const {
    return residual(state, loads.pressure, steady(loads.activation));
  }

  /// Sets a matrix to dR/d(unknowns), and its pressure mass.
  void tangent(const State& state, double pressure, const TensionAt& tension, SparseMatrix& K,
               const Motion* motion = nullptr) const;
  void tangent(const State& state, const Loads& loads, SparseMatrix& K) const {
    tangent(state, loads.pressure, steady(loads.activation), K);
  }

  /// The force of a unit pressure in the cavity, and the derivative of the cavity's volume, which
  /// are the same as long as the base stays in its plane; complete on every rank, as long as R
  /// [mm^2].
  [[nodiscard]] std::vector<double> pressure_force(const State& state) const;
  [[nodiscard]] std::vector<double> volume_gradient(const State& state) const;

  /// This rank's elements, and the quadrature points of each.
  [[nodiscard]] std::size_t own_elements() const { return wall_.points.size(); }
  [[nodiscard]] std::span<const int> own() const { return wall_.own; }
  [[nodiscard]] std::size_t elements() const { return wall_.owners.size(); }  ///< of all ranks
  [[nodiscard]] std::size_t points_per_element() const {
    return static_cast<std::size_t>(wall_.pressure_shapes.value.rows());
  }

  /// The fibre stretch at the quadrature points of this rank's elements, one after the other.
  [[nodiscard]] std::vector<double> fibre_stretch(const State& state) const;

  /// Volume-weighted mean over the wall of T with the infarct's factor [kPa].
  [[nodiscard]] double mean_tension(const State& state, const TensionAt& tension) const;

  /// The values at the quadrature points of this rank's elements, one after the other, of a field
  /// that nodes have: the elements' shapes between them, never beyond the values of the element's
  /// own nodes. None of an empty one.
  [[nodiscard]] std::vector<double> at_points(std::span<const double> nodal) const;

  /// Volume-weighted mean over the wall of what those points have.
  [[nodiscard]] double mean(std::span<const double> at_points) const;

  /// int W dX of the passive law, the stabilisation and the resistance to changes of volume [mN
  /// mm].
  [[nodiscard]] double stored_energy(const State& state) const;

  /// int rho v.v/2 dX; 0 without a density [mN mm].
  [[nodiscard]] double kinetic_energy(std::span<const Vec3> velocities) const;

  /// What muscle does while the wall goes from one state to another, -int P_active : dF dX, by the
  /// mean of both stresses; positive where it shortens under tension: of every element, by its
  /// undeformed volume [kPa], and in all [mN mm]. Collective.
  struct Working {
    const State& state;
    const TensionAt& tension;
  };
  struct MuscleWork {
    std::vector<double> density;
    double whole = 0.0;
  };
  [[nodiscard]] MuscleWork muscle_work(const Working& from, const Working& to) const;

  /// What the cavity's pressure does on the endocardium on the way from one state to another [mN
  /// mm].
  [[nodiscard]] double pressure_work(const State& from, const State& to) const;

  /// What the wall does on its supports, and what its viscosity does, int P_viscous : dF dX, on the
  /// same way [mN mm]. Velocities [mm/s] may be empty: at rest.
  struct Moving {
    std::span<const Vec3> positions, velocities;
    solid::BasePlace base = {};
  };
  [[nodiscard]] double support_work(const Moving& from, const Moving& to) const;
  /// What is done on the supports by whatever moves the base: int F_base . dU with the forces
  /// F_base of springs and dashpots on the wall [mN mm].
  [[nodiscard]] double base_work(const Moving& from, const Moving& to) const;
  [[nodiscard]] double viscous_work(const Moving& from, const Moving& to) const;

  /// Stress in every linear cell of the mesh, complete on every rank: means over the cell of what
  /// the elements' own displacement and pressure give, with the tension of the nearest quadrature
  /// point's muscle. Collective.
  [[nodiscard]] std::vector<solid::CellStress> cell_stress(const State& state,
                                                           const TensionAt& tension) const;

 private:
  struct Inside {
    std::vector<double> R;
    bool inverted = false;  ///< at some point
  };
  [[nodiscard]] Inside inside(const State& state, const TensionAt& tension,
                              const Motion* motion) const;
  [[nodiscard]] std::vector<double> summed(std::span<const Vec3> of_nodes) const;

  /// Adds the forces of the cavity's pressure, and of the right ventricle's on the septum.
  void add_pressure(double pressure, std::span<const Vec3> positions, std::span<Vec3> forces) const;

  const mesh::Mesh& mesh_;
  ReferenceWall wall_;
  solid::EndocardialSurface endocardium_, septum_;
  StaticModel model_;
  solid::Supports supports_;
  std::vector<double> contractility_;
  std::vector<Eigen::MatrixXd> masses_;  ///< int rho phi phi^T dX of own elements; none: no inertia
};

}  // namespace lv::implicit
