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
                     const quasi_static::Parameters& solver)
    : mesh_(mesh), fibres_(fibres), muscle_of_(std::move(muscle_of)), solver_(solver) {}

double Ventricle::volume(const Parameters& parameters, const Loads& loads) {
  approach(muscle_of_(parameters), loads);
  if (known_.empty() || distance(nearest(loads).loads, loads) > 0.0)
    known_.push_back({loads, engine_->state()});
  else
    nearest(loads).state = engine_->state();
  return engine_->cavity_volume();
}

/// Brings the engine to equilibrium with the loads.
void Ventricle::approach(const quasi_static::Muscle& muscle, const Loads& loads) {
  if (known_.empty()) {
    engine_.emplace(mesh_, fibres_, muscle, solver_);
  } else {
    const Equilibrium& start = nearest(loads);
    engine_->restore(start.state, start.loads);
    engine_->set_muscle(muscle);
  }
  if (distance(engine_->loads(), loads) > 0.0)
    engine_->go_to(loads);
}

Ventricle::Equilibrium& Ventricle::nearest(const Loads& loads) {
  return *std::min_element(known_.begin(), known_.end(), [&](const auto& a, const auto& b) {
    return distance(a.loads, loads) < distance(b.loads, loads);
  });
}

}  // namespace lv::calibrate
