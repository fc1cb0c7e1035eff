#include "lv/circulation/circuit.hpp"

#include "lv/base/check.hpp"

#include <algorithm>

namespace lv::circulation {
namespace {

/// The states after a step, and how they follow the pressure at its end.
template <class Part>
auto stepped(const Part& part, double t, double dt, double p) {
  constexpr int size = std::decay_t<decltype(part.circuit)>::size;
  const auto rates = [&]<class T>(const std::array<T, size>& y, const T& pressure) {
    return part.circuit.rates(t, y, pressure);
  };
  return implicit_step<size>(rates, backward_difference(part.history, dt), p, part.history.now);
}

}  // namespace

Circuit::Kinds Circuit::kind_of(const CircuitParameters& p) {
  if (p.kind == Kind::closed_loop) {
    const ClosedLoop loop(p.closed_loop, p.valves, p.period);
    return Part<ClosedLoop>{loop, {loop.start(p.start)}};
  }
  if (p.kind == Kind::windkessel)
    return Part<Windkessel>{{p.windkessel, p.valves}, {Windkessel::start(p.start)}};
  throw InputError("circulation.kind", "is \"none\": there is no circuit to join a ventricle to",
                   "Set it to \"windkessel\" or \"closed_loop\"");
}

Circuit::Circuit(const CircuitParameters& parameters) : kind_(kind_of(parameters)) {}

void Circuit::start(const Start& start) {
  std::visit([&](auto& part) { part.history = {part.circuit.start(start)}; }, kind_);
}

void Circuit::start_around(double volume) {
  Start same = start_of(states());
  same.V_lv = volume;
  start(same);
}

void Circuit::start_from(std::span<const double> states) {
  LV_CHECK(states.size() == this->states().size());
  start(start_of(states));
}

void Circuit::scale_arterial_pressure(double factor) {
  std::visit(
      [&]<class C>(Part<C>& part) {
        constexpr int arterial = std::is_same_v<C, ClosedLoop> ? int{ClosedLoop::p_ar_sys} : 1;
        part.history.now[arterial] *= factor;
        part.history.step = 0.0;
      },
      kind_);
}

void Circuit::fill_to(double blood) {
  auto* loop = std::get_if<Part<ClosedLoop>>(&kind_);
  if (loop == nullptr)
    return;
  loop->circuit.fill_to(blood, loop->history.now);
  loop->history.step = 0.0;
}

void Circuit::leap_to(std::span<const double> states) {
  const double volume = this->states().front();
  const double before = blood();
  start_from(states);
  std::visit([&](auto& part) { part.history.now[0] = volume; }, kind_);
  if (auto* loop = std::get_if<Part<ClosedLoop>>(&kind_))
    loop->history.now[ClosedLoop::V_la] += states.front() - volume;
  fill_to(before);
}

VolumeAfter Circuit::after(double t, double dt, double p) const {
  return std::visit(
      [&](const auto& part) {
        const auto next = stepped(part, t, dt, p);
        return VolumeAfter{next.y[0], next.dy_dp[0]};
      },
      kind_);
}

void Circuit::advance(double t, double dt, double p) {
  std::visit([&](auto& part) { part.history.push(stepped(part, t, dt, p).y, dt); }, kind_);
}

Signals Circuit::signals(double t, double p) const {
  return std::visit([&](const auto& part) { return part.circuit.signals(t, part.history.now, p); },
                    kind_);
}

std::span<const double> Circuit::states() const {
  return std::visit([](const auto& part) { return std::span<const double>(part.history.now); },
                    kind_);
}

double Circuit::blood() const {
  const auto* loop = std::get_if<Part<ClosedLoop>>(&kind_);
  return loop == nullptr ? 0.0 : loop->circuit.blood(loop->history.now);
}

std::vector<Column> Circuit::columns() const {
  return std::visit([](const auto& part) { return part.circuit.columns(); }, kind_);
}

std::vector<double> Circuit::numbers() const {
  return std::visit(
      [](const auto& part) {
        std::vector<double> numbers{part.history.step};
        numbers.insert(numbers.end(), part.history.now.begin(), part.history.now.end());
        numbers.insert(numbers.end(), part.history.before.begin(), part.history.before.end());
        return numbers;
      },
      kind_);
}

bool Circuit::takes(std::size_t numbers) const {
  return numbers == 1 + 2 * states().size();
}

double blood_of(const CircuitParameters& parameters, const Signals& s) {
  if (parameters.kind != Kind::closed_loop)
    return 0.0;
  const ClosedLoop loop(parameters.closed_loop, parameters.valves, parameters.period);
  const auto& o = s.others;  // ClosedLoop::columns
  return loop.blood({s.volume, o[0], o[1], o[2], s.aortic_pressure, o[5], o[6], o[7]});
}

Start start_of(std::span<const double> states) {
  if (states.size() == Windkessel::size)
    return {.V_lv = states[0], .p_ar_sys = states[1]};
  LV_CHECK(states.size() == ClosedLoop::size);
  return {states[0], states[1], states[2], states[3], states[4],  states[5],
          states[6], states[7], states[8], states[9], states[10], states[11]};
}

void Circuit::set_numbers(std::span<const double> numbers) {
  LV_CHECK(takes(numbers.size()));
  std::visit(
      [&](auto& part) {
        const std::size_t n = part.history.now.size();
        part.history.step = numbers[0];
        std::copy_n(numbers.begin() + 1, n, part.history.now.begin());
        std::copy_n(numbers.begin() + 1 + n, n, part.history.before.begin());
      },
      kind_);
}

}  // namespace lv::circulation
