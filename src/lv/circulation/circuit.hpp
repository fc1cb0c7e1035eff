#pragma once

#include "lv/circulation/closed_loop.hpp"
#include "lv/circulation/implicit_step.hpp"
#include "lv/circulation/parameters.hpp"
#include "lv/circulation/windkessel.hpp"

#include <span>
#include <variant>
#include <vector>

namespace lv::circulation {

/// The volume that a step leaves in the left ventricle, and how it follows the pressure there.
struct VolumeAfter {
  double volume = 0.0;        ///< [mm^3]
  double per_pressure = 0.0;  ///< [mm^3/kPa]
};

/// A circuit around a left ventricle that is somebody else's: told the pressure at the end of an
/// implicit step of second order, it says which volume the valves leave there.
class Circuit {
 public:
  /// At the start that the parameters say. Throws InputError where they ask for no circulation.
  explicit Circuit(const CircuitParameters& parameters);

  /// Starts again around a ventricle of this volume [mm^3] instead of start.V_lv; a closed loop
  /// with as much blood as its parameters say, if they do.
  void start_around(double volume);

  /// Starts again in states such as states() gives; with as much blood as the parameters say, if
  /// they do.
  void start_from(std::span<const double> states);

  /// Multiplies the pressure in the arteries of the body.
  void scale_arterial_pressure(double factor);

  /// Brings a closed loop's blood to so much [mm^3]: ClosedLoop::fill_to.
  void fill_to(double blood);

  /// Starts again in other states, but for the left ventricle's volume, which is a wall's: in a
  /// closed loop the left atrium, with which it shares its filling, takes the difference. Blood
  /// stays what it is.
  void leap_to(std::span<const double> states);

  /// A step of dt [s] to the time t [s] with the pressure p [kPa] at its end. Throws RunError when
  /// the step has no solution that is found.
  [[nodiscard]] VolumeAfter after(double t, double dt, double p) const;

  /// Takes that step.
  void advance(double t, double dt, double p);

  /// At the present states and time t, for the pressure p.
  [[nodiscard]] Signals signals(double t, double p) const;

  /// The present states, the left ventricle's volume first.
  [[nodiscard]] std::span<const double> states() const;

  /// All blood of a closed loop [mm^3]; 0 of one that has sources.
  [[nodiscard]] double blood() const;

  /// What Signals::others holds.
  [[nodiscard]] std::vector<Column> columns() const;

  /// The history that further steps depend on, and back: for checkpoints.
  [[nodiscard]] std::vector<double> numbers() const;
  /// Whether so many numbers can be those of this circuit.
  [[nodiscard]] bool takes(std::size_t numbers) const;
  void set_numbers(std::span<const double> numbers);

 private:
  template <class C>
  struct Part {
    C circuit;
    History<C::size> history;
  };
  using Kinds = std::variant<Part<Windkessel>, Part<ClosedLoop>>;
  static Kinds kind_of(const CircuitParameters& parameters);
  void start(const Start& start);

  Kinds kind_;
};

/// What a closed loop holds that shows such signals [mm^3]; 0 of a windkessel.
[[nodiscard]] double blood_of(const CircuitParameters& parameters, const Signals& signals);

/// A start in states such as Circuit::states() gives.
[[nodiscard]] Start start_of(std::span<const double> states);

}  // namespace lv::circulation
