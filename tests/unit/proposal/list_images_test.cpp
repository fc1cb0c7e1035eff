#include "lv/proposal/list_images.hpp"

#include "lv/base/check.hpp"

#include "support/scanner_files.hpp"
#include "support/temporary_folder.hpp"
#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <sys/stat.h>

namespace {

using namespace lv;
using Catch::Matchers::Contains;

std::string listed(const std::filesystem::path& where, std::vector<int> cavity = {}) {
  try {
    return proposal::list_images({where, {}, {}, std::move(cavity)});
  } catch (const InputError& error) {
    return error.what();
  }
}

test::NiftiSpec map_of_frames(int frames, const std::vector<int>& labelled) {
  test::NiftiSpec spec = test::label_map({4, 4, 3}, Mat3::Identity(), {2.0, 2.0, 8.0}, {1, 2, 3},
                                         [](const Vec3&) { return 1; });
  spec.size[3] = frames;
  spec.values.assign(static_cast<std::size_t>(48 * frames), 0.0);
  for (std::size_t k = 0; k < labelled.size(); ++k)
    for (std::size_t v = 0; v < 48 - 10 * k; ++v)
      spec.values[48 * static_cast<std::size_t>(labelled[k] - 1) + v] = 1.0;
  return spec;
}

}  // namespace

TEST_CASE("a folder without images is named itself, not the contours that are given with it",
          "[unit][proposal]") {
  const test::TemporaryFolder dicom;
  const test::TemporaryFolder contours;
  test::write_bytes(dicom / "notes.txt", "no image");
  try {
    static_cast<void>(proposal::list_images({dicom / "", contours / "", {}, {}}));
    FAIL("is not refused");
  } catch (const InputError& error) {
    CHECK(error.where() == (dicom / "").string());
    CHECK_THAT(error.what(), Contains("holds no DICOM image"));
  }
}

TEST_CASE("any file is answered with what it is and with what is read", "[unit][proposal]") {
  const test::TemporaryFolder folder;
  const auto answer = [&](const std::string& name, const std::string& bytes) {
    test::write_bytes(folder / name, bytes);
    return listed(folder / name);
  };
  CHECK_THAT(
      answer("a.stl",
             "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 2 0 0\nvertex 0 3 0\n"
             "endloop\nendfacet\nendsolid\n"),
      Contains("a surface of 1 triangles, 2 x 3 x 0 in its unit, which it does not state") &&
          Contains("a space that it does not state") && Contains("anatomy.surfaces"));
  CHECK_THAT(answer("a.seg.nrrd", "NRRD0004\n"), Contains("cannot be read as NRRD"));
  CHECK_THAT(answer("a.png", "\x89PNG\r\n"), Contains("is a PNG picture"));
  CHECK_THAT(answer("a.toml", "name = \"x\"\n"), Contains("a case file; see `ventricle validate`"));
  CHECK_THAT(answer("a.inp", "*NODE\n"), Contains("holds no volume cells"));
  CHECK_THAT(answer("empty", ""), Contains("is an empty file"));
  CHECK_THAT(answer("noise", std::string("\1\2\3\0\5", 5)), Contains("is of an unknown kind"));
  CHECK_THAT(answer("note", "words\n"), Contains("is text of an unknown kind") &&
                                            Contains("NIfTI") && Contains("DICOM") &&
                                            Contains("(ABAQUS .inp"));
  CHECK_THAT(answer("nameless", test::nifti_bytes(map_of_frames(1, {1}))),
             Contains("is NIfTI whose name does not say so"));
  REQUIRE(mkfifo((folder / "pipe.nii").c_str(), 0600) == 0);
  CHECK_THAT(listed(folder / "pipe.nii"), Contains("it is a pipe"));
  CHECK_THAT(listed("/dev/zero"), Contains("it is a device"));
  CHECK_THAT(listed(folder / "absent"), Contains("there is no such file"));
}

TEST_CASE("frames without labels are counted, not proposed", "[unit][proposal]") {
  const test::TemporaryFolder folder;
  test::write_bytes(folder / "m.nii", test::nifti_bytes(map_of_frames(6, {2, 5})));
  const std::string text = listed(folder / "m.nii", {1});
  CHECK_THAT(text, Contains("labels of frame 2: 1 (1.54 ml)"));
  CHECK_THAT(text, Contains("4 of 6 frames hold no label but 0"));
  CHECK_THAT(text, Contains("4 of 6 frames show no cavity"));
  CHECK_THAT(text, Contains("proposed: end-diastole 2, end-systole 5; no frame after it"));
}

TEST_CASE("a map with pixels of no usual size has a note, and 0 is no cavity", "[unit][proposal]") {
  const test::TemporaryFolder folder;
  test::NiftiSpec spec = test::label_map({4, 4, 3}, Mat3::Identity(), {0.14, 0.14, 8.0}, {1, 2, 3},
                                         [](const Vec3& x) { return x.z() > 5.0 ? 1 : 0; });
  test::write_bytes(folder / "m.nii", test::nifti_bytes(spec));
  CHECK_THAT(listed(folder / "m.nii"), Contains("note: pixels of 0.14 mm"));
  CHECK_THAT(listed(folder / "m.nii", {0}), Contains("--cavity: 0 is the background of the map"));
}

TEST_CASE("a table of contours with semicolons is named as such", "[unit][proposal]") {
  const test::TemporaryFolder folder;
  test::write_bytes(folder / "c.csv", "slice;contour;point;x_mm;y_mm;z_mm\n1;endo;1;20,0;0;0\n");
  CHECK_THAT(listed(folder / "c.csv"), Contains("c.csv:1: columns are separated by ';'"));
}

TEST_CASE("a folder of NIfTI files is listed by its files", "[unit][proposal]") {
  const test::TemporaryFolder folder;
  test::write_bytes(folder / "a.nii", test::nifti_bytes(map_of_frames(1, {1})));
  test::write_bytes(folder / "b.nii", "damaged");
  const std::string text = listed(folder / "");
  CHECK_THAT(text, Contains("a.nii: 4 x 4 x 3 voxels of 2.000 x 2.000 x 8.000 mm"));
  CHECK_THAT(text, Contains("b.nii: cannot be read as NIfTI: it has no NIfTI header"));
}
