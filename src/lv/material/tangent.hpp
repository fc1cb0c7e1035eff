#pragma once

#include "lv/base/tensor.hpp"

namespace lv::material {

/// dP/dF, both tensors column by column: row i + 3 j belongs to P(i,j), column k + 3 l to F(k,l).
template <class T>
using Tangent = Eigen::Matrix<T, 9, 9>;

}  // namespace lv::material
