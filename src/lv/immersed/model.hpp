#pragma once

#include "lv/fluid/advect.hpp"
#include "lv/fluid/stokes.hpp"
#include "lv/immersed/coupling.hpp"
#include "lv/solid/cardiac_model.hpp"
#include "lv/solid/contraction.hpp"
#include "lv/solid/endocardial_surface.hpp"
#include "lv/solid/loads.hpp"
#include "lv/solid/opening.hpp"
#include "lv/solid/support.hpp"
#include "lv/solid/wall.hpp"

#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace lv::immersed {

struct ModelParameters {
  fluid::Grid grid;
  fluid::Blood blood;
  CouplingParameters coupling;
};

/// Everything that one rank's part of a Model carries from step to step.
struct ModelState {
  std::vector<Vec3> positions, node_velocities;
  std::vector<Vec3> velocity_change;  ///< of the nodes in the last step [mm/s]
  std::vector<double> contraction;
  fluid::ModeField velocity_modes;
  fluid::FaceField convection;
  double dt = 0.0;                   ///< of the last step [s]
  double dt_before = 0.0;            ///< of the one before [s]
  std::vector<double> calcium{0.0};  ///< at the last step, of each node or a single one of all [uM]
  bool slack = false;                ///< without tension, see Model::slacken
};

/// What a step says about itself; the same on all ranks.
struct StepReport {
  bool inside_box = true;           ///< false also when a position is not a number
  double largest_node_speed = 0.0;  ///< [mm/s]
  /// Correlation of the nodes' last two velocity changes: near 1 for a motion that the steps
  /// resolve, near -1 for one that flips from step to step.
  double smoothness = 1.0;
  double velocity_change = 0.0;  ///< rms of the last change of the nodes' velocities [mm/s]
  solid::VolumeRange J;          ///< at the start of the step, over all ranks
  double pressure = 0.0;         ///< in the cavity, as it was given or found [kPa]
};

/// How the cavity's volume at the end of a step follows the pressure p during it,
/// V + dV/dp (p - guess). V is that before the step and what the endocardium sweeps in it against
/// the lid on the opening, which an elastic base carries (solid::Opening) and which otherwise goes
/// with the place where the base is held. It does not go with the endocardium's edge: that edge is
/// light, the pressure does not push the lid (solid::EndocardialSurface), and a volume that
/// followed it would give it a negative mass.
struct StepVolume {
  double guess = 0.0;         ///< [kPa]
  double volume = 0.0;        ///< V [mm^3]
  double per_pressure = 0.0;  ///< dV/dp [mm^3/kPa]
};

/// How the base is held in a step. Both at rest: it stays where it was undeformed.
struct HeldBase {
  /// Where its springs pull to at the start of the step, and how fast that place moves in the half
  /// step before, whose velocity the dashpots see.
  solid::BasePlace start{};
  solid::AffineField velocity{};  ///< of that place in the step [mm/s]
};

/// The pressure that a step should have [kPa]; not a number: there is none, and the step fails.
using PressureOfStep = std::function<double(const StepVolume&)>;

/// The wall immersed in blood (2.1)-(2.4), advanced by a staggered leapfrog: positions at whole
/// steps, velocities at half steps. Second order in time:
///
///   T^n         from (A.2)-(A.11) with the stretch increment of the step that ended at t^n
///   F^n         = weak form of all stresses and loads at x^n                                   (2.9)-(2.10)
///                 and the supports' forces at x^n; their dashpots see the velocity U^{n-1/2}
///   u^{n+1/2}   from u^{n-1/2}, the force at t^n and convection extrapolated to t^n            (2.1)-(2.2)
///   x^{n+1}     = x^n + dt U,  U = u^{n+1/2} interpolated at x^n + dt/2 U^{n-1/2}              (2.4)
class Model {
 public:
  /// The mesh must outlive the model. Throws InputError when the wall does not fit in the box, or
  /// an element is inverted.
  Model(const mesh::Mesh& mesh, const solid::CardiacModel& heart,
        const ModelParameters& parameters);

  /// Advances by dt [s] from the present time, at which `loads` act. `drag` [1/s] is a uniform
  /// resistance to the velocity, which moves no equilibrium.
  StepReport step(const solid::Loads& loads, double dt, double drag = 0.0);

  /// The same under a pressure that is found within the step. The step is linear in the pressure:
  /// with u_g under a guess, that of `loads`, and the response u_1 of wall and blood at rest to a
  /// unit pressure over this step, another solve of the same equations,
  ///
  ///   u = u_g + (p - guess) u_1,   x^{n+1} = x^n + dt U,
  ///   dV = dt dV/dx(x^n + dt/2 U^{n-1/2}) . (U - L),   L the velocity of the lid
  ///
  /// u_1 changes as slowly as the wall's shape does: it is kept until `anew` asks for another or
  /// dt changes. `anew` also makes the velocity anew from its modes, so that a restored model takes
  /// the same steps from there on to the last bit.
  StepReport step(const solid::Loads& loads, double dt, const PressureOfStep& pressure, bool anew);

  /// How the base is held in the steps from now on; no part of the state.
  void hold_base(const HeldBase& base) { base_ = base; }

  /// The longest step that the supports of epicardium and base allow [s]: the springs move at least
  /// the blood of one mesh width h with the wall, rho h per area (Surroundings::longest_step). The
  /// 4-point kernel spreads a sheet's force over 8/3 h.
  [[nodiscard]] double longest_step() const { return longest_step_; }

  /// The forces on the nodes at the start of the last step [mN]; complete on every rank.
  [[nodiscard]] std::span<const Vec3> node_forces() const { return node_forces_; }

  /// The model as it is now, and back to an earlier state: all steps after it come out the same to
  /// the last bit.
  [[nodiscard]] const ModelState& state();
  void restore(const ModelState& state);

  /// Pressure of blood and wall at cell centres at the start of the last step, one Component per
  /// slab [kPa].
  [[nodiscard]] fluid::Component pressure() const;

  /// Brings the muscle to its resting state at this calcium [uM].
  void relax(double calcium);

  /// Muscle without any tension, whatever the calcium, until it is brought to a balance.
  void slacken() { state_.slack = true; }

  /// Brings the muscle to its steady state at this calcium [uM] and the stretch that it now has.
  void balance(double calcium);

  [[nodiscard]] std::span<const Vec3> positions() const { return state_.positions; }
  [[nodiscard]] std::span<const Vec3> node_velocities() const { return state_.node_velocities; }
  [[nodiscard]] double cavity_volume() const {
    return endocardium_.volume(state_.positions);
  }  ///< [mm^3]
  /// Over the wall, with the infarct's factor (2.24), weighted by reference volume [kPa].
  [[nodiscard]] double mean_tension() const;
  /// The mean of what each node has, weighted by reference volume.
  [[nodiscard]] double mean(std::span<const double> at_nodes) const;
  [[nodiscard]] const solid::Contraction& contraction() const { return contraction_; }
  [[nodiscard]] const solid::Wall& wall() const { return wall_; }
  [[nodiscard]] const fluid::FaceField& velocity() const { return velocity_; }
  [[nodiscard]] const fluid::BoxTransform& transform() const { return transform_; }
  [[nodiscard]] const fluid::Grid& grid() const { return parameters_.grid; }
  [[nodiscard]] const fluid::Slab& slab() const { return slab_; }
  /// Whether nodes at these positions would be far enough from the box's sides; none that is no
  /// number is.
  [[nodiscard]] bool inside_box(std::span<const Vec3> positions) const;

 private:
  void activate(const solid::Loads& loads);
  solid::VolumeRange nodal_forces(double pressure);
  void move_blood(double drag, double dt);
  StepReport move_wall(double dt, const std::function<double()>& correct_velocities);
  double find_pressure(double guess, double dt, const PressureOfStep& pressure);
  void find_response(double half_steps);
  StepReport finished(StepReport report, const solid::VolumeRange& J, const solid::Loads& loads,
                      double dt);

  ModelParameters parameters_;
  fluid::Slab slab_;
  solid::Wall wall_;
  material::ActiveLaw active_;
  std::vector<double> strength_;  ///< of contraction, per node
  solid::Contraction contraction_;
  solid::Supports supports_;
  double longest_step_;
  solid::EndocardialSurface endocardium_;
  solid::Opening opening_;
  bool base_is_elastic_;
  HeldBase base_;
  Transfer transfer_;
  std::unique_ptr<Coupling> coupling_;
  fluid::BoxTransform transform_;
  fluid::Stokes stokes_;

  ModelState state_;
  std::vector<double> stretch_;
  std::vector<Vec3> node_forces_, midpoints_;
  fluid::FaceField velocity_, force_;
  fluid::ModeField force_modes_;

  /// What a unit pressure in the cavity does in a step.
  struct Response {
    double half_steps;  ///< of the last and this step, from middle to middle [s]
    std::vector<Vec3> nodes;
    fluid::FaceField velocity;
    fluid::ModeField modes, force_modes;
  };
  std::optional<Response> response_;
};

}  // namespace lv::immersed
