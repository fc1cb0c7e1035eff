#pragma once

#include "lv/implicit/arc_length.hpp"
#include "lv/implicit/newton.hpp"

#include <functional>
#include <limits>
#include <string>

namespace lv::implicit {

/// Parameters of the quasi-static engine.
struct SolverParameters {
  NewtonParameters newton;
  double first_step = 0.1;      ///< of the way from one load to the next [-]
  double smallest_step = 1e-4;  ///< before the engine gives up [-]
  /// Most by which the cavity should change in a step, of its volume at the start [-]. A step is
  /// made as long as the one before it lets expect.
  double largest_change = std::numeric_limits<double>::infinity();
};

/// The straight line through two states, `by` times their distance beyond the second.
[[nodiscard]] State extrapolate(const State& before, const State& now, double by);

/// One equilibrium on the way to the loads that were asked for.
struct Step {
  Loads loads;
  double progress = 0.0;  ///< share of the way done [-]
  double length = 0.0;    ///< of the step, as a share of the way [-]
  double volume = 0.0;    ///< of the cavity [mm^3]
  NewtonReport newton;
};

/// The wall in equilibrium with its loads; goes from loads to loads by adaptive steps. All is
/// collective.
class Engine {
 public:
  /// The mesh must outlive the engine. Throws InputError as reference_wall.
  Engine(const mesh::Mesh& mesh, const StaticModel& model, const SolverParameters& parameters);

  /// Goes straight from the present loads to others, in steps as long as Newton's method manages,
  /// and returns the cavity's volume there [mm^3]; `observe` (may be empty) is told each
  /// equilibrium. Where the smallest step fails the elements are held harder against buckling
  /// inside, from then on (StaticModel::firm_stabilisation). Where the next one fails contracting
  /// muscle gives way (give_way), a few times; where that fails too its path is followed by its
  /// length (follow_path), past limit points. Else the engine stays at the last equilibrium, and
  /// says where the path turned.
  Outcome<double> go_to(const Loads& target, const std::function<void(const Step&)>& observe = {});

  /// Replaces the muscle and finds the equilibrium under the same loads, at once if Newton's method
  /// manages, or contracting muscle does with elements that are held harder or gives way, else all
  /// the way from rest; returns the cavity's volume [mm^3]. Without loads the wall is undeformed,
  /// as at first: balanced by the tension of resting muscle alone it would lie on the switches I4 =
  /// 1 of (2.16), where Newton's method finds no way on.
  Outcome<double> set_model(const StaticModel& model);

  /// How far the nodes go, to first order and under the same loads, when the muscle becomes each of
  /// these: -K^-1 (R(x; other) - R(x)), by one factorisation.
  Outcome<std::vector<std::vector<Vec3>>> responses(const std::vector<StaticModel>& others);

  /// The equilibrium near a guess, with any tension, or around a volume of the cavity; stays at the
  /// present one if it finds none. The loads are then its pressure alone.
  NewtonReport find(State guess, const Equilibrium& equilibrium);

  /// Where find() finds none: the equilibrium to which the wall gives way (give_way), if there is
  /// one.
  [[nodiscard]] bool give_way(const Equilibrium& equilibrium);

  /// Forgets what was learned of the tangent on the way here, up to the order of its unknowns.
  void begin_anew() { newton_.begin_anew(); }

  /// Back to the undeformed wall without loads.
  void relax();

  [[nodiscard]] const State& state() const { return state_; }
  [[nodiscard]] const Loads& loads() const { return loads_; }
  [[nodiscard]] const Equations& equations() const { return equations_; }
  [[nodiscard]] double cavity_volume() const {
    return equations_.endocardium().volume(state_.positions);
  }  ///< [mm^3]
  /// Stress in every linear cell of the mesh; collective.
  [[nodiscard]] std::vector<solid::CellStress> cell_stress() const {
    return equations_.cell_stress(state_, equations_.steady(loads_.activation));
  }
  /// Volume-weighted mean over the wall of the active tension, with the infarct's factor [kPa].
  [[nodiscard]] double mean_tension() const {
    return equations_.mean_tension(state_, equations_.steady(loads_.activation));
  }

  /// Takes over an equilibrium that was reached before, with the loads that held it. Throws
  /// InputError when it is one of another wall.
  void restore(const State& state, const Loads& loads);

  /// Takes over the state at the end of a step whose balance is not at its end, which find()
  /// found. The tangent may be kept.
  void place(State state) { state_ = std::move(state); }

  /// Another step or rule of time makes the tangent another one.
  void forget_tangent() { newton_.forget_tangent(); }

 private:
  /// Where no step leads on, however short.
  struct Obstacle {
    const WayOfLoads& way;
    double progress = 0.0;
    bool may_give_way = true;
    const std::string& why;
  };

  /// The muscle with its elements held as hard as this engine has had to.
  [[nodiscard]] StaticModel held(StaticModel model) const;

  /// Holds the elements harder, if they are not yet, and stays under the same loads; whether there
  /// is an equilibrium.
  [[nodiscard]] bool hold_firmly();

  [[nodiscard]] bool contracting_gives_way(State& state, const Loads& loads);

  /// Brings contracting muscle to an equilibrium farther on, and returns by which share of the way.
  [[nodiscard]] Outcome<double> get_over(const Obstacle& at, State& state);

  SolverParameters parameters_;
  Equations equations_;
  Newton newton_;
  State state_;
  Loads loads_;
  bool is_firm_ = false;
};

}  // namespace lv::implicit
