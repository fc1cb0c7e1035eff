#include "lv/material/muscle_states.hpp"

#include "lv/base/check.hpp"

#include <algorithm>
#include <array>
#include <tuple>
#include <utility>

namespace lv::material {
namespace {

template <class T>
constexpr std::size_t lanes = std::is_same_v<T, Pack> ? pack_size : 1;

double lane(double value, std::size_t /*of one*/) {
  return value;
}
double lane(const Pack& pack, std::size_t i) {
  return pack.get(i);
}

/// The value whose lanes are of(0), of(1), ...
template <class T, class Of>
T of_lanes(const Of& of) {
  if constexpr (std::is_same_v<T, double>) {
    return of(0);
  } else {
    alignas(Pack) std::array<double, pack_size> values;
    for (std::size_t i = 0; i < values.size(); ++i)
      values[i] = of(i);
    return Pack::load_aligned(values.data());
  }
}

template <class State>
constexpr std::size_t numbers_of = std::tuple_size_v<decltype(std::declval<State>().fields())>;

}  // namespace

template <class T>
typename MuscleStates<T>::States MuscleStates<T>::resting(const ActiveLaw& law,
                                                          std::size_t points) {
  return std::visit(
      [&](const auto& kinetics) -> States {
        using Law = std::decay_t<decltype(kinetics)>;
        if constexpr (std::is_same_v<Law, PrescribedTension>) {
          return std::monostate{};
        } else {
          Of<Law> result{kinetics, {}};
          result.states.resize((points + lanes<T> - 1) / lanes<T>);
          return result;
        }
      },
      law);
}

template <class T>
MuscleStates<T>::MuscleStates(const ActiveLaw& law, std::size_t points)
    : states_(resting(law, points)), points_(points) {}

template <class T>
void MuscleStates<T>::relax(double Ca, std::span<const double> stretch) {
  LV_CHECK(stretch.size() == 1 || stretch.size() == points_);
  std::vector<double> numbers;
  visit([&](const auto& law, const auto&) {
    for (const double s : stretch) {
      auto rest = law.steady_state(Ca, s);
      for (const double* number : rest.fields())
        numbers.push_back(*number);
    }
  });
  const std::size_t of_one = numbers_per_point();
  if (stretch.size() == 1)
    for (std::size_t i = of_one; i < points_ * of_one; ++i)
      numbers.push_back(numbers[i - of_one]);
  set_numbers(numbers);
}

template <class T>
std::size_t MuscleStates<T>::numbers_per_point() const {
  std::size_t count = 0;
  visit([&](const auto&, const auto& states) {
    count = numbers_of<typename std::decay_t<decltype(states)>::value_type>;
  });
  return count;
}

template <class T>
std::vector<double> MuscleStates<T>::numbers() const {
  std::vector<double> numbers;
  visit([&](const auto&, const auto& states) {
    for (std::size_t a = 0; a < points_; ++a) {
      auto state = states[a / lanes<T>];
      for (const T* number : state.fields())
        numbers.push_back(lane(*number, a % lanes<T>));
    }
  });
  return numbers;
}

template <class T>
void MuscleStates<T>::set_numbers(std::span<const double> numbers) {
  const std::size_t of_one = numbers_per_point();
  LV_CHECK(numbers.size() == points_ * of_one);
  visit([&](const auto&, auto& states) {
    for (std::size_t g = 0; g < states.size(); ++g) {
      const auto to = states[g].fields();
      for (std::size_t f = 0; f < to.size(); ++f)
        *to[f] = of_lanes<T>([&](std::size_t i) {
          return numbers[std::min(g * lanes<T> + i, points_ - 1) * of_one + f];
        });
    }
  });
}

template class MuscleStates<double>;
template class MuscleStates<Pack>;

}  // namespace lv::material
