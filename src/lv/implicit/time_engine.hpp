#pragma once

#include "lv/implicit/engine.hpp"
#include "lv/implicit/muscle.hpp"

namespace lv::implicit {

/// The wall through time, with the states of the active law at every quadrature point, around a
/// cavity whose volume a circuit gives. All is collective.
///
/// Without density the wall is in equilibrium at the end of every step; with viscosity or dashpots
/// the velocities are those of backward Euler's rule. With density steps follow the generalised
/// alpha rule: the wall is balanced at a share of the step, balance(), where active tension, cavity
/// pressure and given volume are the means of their values at the step's ends with the same
/// weights. The elements' pressures, which have no rates, stay those at balance.
class TimeEngine {
 public:
  /// The mesh must outlive the engine. Throws InputError as Engine and Muscle.
  TimeEngine(const mesh::Mesh& mesh, const StaticModel& model, const SolverParameters& parameters,
             double spectral_radius = default_spectral_radius);

  /// Of the generalised alpha rule, where the model has a density.
  static constexpr double default_spectral_radius = 0.5;

  /// Goes from the undeformed wall to a pressure with muscle at rest, at balance with its calcium
  /// Ca_0 [uM]; the cavity's volume there [mm^3].
  Outcome<double> fill(double pressure, double Ca_0);

  /// One step; the engine stays where it was when it fails.
  NewtonReport advance(const TimeStep& step, const VolumeOfPressure& volume);

  /// One step under a tension and a pressure (or around a volume) that are given for the moment of
  /// balance; the muscle's own states are left alone.
  NewtonReport move(double dt, Equilibrium at_balance);

  /// The share of a step at which the wall is balanced: 1 without inertia.
  [[nodiscard]] double balance() const { return has_inertia_ ? 1.0 - rule_.alpha_f : 1.0; }

  /// Velocities of the nodes, and with inertia accelerations; of use where the model has rates.
  [[nodiscard]] const Rates& rates() const { return rates_; }

  [[nodiscard]] double pressure() const { return engine_.state().cavity_pressure; }  ///< [kPa]
  [[nodiscard]] double cavity_volume() const { return engine_.cavity_volume(); }     ///< [mm^3]
  [[nodiscard]] const State& state() const { return engine_.state(); }

 private:
  [[nodiscard]] std::size_t point_number(std::size_t element, std::size_t point) const {
    return element * engine_.equations().points_per_element() + point;
  }

  void rest();
  [[nodiscard]] State predicted(const State& now, double dt) const;
  NewtonReport advance_with_rates(const TimeStep& step, const VolumeOfPressure& volume);

  Engine engine_;
  Muscle muscle_;
  bool has_rates_, has_inertia_;
  GeneralisedAlpha rule_;
  Rates rates_;             ///< where the model has rates
  State before_;            ///< at the start of the last step, to extrapolate from
  double dt_before_ = 0.0;  ///< of the last step; 0: there is none [s]
};

}  // namespace lv::implicit
