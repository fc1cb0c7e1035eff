#include "lv/image/nifti.hpp"

#include "lv/base/check.hpp"
#include "lv/image/lookup.hpp"
#include "lv/image/volume_file.hpp"

#include "image/nifti_files.hpp"
#include "support/scanner_files.hpp"
#include "support/temporary_folder.hpp"
#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <system_error>
#include <utility>

namespace {

using namespace lv;
using namespace lv::image;
using Catch::Matchers::Contains;
using test::gzipped;
using test::oblique;
using test::read_back;

test::NiftiSpec small(const Mat3& directions) {
  return test::label_map({3, 4, 5}, directions, {1.0, 2.0, 8.0}, {10.0, -20.0, 30.0},
                         [n = 0](const Vec3&) mutable { return n++ % 7; });
}

/// The sform in another unit of length.
test::NiftiSpec in_unit(test::NiftiSpec spec, int code, double per_mm) {
  for (auto& row : spec.sform)
    for (double& entry : row)
      entry *= per_mm;
  spec.units = code;
  return spec;
}

std::string complaint(const test::NiftiSpec& spec, std::size_t cut = 0) {
  const test::TemporaryFolder folder;
  const std::string bytes = test::nifti_bytes(spec);
  test::write_bytes(folder / "x.nii", bytes.substr(0, bytes.size() - cut));
  try {
    static_cast<void>(read_nifti(folder / "x.nii"));
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

}  // namespace

TEST_CASE("a NIfTI image lies where its sform or qform says, in any order and direction of axes",
          "[unit][image]") {
  Mat3 swapped = Mat3::Zero();  // j along -x, k along y, i along z
  swapped(2, 0) = 1.0;
  swapped(0, 1) = -1.0;
  swapped(1, 2) = 1.0;
  Mat3 mirrored = oblique();
  mirrored.col(1) *= -1.0;
  const auto code = GENERATE(std::array{1, 0}, std::array{0, 1}, std::array{1, 1});
  for (const Mat3& directions : {Mat3(Mat3::Identity()), oblique(), swapped, mirrored}) {
    test::NiftiSpec spec = small(directions);
    spec.same_qform = true;
    spec.sform_code = code[0];
    spec.qform_code = code[1];
    const Volume v = read_back(spec);
    CHECK((v.directions - directions).norm() < 1e-5);
    const Vec3 expected = Vec3(10.0, -20.0, 30.0) + directions * Vec3(2.0, 2.0 * 3.0, 8.0 * 4.0);
    CHECK((v.point({2.0, 3.0, 4.0}) - expected).norm() < 1e-3);
    CHECK((v.index(expected) - Vec3(2.0, 3.0, 4.0)).norm() < 1e-4);
    CHECK(v.at(2, 3, 4) == (2 + 3 * 3 + 12 * 4) % 7);
    CHECK(slice_axis(v) == 2);
    const Cine cine = cine_of(v);
    CHECK(cine.slices.size() == 5);
    CHECK((cine.slices[4].frames[0].plane.point(2, 3) - expected).norm() < 1e-3);
    CHECK(cine.slices[4].frames[0].at(2, 3) == v.at(2, 3, 4));
    CHECK(has_label(v, expected, {static_cast<int>(v.at(2, 3, 4))}));
    CHECK_FALSE(has_label(v, expected + 20.0 * directions.col(2), {0, 1, 2, 3, 4, 5, 6}));
  }
}

TEST_CASE("slope and intercept of a NIfTI image are applied; times are kept", "[unit][image]") {
  test::NiftiSpec spec = small(oblique());
  spec.size = {3, 4, 5, 2};
  for (int i = 0; i < 60; ++i)
    spec.values.push_back(9);
  spec.slope = 0.5F;
  spec.intercept = 2.0F;
  const Volume v = read_back(spec);
  REQUIRE(v.frames == 2);
  CHECK(v.time_step == Approx(0.04));
  CHECK(v.at(0, 0, 0, 0) == 2.0F);
  CHECK(v.at(1, 0, 0, 0) == 2.5F);
  CHECK(v.at(1, 1, 1, 1) == 6.5F);
}

TEST_CASE("a truncated NIfTI image is refused, not filled with zeros", "[unit][image]") {
  CHECK(complaint(small(oblique())).empty());
  CHECK_THAT(complaint(small(oblique()), 1), Contains("it ends after 411 of 412 bytes"));
  CHECK_THAT(complaint(small(oblique()), 100), Contains("cannot be read as NIfTI"));
}

TEST_CASE("a sheared sform and a sform that contradicts the qform are refused", "[unit][image]") {
  test::NiftiSpec sheared = small(oblique());
  sheared.sform[0][2] += 3.0;
  CHECK_THAT(complaint(sheared),
             Contains("its axes are not at right angles, ") && Contains("degrees apart"));
  test::NiftiSpec contradiction = small(oblique());
  contradiction.qform_code = 1;
  CHECK_THAT(complaint(contradiction), Contains("its sform and its qform put a corner"));
}

TEST_CASE("metres and micrometres become millimetres, of the sform and of the qform",
          "[unit][image]") {
  const Volume mm = read_back(small(oblique()));
  for (const auto& [code, per_mm] : {std::pair(1, 1e-3), {3, 1e3}, {2, 1.0}, {0, 1.0}})
    for (const bool by_qform : {false, true}) {
      test::NiftiSpec spec = in_unit(small(oblique()), code, per_mm);
      spec.same_qform = by_qform;
      spec.qform_code = by_qform ? 1 : 0;
      spec.sform_code = by_qform ? 0 : 1;
      const Volume v = read_back(spec);
      CHECK((v.spacing - mm.spacing).norm() < 1e-5);
      CHECK((v.origin - mm.origin).norm() < 1e-3);
    }
  CHECK_THAT(complaint(in_unit(small(oblique()), 0, 1e-3)),
             Contains("its voxels measure 0.001 x 0.002 x 0.008 mm"));
  CHECK_THAT(complaint(in_unit(small(oblique()), 1, 1.0)),
             Contains("its voxels measure 1000 x 2000 x 8000 mm (unit of the file: m)"));
  CHECK_THAT(complaint(in_unit(small(oblique()), 4, 1.0)), Contains("unknown code 4"));
}

TEST_CASE("axes a little off right angles, by rounding, become orthonormal", "[unit][image]") {
  for (const double degrees : {0.007, 0.09, 0.2}) {
    test::NiftiSpec spec = small(Mat3::Identity());
    spec.sform[0][1] = -2.0 * std::sin(degrees / 57.29578);  // axis j leans towards i
    if (degrees > 0.1) {
      CHECK_THAT(complaint(spec), Contains("not at right angles, i and j are 89.80 degrees apart"));
      continue;
    }
    const Volume v = read_back(spec);
    CHECK((v.directions.transpose() * v.directions - Mat3::Identity()).norm() < 1e-12);
    CHECK((v.directions - Mat3::Identity()).norm() < 2e-3);
    CHECK(v.notes.empty());
  }
}

TEST_CASE("negative sizes of voxels are told, and mirror nothing", "[unit][image]") {
  test::NiftiSpec spec = small(oblique());
  spec.pixdim = {-1.0, 2.0, 8.0};
  const Volume v = read_back(spec);
  CHECK((v.directions - oblique()).norm() < 1e-5);
  REQUIRE(v.notes.size() == 1);
  CHECK_THAT(v.notes.front(), Contains("(pixdim) (-1, 2, 8) some are negative"));
}

TEST_CASE("lengths of the sform that are not the sizes of voxels are told apart and told",
          "[unit][image]") {
  test::NiftiSpec directions = test::label_map({3, 4, 5}, oblique(), Vec3::Ones(), Vec3(1, 2, 3),
                                               [](const Vec3&) { return 0; });
  directions.pixdim = {1.5, 1.5, 8.0};
  const Volume by_pixdim = read_back(directions);
  CHECK((by_pixdim.spacing - Vec3(1.5, 1.5, 8.0)).norm() < 1e-6);
  CHECK((by_pixdim.directions - oblique()).norm() < 1e-5);
  CHECK((by_pixdim.origin - Vec3(1, 2, 3)).norm() < 1e-5);
  REQUIRE(by_pixdim.notes.size() == 1);
  CHECK_THAT(by_pixdim.notes.front(), Contains("the lengths of its sform (1, 1, 1) are not its "
                                               "voxel sizes (pixdim) (1.5, 1.5, 8)"));
  test::NiftiSpec lengths = small(oblique());
  lengths.pixdim = {1.0, 1.0, 1.0};
  const Volume by_sform = read_back(lengths);
  CHECK((by_sform.spacing - Vec3(1.0, 2.0, 8.0)).norm() < 1e-6);
  REQUIRE(by_sform.notes.size() == 1);
  CHECK_THAT(by_sform.notes.front(), Contains("are not its voxel sizes (pixdim) (1, 1, 1)"));
  lengths.pixdim = {1.0, 2.0, 10.0};
  CHECK_THAT(complaint(lengths), Contains("the lengths of its sform (1, 2, 8) are not its voxel "
                                          "sizes (pixdim) (1, 2, 10)"));
}

TEST_CASE("voxels without a size are refused as such", "[unit][image]") {
  test::NiftiSpec spec = small(oblique());
  spec.sform_code = 0;
  spec.pixdim = {1.0, 2.0, 0.0};
  CHECK_THAT(complaint(spec),
             Contains("does not say how large its voxels are: pixdim is (1, 2, 0)"));
}

TEST_CASE("a header of ones at the origin is noted as one that says nothing", "[unit][image]") {
  test::NiftiSpec spec;
  spec.size = {2, 2, 2, 1};
  spec.values.assign(8, 1.0);
  for (int d = 0; d < 3; ++d)
    spec.sform[d][d] = 1.0;
  const Volume v = read_back(spec);
  REQUIRE(v.notes.size() == 1);
  CHECK_THAT(v.notes.front(), Contains("its voxels measure 1 x 1 x 1 mm"));
}

TEST_CASE("NIfTI-2, capital endings and packed files of any name are read alike", "[unit][image]") {
  test::NiftiSpec spec = small(oblique());
  spec.slope = 2.0F;
  const Volume plain = read_back(spec);
  const test::TemporaryFolder folder;
  test::write_bytes(folder / "X.NII.GZ", gzipped(test::nifti_bytes(spec)));
  test::write_bytes(folder / "packed.nii", gzipped(test::nifti_bytes(spec)));
  spec.version = 2;
  test::write_bytes(folder / "second.nii", test::nifti_bytes(spec));
  for (const char* name : {"X.NII.GZ", "packed.nii", "second.nii"}) {
    const Volume v = read_nifti(folder / name);
    CHECK(v.values == plain.values);
    CHECK((v.directions - plain.directions).norm() < 1e-6);
    CHECK((v.origin - plain.origin).norm() < 1e-6);
    CHECK((v.spacing - plain.spacing).norm() < 1e-6);
  }
  CHECK_THAT(read_nifti(folder / "packed.nii").notes.front(), Contains("is packed: name it .gz"));
  test::write_bytes(folder / "map.xyz", "words");
  CHECK_THROWS_WITH(read_volume(folder / "map.xyz"),
                    Contains("has the unknown ending \".xyz\"") &&
                        Contains("NIfTI (.nii, .nii.gz, or .hdr with .img)"));
}

TEST_CASE("a file in the other byte order is read alike", "[unit][image]") {
  test::NiftiSpec spec = small(oblique());
  spec.floating = true;
  std::string bytes = test::nifti_bytes(spec);
  const auto turn = [&](std::size_t from, std::size_t to, std::size_t width) {
    for (std::size_t at = from; at < to; at += width)
      std::reverse(bytes.begin() + static_cast<std::ptrdiff_t>(at),
                   bytes.begin() + static_cast<std::ptrdiff_t>(at + width));
  };
  turn(0, 4, 4);
  turn(40, 56, 2);  // dim
  turn(70, 74, 2);
  turn(76, 120, 4);
  turn(252, 256, 2);
  turn(256, 328, 4);
  turn(352, bytes.size(), 4);
  const test::TemporaryFolder folder;
  test::write_bytes(folder / "x.nii", bytes);
  const Volume v = read_nifti(folder / "x.nii");
  CHECK(v.values == read_back(spec).values);
  CHECK((v.directions - oblique()).norm() < 1e-5);
}

TEST_CASE("header and voxels of a pair are found from either, in any case of their endings",
          "[unit][image]") {
  const std::string whole = test::nifti_bytes(small(oblique()));
  std::string header = whole.substr(0, 348);
  header.replace(108, 4, std::string(4, '\0'));
  header.replace(344, 4, std::string("ni1\0", 4));
  const test::TemporaryFolder folder;
  test::write_bytes(folder / "A.HDR", header);
  CHECK_THROWS_WITH(read_nifti(folder / "A.HDR"), Contains("A.img is not beside it"));
  test::write_bytes(folder / "A.IMG", whole.substr(352));
  test::write_bytes(folder / "b.hdr", header);
  test::write_bytes(folder / "b.img.gz", gzipped(whole.substr(352)));
  const Volume plain = read_back(small(oblique()));
  for (const char* name : {"A.HDR", "A.IMG", "b.hdr", "b.img.gz"})
    CHECK(read_nifti(folder / name).values == plain.values);
  std::string analyze = header;
  analyze.replace(344, 4, std::string(4, '\0'));
  test::write_bytes(folder / "b.hdr", analyze);
  CHECK_THROWS_WITH(read_nifti(folder / "b.hdr"), Contains("is Analyze 7.5"));
}

TEST_CASE("labels that went through a slope are whole numbers still", "[unit][image]") {
  test::NiftiSpec spec = small(oblique());
  for (double& value : spec.values)
    value *= 42;  // stored; 0 to 252
  spec.slope = static_cast<float>(1.0 / 42.0);
  const Volume v = read_back(spec);
  CHECK(v.at(1, 0, 0) == 1.0F);
  CHECK(label_volumes(v).size() == 7);
}

TEST_CASE("times that are no heart's cycle are not taken", "[unit][image]") {
  test::NiftiSpec spec = small(oblique());
  spec.size[3] = 25;
  spec.values.assign(60 * 25, 1.0);
  spec.time_step = 1.0;
  const Volume v = read_back(spec);
  CHECK(v.time_step == 0.0);
  CHECK_THAT(v.notes.front(), Contains("its 25 frames follow each other after 1 s"));
  spec.time_step = 40.0;
  spec.units = 2 | 16;  // mm, ms
  CHECK(read_back(spec).time_step == Approx(0.04));
}

TEST_CASE("an image larger than memory is refused as that", "[unit][image]") {
  test::NiftiSpec spec = small(oblique());
  spec.size = {30000, 30000, 10000, 1};
  CHECK_THAT(complaint(spec), Contains("it ends after 412 of"));  // its file is small
  const test::TemporaryFolder folder;
  test::write_bytes(folder / "x.nii", test::nifti_bytes(spec));
  std::error_code failed;
  std::filesystem::resize_file(folder / "x.nii", 352 + 9000000000000, failed);  // a hole
  if (failed) {
    WARN("skipped: no file of 9 TB with a hole can be made: " << failed.message());
    return;
  }
  CHECK_THROWS_AS(read_nifti(folder / "x.nii"), RunError);
}

TEST_CASE("a voxel that is not a number stays one and is named", "[unit][image]") {
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    test::NiftiSpec spec = small(oblique());
    spec.floating = true;
    spec.values[1 + 3 * 2 + 12 * 3] = bad;
    const test::TemporaryFolder folder;
    test::write_bytes(folder / "x.nii", test::nifti_bytes(spec));
    const Volume v = read_nifti(folder / "x.nii");
    CHECK(std::isnan(v.at(1, 2, 3)));
    CHECK(std::count_if(v.values.begin(), v.values.end(), [](float x) { return std::isnan(x); }) ==
          1);
    CHECK_THROWS_WITH(label_volumes(v), Contains("voxel (1, 2, 3)"));
    CHECK_THROWS_WITH(read_volume_cine(folder / "x.nii"),
                      Contains("voxel (1, 2, 3) of frame 1 is not a finite number"));
  }
}

TEST_CASE("a file that does not say how it lies in space is noted", "[unit][image]") {
  test::NiftiSpec spec = small(oblique());
  spec.sform_code = 0;
  const test::TemporaryFolder folder;
  test::write_bytes(folder / "x.nii", test::nifti_bytes(spec));
  const Volume v = read_nifti(folder / "x.nii");
  REQUIRE(v.notes.size() == 1);
  CHECK_THAT(v.notes.front(), Contains("neither sform nor qform"));
}

TEST_CASE("absent labels are answered with those that there are; fractions are no labels",
          "[unit][image]") {
  Volume v;
  v.file = "map.nii";
  v.size = {2, 1, 1};
  v.spacing = {10.0, 10.0, 10.0};
  v.values = {0.0F, 3.0F};
  CHECK_THROWS_WITH(require_labels(v, 0, {3, 4}, "case.toml:5", "cavity"),
                    Contains("case.toml:5") && Contains("has the label 4 of cavity") &&
                        Contains("0 (1.00 ml), 3 (1.00 ml)"));
  CHECK_THROWS_WITH(require_labels(v, 0, {3, 0}, "case.toml:5", "cavity"),
                    Contains("case.toml:5: 0 is the background of the map, no label of cavity"));
  CHECK_THROWS_WITH(require_labels(v, 1, {3}, "case.toml:5", "cavity"),
                    Contains("there is no frame 2"));
  v.values = {0.0F, 0.4F};
  CHECK_THROWS_WITH(label_volumes(v), Contains("voxel (1, 0, 0)") && Contains("0.4"));
}

TEST_CASE("a stack of images is linear between pixels and between slices", "[unit][image]") {
  Cine stack;
  for (const int s : {0, 1}) {
    Picture picture{{Vec3(0.0, 0.0, 10.0 * s), Vec3::UnitX(), Vec3::UnitY(), 2.0, 2.0, 3, 3}, {}};
    for (int p = 0; p < 9; ++p)
      picture.values.push_back(static_cast<float>(100 * s + p));
    stack.slices.push_back({"", {picture}, {}, 0.0});
  }
  CHECK(sample(stack, {1.0, 2.0, -4.9}) == Approx(3.5));
  CHECK(sample(stack, {1.0, 2.0, 1.0}) == Approx(13.5));
  CHECK(sample(stack, {1.0, 2.0, 6.0}) == Approx(63.5));
  CHECK(sample(stack, {1.0, 2.0, 10.0}) == Approx(103.5));
  CHECK(std::isnan(sample(stack, {1.0, 2.0, -5.1})));
  CHECK(std::isnan(sample(stack, {1.0, 2.0, 15.5})));
  CHECK(std::isnan(sample(stack, {7.0, 2.0, 0.0})));
}

TEST_CASE("labels are looked up where their slice was moved to", "[unit][image]") {
  Volume v;
  v.size = {5, 5, 2};
  v.spacing = {1.0, 1.0, 8.0};
  v.values.assign(50, 0.0F);
  v.values[25 + 2 * 5 + 1] = 4.0F;  // (1, 2, 1)
  const std::vector<Vec3> moves{Vec3::Zero(), Vec3(2.5, 0.5, 0.0)};
  CHECK(has_label(v, {3.5, 2.5, 8.0}, {4}, moves));
  CHECK_FALSE(has_label(v, {1.0, 2.0, 8.0}, {4}, moves));
  CHECK(has_label(v, {1.0, 2.0, 8.0}, {4}));
}
