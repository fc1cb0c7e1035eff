#pragma once

#include "lv/fluid/advect.hpp"
#include "lv/fluid/stokes.hpp"
#include "lv/immersed/coupling.hpp"
#include "lv/solid/boundary.hpp"
#include "lv/solid/cavity.hpp"
#include "lv/solid/contraction.hpp"
#include "lv/solid/wall.hpp"

#include <memory>
#include <vector>

namespace lv::immersed {

/// What acts on the model from outside at one time.
struct Loads {
  double pressure = 0.0;  ///< on the endocardium [kPa]
  double calcium = 0.0;   ///< [uM]
  double drag = 0.0;      ///< uniform resistance to the velocity [1/s]; moves no equilibrium
};

struct ModelParameters {
  fluid::Grid grid;
  fluid::Blood blood;
  CouplingParameters coupling;
  double basal_stiffness = 100.0;  ///< kappa of BasalPenalty [kPa/mm]
};

/// The wall immersed in blood (2.1)-(2.4), advanced by a staggered leapfrog: positions at whole
/// steps, velocities at half steps. Second order in time:
///
///   T^n         from (A.2)-(A.11) with the stretch increment of the step that ended at t^n
///   F^n         = weak form of all stresses and loads at x^n                                   (2.9)-(2.10)
///   u^{n+1/2}   from u^{n-1/2}, the force at t^n and convection extrapolated to t^n            (2.1)-(2.2)
///   x^{n+1}     = x^n + dt U,  U = u^{n+1/2} interpolated at x^n + dt/2 U^{n-1/2}              (2.4)
class Model {
 public:
  Model(const mesh::Mesh& mesh, const mesh::FibreRule& fibres, const solid::WallMaterial& material,
        const material::NiedererHunterSmith& active, const ModelParameters& parameters);

  /// Advances by dt [s] from the present time, at which `loads` act.
  void step(const Loads& loads, double dt);

  [[nodiscard]] std::span<const Vec3> positions() const { return positions_; }
  [[nodiscard]] std::span<const Vec3> node_velocities() const { return node_velocities_; }
  [[nodiscard]] double cavity_volume() const { return cavity_.volume(positions_); }
  [[nodiscard]] solid::Contraction& contraction() { return contraction_; }
  [[nodiscard]] const solid::Contraction& contraction() const { return contraction_; }
  [[nodiscard]] const solid::Wall& wall() const { return wall_; }
  [[nodiscard]] const fluid::FaceField& velocity() const { return velocity_; }
  [[nodiscard]] const fluid::Grid& grid() const { return parameters_.grid; }
  [[nodiscard]] const fluid::Slab& slab() const { return slab_; }

 private:
  void nodal_forces(const Loads& loads);
  void move_blood(const Loads& loads, double dt);
  void move_wall(double dt);

  ModelParameters parameters_;
  fluid::Slab slab_;
  solid::Wall wall_;
  solid::Contraction contraction_;
  solid::BasalPenalty base_;
  solid::Cavity cavity_;
  mesh::Surface endo_;
  std::unique_ptr<Coupling> coupling_;
  fluid::BoxTransform transform_;
  fluid::Stokes stokes_;

  std::vector<double> stretch_;
  std::vector<Vec3> positions_, node_velocities_, node_forces_, midpoints_;
  fluid::FaceField velocity_, convection_, force_;
  fluid::ModeField velocity_modes_, force_modes_;
  double dt_ = 0.0;         ///< of the last step [s]
  double dt_before_ = 0.0;  ///< of the one before
  double calcium_ = 0.0;    ///< at the last step
};

}  // namespace lv::immersed
