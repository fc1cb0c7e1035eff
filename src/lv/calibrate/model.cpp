#include "lv/calibrate/model.hpp"

#include "lv/base/units.hpp"
#include "lv/implicit/inverse.hpp"

#include <algorithm>
#include <cmath>

namespace lv::calibrate {
namespace {

using solid::Loads;

/// How far apart loads are, in mmHg; full activation counts as much as a systolic pressure.
double distance(const Loads& a, const Loads& b) {
  return std::abs(a.pressure - b.pressure) / units::mmHg +
         100.0 * std::abs(a.activation - b.activation);
}

}  // namespace

Ventricle::Ventricle(const mesh::Mesh& mesh, ModelOf model_of,
                     const implicit::SolverParameters& solver,
                     const implicit::UnloadParameters& unloading)
    : given_(mesh),
      model_of_(std::move(model_of)),
      solver_(solver),
      unloading_(unloading),
      wall_(mesh),
      endocardium_(mesh) {}

void Ventricle::begin_near(std::vector<Vec3> unloaded) {
  unloaded_ = implicit::Unloaded{std::move(unloaded), {}, {}};
  unloaded_with_ = {.C_a = 0.0};  // of no muscle: it is not yet found
}

void Ventricle::linearise(const std::optional<FitParameters>& about,
                          const std::vector<int>& segments) {
  about_ = about;
  segments_ = segments;
  slopes_.clear();
}

bool Ventricle::is_linear(const FitParameters& parameters) const {
  if (!about_ || parameters == *about_)
    return false;
  FitParameters others = parameters;
  others.segments = about_->segments;
  return others == *about_;
}

/// Active stress goes in proportion to a factor, so that twice as much changes the residual by its
/// derivative by the logarithm.
Outcome<Ventricle::Slopes> Ventricle::slopes(const Loads& loads) {
  const auto volume_there = volume(*about_, loads);
  if (!volume_there)
    return volume_there.why();
  std::vector<implicit::StaticModel> twice;
  for (const int segment : segments_) {
    FitParameters other = *about_;
    other.segments[segment - 1] *= 2.0;
    twice.push_back(model_of_(other));
  }
  const auto responses = engine_->responses(twice);
  if (!responses)
    return responses.why();
  return Slopes{loads, engine_->state().positions, *responses};
}

Outcome<std::vector<Vec3>> Ventricle::moved(const FitParameters& parameters, const Loads& loads) {
  auto found = std::find_if(slopes_.begin(), slopes_.end(),
                            [&](const Slopes& s) { return distance(s.loads, loads) == 0.0; });
  if (found == slopes_.end()) {
    auto added = slopes(loads);
    if (!added)
      return added.why();
    found = slopes_.insert(slopes_.end(), *added);
  }
  std::vector<Vec3> positions = found->positions;
  for (std::size_t j = 0; j < segments_.size(); ++j) {
    const int s = segments_[j] - 1;
    const double by = std::log(parameters.segments[s] / about_->segments[s]);
    for (std::size_t a = 0; by != 0.0 && a < positions.size(); ++a)
      positions[a] += by * found->by_segment[j][a];
  }
  return positions;
}

Outcome<double> Ventricle::unloaded_volume(const FitParameters& parameters) {
  if (is_linear(parameters))
    return unloaded_volume(*about_);
  if (unloading_.pressure == 0.0 || (unloaded_ && unloaded_with_ == parameters))
    return endocardium_.volume(wall_.nodes);
  folded_volume_ = std::numeric_limits<double>::quiet_NaN();
  const auto unloaded = implicit::unload(
      given_, model_of_(parameters), unloading_, solver_,
      {.start = unloaded_ ? &*unloaded_ : nullptr, .folded_volume = &folded_volume_});
  if (!unloaded)
    return unloaded.why();
  unloaded_ = *unloaded;
  unloaded_with_ = parameters;
  polishing_ += unloaded_->polishing;
  engine_.reset();
  wall_ = mesh::with_nodes(given_, unloaded_->nodes);
  if (known_.empty())
    known_.push_back({{unloading_.pressure, 0.0}, unloaded_->loaded});
  return endocardium_.volume(wall_.nodes);
}

Outcome<double> Ventricle::share_that_leaves(const FitParameters& parameters, double volume) const {
  std::optional<double> share;
  if (unloading_.pressure > 0.0 && solver_.newton.linear.method == implicit::LinearMethod::direct)
    share = implicit::share_that_leaves(volume, given_, model_of_(parameters), unloading_.pressure,
                                        solver_.newton);
  if (!share)
    return Unsolved{"No part of the pressure leaves that volume", ""};
  return *share;
}

void Ventricle::restore(Memory memory) {
  known_ = std::move(memory.known);
  unloaded_ = std::move(memory.unloaded);
  unloaded_with_ = memory.unloaded_with;
  wall_ = unloaded_ ? mesh::with_nodes(given_, unloaded_->nodes) : given_;
  engine_.reset();
}

Outcome<double> Ventricle::volume(const FitParameters& parameters, const Loads& loads) {
  auto unloaded = unloaded_volume(parameters);
  if (!unloaded || distance(loads, {}) == 0.0)  // undeformed, as implicit::Engine::set_model says
    return unloaded;
  if (is_linear(parameters)) {
    const auto positions = moved(parameters, loads);
    return positions ? Outcome<double>(endocardium_.volume(*positions)) : positions.why();
  }
  auto volume = approach(model_of_(parameters), loads);
  if (!volume)
    return volume;
  if (known_.empty() || distance(nearest(loads).loads, loads) > 0.0)
    known_.push_back({loads, engine_->state()});
  else
    nearest(loads).state = engine_->state();
  return volume;
}

Outcome<std::vector<Vec3>> Ventricle::positions(const FitParameters& parameters,
                                                const Loads& loads) {
  if (is_linear(parameters))
    return moved(parameters, loads);
  if (const auto found = volume(parameters, loads); !found)
    return found.why();
  return engine_->state().positions;
}

/// Brings the engine to equilibrium with the loads.
Outcome<double> Ventricle::approach(const implicit::StaticModel& model, const Loads& loads) {
  if (!engine_)
    engine_.emplace(wall_, model, solver_);
  if (!known_.empty()) {
    const Equilibrium& start = nearest(loads);
    engine_->restore(start.state, start.loads);
  } else {
    engine_->relax();
  }
  const auto volume = engine_->set_model(model);
  if (!volume || distance(engine_->loads(), loads) == 0.0)
    return volume;
  if (!on_the_way_)
    return engine_->go_to(loads);
  return engine_->go_to(loads,
                        [&](const implicit::Step& step) { on_the_way_(loads, step.progress); });
}

Ventricle::Equilibrium& Ventricle::nearest(const Loads& loads) {
  return *std::min_element(known_.begin(), known_.end(), [&](const auto& a, const auto& b) {
    return distance(a.loads, loads) < distance(b.loads, loads);
  });
}

}  // namespace lv::calibrate
