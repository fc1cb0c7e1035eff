#pragma once

#include "lv/base/check.hpp"
#include "lv/base/outcome.hpp"

#include <functional>
#include <string>
#include <utility>

namespace lv::calibrate {

/// Allowed values of a parameter, above zero.
struct Range {
  double low = 0.0;
  double high = 0.0;
};

/// A parameter on which a volume depends.
struct Unknown {
  std::string name;
  double start = 1.0;
  Range range;
  double first_factor = 1.5;  ///< of the first step from the start
};

/// A measured volume.
struct Target {
  double volume = 0.0;  ///< [mm^3]
  std::string origin;   ///< where it was set, for messages
};

/// No value of the unknown makes the target's volume.
class OutOfReach : public InputError {
 public:
  /// `missing` as below.
  OutOfReach(const std::string& where, std::string what, std::string what_to_do, double missing)
      : InputError(where, what, what_to_do),
        what_(std::move(what)),
        what_to_do_(std::move(what_to_do)),
        missing_(missing) {}

  /// |ln(V/V_target)| at the end of the range: found there, or where there was no equilibrium that
  /// far, on the straight line through the last two in the unknown's logarithm. Zero where that
  /// line meets the target or only one was found: the target may be within reach then.
  [[nodiscard]] double missing() const { return missing_; }

  /// The same, with where it was found out.
  [[nodiscard]] OutOfReach found(const std::string& how) const {
    return {where(), what_ + how, what_to_do_, missing_};
  }

 private:
  std::string what_, what_to_do_;
  double missing_;
};

/// The value of the unknown at which a volume that falls with it is the target's, within
/// `accuracy` as a fraction. A volume may have a maximum, and fall on both sides of it (that of a
/// wall which is unloaded anew for every stiffness: very soft muscle is stretched to where it is
/// stiff already in the shape that was seen); the root on the side of large values is found, and
/// the largest volume is named when it is too small. The root is bracketed by growing steps from
/// the start, none longer than half as far again as the last two trials let expect it, then found
/// by TOMS 748 (Alefeld, Potra & Shi, ACM Trans. Math. Softw. 21:327, 1995), both in the unknown's
/// logarithm. Where that ends at a jump since the wall has two equilibria and was first in another
/// one than it keeps, the search begins once more on the branch that it keeps.
///
/// There may be values without an equilibrium, which it keeps clear of; if the start is one, it
/// starts from half, twice, a quarter or four times of it. Throws OutOfReach with the
/// volume that is nearest to the target, at the end of the range or where there is no equilibrium
/// any farther, when that does not reach it; Unsolved where there is none to start from.
Outcome<double> find_root(const std::function<Outcome<double>(double)>& volume,
                          const Unknown& unknown, const Target& target, double accuracy);

}  // namespace lv::calibrate
