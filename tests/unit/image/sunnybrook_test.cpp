#include "lv/image/sunnybrook.hpp"

#include "lv/geometry/spline_wall.hpp"
#include "lv/image/close_walls.hpp"
#include "lv/image/dicom_study.hpp"
#include "lv/image/label_contours.hpp"
#include "lv/image/nifti.hpp"

#include <catch2/catch.hpp>

#include <array>
#include <cstdlib>
#include <filesystem>

namespace {

using namespace lv;
using namespace lv::image;

/// A real patient, if the folder is there: not part of the project.
std::filesystem::path patient() {
  const char* set = std::getenv("VENTRICLE_DATA");
  return std::filesystem::path(set != nullptr ? set : LV_DATA_DIR) / "sunnybrook_SC-HF-I-1";
}

bool there() {
  if (std::filesystem::exists(patient()))
    return true;
  WARN("skipped: no folder " << patient() << "; set VENTRICLE_DATA to the folder that holds it");
  return false;
}

geometry::FitReport fitted(geometry::Contours contours) {
  std::vector<std::string> notes;
  geometry::SplineFitParameters fit;
  fit.frame.base_at = geometry::BaseAt::slab;
  close_walls(contours, fit.thinnest_wall, notes);
  return geometry::fit_spline_wall(contours, fit).report();
}

}  // namespace

// 191.3 ml are the areas of the drawn loops times 10 mm.
TEST_CASE("a patient's end-diastolic cavity from contours with their DICOM images",
          "[unit][image][data]") {
  if (!there())
    return;
  const DicomStack stack =
      choose_stack(read_dicom_study(std::array{patient() / "dicom"}), {}, "dicom", "series");
  CHECK(stack.slices.size() == 12);
  const DrawnPhases drawn =
      read_sunnybrook(patient() / "contours", stack, PixelOrigin::corner, DrawnBy::manual);
  CHECK(geometry::slab_volumes(drawn.phases.at(3)).cavity == Approx(191.3e3).epsilon(0.001));
  CHECK(geometry::slab_volumes(drawn.phases.at(1)).cavity == Approx(141.3e3).epsilon(0.001));
  const auto report = fitted(drawn.phases.at(3));
  CHECK(report.volume_cavity == Approx(191.3e3).epsilon(0.03));
  CHECK(report.volume_wall == Approx((302.5 - 191.3) * 1e3).epsilon(0.06));
}

TEST_CASE(
    "contours on slices with different numbers of images are refused, for their phases would "
    "be mixed",
    "[unit][image][data]") {
  if (!there())
    return;
  DicomStack stack =
      choose_stack(read_dicom_study(std::array{patient() / "dicom"}), {}, "dicom", "series");
  for (DicomSlice& slice : stack.slices)
    std::erase_if(slice.images, [](const DicomImage& image) { return image.instance == 110; });
  CHECK_THROWS_WITH(
      read_sunnybrook(patient() / "contours", stack, PixelOrigin::corner, DrawnBy::manual),
      Catch::Matchers::Contains("has 2 images where slice") &&
          Catch::Matchers::Contains("the phases of the contours cannot be told"));
}

TEST_CASE("the same patient's cavity from a map of labels", "[unit][image][data]") {
  if (!there())
    return;
  const Volume volume = read_nifti(patient() / "nifti_derived" / "SC-HF-I-1_ED_label.nii.gz");
  const LabelContours labels = trace_labels(volume, {{1}, {2}, {}}, 0);
  CHECK(labels.cavity == Approx(194.84e3).epsilon(0.001));
  CHECK(fitted(labels.contours).volume_cavity == Approx(labels.cavity).epsilon(0.03));
}
