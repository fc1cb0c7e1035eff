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

  /// All that further steps depend on, in the order of the mesh's elements; the same on all ranks.
  struct Moment {
    State now, before;
    double dt_before = 0.0;      ///< of the step between them; 0: there was none [s]
    std::vector<double> muscle;  ///< Muscle::numbers of all elements
  };
  /// Collective. The steps that follow are those that follow a restore: what the solver had
  /// learned of its matrix is forgotten, so that both go the same way to the last bit.
  [[nodiscard]] Moment moment();
  void restore(const Moment& moment);
  /// How many numbers Moment::muscle has.
  [[nodiscard]] std::size_t muscle_numbers() const;

  /// A time that was passed: where the wall was and what its muscle was like.
  struct Passed {
    State state;
    Muscle muscle;
  };
  [[nodiscard]] Passed present() const { return {engine_.state(), muscle_}; }
  /// Stress in every linear cell of the mesh; collective.
  [[nodiscard]] std::vector<solid::CellStress> cell_stress(const Passed& at) const;
  /// What muscle did since a time, if that is one step ago [mN mm].
  [[nodiscard]] double muscle_work_since(const Passed& before) const;
  [[nodiscard]] double stored_energy() const {
    return engine_.equations().stored_energy(engine_.state());
  }  ///< [mN mm]
  /// Volume-weighted mean over the wall of the active tension, with the infarct's factor [kPa].
  [[nodiscard]] double mean_tension() const;

  [[nodiscard]] double pressure() const { return engine_.state().cavity_pressure; }  ///< [kPa]
  [[nodiscard]] double cavity_volume() const { return engine_.cavity_volume(); }     ///< [mm^3]
  [[nodiscard]] const State& state() const { return engine_.state(); }

 private:
  [[nodiscard]] std::size_t point_number(std::size_t element, std::size_t point) const {
    return element * engine_.equations().points_per_element() + point;
  }
  /// The tension that muscle has, whatever the stretch.
  [[nodiscard]] TensionAt tension_of(const Muscle& muscle) const;

  Engine engine_;
  Muscle muscle_;
  State before_;            ///< at the start of the last step, to extrapolate from
  double dt_before_ = 0.0;  ///< of the last step; 0: there is none [s]
};

}  // namespace lv::implicit
