#pragma once

#include "lv/implicit/engine.hpp"
#include "lv/implicit/muscle.hpp"

namespace lv::implicit {

/// The wall without inertia through time: equilibrium at the end of every step, with the states of
/// the active law at every quadrature point, around a cavity whose volume a circuit gives. All is
/// collective.
class TimeEngine {
 public:
  /// The mesh must outlive the engine. Throws InputError as Engine and Muscle.
  TimeEngine(const mesh::Mesh& mesh, const StaticModel& model, const SolverParameters& parameters);

  /// Goes from the undeformed wall to a pressure with muscle at rest, at balance with its calcium
  /// Ca_0 [uM]; the cavity's volume there [mm^3].
  Outcome<double> fill(double pressure, double Ca_0);

  /// One step; the engine stays where it was when it fails.
  NewtonReport advance(const TimeStep& step, const VolumeOfPressure& volume);

  [[nodiscard]] double pressure() const { return engine_.state().cavity_pressure; }  ///< [kPa]
  [[nodiscard]] double cavity_volume() const { return engine_.cavity_volume(); }     ///< [mm^3]
  [[nodiscard]] const State& state() const { return engine_.state(); }

 private:
  [[nodiscard]] std::size_t point_number(std::size_t element, std::size_t point) const {
    return element * engine_.equations().points_per_element() + point;
  }

  Engine engine_;
  Muscle muscle_;
  State before_;            ///< at the start of the last step, to extrapolate from
  double dt_before_ = 0.0;  ///< of the last step; 0: there is none [s]
};

}  // namespace lv::implicit
