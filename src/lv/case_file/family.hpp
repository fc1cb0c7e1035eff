#pragma once

#include "lv/case_file/case.hpp"
#include "lv/circulation/family.hpp"

#include <string>
#include <vector>

namespace lv::case_file {

/// The parameters by which a heart that beats in a circulation is filled more or less, ejects
/// against more or less, and is stronger or weaker.
struct Levers {
  const char* filling;        ///< pressure of its source, or blood of a closed loop
  const char* resistance;     ///< of the arteries
  const char* compliance;     ///< of the arteries
  const char* contractility;  ///< the muscle's tension
};
[[nodiscard]] Levers levers(const Case& c);

/// The case with so much blood in its closed loop as the start holds around a left ventricle of
/// this volume [mm^3], unless it says how much there is.
[[nodiscard]] Case with_blood_around(double volume, Case c);

/// One of the cases that a study asks for.
struct Member {
  std::string name;  ///< "case", "preload_0.8", "contractility_1.2_afterload_1.5"
  circulation::Factors factors;
};

/// The case itself first, then its preloads and afterloads; the same under every contractility and
/// every heart rate.
[[nodiscard]] std::vector<Member> family(const Study& study);

/// The case under other factors, without its study and what it fits: the fitted values are to be
/// in it, and a closed loop's blood where that is not what circulation.start holds. Throws
/// InputError where a factor makes it one that cannot be run, at the line of the study that asks
/// for it.
[[nodiscard]] Case under(const circulation::Factors& factors, Case c);

}  // namespace lv::case_file
