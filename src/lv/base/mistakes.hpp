#pragma once

#include "lv/base/check.hpp"

#include <vector>

namespace lv {

/// Gathers what is wrong with an input, so that a user is told all of it at once.
class Mistakes {
 public:
  /// Does something; an InputError of it is kept for `raise`.
  template <class Work>
  void attempt(const Work& work) {
    try {
      work();
    } catch (const InputError& mistake) {
      found_.push_back(mistake);
    }
  }

  /// Throws an InputError that says them all, one a line, if there were any.
  void raise() const;

 private:
  std::vector<InputError> found_;
};

}  // namespace lv
