#pragma once

#include "lv/image/picture.hpp"

#include <functional>
#include <vector>

namespace lv::strain {

/// A picture with all that is on it moved by the part of `shift` that lies in its plane (image
/// space, mm). Grey values between pixels by cubic B-splines; what comes in over the border has the
/// border's value.
[[nodiscard]] image::Picture moved(const image::Picture& picture, const Vec3& shift);

/// How far muscle that was at X at end-diastole has moved along a stack's normal, at a step of the
/// cycle after it [mm].
using NormalMotion = std::function<double(const Vec3& X, int step)>;

/// Images that went along with the muscle of a slice.
struct MuscleSlice {
  image::CineSlice images;  ///< as if on the slice's plane
  double beyond = 0.0;      ///< how far muscle left the stack, in the middle of the image [mm]
};

/// The images of a slice as if its plane had moved with its muscle: the grey value at X is that of
/// the stack at X + u(X, t) n, by Lagrange's polynomial through the four nearest slices along the
/// normal n; two slices at the ends of the stack, the end slice beyond them. Between slices 8 mm
/// apart a cubic keeps edges and texture that a linear mean blurs. `drawn` is the index of the
/// image at end-diastole. @pre Two slices or more, with their pixels one above the other.
[[nodiscard]] MuscleSlice follow_muscle(const std::vector<image::CineSlice>& stack,
                                        std::size_t slice, int drawn, const NormalMotion& u);

}  // namespace lv::strain
