#pragma once

#include "lv/base/tensor.hpp"

#include <Eigen/Geometry>

#include <random>
#include <vector>

namespace lv::test {

/// Reproducible numbers in [-1, 1], and what is made of them.
class RandomValues {
 public:
  explicit RandomValues(unsigned seed) : engine_(seed) {}

  double operator()() { return uniform_(engine_); }

  Vec3 vector() { return {(*this)(), (*this)(), (*this)()}; }

  Mat3 tensor() {
    Mat3 A;
    A << vector(), vector(), vector();
    return A;
  }

  Mat3 rotation() {
    return Eigen::Quaterniond(Eigen::Vector4d((*this)(), (*this)(), (*this)(), (*this)()))
        .normalized()
        .toRotationMatrix();
  }

  std::vector<Vec3> vectors(std::size_t count, double size) {
    std::vector<Vec3> result(count);
    for (Vec3& v : result)
      v = size * vector();
    return result;
  }

 private:
  std::mt19937 engine_;
  std::uniform_real_distribution<double> uniform_{-1.0, 1.0};
};

}  // namespace lv::test
