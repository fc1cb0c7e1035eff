#include "lv/calibrate/model.hpp"

#include "lv/base/units.hpp"

#include <algorithm>
#include <cmath>

namespace lv::calibrate {
namespace {

using quasi_static::Loads;

/// How far apart loads are, in mmHg; full activation counts as much as a systolic pressure.
double distance(const Loads& a, const Loads& b) {
  return std::abs(a.pressure - b.pressure) / units::mmHg +
         100.0 * std::abs(a.activation - b.activation);
}

}  // namespace

Ventricle::Ventricle(const mesh::Mesh& mesh, const mesh::FibreRule& fibres, MuscleOf muscle_of,
                     const quasi_static::Parameters& solver,
                     const quasi_static::UnloadParameters& unloading)
    : given_(mesh),
      fibres_(fibres),
      muscle_of_(std::move(muscle_of)),
      solver_(solver),
      unloading_(unloading),
      wall_(mesh),
      cavity_(mesh) {}

double Ventricle::volume(const Parameters& parameters, const Loads& loads) {
  go_to(parameters, loads);
  return engine_->cavity_volume();
}

double Ventricle::unloaded_volume(const Parameters& parameters) {
  return cavity_.volume(wall(parameters).nodes);
}

std::vector<Vec3> Ventricle::positions(const Parameters& parameters, const Loads& loads) {
  go_to(parameters, loads);
  return engine_->state().positions;
}

const mesh::Mesh& Ventricle::wall(const Parameters& parameters) {
  if (unloading_.pressure == 0.0 || (unloaded_ && unloaded_with_ == parameters))
    return wall_;
  unloaded_ = quasi_static::unload(given_, fibres_, muscle_of_(parameters), unloading_, solver_,
                                   unloaded_ ? &*unloaded_ : nullptr);
  unloaded_with_ = parameters;
  engine_.reset();
  wall_.nodes = unloaded_->nodes;
  if (known_.empty())
    known_.push_back({{unloading_.pressure, 0.0}, unloaded_->loaded});
  return wall_;
}

const std::optional<quasi_static::Unloaded>& Ventricle::unloaded(const Parameters& parameters) {
  static_cast<void>(wall(parameters));
  return unloaded_;
}

void Ventricle::restore(Memory memory) {
  known_ = std::move(memory.known);
  unloaded_ = std::move(memory.unloaded);
  unloaded_with_ = memory.unloaded_with;
  wall_.nodes = unloaded_ ? unloaded_->nodes : given_.nodes;
  engine_.reset();
}

void Ventricle::go_to(const Parameters& parameters, const Loads& loads) {
  static_cast<void>(wall(parameters));
  approach(muscle_of_(parameters), loads);
  if (known_.empty() || distance(nearest(loads).loads, loads) > 0.0)
    known_.push_back({loads, engine_->state()});
  else
    nearest(loads).state = engine_->state();
}

/// Brings the engine to equilibrium with the loads.
void Ventricle::approach(const quasi_static::Muscle& muscle, const Loads& loads) {
  if (!engine_)
    engine_.emplace(wall_, fibres_, muscle, solver_);
  if (!known_.empty()) {
    const Equilibrium& start = nearest(loads);
    engine_->restore(start.state, start.loads);
  } else {
    engine_->relax();
  }
  engine_->set_muscle(muscle);
  if (distance(engine_->loads(), loads) > 0.0)
    engine_->go_to(loads);
}

Ventricle::Equilibrium& Ventricle::nearest(const Loads& loads) {
  return *std::min_element(known_.begin(), known_.end(), [&](const auto& a, const auto& b) {
    return distance(a.loads, loads) < distance(b.loads, loads);
  });
}

}  // namespace lv::calibrate
