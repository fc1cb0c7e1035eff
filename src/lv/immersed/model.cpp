#include "lv/immersed/model.hpp"

#include "lv/base/check.hpp"
#include "lv/base/parallel.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace lv::immersed {
namespace {

/// Of each node, or a single number of all.
std::span<const double> calcium_of(const solid::Loads& loads) {
  if (loads.calcium_at_nodes.empty())
    return {&loads.calcium, 1};
  return loads.calcium_at_nodes;
}

}  // namespace

Model::Model(const mesh::Mesh& mesh, const solid::CardiacModel& heart,
             const ModelParameters& parameters)
    : parameters_(parameters),
      slab_(fluid::slab_of(parameters.grid, parallel::rank(), parallel::size())),
      wall_(mesh, heart.myocardium),
      active_(heart.myocardium.active),
      strength_(solid::strength(mesh, heart.myocardium.infarct)),
      contraction_(
          active_,
          {mesh.nodes, wall_.nodal_volumes(), strength_, mesh::at_nodes(mesh, heart.contractility)},
          parameters.blood.density, parameters.grid.spacing.minCoeff()),
      supports_(mesh, heart.base, heart.surroundings),
      longest_step_(heart.surroundings.longest_step(parameters.blood.density *
                                                    parameters.grid.spacing.minCoeff())),
      endocardium_(mesh),
      opening_(mesh),
      base_is_elastic_(heart.base.kind == solid::BasalSupport::Kind::elastic),
      transfer_(parameters.grid, slab_, parameters.coupling.kernel),
      coupling_(make_coupling(parameters.coupling, mesh, parameters.grid, slab_)),
      transform_(parameters.grid, slab_),
      stokes_(parameters.grid, transform_, parameters.blood),
      state_{mesh.nodes,
             std::vector<Vec3>(mesh.nodes.size(), Vec3::Zero()),
             std::vector<Vec3>(mesh.nodes.size(), Vec3::Zero()),
             contraction_.state(),
             transform_.zero_modes(),
             fluid::FaceField(parameters.grid, slab_)},
      stretch_(mesh.nodes.size()),
      node_forces_(mesh.nodes.size()),
      midpoints_(mesh.nodes.size()),
      velocity_(parameters.grid, slab_),
      force_(parameters.grid, slab_),
      force_modes_(transform_.zero_modes()) {
  if (!inside_box(state_.positions))
    throw InputError("box",
                     "the wall does not fit in the box with three cells to spare on every side",
                     "Enlarge box.size in the case file");
}

void Model::relax(double calcium) {
  contraction_.relax(calcium);
  state_.calcium = {calcium};
}

void Model::balance(double calcium) {
  state_.slack = false;
  wall_.nodal_stretch(state_.positions, stretch_);
  contraction_.relax(calcium, stretch_);
  state_.calcium = {calcium};
}

StepReport Model::step(const solid::Loads& loads, double dt, double drag) {
  activate(loads);
  const solid::VolumeRange J = nodal_forces(loads.pressure);
  move_blood(drag, dt);
  return finished(move_wall(dt, [&] { return loads.pressure; }), J, loads, dt);
}

StepReport Model::step(const solid::Loads& loads, double dt, const PressureOfStep& pressure,
                       bool anew) {
  if (anew) {
    response_.reset();
    transform_.to_points(state_.velocity_modes, velocity_);
    fluid::fill_ghosts(velocity_, slab_);
  }
  activate(loads);
  const solid::VolumeRange J = nodal_forces(loads.pressure);
  move_blood(0.0, dt);
  const auto correct = [&] { return find_pressure(loads.pressure, dt, pressure); };
  return finished(move_wall(dt, correct), J, loads, dt);
}

StepReport Model::finished(StepReport report, const solid::VolumeRange& J,
                           const solid::Loads& loads, double dt) {
  report.J = {parallel::min(J.min_J), parallel::max(J.max_J)};
  state_.dt_before = state_.dt;
  state_.dt = dt;
  const auto calcium = calcium_of(loads);
  state_.calcium.assign(calcium.begin(), calcium.end());
  return report;
}

void Model::activate(const solid::Loads& loads) {
  if (state_.slack) {
    contraction_.prescribe(0.0);
  } else if (const auto* prescribed = std::get_if<material::PrescribedTension>(&active_)) {
    contraction_.prescribe(loads.activation * prescribed->T_max);
  } else if (state_.dt > 0.0) {
    wall_.nodal_stretch(state_.positions, stretch_);
    const std::span<const double> before = state_.calcium;
    contraction_.advance(stretch_, {before, calcium_of(loads)}, state_.dt);
  }
}

solid::VolumeRange Model::nodal_forces(double pressure) {
  std::fill(node_forces_.begin(), node_forces_.end(), Vec3::Zero());
  const solid::VolumeRange J =
      wall_.add_elastic_forces(state_.positions, contraction_.tension(), node_forces_);
  endocardium_.add_gradient(pressure, state_.positions, node_forces_);
  supports_.add_forces(state_.positions, state_.node_velocities, node_forces_, base_.start);
  parallel::sum({node_forces_.data()->data(), 3 * node_forces_.size()});
  return J;
}

void Model::move_blood(double drag, double dt) {
  const double elapsed = state_.dt + state_.dt_before;
  const double r = elapsed > 0.0 ? state_.dt / elapsed : 0.0;
  fluid::convection_force(velocity_, parameters_.grid, parameters_.blood.density, {1.0 + r, -r},
                          state_.convection, force_);
  coupling_->spread(state_.positions, node_forces_, force_);
  transform_.to_modes(force_, force_modes_);
  stokes_.advance(state_.velocity_modes, force_modes_, 0.5 * (state_.dt + dt), drag);
  transform_.to_points(state_.velocity_modes, velocity_);
  fluid::fill_ghosts(velocity_, slab_);
}

/// `correct_velocities` may change what the blood's velocity makes of the nodes', and says under
/// which pressure.
StepReport Model::move_wall(double dt, const std::function<double()>& correct_velocities) {
  auto& x = state_.positions;
  auto& U = state_.node_velocities;
  for (std::size_t a = 0; a < x.size(); ++a)
    midpoints_[a] = x[a] + 0.5 * dt * U[a];
  StepReport report;
  report.inside_box = inside_box(midpoints_);
  if (!report.inside_box)
    return report;
  const std::vector<Vec3> U_before = U;
  coupling_->interpolate(velocity_, midpoints_, U);
  report.pressure = correct_velocities();

  double product = 0.0;
  double squares = 0.0;
  double squares_before = 0.0;
  double largest = 0.0;
  for (std::size_t a = 0; a < x.size(); ++a) {
    x[a] += dt * U[a];
    const Vec3 change = U[a] - U_before[a];
    product += change.dot(state_.velocity_change[a]);
    squares += change.squaredNorm();
    squares_before += state_.velocity_change[a].squaredNorm();
    state_.velocity_change[a] = change;
    largest = std::max(largest, U[a].squaredNorm());
  }
  report.largest_node_speed = std::sqrt(largest);
  report.velocity_change = std::sqrt(squares / static_cast<double>(x.size()));
  if (squares > 0.0 && squares_before > 0.0)
    report.smoothness = product / std::sqrt(squares * squares_before);
  report.inside_box = inside_box(x);
  return report;
}

/// Adds the response to the pressure that is missing from the guess.
double Model::find_pressure(double guess, double dt, const PressureOfStep& pressure) {
  const double half_steps = 0.5 * (state_.dt + dt);
  constexpr double rounding = 1e-9;  // of steps that share a duration evenly
  if (!response_ || std::abs(half_steps - response_->half_steps) > rounding * half_steps)
    find_response(half_steps);
  auto& U = state_.node_velocities;
  std::vector<Vec3> gradient(U.size(), Vec3::Zero());
  endocardium_.add_gradient(1.0, midpoints_, gradient);
  std::array<double, 2> flow{};  // under the guess, and of the response [mm^3/s]
  const Vec3 L = base_is_elastic_ ? opening_.carried(U) : base_.velocity.at(opening_.centre());
  const Vec3 L_1 = base_is_elastic_ ? opening_.carried(response_->nodes) : Vec3::Zero();
  for (std::size_t a = 0; a < U.size(); ++a) {
    flow[0] += gradient[a].dot(U[a] - L);
    flow[1] += gradient[a].dot(response_->nodes[a] - L_1);
  }
  parallel::sum(flow);
  const double found = pressure({guess, cavity_volume() + dt * flow[0], dt * flow[1]});
  const double dp = found - guess;
  for (std::size_t a = 0; a < U.size(); ++a)
    U[a] += dp * response_->nodes[a];
  const auto add = [dp](std::span<const double> from, std::span<double> to) {
    for (std::size_t i = 0; i < to.size(); ++i)
      to[i] += dp * from[i];
  };
  for (int c = 0; c < 3; ++c) {
    add(response_->velocity.component[c].values(), velocity_.component[c].values());
    add(response_->modes[c], state_.velocity_modes[c]);
    add(response_->force_modes[c], force_modes_[c]);
  }
  return found;
}

void Model::find_response(double half_steps) {
  response_ = Response{half_steps, std::vector<Vec3>(state_.positions.size(), Vec3::Zero()),
                       fluid::FaceField(parameters_.grid, slab_), transform_.zero_modes(),
                       transform_.zero_modes()};
  Response& r = *response_;
  endocardium_.add_gradient(1.0, state_.positions, r.nodes);
  parallel::sum({r.nodes.data()->data(), 3 * r.nodes.size()});
  coupling_->spread(state_.positions, r.nodes, r.velocity);  // the force, to begin with
  transform_.to_modes(r.velocity, r.force_modes);
  stokes_.advance(r.modes, r.force_modes, half_steps, 0.0);
  transform_.to_points(r.modes, r.velocity);
  fluid::fill_ghosts(r.velocity, slab_);
  coupling_->interpolate(r.velocity, midpoints_, r.nodes);
}

bool Model::inside_box(std::span<const Vec3> positions) const {
  return std::all_of(positions.begin(), positions.end(),
                     [&](const Vec3& x) { return transfer_.inside(x); });
}

void Model::restore(const ModelState& state) {
  state_ = state;
  response_.reset();
  contraction_.set_state(state.contraction);
  transform_.to_points(state_.velocity_modes, velocity_);
  fluid::fill_ghosts(velocity_, slab_);
}

const ModelState& Model::state() {
  state_.contraction = contraction_.state();
  return state_;
}

fluid::Component Model::pressure() const {
  const fluid::Grid& grid = parameters_.grid;
  fluid::ComponentTransform transform(grid, slab_, fluid::cell_centred);
  fluid::Component p(grid.cells[0], grid.cells[1], slab_.planes.size());
  transform.to_points(stokes_.pressure(force_modes_, transform.layout()), p);
  fluid::fill_ghosts(p, slab_);
  return p;
}

double Model::mean_tension() const {
  const auto tension = contraction_.tension();
  std::vector<double> developed(tension.size());
  for (std::size_t a = 0; a < tension.size(); ++a)
    developed[a] = strength_[a] * tension[a];
  return mean(developed);
}

double Model::mean(std::span<const double> at_nodes) const {
  const auto volume = wall_.nodal_volumes();
  double sum = 0.0;
  double total = 0.0;
  for (std::size_t a = 0; a < at_nodes.size(); ++a) {
    sum += volume[a] * at_nodes[a];
    total += volume[a];
  }
  return sum / total;
}

}  // namespace lv::immersed
