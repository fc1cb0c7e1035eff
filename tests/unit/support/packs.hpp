#pragma once

#include "lv/base/tensor.hpp"

#include <array>

namespace lv::test {

/// A pack with value(i) in lane i.
template <class Value>
Pack packed(const Value& value) {
  alignas(Pack) std::array<double, pack_size> lanes;
  for (int i = 0; i < pack_size; ++i)
    lanes[i] = value(i);
  return Pack::load_aligned(lanes.data());
}

/// One tensor per lane.
inline Tensor<Pack> packed(const std::array<Mat3, pack_size>& tensors) {
  Tensor<Pack> result;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c)
      result(r, c) = packed([&](int i) { return tensors[i](r, c); });
  return result;
}

inline Mat3 lane(const Tensor<Pack>& tensors, int i) {
  Mat3 result;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c)
      result(r, c) = tensors(r, c).get(i);
  return result;
}

}  // namespace lv::test
