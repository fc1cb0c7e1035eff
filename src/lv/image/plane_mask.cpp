#include "lv/image/plane_mask.hpp"

#include "lv/image/lookup.hpp"

#include <itkConnectedComponentImageFilter.h>
#include <itkContourExtractor2DImageFilter.h>
#include <itkImage.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

namespace lv::image {
namespace {

using Image = itk::Image<unsigned char, 2>;

/// With a frame of outside pixels around it, so that every line closes.
Image::Pointer to_itk(const PlaneMask& mask) {
  const auto image = Image::New();
  image->SetRegions(
      {static_cast<unsigned>(mask.columns + 2), static_cast<unsigned>(mask.rows + 2)});
  image->Allocate(true);
  for (int j = 0; j < mask.rows; ++j)
    for (int i = 0; i < mask.columns; ++i)
      image->SetPixel({i + 1, j + 1}, mask.at(i, j) ? 1 : 0);
  return image;
}

using Labels = itk::Image<unsigned, 2>;

/// Numbers from 1 of the parts that hang together along edges, 0 outside them.
itk::ConnectedComponentImageFilter<Image, Labels>::Pointer labelled(const Image* image) {
  const auto filter = itk::ConnectedComponentImageFilter<Image, Labels>::New();
  filter->SetInput(image);
  filter->Update();
  return filter;
}

template <class Chosen>
PlaneMask from_itk(const Labels& labels, int columns, int rows, const Chosen& chosen) {
  PlaneMask mask(columns, rows);
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i)
      mask.inside[static_cast<std::size_t>(j) * columns + i] =
          chosen(labels.GetPixel({i + 1, j + 1})) ? 1 : 0;
  return mask;
}

}  // namespace

std::size_t PlaneMask::count() const {
  return static_cast<std::size_t>(std::count(inside.begin(), inside.end(), 1));
}

PlaneMask mask_of(const Picture& picture, const std::vector<int>& labels) {
  PlaneMask mask(picture.plane.columns, picture.plane.rows);
  for (std::size_t p = 0; p < mask.inside.size(); ++p)
    mask.inside[p] = is_one_of(picture.values[p], labels) ? 1 : 0;
  return mask;
}

double part_of_edge_on(const PlaneMask& other, const PlaneMask& mask) {
  double edge = 0.0;
  double on = 0.0;
  for (int j = 1; j + 1 < mask.rows; ++j)
    for (int i = 1; i + 1 < mask.columns; ++i)
      for (const auto& [x, y] : {std::array{-1, 0}, {1, 0}, {0, -1}, {0, 1}})
        if (mask.at(i, j) && !mask.at(i + x, j + y)) {
          edge += 1.0;
          on += other.at(i + x, j + y) ? 1.0 : 0.0;
        }
  return edge > 0.0 ? on / edge : 0.0;
}

std::vector<PlaneMask> parts(const PlaneMask& mask) {
  const auto filter = labelled(to_itk(mask));
  const auto count = static_cast<unsigned>(filter->GetObjectCount());
  std::vector<PlaneMask> found;
  for (unsigned label = 1; label <= count; ++label)
    found.push_back(from_itk(*filter->GetOutput(), mask.columns, mask.rows,
                             [label](unsigned value) { return value == label; }));
  std::stable_sort(found.begin(), found.end(),
                   [](const PlaneMask& a, const PlaneMask& b) { return a.count() > b.count(); });
  return found;
}

PlaneMask filled(const PlaneMask& mask) {
  const Image::Pointer around = to_itk(mask);
  for (unsigned char& pixel :
       std::span(around->GetBufferPointer(), around->GetPixelContainer()->Size()))
    pixel = 1 - pixel;
  const auto filter = labelled(around);
  const Labels& labels = *filter->GetOutput();
  const unsigned outside = labels.GetPixel({0, 0});
  return from_itk(labels, mask.columns, mask.rows,
                  [outside](unsigned label) { return label != outside; });
}

PixelLoop outline(const PlaneMask& mask) {
  const auto filter = itk::ContourExtractor2DImageFilter<Image>::New();
  filter->SetInput(to_itk(mask));
  filter->SetContourValue(0.5);
  filter->Update();
  PixelLoop longest;
  for (unsigned n = 0; n < filter->GetNumberOfOutputs(); ++n) {
    PixelLoop loop;
    for (const auto& vertex : *filter->GetOutput(n)->GetVertexList())
      loop.emplace_back(vertex[0] - 1.0, vertex[1] - 1.0);
    while (loop.size() > 1 && (loop.front() - loop.back()).norm() < 1e-9)
      loop.pop_back();
    if (area(loop) > area(longest))
      longest = std::move(loop);
  }
  return longest;
}

double area(const PixelLoop& loop) {
  double twice = 0.0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const auto& a = loop[i];
    const auto& b = loop[(i + 1) % loop.size()];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return 0.5 * std::abs(twice);
}

}  // namespace lv::image
