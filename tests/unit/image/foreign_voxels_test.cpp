#include "lv/base/check.hpp"
#include "lv/image/dicom_segmentation.hpp"
#include "lv/image/label_contours.hpp"
#include "lv/image/volume_file.hpp"

#include "image/foreign_files.hpp"
#include "image/nifti_files.hpp"
#include "support/temporary_folder.hpp"
#include <catch2/catch.hpp>

#include <cstdlib>
#include <filesystem>

namespace {

using namespace lv;
using namespace lv::image;
using Catch::Matchers::Contains;

Volume read_voxels(const std::string& name, const std::string& bytes) {
  const test::TemporaryFolder folder;
  test::write_bytes(folder / name, bytes);
  return read_labels(folder / name);
}

std::string refusal(const std::string& name, const std::string& bytes) {
  try {
    static_cast<void>(read_voxels(name, bytes));
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

/// Values 0, 1, 2, ... of so many voxels.
std::string counted(int voxels) {
  std::string values;
  for (int v = 0; v < voxels; ++v)
    values += static_cast<char>(v);
  return values;
}

const std::string box_in_space =
    "dimension: 3\nsizes: 2 3 4\nspace directions: (1.5,0,0) (0,0,2) (0,-3,0)\n"
    "space origin: (10,20,30)";

}  // namespace

TEST_CASE("NRRD lies where its directions say, in the space that it states", "[unit][image]") {
  const Volume lps = read_voxels(
      "a.nrrd", test::nrrd_bytes("space: left-posterior-superior\n" + box_in_space, counted(24)));
  CHECK(lps.size == std::array{2, 3, 4});
  CHECK(lps.spacing.isApprox(Vec3(1.5, 2.0, 3.0)));
  CHECK(lps.point({1, 2, 3}).isApprox(Vec3(11.5, 11.0, 34.0)));
  CHECK(lps.at(1, 2, 3) == 23.0F);
  const Volume ras = read_voxels(
      "a.nrrd", test::nrrd_bytes("space: right-anterior-superior\n" + box_in_space, counted(24)));
  CHECK(ras.point({1, 2, 3}).isApprox(Vec3(-11.5, -11.0, 34.0)));
  const Volume las =
      read_voxels("a.nrrd", test::nrrd_bytes("space: LAS\n" + box_in_space, counted(24)));
  CHECK(las.point({1, 2, 3}).isApprox(Vec3(11.5, -11.0, 34.0)));
  const Volume metres =
      read_voxels("a.nrrd", test::nrrd_bytes("space: LPS\nspace units: \"cm\" \"cm\" "
                                             "\"cm\"\n" +
                                                 box_in_space,
                                             counted(24)));
  CHECK(metres.point({1, 2, 3}).isApprox(Vec3(115.0, 110.0, 340.0)));
}

TEST_CASE("NRRD that does not state its space or its place is refused with the remedy",
          "[unit][image]") {
  CHECK_THAT(
      refusal("a.nrrd", test::nrrd_bytes("space dimension: 3\n" + box_in_space, counted(24))),
      Contains("does not state the space") && Contains("space: left-posterior-superior"));
  CHECK_THAT(refusal("a.nrrd", test::nrrd_bytes(box_in_space, counted(24))),
             Contains("does not state the space") && Contains("space: left-posterior-superior"));
  CHECK_THAT(refusal("a.nrrd", test::nrrd_bytes(box_in_space + "\nspace: LPS", counted(24))),
             Contains("states its space in line ") && Contains("Put \"space: LPS\" before it"));
  CHECK_THAT(
      refusal("a.nrrd", test::nrrd_bytes("space: 3D-right-handed\n" + box_in_space, counted(24))),
      Contains("states a space that is not the patient's"));
  CHECK_THAT(refusal("a.nrrd", test::nrrd_bytes("dimension: 3\nsizes: 2 3 4", counted(24))),
             Contains("0 axes with a direction in space"));
  CHECK_THAT(refusal("a.nrrd", test::nrrd_bytes("space: LPS\n" + box_in_space, counted(20))),
             Contains("cannot be read as NRRD"));
  CHECK_THAT(
      refusal("a.nrrd",
              test::nrrd_bytes("dimension: 4\nspace: LPS\nsizes: 3 2 2 2\nkinds: RGB-color domain "
                               "domain domain\nspace directions: none (1,0,0) (0,1,0) (0,0,1)\n"
                               "space origin: (0,0,0)",
                               counted(24))),
      Contains("3 values per voxel"));
}

TEST_CASE("frames of NRRD have times where spacing and unit are stated", "[unit][image]") {
  const std::string axes =
      "dimension: 4\nspace: LPS\nsizes: 2 2 2 3\nkinds: domain domain domain time\n"
      "space directions: (1,0,0) (0,1,0) (0,0,1) none\nspace origin: (0,0,0)";
  const Volume timed =
      read_voxels("a.nrrd", test::nrrd_bytes(axes + "\nspacings: nan nan nan 40\nunits: "
                                                    "\"\" \"\" \"\" \"ms\"",
                                             counted(24)));
  CHECK(timed.frames == 3);
  CHECK(timed.time_step == Approx(0.04));
  CHECK(timed.at(1, 0, 1, 2) == 21.0F);
  const Volume untimed = read_voxels("a.nrrd", test::nrrd_bytes(axes, counted(24)));
  CHECK(untimed.time_step == 0.0);
  CHECK_THAT(untimed.notes.front(), Contains("times are taken as not known"));
}

TEST_CASE("a detached NRRD header finds its voxels beside it", "[unit][image]") {
  const test::TemporaryFolder folder;
  test::write_bytes(folder / "a.raw", counted(24));
  test::write_bytes(folder / "a.nhdr", "NRRD0004\ntype: uchar\nencoding: raw\nspace: LPS\n" +
                                           box_in_space + "\ndata file: a.raw\n");
  CHECK(read_volume(folder / "a.nhdr").at(1, 2, 3) == 23.0F);
  std::filesystem::remove(folder / "a.raw");
  CHECK_THROWS_WITH(read_volume(folder / "a.nhdr"), Contains("cannot be read as NRRD"));
}

TEST_CASE("segments of 3D Slicer name their labels, and where they overlap have one of their own",
          "[unit][image]") {
  const std::string one_layer = "space: LPS\n" + box_in_space +
                                "\nSegment0_ID:=S1\nSegment0_Name:=LV blood\nSegment0_LabelValue:="
                                "5\nSegment0_Layer:=0\nSegment1_ID:=S2\nSegment1_Name:=LV wall\n"
                                "Segment1_LabelValue:=7\nSegment1_Layer:=0";
  const Volume plain = read_voxels("a.seg.nrrd", test::nrrd_bytes(one_layer, counted(24)));
  CHECK(plain.names == std::map<int, std::string>{{5, "LV blood"}, {7, "LV wall"}});
  CHECK(plain.at(1, 2, 3) == 23.0F);

  const std::string layers =
      "dimension: 4\nspace: LPS\nsizes: 2 2 1 2\nkinds: list domain domain domain\n"
      "space directions: none (1,0,0) (0,1,0) (0,0,1)\nspace origin: (0,0,0)\n"
      "Segment0_ID:=S1\nSegment0_Name:=A\nSegment0_LabelValue:=1\nSegment0_Layer:=0\n"
      "Segment1_ID:=S2\nSegment1_Name:=B\nSegment1_LabelValue:=1\nSegment1_Layer:=1";
  const Volume joined =
      read_voxels("a.seg.nrrd", test::nrrd_bytes(layers, std::string("\1\0\0\1\1\1\0\0", 8)));
  CHECK(joined.frames == 1);
  CHECK(joined.values == std::vector<float>{1.0F, 2.0F, 3.0F, 0.0F});
  CHECK(joined.names.at(3) == "A + B");
  CHECK_THAT(joined.notes.front(), Contains("its segments overlap"));
  CHECK_THAT(
      refusal("a.seg.nrrd",
              test::nrrd_bytes("space: LPS\n" + box_in_space + "\nSegment0_ID:=S1", counted(24))),
      Contains("which label and layer its segment \"S1\" has"));
  CHECK_THAT(refusal("a.seg.nrrd", test::nrrd_bytes("space: LPS\n" + box_in_space +
                                                        "\nSegment0_ID:=S1\nSegment0_LabelValue:=1"
                                                        "\nSegment0_Layer:=3",
                                                    counted(24))),
             Contains("lies in layer 3"));
}

TEST_CASE("MetaImage is read in LPS, by its matrix and unit", "[unit][image]") {
  const std::string head =
      "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\n"
      "CompressedData = False\nTransformMatrix = 1 0 0 0 0 1 0 -1 0\nOffset = 10 20 30\n"
      "ElementSpacing = 1.5 2 3\nDimSize = 2 3 4\n";
  const std::string tail = "ElementType = MET_UCHAR\nElementDataFile = LOCAL\n";
  const Volume v = read_voxels("a.mha", head + tail + counted(24));
  CHECK(v.point({1, 2, 3}).isApprox(Vec3(11.5, 11.0, 34.0)));
  CHECK(v.at(1, 2, 3) == 23.0F);
  CHECK(v.notes.empty());
  const Volume cm = read_voxels("a.mha", head + "DistanceUnits = cm\n" + tail + counted(24));
  CHECK(cm.point({1, 2, 3}).isApprox(Vec3(115.0, 110.0, 340.0)));
  CHECK_THAT(refusal("a.mha", head + tail + counted(20)), Contains("cannot be read as MetaImage"));
  std::string without_sizes = head + tail + counted(24);
  without_sizes.erase(without_sizes.find("ElementSpacing"), 25);
  CHECK_THAT(refusal("a.mha", without_sizes),
             Contains("does not say how large its voxels are: it has no line ElementSpacing"));
  std::string negative = head;
  negative.replace(negative.find("1.5 2 3"), 7, "1.5 -2 3");
  CHECK_THAT(refusal("a.mha", negative + tail + counted(24)),
             Contains("has the negative voxel size -2 (ElementSpacing, axis 2)") &&
                 Contains("TransformMatrix"));
  const Volume frames = read_voxels(
      "a.mha",
      "ObjectType = Image\nNDims = 4\nBinaryData = True\nDimSize = 2 2 2 3\nElementSpacing "
      "= 1 1 2 40\nElementType = MET_UCHAR\nElementDataFile = LOCAL\n" +
          counted(24));
  CHECK(frames.frames == 3);
  CHECK(frames.time_step == 0.0);
  CHECK_THAT(frames.notes.front(), Contains("does not state its axes"));
  CHECK_THAT(frames.notes.back(), Contains("states no unit of time"));
}

TEST_CASE("a DICOM segmentation is a map of labels, oblique, with gaps and overlaps",
          "[unit][image]") {
  const Mat3 axes = test::oblique();
  const Volume v = read_voxels("x", test::segmentation_bytes(axes));
  CHECK(v.size == std::array{5, 3, 4});
  CHECK(v.spacing.isApprox(Vec3(1.25, 1.5, 8.0), 1e-5));
  CHECK((v.point({2, 1, 3}) -
         (Vec3(10, -20, 30) + 2.5 * axes.col(0) + 1.5 * axes.col(1) + 24.0 * axes.col(2)))
            .norm() < 1e-4);
  CHECK(v.names ==
        std::map<int, std::string>{{1, "LV blood"}, {2, "Scar"}, {3, "LV blood + Scar"}});
  CHECK(v.at(0, 0, 0) == 3.0F);
  CHECK(v.at(4, 0, 0) == 2.0F);
  CHECK(v.at(2, 0, 2) == 1.0F);
  CHECK(v.at(3, 0, 3) == 1.0F);
  double sum = 0.0;
  for (const float value : v.values)
    sum += value;
  CHECK(sum == 7.0);  // the slice between is absent and empty
}

TEST_CASE("sample files of segmentations are read", "[unit][image][data]") {
  const char* set = std::getenv("VENTRICLE_DATA");
  const std::filesystem::path folder =
      std::filesystem::path(set != nullptr ? set : LV_DATA_DIR) / "formats";
  if (!std::filesystem::exists(folder)) {
    WARN("skipped: no folder " << folder << "; set VENTRICLE_DATA to the folder that holds it");
    return;
  }
  const Volume slicer = read_labels(folder / "SegmentationOverlapping.seg.nrrd");
  CHECK(slicer.size == std::array{128, 128, 34});
  CHECK(slicer.frames == 1);
  CHECK(slicer.names.at(1) == "ribs");
  CHECK(slicer.origin.isApprox(Vec3(193.09599304199222, 216.39599609374994, -340.25)));
  CHECK(read_labels(folder / "Segmentation.seg.nrrd").names.size() >= 3);
  CHECK(read_labels(folder / "seg_image_ct_binary.dcm").names.size() == 1);
  const Volume overlap = read_labels(folder / "seg_image_ct_binary_overlap.dcm");
  CHECK(overlap.names.size() > 2);
}
