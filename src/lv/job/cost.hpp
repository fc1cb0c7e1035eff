#pragma once

#include "lv/job/stages.hpp"

#include <string>

namespace lv::job {

/// What a case would take.
struct Cost {
  std::string details;  ///< lines on grid, elements and unknowns
  std::string words;    ///< "immersed about 24 min, quasi_static about 50 s"
};

/// Tried on this machine: a few steps of the immersed engine, the first load step of the
/// quasi-static one, each on its own mesh. What an engine cannot run says why. `mesh` is that of
/// the engine of the case.
[[nodiscard]] Cost cost_of(const Case& c, const Shape& shape, const MeshResult& mesh);

}  // namespace lv::job
