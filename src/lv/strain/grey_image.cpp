#include "lv/strain/grey_image.hpp"

#include <itkSmoothingRecursiveGaussianImageFilter.h>

#include <array>

namespace lv::strain {

GreyImage::Pointer cropped(const image::Picture& picture, const Window& w) {
  const auto image = GreyImage::New();
  GreyImage::SizeType size{};
  size[0] = w.columns;
  size[1] = w.rows;
  image->SetRegions(size);
  const std::array<double, 2> spacing{picture.plane.spacing_i, picture.plane.spacing_j};
  const std::array<double, 2> origin{w.left * spacing[0], w.top * spacing[1]};
  image->SetSpacing(spacing.data());
  image->SetOrigin(origin.data());
  image->Allocate();
  double* out = image->GetBufferPointer();
  for (int j = 0; j < w.rows; ++j)
    for (int i = 0; i < w.columns; ++i)
      *out++ = picture.at(w.left + i, w.top + j);
  return image;
}

Interpolator::Pointer interpolated(const GreyImage* image, double smoothing) {
  const auto interpolator = Interpolator::New();
  interpolator->SetSplineOrder(3);
  if (smoothing > 0.0) {
    const auto filter = itk::SmoothingRecursiveGaussianImageFilter<GreyImage, GreyImage>::New();
    filter->SetInput(image);
    filter->SetSigma(smoothing);
    filter->SetNumberOfWorkUnits(1);
    filter->Update();
    interpolator->SetInputImage(filter->GetOutput());
  } else {
    interpolator->SetInputImage(image);
  }
  return interpolator;
}

}  // namespace lv::strain
