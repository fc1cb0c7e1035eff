#include "lv/base/check.hpp"
#include "lv/image/dicom_study.hpp"
#include "lv/image/dicom_text.hpp"
#include "lv/image/pixel_grid.hpp"

#include "support/scanner_files.hpp"
#include "support/temporary_folder.hpp"
#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <random>

namespace {

using namespace lv;
using namespace lv::image;
using Catch::Matchers::Contains;
using test::DicomSpec;

constexpr int columns = 6;
constexpr int rows = 4;

/// Phase p of slice s of an oblique stack, slices 8 mm apart.
DicomSpec oblique(int s, int p) {
  const Mat3 axes = Eigen::AngleAxisd(0.8, Vec3(0.2, -0.5, 0.7).normalized()).toRotationMatrix();
  DicomSpec spec;
  spec.plane = {Vec3(10.0, -20.0, 30.0) + 8.0 * s * axes.col(2),
                axes.col(0),
                axes.col(1),
                1.5,
                1.25,
                columns,
                rows};
  for (int i = 0; i < columns * rows; ++i)
    spec.pixels.push_back(static_cast<std::uint16_t>(1000 * s + 100 * p + i));
  spec.instance = 10 * s + p + 1;
  spec.instance_uid = fmt::format("1.2.3.4.{}.{}", s + 1, p + 1);
  spec.trigger_ms = 40.0 * p + 3.0;
  spec.rr_ms = 700 + 50 * s;
  spec.slope = 2.0;
  spec.intercept = -5.0;
  return spec;
}

/// A stack of 3 slices with 2 phases, under names that say nothing.
void write_stack(const test::TemporaryFolder& folder) {
  int name = 97;
  for (int s = 0; s < 3; ++s)
    for (int p = 0; p < 2; ++p)
      test::write_bytes(folder / fmt::format("{}", (name = name * 31 % 101)),
                        test::dicom_bytes(oblique(s, p)));
}

Cine read(const test::TemporaryFolder& folder, const std::vector<std::string>& series = {}) {
  return read_dicom_cine(std::array{folder / ""}, series);
}

std::string complaint(const test::TemporaryFolder& folder,
                      const std::vector<std::string>& series = {}) {
  try {
    static_cast<void>(read(folder, series));
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

}  // namespace

TEST_CASE("slices and phases are sorted by the headers, whatever the files are called",
          "[unit][image]") {
  const test::TemporaryFolder folder;
  write_stack(folder);
  const Cine cine = read(folder);
  REQUIRE(cine.slices.size() == 3);
  for (int s = 0; s < 3; ++s) {
    const CineSlice& slice = cine.slices[s];
    REQUIRE(slice.frames.size() == 2);
    CHECK(slice.rr == Approx(0.7 + 0.05 * s));
    for (int p = 0; p < 2; ++p) {
      const DicomSpec spec = oblique(s, p);
      CHECK(slice.times[p] == Approx(1e-3 * *spec.trigger_ms));
      CHECK((slice.frames[p].plane.origin - spec.plane.origin).norm() < 1e-4);
      CHECK((slice.frames[p].plane.normal() - spec.plane.normal()).norm() < 1e-6);
      CHECK(slice.frames[p].plane.spacing_i == 1.5);
      CHECK(slice.frames[p].plane.spacing_j == 1.25);
      CHECK(slice.frames[p].at(5, 2) == 2.0F * spec.pixels[2 * columns + 5] - 5.0F);
    }
  }
  CHECK_THAT(fmt::format("{}", fmt::join(cine.notes, "|")), Contains("RR 700 to 800 ms"));
}

TEST_CASE("images stored with white as the least value are as bright as others", "[unit][image]") {
  const test::TemporaryFolder folder;
  for (int s = 0; s < 3; ++s) {
    DicomSpec spec = oblique(s, 0);
    spec.photometric = "MONOCHROME1";
    test::write_bytes(folder / fmt::format("{}", s), test::dicom_bytes(spec));
  }
  const Cine cine = read(folder);
  const DicomSpec spec = oblique(1, 0);
  CHECK(cine.slices[1].frames[0].at(5, 2) == 2.0F * (65535 - spec.pixels[2 * columns + 5]) - 5.0F);
}

TEST_CASE("a missing phase, a gap and a copy of a file are told", "[unit][image]") {
  const test::TemporaryFolder folder;
  for (const int s : {0, 1, 3})
    for (int p = 0; p < 2; ++p)
      if (s != 1 || p != 0)
        test::write_bytes(folder / fmt::format("{}{}", s, p), test::dicom_bytes(oblique(s, p)));
  test::write_bytes(folder / "copy", test::dicom_bytes(oblique(0, 0)));
  test::write_bytes(folder / "notes.txt", "no image");
  const Cine cine = read(folder);
  REQUIRE(cine.slices.size() == 3);
  CHECK(cine.slices[0].frames.size() == 2);
  const std::string notes = fmt::format("{}", fmt::join(cine.notes, "|"));
  CHECK_THAT(notes, Contains("has 1 images where others have 2"));
  CHECK_THAT(notes, Contains("8.00 to 16.00 mm apart"));
  CHECK_THAT(notes, Contains("copy is left out: the same image as"));
  CHECK_THAT(notes, Contains("notes.txt is left out: it is not DICOM"));
}

TEST_CASE("a slice with other pixels is told with both sizes, and refused where one is needed",
          "[unit][image]") {
  const test::TemporaryFolder folder;
  for (int s = 0; s < 3; ++s) {
    DicomSpec spec = oblique(s, 0);
    if (s == 1)
      spec.plane.spacing_i = spec.plane.spacing_j = 2.0;
    test::write_bytes(folder / fmt::format("{}", s), test::dicom_bytes(spec));
  }
  const std::string note =
      "has 6 x 4 pixels of 2.000 mm where others have 6 x 4 pixels of 1.500 x 1.250 mm";
  CHECK_THAT(describe(read_dicom_study(std::array{folder / ""})),
             Contains("note: the slice at") && Contains(note));
  const Cine cine = read(folder);
  CHECK_THAT(fmt::format("{}", fmt::join(cine.notes, "|")), Contains(note));
  CHECK_THROWS_WITH(require_one_grid(cine, "study", "segment.series"),
                    Contains("study: slice 1 has 6 x 4 pixels of 1.500 x 1.250 mm and slice 2 has "
                             "6 x 4 pixels of 2.000 mm") &&
                        Contains("Choose with segment.series"));
}

TEST_CASE("a slice with more rows is told and refused too, and equal slices are not",
          "[unit][image]") {
  const test::TemporaryFolder folder;
  write_stack(folder);
  CHECK_NOTHROW(require_one_grid(read(folder), "study", "series"));
  DicomSpec taller = oblique(3, 0);
  taller.plane.rows += 2;
  taller.pixels.resize(static_cast<std::size_t>(columns) * (rows + 2));
  test::write_bytes(folder / "taller", test::dicom_bytes(taller));
  const Cine cine = read(folder);
  CHECK_THAT(fmt::format("{}", fmt::join(cine.notes, "|")),
             Contains("has 6 x 6 pixels of 1.500 x 1.250 mm where others have 6 x 4 pixels"));
  CHECK_THROWS_WITH(require_one_grid(cine, "study", "series"), Contains("6 x 6 pixels"));
}

TEST_CASE("images of one slice with pixels of two sizes are no cine", "[unit][image]") {
  const test::TemporaryFolder folder;
  DicomSpec other = oblique(0, 1);
  other.plane.spacing_i = 2.0;
  test::write_bytes(folder / "a", test::dicom_bytes(oblique(0, 0)));
  test::write_bytes(folder / "b", test::dicom_bytes(other));
  CHECK_THAT(complaint(folder), Contains("has images of different places or sizes"));
}

TEST_CASE("pixels of a size that no image of a heart has are told", "[unit][image]") {
  CHECK(unusual_pixels(0.3, 5.0).empty());
  CHECK(unusual_pixels(0.14, 0.14) == "pixels of 0.14 mm: the header's unit seems wrong");
  CHECK(unusual_pixels(1.4, 14.0) == "pixels of 14 mm: the header's unit seems wrong");
  const test::TemporaryFolder folder;
  DicomSpec tiny = oblique(0, 0);
  tiny.plane.spacing_i = tiny.plane.spacing_j = 0.14;
  test::write_bytes(folder / "a", test::dicom_bytes(tiny));
  CHECK_THAT(describe(read_dicom_study(std::array{folder / ""})),
             Contains("note: pixels of 0.14 mm: the header's unit seems wrong"));
}

TEST_CASE("series that are mixed in a folder are named, and chosen by number or description",
          "[unit][image]") {
  const test::TemporaryFolder folder;
  write_stack(folder);
  DicomSpec other = oblique(0, 0);
  std::swap(other.plane.along_row, other.plane.along_column);
  other.plane.along_row = -other.plane.along_row;
  other.series_uid = "1.2.3.5";
  other.instance_uid = "1.2.3.5.1";
  other.series_number = 7;
  other.description = "Long Axis";
  test::write_bytes(folder / "la", test::dicom_bytes(other));
  const std::string message = complaint(folder);
  CHECK_THAT(message, Contains("holds 2 stacks of images"));
  CHECK_THAT(message, Contains("\"1\" cine"));
  CHECK_THAT(message, Contains("\"7\" Long Axis"));
  CHECK(read(folder, {"1"}).slices.size() == 3);
  CHECK(read(folder, {"long axis"}).slices.size() == 1);
  CHECK(read(folder, {"1.2.3.5"}).slices.size() == 1);
  CHECK_THAT(complaint(folder, {"8"}), Contains("has no series \"8\""));
}

TEST_CASE("the same slice in two series is refused", "[unit][image]") {
  const test::TemporaryFolder folder;
  write_stack(folder);
  DicomSpec again = oblique(1, 0);
  again.series_uid = "1.2.3.9";
  again.instance_uid = "1.2.3.9.1";
  again.series_number = 9;
  again.trigger_ms = 500.0;
  test::write_bytes(folder / "again", test::dicom_bytes(again));
  CHECK_THAT(complaint(folder, {"1", "9"}), Contains("is there more than once"));
}

TEST_CASE("truncated and empty files are named", "[unit][image]") {
  const test::TemporaryFolder folder;
  write_stack(folder);
  const std::string whole = test::dicom_bytes(oblique(3, 0));
  test::write_bytes(folder / "cut", whole.substr(0, whole.size() - 20));
  CHECK_THAT(complaint(folder), Contains("cut") && Contains("truncated"));
  test::write_bytes(folder / "cut", whole.substr(0, 300));
  CHECK(read(folder).slices.size() == 3);  // its header is lost: skipped, and noted
  const test::TemporaryFolder nothing;
  test::write_bytes(nothing / "empty", "");
  CHECK_THAT(complaint(nothing), Contains("holds no DICOM image") && Contains("it is not DICOM"));
}

TEST_CASE("a second acquisition at the same times is refused with two of its files",
          "[unit][image]") {
  for (const double later : {0.0, 0.5}) {
    const test::TemporaryFolder folder;
    write_stack(folder);
    DicomSpec again = oblique(1, 1);
    again.instance = 1012;
    again.instance_uid = "1.2.3.9.1";
    *again.trigger_ms += later;
    test::write_bytes(folder / "again", test::dicom_bytes(again));
    const std::string message = complaint(folder);
    CHECK_THAT(message, Contains("is there more than once at 43 ms: ") && Contains("/again"));
    CHECK_THAT(describe(read_dicom_study(std::array{folder / ""})),
               Contains("note: cannot be used as it is: ") && Contains("/again"));
  }
}

TEST_CASE("twice as many images as phases are announced are refused, whatever their times",
          "[unit][image]") {
  const test::TemporaryFolder folder;
  for (int p = 0; p < 4; ++p) {
    DicomSpec spec = oblique(0, p);
    spec.phases = 2;
    test::write_bytes(folder / fmt::format("{}", p), test::dicom_bytes(spec));
  }
  CHECK_THAT(complaint(folder), Contains("has 4 images where the headers announce 2 phases"));
}

TEST_CASE("phases that nothing tells apart are refused with the tags that are lacking",
          "[unit][image]") {
  const test::TemporaryFolder folder;
  for (int p = 0; p < 2; ++p) {
    DicomSpec spec = oblique(0, p);
    spec.trigger_ms.reset();
    spec.numbered = false;
    test::write_bytes(folder / fmt::format("{}", p), test::dicom_bytes(spec));
  }
  const std::string message = complaint(folder);
  CHECK_THAT(message, Contains("has 2 images whose phases cannot be told apart"));
  CHECK_THAT(message, Contains("they have no TriggerTime, no TemporalPositionIdentifier and no "
                               "InstanceNumber. Export the images with their times"));
}

TEST_CASE("files of several patients are told, and not by name", "[unit][image]") {
  const test::TemporaryFolder folder;
  for (int s = 0; s < 3; ++s) {
    DicomSpec spec = oblique(s, 0);
    spec.patient = s == 1 ? "SECRET2" : "SECRET1";
    test::write_bytes(folder / fmt::format("{}", s), test::dicom_bytes(spec));
  }
  const std::string notes = fmt::format("{}", fmt::join(read(folder).notes, "|"));
  CHECK_THAT(notes, Contains("files of 2 patients") && !Contains("SECRET"));
}

TEST_CASE("images that are left out are kept with their instance numbers", "[unit][image]") {
  const test::TemporaryFolder folder;
  write_stack(folder);
  DicomSpec spec = oblique(3, 0);
  spec.plane.spacing_i = 0.0;
  test::write_bytes(folder / "lost", test::dicom_bytes(spec));
  test::write_bytes(folder / "notes.txt", "no image");
  const DicomStack stack =
      choose_stack(read_dicom_study(std::array{folder / ""}), {}, "study", "series");
  REQUIRE(stack.lost.size() == 1);
  CHECK(stack.lost.front().instance == 31);
  CHECK_THAT(stack.lost.front().file.reason, Contains("PixelSpacing"));
}

TEST_CASE("magnitude and phase frames of one enhanced file are two stacks", "[unit][image]") {
  for (const bool by_component : {false, true}) {
    std::vector<DicomSpec> frames;
    for (const char* kind : {"M", "P"})
      for (int p = 0; p < 3; ++p) {
        DicomSpec frame = oblique(0, p);
        frame.kind = by_component ? "CINE" : kind;
        frame.component = by_component ? (*kind == 'M' ? "MAGNITUDE" : "PHASE") : "";
        frames.push_back(frame);
      }
    const test::TemporaryFolder folder;
    test::write_bytes(folder / "x", test::enhanced_dicom_bytes(frames));
    const DicomStudy study = read_dicom_study(std::array{folder / ""});
    REQUIRE(study.stacks.size() == 2);
    for (const DicomStack& stack : study.stacks)
      CHECK(stack.slices.front().images.size() == 3);
    CHECK(study.stacks[1].kind == (by_component ? "CINE\\PHASE" : "P"));
  }
}

TEST_CASE("enhanced files of one frame each are ordered by their own instance numbers",
          "[unit][image]") {
  const test::TemporaryFolder folder;
  for (int p = 0; p < 3; ++p) {
    DicomSpec frame = oblique(0, p);
    frame.trigger_ms.reset();
    frame.instance = 7 - p;
    test::write_bytes(folder / fmt::format("{}", p), test::enhanced_dicom_bytes({frame}));
  }
  const DicomStack stack =
      choose_stack(read_dicom_study(std::array{folder / ""}), {}, "study", "series");
  REQUIRE(stack.slices.front().images.size() == 3);
  CHECK(stack.slices.front().images.front().instance == 5);
  CHECK(read_pixels(stack).slices.front().frames.front().at(0, 0) == 200.0F);
}

TEST_CASE("images with one SOPInstanceUID are told apart, and copies of them found",
          "[unit][image]") {
  const test::TemporaryFolder folder;
  for (int s = 0; s < 3; ++s)
    for (int p = 0; p < 2; ++p) {
      DicomSpec spec = oblique(s, p);
      spec.instance_uid = "1.2.3.4";
      test::write_bytes(folder / fmt::format("{}{}", s, p), test::dicom_bytes(spec));
    }
  DicomSpec copy = oblique(1, 1);
  copy.instance_uid = "1.2.3.4";
  copy.description = "anonymous";
  test::write_bytes(folder / "z", test::dicom_bytes(copy));
  const Cine cine = read(folder);
  REQUIRE(cine.slices.size() == 3);
  CHECK(cine.slices[1].frames.size() == 2);
  const std::string notes = fmt::format("{}", fmt::join(cine.notes, "|"));
  CHECK_THAT(notes, Contains("SOPInstanceUIDs are used more than once, by 5 images"));
  CHECK_THAT(notes, Contains("/z is left out: the same image as"));
}

TEST_CASE("deflated and big-endian files are read like plain ones, and named where they are cut",
          "[unit][image]") {
  const DicomSpec spec = oblique(0, 0);
  const test::TemporaryFolder plain;
  test::write_bytes(plain / "x", test::dicom_bytes(spec));
  const std::vector<float> values = read(plain).slices.front().frames.front().values;
  for (const std::string& bytes :
       {test::deflated_dicom_bytes(spec), test::big_endian_dicom_bytes(spec)}) {
    const test::TemporaryFolder folder;
    test::write_bytes(folder / "x", bytes);
    CHECK(read(folder).slices.front().frames.front().values == values);
    for (const std::size_t lost : {2, 20, 60}) {  // one more byte may be there to make it even
      test::write_bytes(folder / "x", bytes.substr(0, bytes.size() - lost));
      CHECK_THAT(complaint(folder), Contains("/x") && Contains("truncated"));
    }
  }
}

TEST_CASE("deflated files of any length are read whole", "[unit][image]") {
  DicomSpec spec = oblique(0, 0);
  spec.plane.rows = spec.plane.columns = 64;
  spec.slope = 1.0;
  spec.intercept = 0.0;
  spec.pixels.assign(64 * 64, 0);
  std::mt19937 random(1);
  for (std::size_t noisy = 1400; noisy <= 2000; noisy += 100) {  // 3 to 4.5 kB deflated
    for (std::size_t p = 0; p < noisy; ++p)
      spec.pixels[p] = static_cast<std::uint16_t>(random());
    const test::TemporaryFolder folder;
    test::write_bytes(folder / "x", test::deflated_dicom_bytes(spec));
    const auto values = read(folder).slices.front().frames.front().values;
    CHECK(std::equal(values.begin(), values.end(), spec.pixels.begin(), spec.pixels.end()));
  }
}

TEST_CASE("texts of DICOM files are shown in their own letters", "[unit][image]") {
  const std::string latin = "Herz f\xfcr alle", utf8 = "Herz f\xc3\xbcr alle";
  CHECK(dicom_text(latin, "ISO_IR 100 ") == utf8);
  CHECK(dicom_text(latin, "") == utf8);
  CHECK(dicom_text(utf8, "") == utf8);
  CHECK(dicom_text(utf8, "ISO_IR 192") == utf8);
  CHECK(dicom_text("\xc0\xff\x80", "ISO_IR 100") == "\xc3\x80\xc3\xbf\xc2\x80");
  CHECK(dicom_text("a \xb6\xf7 b", "ISO_IR 144") == "a ? b");
  CHECK(dicom_text("\x1b$B;3\x1b(B=", "\\ISO 2022 IR 87") == "?=");
  const test::TemporaryFolder folder;
  DicomSpec spec = oblique(0, 0);
  spec.description = latin;
  std::string bytes = test::dicom_bytes(spec);
  const std::string first(
      "\x08\x00\x08\x00"
      "CS",
      6);
  bytes.insert(bytes.find(first), std::string("\x08\x00\x05\x00"
                                              "CS\x0a\x00ISO_IR 100",
                                              18));
  test::write_bytes(folder / "x", bytes);
  CHECK(read_dicom_study(std::array{folder / ""}).stacks.front().description == utf8);
}

TEST_CASE("links that lead nowhere, pipes and links to themselves are told, and no one waits",
          "[unit][image]") {
  namespace fs = std::filesystem;
  const test::TemporaryFolder folder;
  fs::create_symlink("../annex/a", folder / "a.dcm");
  fs::create_symlink("../annex/b", folder / "b.dcm");
  fs::create_symlink("c.dcm", folder / "c.dcm");
  REQUIRE(mkfifo((folder / "d.dcm").c_str(), 0600) == 0);
  const std::string message = complaint(folder);
  CHECK_THAT(message, Contains("holds no DICOM image with a place in space; 2 files are left out, "
                               "the first") &&
                          Contains("a.dcm: the link leads nowhere"));
  CHECK_THAT(message, Contains("c.dcm is left out: the link leads to itself") &&
                          Contains("d.dcm is left out: it is a pipe"));
  CHECK_THROWS_WITH(read_dicom_study(std::array{folder / "d.dcm"}), Contains("it is a pipe"));
  write_stack(folder);
  CHECK_THAT(fmt::format("{}", fmt::join(read(folder).notes, "|")), Contains("leads nowhere"));
}
