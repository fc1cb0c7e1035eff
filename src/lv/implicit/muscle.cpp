#include "lv/implicit/muscle.hpp"

#include "lv/base/check.hpp"
#include "lv/base/dual.hpp"

#include <tuple>

namespace lv::implicit {
namespace {

using material::Tension;
using OneSlope = Dual<1>;

/// A state of another scalar with the same numbers.
template <class Law>
auto as_dual(typename Law::template State<double> state) {
  typename Law::template State<OneSlope> dual;
  const auto from = state.fields();
  const auto to = dual.fields();
  for (std::size_t f = 0; f < to.size(); ++f)
    *to[f] = *from[f];
  return dual;
}

/// Calls f(law, states) where there are states.
template <class Variant, class F>
void with_states(Variant& variant, const F& f) {
  std::visit(
      [&](auto& points) {
        if constexpr (!std::is_same_v<std::decay_t<decltype(points)>, std::monostate>)
          f(points.law, points.states);
      },
      variant);
}

}  // namespace

Muscle::States Muscle::states_of(const material::ActiveLaw& law, std::size_t points) {
  return std::visit(
      [&](const auto& kinetics) -> States {
        using Law = std::decay_t<decltype(kinetics)>;
        if constexpr (std::is_same_v<Law, material::PrescribedTension>) {
          if (kinetics.T_max != 0.0)
            throw InputError("active.law", "prescribes a tension, which knows no time",
                             "Choose \"land2017\" or \"niederer\"");
          return std::monostate{};
        } else {
          Points<Law> result{kinetics, {}};
          result.states.resize(points);
          return result;
        }
      },
      law);
}

Muscle::Muscle(const material::ActiveLaw& law, std::size_t points)
    : states_(states_of(law, points)) {}

void Muscle::relax(double Ca, std::span<const double> stretch) {
  with_states(states_, [&](const auto& law, auto& states) {
    for (std::size_t i = 0; i < states.size(); ++i)
      states[i] = law.steady_state(Ca, stretch[i]);
  });
}

Tension Muscle::after(const TimeStep& step, std::size_t point, double stretch) const {
  Tension result;
  with_states(states_, [&](const auto& law, const auto& states) {
    auto state = as_dual<std::decay_t<decltype(law)>>(states[point]);
    const auto [before, after] = step.calcium_of(point);
    law.advance(state, OneSlope::variable(stretch), before, after, step.dt);
    result = {state.tension.value, state.tension.slope[0]};
  });
  return result;
}

Tension Muscle::now(std::size_t point) const {
  Tension result;
  with_states(states_,
              [&](const auto&, const auto& states) { result.value = states[point].tension; });
  return result;
}

void Muscle::advance(const TimeStep& step, std::span<const double> stretch) {
  with_states(states_, [&](const auto& law, auto& states) {
    for (std::size_t i = 0; i < states.size(); ++i) {
      const auto [before, after] = step.calcium_of(i);
      law.advance(states[i], stretch[i], before, after, step.dt);
    }
  });
}

std::size_t Muscle::numbers_per_point() const {
  std::size_t count = 0;
  with_states(states_, [&](const auto&, const auto& states) {
    using State = typename std::decay_t<decltype(states)>::value_type;
    count = std::tuple_size_v<decltype(std::declval<State>().fields())>;
  });
  return count;
}

std::vector<double> Muscle::numbers() const {
  std::vector<double> numbers;
  with_states(states_, [&](const auto&, const auto& states) {
    for (auto state : states)
      for (const double* number : state.fields())
        numbers.push_back(*number);
  });
  return numbers;
}

void Muscle::set_numbers(std::span<const double> numbers) {
  with_states(states_, [&](const auto&, auto& states) {
    LV_CHECK(numbers.size() == states.size() * numbers_per_point());
    const double* next = numbers.data();
    for (auto& state : states)
      for (double* number : state.fields())
        *number = *next++;
  });
}

}  // namespace lv::implicit
