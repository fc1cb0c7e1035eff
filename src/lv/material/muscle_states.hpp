#pragma once

#include "lv/material/active_law.hpp"

#include <span>
#include <type_traits>
#include <variant>
#include <vector>

namespace lv::material {

/// The contractile states of muscle at points, as a law with kinetics has them: for double one by
/// one, for Pack side by side in packs, of which the last repeats its last point. A law without
/// kinetics has none.
template <class T>
class MuscleStates {
 public:
  MuscleStates(const ActiveLaw& law, std::size_t points);

  /// Calls f(law, states) where there are states.
  template <class F>
  void visit(const F& f) {
    visit_in(states_, f);
  }
  template <class F>
  void visit(const F& f) const {
    visit_in(states_, f);
  }

  /// Brings every point to its steady state at this calcium [uM] and its own stretch, or at one for
  /// all.
  void relax(double Ca, std::span<const double> stretch);

  /// The states as numbers, so many a point, point by point, and back: for checkpoints.
  [[nodiscard]] std::size_t numbers_per_point() const;
  [[nodiscard]] std::vector<double> numbers() const;
  void set_numbers(std::span<const double> numbers);

 private:
  template <class Law>
  struct Of {
    Law law;
    std::vector<typename Law::template State<T>> states;
  };
  using States = std::variant<std::monostate, Of<NiedererHunterSmith>, Of<Land2017>>;

  static States resting(const ActiveLaw& law, std::size_t points);

  template <class Variant, class F>
  static void visit_in(Variant& variant, const F& f) {
    std::visit(
        [&](auto& of) {
          if constexpr (!std::is_same_v<std::decay_t<decltype(of)>, std::monostate>)
            f(of.law, of.states);
        },
        variant);
  }

  States states_;
  std::size_t points_;
};

extern template class MuscleStates<double>;
extern template class MuscleStates<Pack>;

}  // namespace lv::material
