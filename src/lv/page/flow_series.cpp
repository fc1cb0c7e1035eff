#include "lv/page/flow_series.hpp"

#include "lv/base/check.hpp"
#include "lv/base/interrupt.hpp"

#include <fmt/format.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkObject.h>
#include <vtkSmartPointer.h>
#include <vtkXMLImageDataReader.h>

#include <algorithm>
#include <cmath>

namespace lv::page {
namespace {

vtkSmartPointer<vtkImageData> read_image(const std::filesystem::path& file) {
  vtkObject::GlobalWarningDisplayOff();  // what goes wrong is said once, below
  vtkNew<vtkXMLImageDataReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  vtkSmartPointer<vtkImageData> image = reader->GetOutput();
  const auto has = [&](const char* name, int components) {
    vtkDataArray* array = image->GetCellData()->GetArray(name);
    return array != nullptr && array->GetNumberOfComponents() == components &&
           array->GetNumberOfTuples() == image->GetNumberOfCells();
  };
  const double* spacing = image->GetSpacing();
  if (reader->GetErrorCode() != 0 || !has("velocity", 3) || !has("pressure", 1) ||
      image->GetDataDimension() != 3 || image->GetDimensions()[1] < 3 ||
      !(spacing[0] > 0.0 && spacing[1] > 0.0 && spacing[2] > 0.0))
    throw RunError(fmt::format("{} cannot be read", file.string()),
                   "Remove the stage's folder and run the case again");
  return image;
}

/// Cells of an image: n along each direction.
std::array<int, 3> cells_of(vtkImageData* image) {
  const int* points = image->GetDimensions();
  return {points[0] - 1, points[1] - 1, points[2] - 1};
}

/// The part of a plane y = 0 of an image.
struct Window {
  std::array<int, 2> first, size;  ///< cells along x and z
  int layer;                       ///< cells `layer - 1` and `layer` along y meet at y = 0

  Window(vtkImageData* image, const std::array<double, 2>& lower,
         const std::array<double, 2>& upper)
      : first(), size() {
    const double* origin = image->GetOrigin();
    const double* spacing = image->GetSpacing();
    const auto cells = cells_of(image);
    const auto index = [&](double at, int d) {
      const double cell = std::floor((at - origin[d]) / spacing[d]);
      return static_cast<int>(std::fmax(0.0, std::fmin(cell, cells[d] - 1.0)));
    };
    for (const int i : {0, 1}) {
      first[i] = index(lower[i], 2 * i);
      size[i] = index(upper[i], 2 * i) + 1 - first[i];
    }
    const double middle = std::round(-origin[1] / spacing[1]);
    layer = static_cast<int>(std::fmax(1.0, std::fmin(middle, cells[1] - 1.0)));
  }
};

std::vector<float> plane_of(vtkImageData* image, const char* name, const Window& window) {
  vtkDataArray* array = image->GetCellData()->GetArray(name);
  const auto cells = cells_of(image);
  std::vector<float> values;
  for (int k = window.first[1]; k < window.first[1] + window.size[1]; ++k)
    for (int i = window.first[0]; i < window.first[0] + window.size[0]; ++i)
      for (int d = 0; d < array->GetNumberOfComponents(); ++d) {
        const auto at = [&](int j) {
          return array->GetComponent(i + cells[0] * (j + static_cast<vtkIdType>(cells[1]) * k), d);
        };
        values.push_back(static_cast<float>(0.5 * (at(window.layer - 1) + at(window.layer))));
      }
  return values;
}

}  // namespace

FlowSeries read_flow_series(const std::vector<TimedFrame>& frames,
                            const std::array<double, 2>& lower,
                            const std::array<double, 2>& upper) {
  FlowSeries flow;
  for (const TimedFrame& frame : frames) {
    interrupt::check();
    const auto image = read_image(frame.file);
    const Window window(image, lower, upper);
    flow.cells = window.size;
    for (const int i : {0, 1}) {
      flow.spacing[i] = image->GetSpacing()[2 * i];
      flow.lower[i] = image->GetOrigin()[2 * i] + window.first[i] * flow.spacing[i];
    }
    flow.times.push_back(frame.time);
    flow.velocity.push_back(plane_of(image, "velocity", window));
    flow.pressure.push_back(plane_of(image, "pressure", window));
  }
  return flow;
}

}  // namespace lv::page
