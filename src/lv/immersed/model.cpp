#include "lv/immersed/model.hpp"

#include "lv/base/parallel.hpp"

namespace lv::immersed {

Model::Model(const mesh::Mesh& mesh, const mesh::FibreRule& fibres,
             const solid::WallMaterial& material, const material::NiedererHunterSmith& active,
             const ModelParameters& parameters)
    : parameters_(parameters),
      slab_(fluid::slab_of(parameters.grid, parallel::rank(), parallel::size())),
      wall_(mesh, fibres, material),
      contraction_(active, mesh.nodes, wall_.nodal_volumes(), parameters.blood.density,
                   parameters.grid.spacing.minCoeff()),
      base_(mesh, parameters.basal_stiffness),
      cavity_(mesh),
      endo_(mesh.endo),
      coupling_(make_coupling(parameters.coupling, mesh, parameters.grid, slab_)),
      transform_(parameters.grid, slab_),
      stokes_(parameters.grid, transform_, parameters.blood),
      stretch_(mesh.nodes.size()),
      positions_(mesh.nodes),
      node_velocities_(mesh.nodes.size(), Vec3::Zero()),
      node_forces_(mesh.nodes.size()),
      midpoints_(mesh.nodes.size()),
      velocity_(parameters.grid, slab_),
      convection_(parameters.grid, slab_),
      force_(parameters.grid, slab_),
      velocity_modes_(transform_.zero_modes()),
      force_modes_(transform_.zero_modes()) {}

void Model::step(const Loads& loads, double dt) {
  if (dt_ > 0.0) {
    wall_.nodal_stretch(positions_, stretch_);
    contraction_.advance(stretch_, calcium_, loads.calcium, dt_);
  }
  nodal_forces(loads);
  move_blood(loads, dt);
  move_wall(dt);
  dt_before_ = dt_;
  dt_ = dt;
  calcium_ = loads.calcium;
}

void Model::nodal_forces(const Loads& loads) {
  std::fill(node_forces_.begin(), node_forces_.end(), Vec3::Zero());
  wall_.add_elastic_forces(positions_, contraction_.tension(), node_forces_);
  solid::add_pressure_forces(endo_, loads.pressure, positions_, node_forces_);
  base_.add_forces(positions_, node_forces_);
  parallel::sum({node_forces_.data()->data(), 3 * node_forces_.size()});
}

void Model::move_blood(const Loads& loads, double dt) {
  const double r = dt_ + dt_before_ > 0.0 ? dt_ / (dt_ + dt_before_) : 0.0;
  fluid::convection_force(velocity_, parameters_.grid, parameters_.blood.density, {1.0 + r, -r},
                          convection_, force_);
  coupling_->spread(positions_, node_forces_, force_);
  transform_.to_modes(force_, force_modes_);
  stokes_.advance(velocity_modes_, force_modes_, 0.5 * (dt_ + dt), loads.drag);
  transform_.to_points(velocity_modes_, velocity_);
  fluid::fill_ghosts(velocity_, slab_);
}

void Model::move_wall(double dt) {
  for (std::size_t a = 0; a < positions_.size(); ++a)
    midpoints_[a] = positions_[a] + 0.5 * dt * node_velocities_[a];
  coupling_->interpolate(velocity_, midpoints_, node_velocities_);
  for (std::size_t a = 0; a < positions_.size(); ++a)
    positions_[a] += dt * node_velocities_[a];
}

}  // namespace lv::immersed
