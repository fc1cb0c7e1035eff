#pragma once

#include "lv/mesh/quadratic.hpp"

#include <vector>

namespace lv::implicit {

/// The rank of each element, 0 to ranks - 1: about as many elements on each, and few nodes between
/// them (METIS: by halves, for more than 8 ranks k-way). Every rank that asks gets the same answer.
[[nodiscard]] std::vector<int> partition(const mesh::ElementNodes& elements, int ranks);

}  // namespace lv::implicit
