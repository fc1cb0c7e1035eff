#pragma once

#include "lv/base/tensor.hpp"
#include "lv/mesh/mesh.hpp"

namespace lv::solid {

/// A field u(X) = H X + d.
struct AffineField {
  Mat3 H = Mat3::Zero();
  Vec3 d = Vec3::Zero();

  [[nodiscard]] Vec3 at(const Vec3& X) const { return H * X + d; }
};

/// The field that many parts of the way from one to another.
[[nodiscard]] inline AffineField between(const AffineField& a, const AffineField& b, double share) {
  return {(1.0 - share) * a.H + share * b.H, (1.0 - share) * a.d + share * b.d};
}

/// How far the base, as a rigid body, has gone from where the undeformed wall has it.
struct BasePose {
  double axial = 0.0;        ///< of its middle along the long axis, towards the apex [mm]
  double septal_tilt = 0.0;  ///< the septal edge goes towards the apex, the lateral one away [rad]
  double anterior_tilt = 0.0;  ///< the anterior edge goes towards the apex [rad]
  double rotation = 0.0;       ///< about the long axis, anticlockwise seen from the apex [rad]
};

/// What a pose refers to: the model's z is the long axis, from apex to base.
struct BaseFrame {
  Vec3 middle = Vec3::Zero();  ///< of the undeformed base [mm]
  double septum_angle = 0.0;   ///< as mesh::RegionParameters has it [rad]
};

/// The middle of the nodes of a mesh's base.
[[nodiscard]] BaseFrame base_frame(const mesh::Mesh& mesh, double septum_angle);

/// u(X) = (R - 1)(X - c) - axial e_z about the base's middle c, with one turn R for tilts and
/// rotation: its vector is septal_tilt n - anterior_tilt s - rotation e_z, s from the long axis to
/// the middle of the septum and n to the anterior wall.
[[nodiscard]] AffineField displacement(const BasePose& pose, const BaseFrame& frame);

/// Where a moving base's springs pull to, and how fast that place moves. Both zero: it is where the
/// base was undeformed.
struct BasePlace {
  AffineField displacement{};  ///< [mm]
  AffineField velocity{};      ///< [mm/s]
};

/// The displacements of a moving base at the ends of a step.
struct BaseStep {
  AffineField before{}, after{};

  /// At a share of a step of dt [s], whose velocity is that of the whole step.
  [[nodiscard]] BasePlace at(double share, double dt) const {
    return {between(before, after, share), {(after.H - before.H) / dt, (after.d - before.d) / dt}};
  }
};

}  // namespace lv::solid
