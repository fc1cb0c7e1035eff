#pragma once

#include "lv/analysis/results.hpp"

namespace lv::verify {

/// What a beat comes to, element by element and in numbers; on the root.
struct Analysis {
  analysis::BeatFields fields;
  analysis::Results results;
};

/// Of a beat of this heart. Collective.
[[nodiscard]] Analysis analyse(const mesh::Mesh& mesh, const heartbeat::Beat& beat,
                               const solid::CardiacModel& heart);

}  // namespace lv::verify
