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

  /// Goes from the undeformed wall to a pressure without any tension; the muscle's states are then
  /// at balance with the calcium Ca_0 [uM] and this wall's stretch, so that its resting tension
  /// acts from the first step on. A base that is not where it was undeformed takes the filled wall
  /// along. The cavity's volume [mm^3].
  Outcome<double> fill(double pressure, double Ca_0, const solid::AffineField& base = {});

  /// One step; the engine stays where it was when it fails.
  NewtonReport advance(const TimeStep& step, const VolumeOfPressure& volume);

  /// A time that was passed: where the wall was and what its muscle was like.
  struct Passed {
    State state;
    Muscle muscle;
    Rates rates;
    solid::BasePlace base;
  };
  /// Takes the last step back, to where it began.
  void go_back(const Passed& begin);

  /// A step after which the wall is where it gives way to, where advance() finds no equilibrium
  /// near by. Of a wall without rates, which no inertia or viscosity holds back. False, with the
  /// engine where it was, if there is none.
  [[nodiscard]] bool give_way(const TimeStep& step, const VolumeOfPressure& volume);

  /// One step under a tension and a pressure (or around a volume) that are given for the moment of
  /// balance; the muscle's own states are left alone.
  NewtonReport move(double dt, Equilibrium at_balance);

  /// The share of a step at which the wall is balanced: 1 without inertia.
  [[nodiscard]] double balance() const { return has_inertia_ ? 1.0 - rule_.alpha_f : 1.0; }

  /// Velocities of the nodes, and with inertia accelerations; of use where the model has rates.
  [[nodiscard]] const Rates& rates() const { return rates_; }

  /// All that further steps depend on, in the order of the mesh's elements; the same on all ranks.
  struct Moment {
    State now, before;
    double dt_before = 0.0;      ///< of the step between them; 0: there was none [s]
    Rates rates;                 ///< where the model has rates
    std::vector<double> muscle;  ///< Muscle::numbers of all elements
    solid::BasePlace base;       ///< where the base was held at the end of the step
  };
  /// Collective. The steps that follow are those that follow a restore: what the solver had
  /// learned of its matrix is forgotten, so that both go the same way to the last bit.
  [[nodiscard]] Moment moment();
  void restore(const Moment& moment);
  /// How many numbers Moment::muscle has.
  [[nodiscard]] std::size_t muscle_numbers() const;

  [[nodiscard]] Passed present() const { return {engine_.state(), muscle_, rates_, base_}; }
  /// Stress in every linear cell of the mesh; collective.
  [[nodiscard]] std::vector<solid::CellStress> cell_stress(const Passed& at) const;
  /// What was done since a time, if that is one step ago: by the cavity's pressure and the muscle
  /// on the wall, by the wall on its supports and against its viscosity, and by what moves the base
  /// on its supports [mN mm].
  struct Work {
    double pressure = 0.0;
    Equations::MuscleWork muscle;
    double supports = 0.0, viscosity = 0.0, base = 0.0;
  };
  [[nodiscard]] Work work_since(const Passed& before) const;
  [[nodiscard]] double stored_energy() const {
    return engine_.equations().stored_energy(engine_.state());
  }  ///< [mN mm]
  [[nodiscard]] double kinetic_energy() const {
    return engine_.equations().kinetic_energy(rates_.velocity);
  }  ///< [mN mm]
  /// Volume-weighted mean over the wall of the active tension, with the infarct's factor [kPa].
  [[nodiscard]] double mean_tension() const;

  [[nodiscard]] double pressure() const { return engine_.state().cavity_pressure; }  ///< [kPa]
  [[nodiscard]] double cavity_volume() const { return engine_.cavity_volume(); }     ///< [mm^3]
  [[nodiscard]] const State& state() const { return engine_.state(); }
  [[nodiscard]] const Equations& equations() const { return engine_.equations(); }

 private:
  [[nodiscard]] std::size_t point_number(std::size_t element, std::size_t point) const {
    return element * engine_.equations().points_per_element() + point;
  }
  /// The tension that muscle has, whatever the stretch.
  [[nodiscard]] TensionAt tension_of(const Muscle& muscle) const;

  [[nodiscard]] TensionAt tension_after(const TimeStep& step) const;

  void rest();
  [[nodiscard]] NewtonReport carry(const Equilibrium& filled, const solid::AffineField& base);
  [[nodiscard]] State predicted(const State& now, double dt) const;
  NewtonReport advance_with_rates(const TimeStep& step, const VolumeOfPressure& volume);

  Engine engine_;
  Muscle muscle_;
  bool has_rates_, has_inertia_;
  GeneralisedAlpha rule_;
  Rates rates_;             ///< where the model has rates
  solid::BasePlace base_;   ///< where the base is held
  State before_;            ///< at the start of the last step, to extrapolate from
  double dt_before_ = 0.0;  ///< of the last step; 0: there is none [s]
};

}  // namespace lv::implicit
