#include "lv/implicit/muscle.hpp"

#include "lv/base/check.hpp"
#include "lv/base/dual.hpp"

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

}  // namespace

Muscle::Muscle(const material::ActiveLaw& law, std::size_t points,
               std::span<const double> contractility)
    : states_(law, points), contractility_(contractility.begin(), contractility.end()) {
  const auto* prescribed = std::get_if<material::PrescribedTension>(&law);
  if (prescribed != nullptr && prescribed->T_max != 0.0)
    throw InputError("active.law", "prescribes a tension, which knows no time",
                     "Choose \"land2017\" or \"niederer\"");
}

Tension Muscle::after(const TimeStep& step, std::size_t point, double stretch) const {
  Tension result;
  states_.visit([&](const auto& law, const auto& states) {
    auto state = as_dual<std::decay_t<decltype(law)>>(states[point]);
    const auto [before, after] = step.calcium_of(point);
    law.advance(state, OneSlope::variable(stretch), before, after, step.dt);
    result = {state.tension.value, state.tension.slope[0]};
  });
  return contractility(point) * result;
}

Tension Muscle::now(std::size_t point) const {
  Tension result;
  states_.visit([&](const auto&, const auto& states) { result.value = states[point].tension; });
  return contractility(point) * result;
}

void Muscle::advance(const TimeStep& step, std::span<const double> stretch) {
  states_.visit([&](const auto& law, auto& states) {
    for (std::size_t i = 0; i < states.size(); ++i) {
      const auto [before, after] = step.calcium_of(i);
      law.advance(states[i], stretch[i], before, after, step.dt);
    }
  });
}

}  // namespace lv::implicit
