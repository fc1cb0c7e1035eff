#include "lv/circulation/cycle.hpp"

#include "lv/base/interrupt.hpp"
#include "lv/circulation/closed_loop.hpp"
#include "lv/circulation/implicit_step.hpp"
#include "lv/circulation/windkessel.hpp"

#include <algorithm>
#include <cmath>

namespace lv::circulation {
namespace {

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
    observe();
    while (static_cast<int>(cycle_.beats.size()) < p_.beats && !cycle_.is_limit) {
      interrupt::check();
      beat();
    }
    return std::move(cycle_);
  }

  [[nodiscard]] const std::array<double, size>& states() const { return history_.now; }

 private:
  void beat() {
    const auto before = history_.now;
    const std::size_t first = cycle_.samples.size() - 1;
    const int steps = static_cast<int>(std::ceil(p_.period / p_.step - 1e-9));
    const double dt = p_.period / steps;
    const double begin = static_cast<double>(cycle_.beats.size()) * p_.period;
    for (int i = 1; i <= steps; ++i)
      step(begin + i * dt, dt);
    cycle_.beats.push_back(measure_beat(std::span(cycle_.samples).subspan(first)));
    cycle_.change = largest_change(before, history_.now);
    cycle_.is_limit = cycle_.change <= p_.tolerance;
  }

  void step(double t, double dt) {
    const auto rates = [&]<class T>(const std::array<T, size>& y, const T&) {
      return circuit_.rates(t, y, ventricle_.pressure(t, y[0]));
    };
    const auto next =
        implicit_step<size>(rates, backward_difference(history_, dt), 0.0, history_.now);
    history_.push(next.y, dt);
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

}  // namespace

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

Cycle run_alone(const CircuitParameters& p) {
  return run_with(p, Elastance(p.left_ventricle, p.period)).cycle;
}

CycleAlone run_alone(const CircuitParameters& p, const StandIn& ventricle) {
  return run_with(p, ventricle);
}

}  // namespace lv::circulation
