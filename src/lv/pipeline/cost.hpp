#pragma once

#include "lv/pipeline/stages.hpp"

#include <string>

namespace lv::pipeline {

/// What a case would take.
struct Cost {
  std::string details;  ///< lines on grid, elements and unknowns
  std::string words;    ///< "immersed about 24 min, quasi_static about 50 s"
};

/// Tried on this machine: a few steps of the immersed engine, the first load step of the
/// quasi-static one, each on its own mesh; of heartbeats the time of one and their number. What an
/// engine cannot run says why. `mesh` is that of the engine of the case.
[[nodiscard]] Cost cost_of(const case_file::Case& c, const anatomy::Shape& shape,
                           const anatomy::MeshResult& mesh);

}  // namespace lv::pipeline
