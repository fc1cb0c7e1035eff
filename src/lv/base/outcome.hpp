#pragma once

#include "lv/base/check.hpp"

#include <string>
#include <utility>
#include <variant>

namespace lv {

/// Nature has no answer to what was looked for, no equilibrium, no root: why, and what to try.
struct Unsolved {
  std::string what, what_to_do;
};

/// What a computation that may fail by nature came to.
template <class T>
class [[nodiscard]] Outcome {
 public:
  // NOLINTBEGIN(google-explicit-constructor): an answer or its absence is returned as it is
  Outcome(T answer) : content_(std::move(answer)) {}
  Outcome(Unsolved why) : content_(std::move(why)) {}
  // NOLINTEND(google-explicit-constructor)

  explicit operator bool() const { return std::holds_alternative<T>(content_); }
  const T& operator*() const { return std::get<T>(content_); }
  const T* operator->() const { return &**this; }
  [[nodiscard]] const Unsolved& why() const { return std::get<Unsolved>(content_); }

  /// For whom there is no other way: throws NoSolution where there is no answer.
  // NOLINTNEXTLINE(modernize-use-nodiscard): some ask for it to throw alone
  const T& value() const {
    if (!*this)
      throw NoSolution(why().what, why().what_to_do);
    return **this;
  }

 private:
  std::variant<T, Unsolved> content_;
};

}  // namespace lv
