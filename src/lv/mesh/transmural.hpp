#pragma once

#include "lv/mesh/mesh.hpp"

#include <vector>

namespace lv::mesh {

/// The transmural coordinate of every node from its distances to the two sides of the wall (Potse
/// et al., IEEE Trans. Biomed. Eng. 53:2425, 2006):
///
///   t = d_endo / (d_endo + d_epi)
///
/// Exactly 0 on the endocardium and 1 on the epicardium.
[[nodiscard]] std::vector<double> transmural_by_distance(const Mesh& mesh);

}  // namespace lv::mesh
