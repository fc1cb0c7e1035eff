#pragma once

#include "lv/calibrate/bracket.hpp"
#include "lv/calibrate/model.hpp"

namespace lv::calibrate {

/// How `fit` says that a volume is out of reach: with the parameters that came nearest, from which
/// the fit of another wall finds out at once whether it is out of that one's reach too.
class FitOutOfReach : public OutOfReach {
 public:
  FitOutOfReach(const OutOfReach& why, const FitParameters& parameters)
      : OutOfReach(why), parameters_(parameters) {}

  [[nodiscard]] const FitParameters& parameters() const { return parameters_; }

 private:
  FitParameters parameters_;
};

}  // namespace lv::calibrate
