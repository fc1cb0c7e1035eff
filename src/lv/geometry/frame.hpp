#pragma once

#include "lv/base/tensor.hpp"

namespace lv::geometry {

/// The rigid motion between image space (scanner coordinates, mm) and the model frame: z along the
/// long axis, base plane z = 0, apex at negative z. Results can so be laid back over the images.
struct Frame {
  Mat3 axes = Mat3::Identity();  ///< columns: the model's x, y, z directions in image space
  Vec3 origin = Vec3::Zero();    ///< centre of the base in image space [mm]

  [[nodiscard]] Vec3 to_model(const Vec3& image) const {
    return axes.transpose() * (image - origin);
  }
  [[nodiscard]] Vec3 to_image(const Vec3& model) const { return axes * model + origin; }
};

}  // namespace lv::geometry
