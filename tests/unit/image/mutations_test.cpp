// Files as a scanner or an observer writes them, damaged: see support/mutations.hpp.
#include "support/mutations.hpp"

#include "lv/geometry/contour_checks.hpp"
#include "lv/geometry/contours.hpp"
#include "lv/image/close_walls.hpp"
#include "lv/image/dicom_segmentation.hpp"
#include "lv/image/dicom_study.hpp"
#include "lv/image/foreign_contours.hpp"
#include "lv/image/guide_points.hpp"
#include "lv/image/label_contours.hpp"
#include "lv/image/nifti.hpp"
#include "lv/image/rt_structures.hpp"
#include "lv/image/sunnybrook.hpp"
#include "lv/image/volume_file.hpp"

#include "image/foreign_files.hpp"
#include "image/nifti_files.hpp"
#include "image/segment_files.hpp"
#include "support/scanner_files.hpp"
#include "support/temporary_folder.hpp"
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <array>
#include <cmath>

namespace {

using namespace lv;
using namespace lv::image;
using test::try_damaged;

constexpr std::size_t nifti_header = 352;

test::DicomSpec dicom(double trigger_ms) {
  test::DicomSpec spec;
  spec.plane = {Vec3(1, 2, 3), Vec3::UnitX(), Vec3::UnitY(), 1.5, 1.5, 8, 8};
  spec.pixels.assign(64, 7);
  spec.trigger_ms = trigger_ms;
  return spec;
}

void read_dicom(const std::filesystem::path& file) {
  const DicomStudy study = read_dicom_study(std::array{file});
  static_cast<void>(describe(study));
  static_cast<void>(read_pixels(choose_stack(study, {}, "study", "series")));
}

/// Three slices of a round ventricle.
test::NiftiSpec labels() {
  return test::label_map({12, 12, 6}, Mat3::Identity(), {4.0, 4.0, 8.0}, Vec3::Zero(),
                         [](const Vec3& x) {
                           const double r = (x - Vec3(22, 22, x.z())).norm();
                           return r < 12.0 ? 1 : r < 18.0 ? 2 : 0;
                         });
}

void trace_map(const std::filesystem::path& file) {
  const Volume volume = read_nifti(file);
  require_labels(volume, 0, {1, 2}, "case", "cavity");
  geometry::check_contours(trace_labels(volume, {{1}, {2}, {}}, 0).contours);
}

void read_floating(const std::filesystem::path& file) {
  static_cast<void>(read_volume_cine(file));
}

/// The same for real numbers in two frames.
std::string floating_bytes() {
  test::NiftiSpec spec = labels();
  spec.size[3] = 2;
  spec.floating = true;
  spec.qform_code = 1;
  spec.same_qform = true;
  spec.slope = 2.0F;
  const std::vector<double> frame = spec.values;
  spec.values.insert(spec.values.end(), frame.begin(), frame.end());
  return test::nifti_bytes(spec);
}

/// Point i of a loop of 24 with a radius.
std::array<double, 2> on_circle(int i, double radius) {
  return {30 + radius * std::cos(0.2618 * i), 30 + radius * std::sin(0.2618 * i)};
}

std::string csv_loops() {
  std::string text = "slice,contour,point,x_mm,y_mm,z_mm\n";
  for (int s = 1; s <= 3; ++s)
    for (int i = 0; i < 24; ++i)
      for (const auto& [side, radius] : {std::pair("endo", 15.0), {"epi", 24.0}}) {
        const auto [x, y] = on_circle(i, radius);
        text += fmt::format("{},{},{},{:.2f},{:.2f},{}\n", s, side, i + 1, x, y, 8 * s);
      }
  return text;
}

std::string csv_curve() {
  std::string text = "slice,contour,point,x_mm,y_mm,z_mm\n";
  for (int i = 0; i < 21; ++i)
    text += fmt::format("1,endo,{},{:.2f},30,{:.2f}\n", i + 1, 15.0 + 1.5 * i,
                        24.0 + 40.0 * std::sin(0.157 * i));
  return text;
}

}  // namespace

TEST_CASE("damaged DICOM files are read or refused", "[unit][image][mutations]") {
  try_damaged("x.dcm", test::dicom_bytes(dicom(10.0)), read_dicom, {.few = 10});
}

TEST_CASE("damaged DICOM files of several frames are read or refused", "[unit][image][mutations]") {
  try_damaged("x.dcm", test::enhanced_dicom_bytes({dicom(10.0), dicom(20.0)}), read_dicom,
              {.few = 10});
}

TEST_CASE("damaged NIfTI files are read or refused", "[unit][image][mutations]") {
  try_damaged("x.nii", test::nifti_bytes(labels()), trace_map);
  try_damaged("x.nii", floating_bytes(), read_floating);
  try_damaged("x.nii.gz", test::gzipped(floating_bytes()), read_floating);
}

TEST_CASE("NIfTI headers that say anything are read or refused", "[unit][image][mutations]") {
  const test::Damage in_header{.within = nifti_header};
  try_damaged("x.nii", test::nifti_bytes(labels()), trace_map, in_header);
  try_damaged("x.nii", floating_bytes(), read_floating, in_header);
}

TEST_CASE("a damaged NIfTI header beside its voxels is read or refused",
          "[unit][image][mutations]") {
  const std::string whole = floating_bytes();
  std::string header = whole.substr(0, nifti_header);
  header.replace(108, 4, std::string(4, '\0'));  // where the voxels begin in their own file
  header.replace(344, 4, std::string("ni1\0", 4));
  const auto read = [&](const std::filesystem::path& file) {
    const auto voxels = std::filesystem::path(file).replace_extension(".img");
    test::write_bytes(voxels, whole.substr(nifti_header));
    read_floating(file);
  };
  try_damaged("x.hdr", header, read);
}

TEST_CASE("damaged contours of Sunnybrook are read or refused", "[unit][image][mutations]") {
  std::string circle;
  for (int i = 0; i < 24; ++i)
    circle += fmt::format("{:.2f} {:.2f}\n", on_circle(i, 9.0)[0], on_circle(i, 9.0)[1]);
  DicomStack stack;
  DicomImage image;
  image.instance = 1;
  image.plane = {Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY(), 1.0, 1.0, 64, 64};
  stack.slices.push_back({0.0, {image}});
  const auto read = [&](const std::filesystem::path& file) {
    static_cast<void>(
        read_sunnybrook(file.parent_path(), stack, PixelOrigin::corner, DrawnBy::manual));
  };
  try_damaged("IM-0001-0001-icontour-manual.txt", circle, read);
}

TEST_CASE("damaged lists of guide points are read or refused", "[unit][image][mutations]") {
  std::string list = "x\ty\tz\tcontour type\tslice\ttime frame\n";
  for (int s = 0; s < 3; ++s)
    for (int i = 0; i < 24; ++i)
      for (const auto& [type, radius] :
           {std::pair("SAX_LV_ENDOCARDIAL", 15.0), {"SAX_LV_EPICARDIAL", 24.0}}) {
        const auto [x, y] = on_circle(i, radius);
        list += fmt::format("{:.2f}\t{:.2f}\t{}\t{}\t{}\t0\n", x, y, 10 * s, type, s);
      }
  for (int i = 0; i < 12; ++i)
    list += fmt::format("{}\t30\t{}\tLAX_LV_ENDOCARDIAL\t9\t0\n", 12 + 3 * i, 20 - i * (12 - i));
  list += "30\t30\t40\tMITRAL_VALVE\t9\t0\n30\t30\t-30\tAPEX_POINT\t9\t0\n";
  const auto read = [](const std::filesystem::path& file) {
    GuidePoints found = read_guide_points(file, std::nullopt, geometry::Side::epi);
    close_walls(found.contours, 2.0, found.notes);
    geometry::check_contours(found.contours);
  };
  try_damaged("points.txt", list, read);
}

TEST_CASE("damaged CSV files of contours are read or refused", "[unit][image][mutations]") {
  const auto loops = [](const std::filesystem::path& file) {
    static_cast<void>(geometry::read_contours({.short_axis = file, .long_axis = {}, .apex = {}}));
  };
  try_damaged("loops.csv", csv_loops(), loops);
  const auto curve = [&](const std::filesystem::path& file) {
    const auto short_axis = file.parent_path() / "loops.csv";
    test::write_bytes(short_axis, csv_loops());
    static_cast<void>(
        geometry::read_contours({.short_axis = short_axis, .long_axis = file, .apex = {file}}));
  };
  try_damaged("curve.csv", csv_curve(), curve);
}

TEST_CASE("damaged NRRD and MetaImage files are read or refused", "[unit][image][mutations]") {
  const auto read = [](const std::filesystem::path& file) {
    static_cast<void>(image::read_labels(file));
  };
  const std::string values(24, '\1');
  const std::string layers =
      "dimension: 4\nspace: LPS\nsizes: 2 2 3 2\nkinds: list domain domain domain\n"
      "space directions: none (1,0,0) (0,1,0) (0,0,1)\nspace origin: (0,0,0)\n"
      "Segment0_ID:=S1\nSegment0_Name:=A\nSegment0_LabelValue:=1\nSegment0_Layer:=0\n"
      "Segment1_ID:=S2\nSegment1_Name:=B\nSegment1_LabelValue:=1\nSegment1_Layer:=1";
  try_damaged("x.seg.nrrd", test::nrrd_bytes(layers, values), read, {.few = 10});
  try_damaged(
      "x.mha",
      "ObjectType = Image\nNDims = 3\nBinaryData = True\nTransformMatrix = 1 0 0 0 1 0 0 0 "
      "1\nOffset = 1 2 3\nElementSpacing = 1 2 3\nDimSize = 2 3 4\nElementType = MET_UCHAR\n"
      "ElementDataFile = LOCAL\n" +
          values,
      read, {.few = 10});
}

TEST_CASE("damaged DICOM segmentations and contours are read or refused",
          "[unit][image][mutations]") {
  const auto segments = [](const std::filesystem::path& file) {
    static_cast<void>(read_dicom_segmentation(file));
  };
  try_damaged("x.dcm", test::segmentation_bytes(), segments, {.few = 10});
  const auto contours = [](const std::filesystem::path& file) {
    static_cast<void>(describe(read_rt_structures(file)));
  };
  try_damaged("x.dcm", test::rt_structures_bytes({{"endo", 15.0}, {"epi", 24.0}}), contours,
              {.few = 10});
}

TEST_CASE("damaged contours of Segment and cvi42 are read or refused", "[unit][image][mutations]") {
  const auto read = [](const std::filesystem::path& file) {
    const ForeignContours drawn = read_contours(file);
    if (!drawn.in_pixels)
      static_cast<void>(arranged(drawn, "Endo", "Epi", nullptr));
  };
  try_damaged("x.mat", test::segment_bytes(Mat3::Identity()), read, {.few = 10});
  const std::string workspace =
      test::cvi42_text({{"saendocardialContour", 12.0}, {"saepicardialContour", 18.0}});
  try_damaged("x.cvi42wsx", workspace, read);
  try_damaged("x.cvi42wsx", test::zip_bytes({{"x.cvi42wsx", workspace}}), read);
}
