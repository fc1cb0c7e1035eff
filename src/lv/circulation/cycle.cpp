#include "lv/circulation/cycle.hpp"

#include "lv/base/check.hpp"
#include "lv/base/dense.hpp"
#include "lv/base/interrupt.hpp"
#include "lv/base/log.hpp"
#include "lv/base/time_left.hpp"
#include "lv/circulation/closed_loop.hpp"
#include "lv/circulation/implicit_step.hpp"
#include "lv/circulation/windkessel.hpp"

#include <algorithm>
#include <cmath>

namespace lv::circulation {
namespace {

/// Takes a step to the time t; of states whose ventricle's pressure is a function of time and
/// volume alone.
template <class Circuit, class Ventricle>
void take_step(const Circuit& circuit, const Ventricle& ventricle, double t, double dt,
               History<Circuit::size>& history) {
  interrupt::check();
  const auto rates = [&]<class T>(const std::array<T, Circuit::size>& y, const T&) {
    return circuit.rates(t, y, ventricle.pressure(t, y[0]));
  };
  history.push(
      implicit_step<Circuit::size>(rates, backward_difference(history, dt), 0.0, history.now).y,
      dt);
}

int steps_of_beat(const CircuitParameters& p) {
  return static_cast<int>(std::ceil(p.period / p.step - 1e-9));
}

/// How a beat maps the states that it begins with to those that it ends with.
template <class Circuit, class Ventricle>
class BeatMap {
 public:
  static constexpr int size = Circuit::size;
  using States = std::array<double, size>;

  BeatMap(const CircuitParameters& p, const Circuit& circuit, const Ventricle& ventricle)
      : p_(p), circuit_(circuit), ventricle_(ventricle) {}

  /// See lv::circulation::change_to_come.
  [[nodiscard]] double change_to_come(const States& before, const States& after) const {
    const Eigen::Map<const Eigen::ArrayXd> b(before.data(), size), a(after.data(), size);
    const Eigen::ArrayXd scale = a.abs().max(b.abs()).max(least_scale);
    const Eigen::MatrixXd W = slopes(after, scale);
    const Eigen::VectorXd d = (a - b) / scale;
    // a last row that says that the blood of a closed loop stays, which beats alone leave open
    Eigen::MatrixXd A = Eigen::MatrixXd::Zero(size + 1, size);
    A.topRows(size) = Eigen::MatrixXd::Identity(size, size) - W;
    A.row(size) = blood_slopes(after, scale);
    Eigen::VectorXd right = Eigen::VectorXd::Zero(size + 1);
    right.head(size) = W * d;
    const double largest = dense::least_squares(A, right).cwiseAbs().maxCoeff();
    return std::isfinite(largest) ? std::min(largest, 1.0) : 1.0;
  }

 private:
  static constexpr double least_scale = 1e-6;  ///< [mm^3, kPa, mm^3/s]
  static constexpr double part = 1e-3;         ///< of a state, for differences
  static constexpr int most_steps = 200;       ///< of a beat, which slopes need no finer

  [[nodiscard]] States after_beat(const States& begin) const {
    History<size> history{begin};
    const int steps = std::min(steps_of_beat(p_), most_steps);
    const double dt = p_.period / steps;
    for (int i = 1; i <= steps; ++i)
      take_step(circuit_, ventricle_, i * dt, dt, history);
    return history.now;
  }

  /// Of the scaled states.
  [[nodiscard]] Eigen::MatrixXd slopes(const States& y, const Eigen::ArrayXd& scale) const {
    const States now = after_beat(y);
    Eigen::MatrixXd W(size, size);
    for (int j = 0; j < size; ++j) {
      States moved = y;
      moved[j] += part * scale[j];
      const States then = after_beat(moved);
      for (int i = 0; i < size; ++i)
        W(i, j) = (then[i] - now[i]) / (part * scale[i]);
    }
    return W;
  }

  /// How the blood follows the scaled states, as a row of length 1; zeros where there are sources.
  [[nodiscard]] Eigen::RowVectorXd blood_slopes(const States& y,
                                                const Eigen::ArrayXd& scale) const {
    Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(size);
    if constexpr (requires { circuit_.blood(y); }) {
      for (int j = 0; j < size; ++j) {
        States moved = y;
        moved[j] += scale[j];
        row[j] = circuit_.blood(moved) - circuit_.blood(y);
      }
      row.normalize();
    }
    return row;
  }

  const CircuitParameters& p_;
  const Circuit& circuit_;
  const Ventricle& ventricle_;
};

/// A circuit with a left ventricle whose pressure is a function of time and volume alone.
template <class Circuit, class Ventricle>
class Alone {
 public:
  static constexpr int size = Circuit::size;

  Alone(const CircuitParameters& p, const Circuit& circuit, const Ventricle& ventricle)
      : p_(p), circuit_(circuit), ventricle_(ventricle), history_{circuit.start(p.start)} {}

  Cycle run() {
    cycle_.columns = Circuit::columns();
    cycle_.period = p_.period;
    cycle_.atrium = atrial_contraction(p_);
    observe();
    while (static_cast<int>(cycle_.beats.size()) < p_.beats && !cycle_.is_limit)
      beat();
    return std::move(cycle_);
  }

  [[nodiscard]] const std::array<double, size>& states() const { return history_.now; }

 private:
  void beat() {
    const auto before = history_.now;
    const std::size_t first = cycle_.samples.size() - 1;
    const int steps = steps_of_beat(p_);
    const double dt = p_.period / steps;
    const double begin = static_cast<double>(cycle_.beats.size()) * p_.period;
    for (int i = 1; i <= steps; ++i)
      step(begin + i * dt, dt);
    cycle_.beats.push_back(measure_beat(std::span(cycle_.samples).subspan(first), cycle_.atrium));
    cycle_.change = largest_change(before, history_.now);
    const bool changed_little = p_.tolerance > 0.0 && cycle_.change <= p_.tolerance;
    cycle_.to_come = changed_little
                         ? BeatMap(p_, circuit_, ventricle_).change_to_come(before, history_.now)
                         : 0.0;
    cycle_.is_limit = is_limit_cycle(cycle_.change, cycle_.to_come, p_.tolerance);
    report_progress();
  }

  void report_progress() {
    const auto done = static_cast<double>(cycle_.beats.size());
    left_.record(done);
    if (!cycle_.is_limit && left_.due())
      log::info(
          "circulation: {:.0f} beats of at most {}; the last changed the states by {:.2g} of "
          "themselves at most{}",
          done, p_.beats, cycle_.change, left_.words(p_.beats - done));
  }

  void step(double t, double dt) {
    take_step(circuit_, ventricle_, t, dt, history_);
    time_ = t;
    observe();
  }

  void observe() {
    const double p = ventricle_.pressure(time_, history_.now[0]);
    cycle_.samples.push_back({time_, circuit_.signals(time_, history_.now, p)});
  }

  const CircuitParameters& p_;
  Circuit circuit_;
  Ventricle ventricle_;
  History<size> history_;
  double time_ = 0.0;
  Cycle cycle_;
  TimeLeft left_;
};

template <class Circuit, class Ventricle>
CycleAlone run(const CircuitParameters& p, const Circuit& circuit, const Ventricle& ventricle) {
  Alone heart(p, circuit, ventricle);
  Cycle cycle = heart.run();
  return {std::move(cycle), {heart.states().begin(), heart.states().end()}};
}

template <class Ventricle>
CycleAlone run_with(const CircuitParameters& p, const Ventricle& ventricle) {
  if (p.kind != Kind::closed_loop)
    return run(p, Windkessel(p.windkessel, p.valves), ventricle);
  const ClosedLoop circuit(p.closed_loop, p.valves, p.period);
  CycleAlone alone = run(p, circuit, ventricle);
  ClosedLoop::States<double> end;
  std::ranges::copy(alone.states, end.begin());
  alone.cycle.blood_lost =
      std::abs(circuit.blood(end) / circuit.blood(circuit.start(p.start)) - 1.0);
  return alone;
}

/// Such states as an array.
template <class Circuit>
std::array<double, Circuit::size> as_states(std::span<const double> states) {
  LV_CHECK(states.size() == Circuit::size);
  std::array<double, Circuit::size> array;
  std::ranges::copy(states, array.begin());
  return array;
}

template <class Circuit>
double change_to_come_in(const Circuit& circuit, const CircuitParameters& p,
                         const StandIn& ventricle, std::span<const double> before,
                         std::span<const double> after) {
  return BeatMap(p, circuit, ventricle)
      .change_to_come(as_states<Circuit>(before), as_states<Circuit>(after));
}

}  // namespace

double change_to_come(const CircuitParameters& p, const StandIn& ventricle,
                      std::span<const double> before, std::span<const double> after) {
  try {
    return p.kind == Kind::closed_loop
               ? change_to_come_in(ClosedLoop(p.closed_loop, p.valves, p.period), p, ventricle,
                                   before, after)
               : change_to_come_in(Windkessel(p.windkessel, p.valves), p, ventricle, before, after);
  } catch (const NoSolution&) {
    return 1.0;
  }
}

double largest_change(std::span<const double> before, std::span<const double> after) {
  double largest = 0.0;
  for (std::size_t i = 0; i < before.size(); ++i)
    largest = std::max(largest, std::abs(after[i] - before[i]) /
                                    std::max(std::abs(after[i]), std::abs(before[i])));
  return largest;
}

std::span<const Sample> samples_of(const Cycle& cycle, int beat) {
  constexpr double rounding = 1e-9;  // [s]
  const auto at = [&](int beats) {
    return std::find_if(cycle.samples.begin(), cycle.samples.end(),
                        [&](const Sample& s) { return s.time > beats * cycle.period - rounding; });
  };
  const auto end = at(beat + 1);
  return {at(beat), end == cycle.samples.end() ? end : end + 1};
}

double atrial_contraction(const CircuitParameters& p) {
  return p.kind == Kind::closed_loop ? std::fmod(p.closed_loop.left_atrium.t_C, p.period)
                                     : std::numeric_limits<double>::quiet_NaN();
}

Cycle run_alone(const CircuitParameters& p) {
  return run_with(p, Elastance(p.left_ventricle, p.period)).cycle;
}

CycleAlone run_alone(const CircuitParameters& p, const StandIn& ventricle) {
  return run_with(p, ventricle);
}

}  // namespace lv::circulation
