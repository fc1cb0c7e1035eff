#pragma once

#include "lv/anatomy/mesh_result.hpp"
#include "lv/case_file/case.hpp"

#include <vector>

namespace lv::beating_wall {

/// When each node of the wall is activated, after the calcium of a beat begins [s]; empty: all at
/// once. Throws InputError for sites that the wall does not have, a file that does not fit to it,
/// and muscle that is not activated within a beat.
[[nodiscard]] std::vector<double> activation_times(const case_file::Case& c,
                                                   const anatomy::MeshResult& mesh);

}  // namespace lv::beating_wall
