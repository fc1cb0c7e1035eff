#pragma once

#include "lv/activation/front.hpp"

#include <string>
#include <vector>

namespace lv::activation {

/// Everywhere at once, by a front, or as a file says.
enum class Kind { uniform, eikonal, file };

/// When muscle is activated, after the calcium of a beat begins.
struct ActivationParameters {
  Kind kind = Kind::uniform;
  Speeds speeds;
  /// Where a front starts, in the words of Site: the segments nearest to where seven isolated human
  /// hearts were excited first, within 5 ms (D. Durrer et al., Circulation 41:899, 1970). These
  /// areas are high on the anterior wall beside the septum, just below the mitral valve; in the
  /// middle of the septum, somewhat anterior; and on the posterior wall beside the septum, a third
  /// of the way from apex to base, which is lower than the middle of the segment taken for it.
  std::vector<std::string> sites{"basal anterior", "mid anteroseptal", "mid inferior"};
  std::string file;         ///< of times, one for each node or element; as the case file names it
  std::string array;        ///< of a VTK file; empty: the only one
  double time_unit = 1e-3;  ///< of the file's numbers [s]
};

}  // namespace lv::activation
