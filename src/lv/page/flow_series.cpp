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
      image->GetDataDimension() != 3 || image->GetDimensions()[0] < 3 ||
      image->GetDimensions()[1] < 3 || !(spacing[0] > 0.0 && spacing[1] > 0.0 && spacing[2] > 0.0))
    throw RunError(fmt::format("{} cannot be read", file.string()),
                   "Remove the stage's folder and run the case again");
  return image;
}

/// Cells of an image: n along each direction.
std::array<int, 3> cells_of(vtkImageData* image) {
  const int* points = image->GetDimensions();
  return {points[0] - 1, points[1] - 1, points[2] - 1};
}

/// The number of a cell along a direction of the grid, between 0 and the last.
int clamped(double at, int cells) {
  return static_cast<int>(std::fmax(0.0, std::fmin(std::floor(at), cells - 1.0)));
}

/// The part of a long-axis plane that is read.
struct Window {
  std::array<int, 2> size;      ///< cells along s and z
  std::array<double, 2> lower;  ///< corner [mm]
  int first_row;

  Window(vtkImageData* image, const std::array<double, 2>& from, const std::array<double, 2>& to)
      : size(), lower() {
    const double* origin = image->GetOrigin();
    const double* spacing = image->GetSpacing();
    const int rows = cells_of(image)[2];
    first_row = clamped((from[1] - origin[2]) / spacing[2], rows);
    // a width that no heart has would ask for more cells than there is memory
    const int widest = 4 * (cells_of(image)[0] + cells_of(image)[1]);
    size = {1 + clamped((to[0] - from[0]) / spacing[0], widest),
            clamped((to[1] - origin[2]) / spacing[2], rows) + 1 - first_row};
    lower = {from[0], origin[2] + first_row * spacing[2]};
  }
};

/// A cell of the grid's layers and its part in a value.
struct Part {
  int i, j;
  double weight;
};

/// The four cells of a layer around a place.
std::array<Part, 4> around(vtkImageData* image, double x, double y) {
  const auto cells = cells_of(image);
  const auto place = [&](double at, int d) {
    const double cell = (at - image->GetOrigin()[d]) / image->GetSpacing()[d] - 0.5;
    return std::fmax(0.0, std::fmin(cell, cells.at(d) - 1.0));
  };
  const double at_x = place(x, 0);
  const double at_y = place(y, 1);
  const int i = clamped(at_x, cells[0] - 1);
  const int j = clamped(at_y, cells[1] - 1);
  const double a = at_x - i;
  const double b = at_y - j;
  return {{{i, j, (1.0 - a) * (1.0 - b)},
           {i + 1, j, a * (1.0 - b)},
           {i, j + 1, (1.0 - a) * b},
           {i + 1, j + 1, a * b}}};
}

std::vector<float> plane_of(vtkImageData* image, const char* name, const LongAxis& plane,
                            const Window& window) {
  vtkDataArray* array = image->GetCellData()->GetArray(name);
  const auto cells = cells_of(image);
  const double c = std::cos(plane.angle);
  const double s = std::sin(plane.angle);
  std::vector<std::array<Part, 4>> column;
  for (int i = 0; i < window.size[0]; ++i) {
    const double at = window.lower[0] + (i + 0.5) * image->GetSpacing()[0];
    column.push_back(around(image, at * c, at * s));
  }
  std::vector<float> values;
  for (int k = window.first_row; k < window.first_row + window.size[1]; ++k)
    for (const auto& parts : column) {
      const auto mean = [&](int d) {
        double sum = 0.0;
        for (const auto& [i, j, weight] : parts)
          sum += weight *
                 array->GetComponent(i + cells[0] * (j + static_cast<vtkIdType>(cells[1]) * k), d);
        return sum;
      };
      if (array->GetNumberOfComponents() == 1) {
        values.push_back(static_cast<float>(mean(0)));
        continue;
      }
      const double x = mean(0);
      const double y = mean(1);
      for (const double component : {plane.along(x, y), plane.across(x, y), mean(2)})
        values.push_back(static_cast<float>(component));
    }
  return values;
}

}  // namespace

double LongAxis::along(double x, double y) const {
  return x * std::cos(angle) + y * std::sin(angle);
}

double LongAxis::across(double x, double y) const {
  return y * std::cos(angle) - x * std::sin(angle);
}

FlowSeries read_flow_series(const std::vector<TimedFrame>& frames, const LongAxis& plane,
                            const std::array<double, 2>& lower,
                            const std::array<double, 2>& upper) {
  FlowSeries flow;
  for (const TimedFrame& frame : frames) {
    interrupt::check();
    const auto image = read_image(frame.file);
    const Window window(image, lower, upper);
    flow.cells = window.size;
    flow.lower = window.lower;
    flow.spacing = {image->GetSpacing()[0], image->GetSpacing()[2]};
    flow.times.push_back(frame.time);
    flow.velocity.push_back(plane_of(image, "velocity", plane, window));
    flow.pressure.push_back(plane_of(image, "pressure", plane, window));
  }
  return flow;
}

}  // namespace lv::page
