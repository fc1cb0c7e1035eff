#pragma once

#include "lv/material/muscle_states.hpp"
#include "lv/solid/base_motion.hpp"

#include <span>
#include <vector>

namespace lv::implicit {

/// The calcium at the ends of a step [uM].
struct CalciumStep {
  double before = 0.0, after = 0.0;
};

/// A step of time and its calcium, of every point, or one for all muscle; and where the base is
/// moved to.
struct TimeStep {
  double dt = 0.0;  ///< [s]
  std::vector<CalciumStep> calcium = {};
  solid::BaseStep base = {};

  [[nodiscard]] const CalciumStep& calcium_of(std::size_t point) const {
    return calcium[calcium.size() == 1 ? 0 : point];
  }
};

/// The contractile states of muscle at points, advanced by implicit steps: kinetics, stretch and
/// its memory all take the stretch at the end of the step, and the slope of the tension knows it.
class Muscle {
 public:
  /// A law without kinetics has no states and knows no time: such muscle is passive. Throws
  /// InputError when it has a tension. `contractility`: factor of the tension of each point; empty:
  /// 1. Kinetics go by T/T_ref, which it leaves as it is.
  Muscle(const material::ActiveLaw& law, std::size_t points,
         std::span<const double> contractility = {});

  /// Brings every point to its steady state at its stretch.
  void relax(double Ca, std::span<const double> stretch) { states_.relax(Ca, stretch); }

  /// The tension of a point after a step to a stretch [kPa].
  [[nodiscard]] material::Tension after(const TimeStep& step, std::size_t point,
                                        double stretch) const;

  /// The tension of a point as it is, whatever the stretch [kPa].
  [[nodiscard]] material::Tension now(std::size_t point) const;

  /// Takes a step to these stretches.
  void advance(const TimeStep& step, std::span<const double> stretch);

  /// The states as numbers, so many a point, and back: for checkpoints.
  [[nodiscard]] std::size_t numbers_per_point() const { return states_.numbers_per_point(); }
  [[nodiscard]] std::vector<double> numbers() const { return states_.numbers(); }
  void set_numbers(std::span<const double> numbers) { states_.set_numbers(numbers); }

 private:
  [[nodiscard]] double contractility(std::size_t point) const {
    return contractility_.empty() ? 1.0 : contractility_[point];
  }

  material::MuscleStates<double> states_;
  std::vector<double> contractility_;
};

}  // namespace lv::implicit
