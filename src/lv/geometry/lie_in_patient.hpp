#pragma once

#include "lv/base/tensor.hpp"

#include <optional>
#include <string>

namespace lv::geometry {

/// How a left ventricle lies in a patient: unit vectors in image space (LPS: x to the patient's
/// left, y to the back, z to the head).
struct Lie {
  Vec3 apex = Vec3::Zero();    ///< from the base
  std::optional<Vec3> septum;  ///< from the long axis, across it; none where nothing shows it

  /// From the long axis: septum x apex, as regions are named. A mirror image makes it point to the
  /// inferior wall.
  [[nodiscard]] std::optional<Vec3> anterior() const;
};

/// "apex (0.59, -0.56, -0.59), septum (-0.74, -0.66, -0.11), anterior wall (0.33, -0.50, 0.80)".
[[nodiscard]] std::string describe(const Lie& lie);

/// What is odd about a lie, in words, with the mirroring or turn that explains it, if one does;
/// empty for one that hearts have. Their apex points to the left, the front and the feet (J. E.
/// Foster et al., Clin Physiol Funct Imaging 25, 286, 2005), the septum to the right and the front,
/// the anterior wall to the head, the front and the left. Odd is an apex that points to the head by
/// more than 12 degrees or to the right or the back by more than 17, a septum that faces the left
/// or the back by more than 30, an anterior wall that faces back and feet by as much, and a turn of
/// more than 60 degrees against the usual. A mirror image at the plane of apex and septum has the
/// same directions: it is not seen.
[[nodiscard]] std::string oddity(const Lie& lie);

}  // namespace lv::geometry
