#pragma once

#include "lv/image/picture.hpp"

#include <itkBSplineInterpolateImageFunction.h>
#include <itkImage.h>

namespace lv::strain {

/// A picture as ITK has it, in the plane's own coordinates: columns and rows times spacing [mm].
using GreyImage = itk::Image<double, 2>;
using Interpolator = itk::BSplineInterpolateImageFunction<GreyImage, double, double>;

/// A part of an image, in pixels.
struct Window {
  int left, top, columns, rows;
};

[[nodiscard]] GreyImage::Pointer cropped(const image::Picture& picture, const Window& window);

/// Grey values between pixels, by cubic B-splines, of the image smoothed by a Gaussian of standard
/// deviation `smoothing` [mm].
[[nodiscard]] Interpolator::Pointer interpolated(const GreyImage* image, double smoothing);

}  // namespace lv::strain
