#pragma once

#include <Eigen/Core>
#include <xsimd/xsimd.hpp>

#include <algorithm>
#include <cmath>

namespace lv {

/// A pack of doubles, one per SIMD lane: the scalar type of the kernels that treat several elements
/// at once.
using Pack = xsimd::batch<double>;

/// Number of doubles in a Pack.
inline constexpr int pack_size = static_cast<int>(Pack::size);

/// Vectors and second-order tensors in three dimensions, over double or Pack.
template <class T>
using Vector = Eigen::Matrix<T, 3, 1>;
template <class T>
using Tensor = Eigen::Matrix<T, 3, 3>;
using Vec3 = Vector<double>;
using Mat3 = Tensor<double>;

/// Functions that read the same for double and Pack, so that a law is written once for both.
inline double select(bool condition, double yes, double no) {
  return condition ? yes : no;
}
inline double maximum(double x, double y) {
  return std::max(x, y);
}
inline double minimum(double x, double y) {
  return std::min(x, y);
}
inline Pack select(const Pack::batch_bool_type& condition, const Pack& yes, const Pack& no) {
  return xsimd::select(condition, yes, no);
}
inline Pack maximum(const Pack& x, const Pack& y) {
  return xsimd::max(x, y);
}
inline Pack minimum(const Pack& x, const Pack& y) {
  return xsimd::min(x, y);
}

/// x^n for a whole n >= 0.
template <class T>
T power(T x, int n) {
  T result(1.0);
  for (; n > 0; n >>= 1) {
    if ((n & 1) != 0)
      result = result * x;
    x = x * x;
  }
  return result;
}

/// det F.
template <class T>
T determinant(const Tensor<T>& F) {
  return F(0, 0) * (F(1, 1) * F(2, 2) - F(1, 2) * F(2, 1)) -
         F(0, 1) * (F(1, 0) * F(2, 2) - F(1, 2) * F(2, 0)) +
         F(0, 2) * (F(1, 0) * F(2, 1) - F(1, 1) * F(2, 0));
}

/// The tensor v x, whose product with w is the cross product of v and w.
inline Mat3 cross_matrix(const Vec3& v) {
  Mat3 m;
  m << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return m;
}

/// The cofactor tensor det(F) F^{-T}.
template <class T>
Tensor<T> cofactor(const Tensor<T>& F) {
  Tensor<T> C;
  for (int i = 0; i < 3; ++i) {
    const int i1 = (i + 1) % 3;
    const int i2 = (i + 2) % 3;
    for (int j = 0; j < 3; ++j) {
      const int j1 = (j + 1) % 3;
      const int j2 = (j + 2) % 3;
      C(i, j) = F(i1, j1) * F(i2, j2) - F(i1, j2) * F(i2, j1);
    }
  }
  return C;
}

}  // namespace lv

namespace Eigen {

/// Lets Eigen's small fixed-size products work on packs of doubles.
template <>
struct NumTraits<lv::Pack> : GenericNumTraits<double> {
  using Real = lv::Pack;
  using NonInteger = lv::Pack;
  using Nested = lv::Pack;
  using Literal = double;
  // NOLINTNEXTLINE(readability-identifier-naming): Eigen's names
  enum { RequireInitialization = 0, ReadCost = 1, AddCost = 1, MulCost = 1 };
};

}  // namespace Eigen
