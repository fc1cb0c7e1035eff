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
  /// Where a front starts, in the words of Site. The first breakthroughs of a human ventricle: high
  /// on the anterior wall, in the middle of the septum, and inferior (D. Durrer et al., Circulation
  /// 41:899, 1970).
  std::vector<std::string> sites{"basal anterior", "mid anteroseptal", "mid inferior"};
  std::string file;         ///< of times, one for each node or element; as the case file names it
  std::string array;        ///< of a VTK file; empty: the only one
  double time_unit = 1e-3;  ///< of the file's numbers [s]
};

}  // namespace lv::activation
