#include "lv/image/foreign_contours.hpp"

#include "lv/base/check.hpp"
#include "lv/geometry/contour_checks.hpp"
#include "lv/geometry/contour_measures.hpp"
#include "lv/geometry/fit_report.hpp"

#include "image/foreign_files.hpp"
#include "image/nifti_files.hpp"
#include "image/segment_files.hpp"
#include "support/scanner_files.hpp"
#include "support/temporary_folder.hpp"
#include <catch2/catch.hpp>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <numbers>

namespace {

using namespace lv;
using namespace lv::image;
using Catch::Matchers::Contains;

ForeignContours read_drawn(const std::string& name, const std::string& bytes) {
  const test::TemporaryFolder folder;
  test::write_bytes(folder / name, bytes);
  return read_contours(folder / name);
}

/// Three oblique slices, 8 mm apart, with one or two images each.
DicomStack image_stack(const test::TemporaryFolder& folder, const Mat3& axes, int phases = 1) {
  for (int s = 0; s < 3; ++s)
    for (int p = 0; p < phases; ++p) {
      test::DicomSpec spec;
      spec.plane = {
          Vec3(10, -20, 30) + 8.0 * s * axes.col(2), axes.col(0), axes.col(1), 1.25, 1.25, 64, 60};
      spec.pixels.assign(64 * 60, 7);
      spec.instance_uid = fmt::format("1.2.3.4.{}.{}", s + 1, p + 1);
      spec.instance = 10 * s + p + 1;
      spec.trigger_ms = 40.0 * p;
      test::write_bytes(folder / fmt::format("{}_{}", s, p), test::dicom_bytes(spec));
    }
  return choose_stack(read_dicom_study(std::array{folder / ""}), {}, "images", "series");
}

double ring_area(double radius) {
  return 0.5 * 24 * std::sin(2.0 * std::numbers::pi / 24) * radius * radius;
}

}  // namespace

TEST_CASE("contours of Segment lie where its formula says, at every time", "[unit][image]") {
  const Mat3 axes = test::oblique();
  const ForeignContours drawn = read_drawn("x.mat", test::segment_bytes(axes));
  CHECK(drawn.endo == "Endo");
  CHECK_THAT(drawn.notes.front(), Contains("marks time 1 as end-diastole and 2 as end-systole"));
  CHECK(drawn.end_diastole == 1);
  const DrawnPhases phases = arranged(drawn, "Endo", "Epi", nullptr);
  REQUIRE(phases.phases.size() == 2);
  REQUIRE(phases.phases.at(1).short_axis.size() == 6);
  CHECK(phases.phases.at(2).short_axis.size() == 4);
  geometry::check_contours(phases.phases.at(1));
  const Vec3 first =
      Vec3(10, -20, 30) + 1.5 * (31.0 + 10.0 - 1.0) * axes.col(1) + 1.25 * 32.0 * axes.col(0);
  // the loops run from the columns to the rows: slices follow each other along that normal
  const geometry::Contour* endo =
      geometry::find(phases.phases.at(1).short_axis, 1, geometry::Side::endo);
  REQUIRE(endo != nullptr);
  CHECK((endo->points.front() - first).norm() < 1e-9);
  CHECK((geometry::find(phases.phases.at(1).short_axis, 3, geometry::Side::endo)->points.front() -
         (first - 16.0 * axes.col(2)))
            .norm() < 1e-9);
  CHECK(geometry::slab_volumes(phases.phases.at(1)).cavity ==
        Approx(24.0 * ring_area(15.0)).epsilon(1e-3));
  CHECK_THROWS_WITH(read_drawn("x.mat", test::segment_bytes(axes, 1.0)), Contains("was rotated"));
  CHECK_THROWS_WITH(read_drawn("x.mat", "MATLAB 5.0 MAT-file" + std::string(200, ' ')),
                    Contains("setstruct") || Contains("cannot be read as a file of MATLAB"));
}

TEST_CASE("structures of RTSTRUCT are chosen by name", "[unit][image]") {
  const Mat3 axes = test::oblique();
  const ForeignContours drawn = read_drawn(
      "x", test::rt_structures_bytes({{"LV endo", 15.0}, {"LV epi", 24.0}, {"RV", 9.0}}, axes));
  CHECK(drawn.endo.empty());
  CHECK(structures(drawn) == std::map<std::string, int>{{"LV endo", 3}, {"LV epi", 3}, {"RV", 3}});
  CHECK_THAT(drawn.notes.front(), Contains("3 points and open lines are not used"));
  const DrawnPhases phases = arranged(drawn, "LV endo", "LV epi", nullptr);
  REQUIRE(phases.phases.size() == 1);
  CHECK(phases.phases.at(1).short_axis.size() == 6);
  CHECK(geometry::slab_volumes(phases.phases.at(1)).cavity ==
        Approx(24.0 * ring_area(15.0)).epsilon(1e-3));
  CHECK_THROWS_WITH(arranged(drawn, "LV", "LV epi", nullptr),
                    Contains("no contours called \"LV\"") && Contains("\"LV endo\": 3 contours"));
  CHECK_THROWS_WITH(arranged(drawn, "LV epi", "LV epi", nullptr),
                    Contains("endocardium and epicardium are both \"LV epi\""));
  CHECK_THROWS_WITH(
      arranged(drawn, "LV epi", "LV endo", nullptr),
      Contains("on all 3 slices with both, \"LV epi\" (endocardium) encloses more than"));
}

TEST_CASE("structures of open lines are named with what they have", "[unit][image]") {
  std::string bytes = test::rt_structures_bytes({{"LV endo", 15.0}, {"LV epi", 24.0}});
  for (std::size_t at = 0; (at = bytes.find("CLOSED_PLANAR ", at)) != std::string::npos;)
    bytes.replace(at, 14, "OPEN_PLANAR   ");
  CHECK_THROWS_WITH(arranged(read_drawn("x", bytes), "LV endo", "LV epi", nullptr),
                    Contains("has \"LV endo\", but as 3 OPEN_PLANAR, 1 POINT: no closed contours"));
}

TEST_CASE("contours in space lie on the images that they name", "[unit][image]") {
  const Mat3 axes = test::oblique();
  const test::TemporaryFolder folder;
  const DicomStack images = image_stack(folder, axes);
  ForeignContours drawn =
      read_drawn("x", test::rt_structures_bytes({{"endo", 15.0}, {"epi", 24.0}}, axes, true));
  CHECK(arranged(drawn, "endo", "epi", &images).phases.at(1).short_axis.size() == 6);
  for (Vec3& x : drawn.loops.front().points)
    x += 6.0 * axes.col(2);
  CHECK_THROWS_WITH(arranged(drawn, "endo", "epi", &images),
                    Contains("a contour of \"endo\" lies 6.0 mm off the plane of the image"));
}

TEST_CASE("RTSTRUCT of several times needs the images, which say when", "[unit][image]") {
  const Mat3 axes = test::oblique();
  const test::TemporaryFolder folder;
  ForeignContours drawn =
      read_drawn("x", test::rt_structures_bytes({{"endo", 15.0}, {"epi", 24.0}}, axes, true));
  const std::size_t count = drawn.loops.size();
  for (std::size_t l = 0; l < count; ++l) {
    ForeignLoop later = drawn.loops[l];
    later.image_uid.back() = '2';
    drawn.loops.push_back(later);
  }
  CHECK_THROWS_WITH(arranged(drawn, "endo", "epi", nullptr),
                    Contains("twice") && Contains("anatomy.contour_file.images"));
  const DicomStack images = image_stack(folder, axes, 2);
  const DrawnPhases phases = arranged(drawn, "endo", "epi", &images);
  REQUIRE(phases.phases.size() == 2);
  CHECK(phases.phases.at(2).short_axis.size() == 6);
  drawn.loops.front().image_uid = "9.9";
  CHECK_THROWS_WITH(arranged(drawn, "endo", "epi", &images),
                    Contains("the SOPInstanceUID 9.9, which is not among the images"));
}

TEST_CASE("contours of cvi42 lie on the images that they name", "[unit][image]") {
  const Mat3 axes = test::oblique();
  const ForeignContours drawn =
      read_drawn("x.cvi42wsx", test::cvi42_text({{"saendocardialContour", 12.0},
                                                 {"saepicardialContour", 18.0},
                                                 {"sapapilMuscContour1", 3.0},
                                                 {"laendocardialOpenContour", 9.0}},
                                                256));
  CHECK(drawn.in_pixels);
  CHECK(structures(drawn).size() == 2);
  CHECK_THROWS_WITH(arranged(drawn, drawn.endo, drawn.epi, nullptr),
                    Contains("anatomy.contour_file.images"));
  const test::TemporaryFolder folder;
  const DicomStack images = image_stack(folder, axes);
  const DrawnPhases phases = arranged(drawn, drawn.endo, drawn.epi, &images);
  const geometry::Contour* endo =
      geometry::find(phases.phases.at(1).short_axis, 2, geometry::Side::endo);
  REQUIRE(endo != nullptr);
  CHECK((endo->points.front() - (Vec3(10, -20, 30) + 1.25 * 43.5 * axes.col(0) +
                                 1.25 * 29.5 * axes.col(1) + 8.0 * axes.col(2)))
            .norm() < 1e-4);
  CHECK(geometry::slab_volumes(phases.phases.at(1)).cavity ==
        Approx(24.0 * ring_area(12.0 * 1.25)).epsilon(1e-2));
  CHECK_THROWS_WITH(
      read_drawn("x.cvi42wsx", "<a xmlns=\"http://www.circlecvi.com/cvi42/\"><b></a>"),
      Contains("cannot be read as XML"));
  CHECK_THROWS_WITH(read_drawn("x.cvi42wsx", "<a xmlns=\"http://www.circlecvi.com/cvi42/\"></a>"),
                    Contains("holds no closed contours"));
}

TEST_CASE("a workspace of cvi42 is read in a zip archive too", "[unit][image]") {
  const std::string text =
      test::cvi42_text({{"saendocardialContour", 12.0}, {"saepicardialContour", 18.0}});
  const std::string zip = test::zip_bytes({{"note.txt", "words"}, {"a/study.cvi42wsx", text}});
  const ForeignContours plain = read_drawn("x.cvi42wsx", text);
  const ForeignContours packed = read_drawn("x.cvi42wsx", zip);
  REQUIRE(packed.loops.size() == plain.loops.size());
  CHECK(packed.loops.back().points.back() == plain.loops.back().points.back());
  std::string damaged = zip;
  damaged[zip.size() / 2] = static_cast<char>(~damaged[zip.size() / 2]);
  CHECK_THROWS_AS(read_drawn("x.cvi42wsx", damaged), InputError);
  CHECK_THROWS_WITH(read_drawn("x.zip", test::zip_bytes({{"note.txt", "words"}})),
                    Contains("Segment (.mat), DICOM RTSTRUCT and cvi42"));
}

TEST_CASE("files of contours that are none are named as such", "[unit][image]") {
  CHECK_THROWS_WITH(read_drawn("x.txt", "words"),
                    Contains("Segment (.mat), DICOM RTSTRUCT and cvi42"));
}

TEST_CASE("a sample file of RTSTRUCT is read", "[unit][image][data]") {
  const char* set = std::getenv("VENTRICLE_DATA");
  const std::filesystem::path file =
      std::filesystem::path(set != nullptr ? set : LV_DATA_DIR) / "formats" / "rt.dcm";
  if (!std::filesystem::exists(file)) {
    WARN("skipped: no file " << file << "; set VENTRICLE_DATA to the folder that holds formats/");
    return;
  }
  const ForeignContours drawn = read_contours(file);
  CHECK(structures(drawn) == std::map<std::string, int>{{"ROI-1", 2}});
  CHECK(drawn.loops.front().points.size() == 4);
}
