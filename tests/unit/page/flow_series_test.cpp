#include "lv/page/flow_series.hpp"

#include "support/temporary_folder.hpp"
#include <catch2/catch.hpp>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkXMLImageDataWriter.h>

#include <cmath>

namespace {

using namespace lv;

/// Cells of 2 mm around the z axis with fields that are linear in x, y and z.
void write_blood(const std::filesystem::path& file) {
  vtkNew<vtkImageData> image;
  image->SetDimensions(13, 13, 6);
  image->SetOrigin(-12.0, -12.0, -6.0);
  image->SetSpacing(2.0, 2.0, 2.0);
  vtkNew<vtkDoubleArray> velocity;
  vtkNew<vtkDoubleArray> pressure;
  velocity->SetName("velocity");
  velocity->SetNumberOfComponents(3);
  pressure->SetName("pressure");
  for (int k = 0; k < 5; ++k)
    for (int j = 0; j < 12; ++j)
      for (int i = 0; i < 12; ++i) {
        const Vec3 x(-11.0 + 2.0 * i, -11.0 + 2.0 * j, -5.0 + 2.0 * k);
        velocity->InsertNextTuple3(-x.y(), x.x(), x.z());  // turns about the axis
        pressure->InsertNextTuple1(x.x() + 10.0 * x.z());
      }
  image->GetCellData()->AddArray(velocity);
  image->GetCellData()->AddArray(pressure);
  vtkNew<vtkXMLImageDataWriter> writer;
  writer->SetFileName(file.c_str());
  writer->SetInputData(image);
  REQUIRE(writer->Write() == 1);
}

}  // namespace

TEST_CASE("blood is read in the plane that is asked for, in its directions", "[page]") {
  const test::TemporaryFolder folder;
  write_blood(folder / "blood.vti");
  for (const double angle : {0.0, 0.7, -2.0}) {
    const page::LongAxis plane{angle};
    const page::FlowSeries flow =
        page::read_flow_series({{0.5, folder / "blood.vti"}}, plane, {-8.0, -4.5}, {8.0, 2.5});
    CHECK(flow.times == std::vector<double>{0.5});
    CHECK(flow.lower[1] == Approx(-6.0));
    REQUIRE(flow.velocity.front().size() == 3U * flow.cells[0] * flow.cells[1]);
    for (int k = 0; k < flow.cells[1]; ++k)
      for (int i = 0; i < flow.cells[0]; ++i) {
        const double s = flow.lower[0] + (i + 0.5) * flow.spacing[0];
        const double z = flow.lower[1] + (k + 0.5) * flow.spacing[1];
        const std::size_t cell = static_cast<std::size_t>(k) * flow.cells[0] + i;
        CHECK(flow.velocity.front()[3 * cell] == Approx(0.0).margin(1e-5));  // none along s
        CHECK(flow.velocity.front()[3 * cell + 1] == Approx(s).margin(1e-5));
        CHECK(flow.velocity.front()[3 * cell + 2] == Approx(z).margin(1e-5));
        CHECK(flow.pressure.front()[cell] == Approx(s * std::cos(angle) + 10.0 * z).margin(1e-4));
      }
  }
}
