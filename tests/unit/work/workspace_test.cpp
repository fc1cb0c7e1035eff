#include "lv/work/workspace.hpp"

#include "lv/base/table.hpp"
#include "lv/work/ingredients.hpp"

#include "support/temporary_folder.hpp"
#include <catch2/catch.hpp>

#include <vector>

namespace {

using namespace lv;
namespace fs = std::filesystem;

work::StageFolder stage(const test::TemporaryFolder& work, const std::string& value) {
  return {work / "", "03_beat", {{"blood.density", value}}};
}

/// A finished stage with two files.
work::StageFolder finished(const test::TemporaryFolder& work) {
  work::StageFolder folder = stage(work, "1 g/ml");
  const fs::path part = folder.begin();
  fs::create_directories(part / "fields");
  write_file(part / "beat.bin", "beat");
  write_file(part / "fields" / "wall.vtu", "wall");
  folder.finish();
  return folder;
}

/// An unfinished stage with a checkpoint.
void interrupted(const test::TemporaryFolder& work, const std::string& value) {
  write_file(stage(work, value).begin() / "checkpoint.bin", value);
}

std::string contents(const fs::path& path) {
  work::FileContents files;
  return files.of(path);
}

}  // namespace

TEST_CASE("a finished stage is believed while its files are there as recorded", "[unit][work]") {
  const test::TemporaryFolder work;
  const work::StageFolder folder = finished(work);
  REQUIRE(folder.up_to_date());
  CHECK_FALSE(fs::exists(folder.unfinished()));
  SECTION("a file more is nobody's") {
    write_file(folder.folder() / "note.txt", "of a user");
    CHECK(folder.up_to_date());
  }
  SECTION("a file is gone") {
    fs::remove(folder.folder() / "beat.bin");
    CHECK_FALSE(folder.up_to_date());
    CHECK(folder.reason() == "its file beat.bin is gone");
  }
  SECTION("a file in a folder is cut short") {
    fs::resize_file(folder.folder() / "fields" / "wall.vtu", 2);
    CHECK_FALSE(folder.up_to_date());
    CHECK(folder.reason() == "its file fields/wall.vtu has 2 bytes and had 4");
    CHECK_THAT(work::state_of(work / "").at(2), Catch::Contains("03_beat is not whole: its file"));
  }
  SECTION("a damaged record is told as one, not as a stage that has not run") {
    write_file(folder.folder() / "stage.json", "{\"ingredients\": ");
    CHECK_FALSE(folder.up_to_date());
    CHECK(folder.reason() == "its record (stage.json) is gone or damaged");
  }
  SECTION("a record without the list of files is that of an unfinished stage") {
    write_file(folder.folder() / "stage.json", R"({"ingredients": {"blood.density": "1 g/ml"}})");
    CHECK_FALSE(folder.up_to_date());
  }
}

TEST_CASE("an unfinished stage with a damaged record is said to be one, and kept", "[unit][work]") {
  const test::TemporaryFolder work;
  interrupted(work, "1 g/ml");
  write_file(work / "03_beat.part/stage.json", "");
  CHECK(stage(work, "1 g/ml").reason() ==
        "it was interrupted, and its record (stage.json) is gone or damaged");
  static_cast<void>(stage(work, "1 g/ml").begin());
  CHECK(fs::exists(work / "03_beat.other/checkpoint.bin"));
}

TEST_CASE("an unfinished stage with other ingredients is kept, however many there are",
          "[unit][work]") {
  const test::TemporaryFolder work;
  for (const char* value : {"1 g/ml", "2 g/ml", "3 g/ml"})
    interrupted(work, value);
  CHECK(read_file(work / "03_beat.other/checkpoint.bin") == "1 g/ml");
  CHECK(read_file(work / "03_beat.other2/checkpoint.bin") == "2 g/ml");
  CHECK(read_file(work / "03_beat.part/checkpoint.bin") == "3 g/ml");
}

TEST_CASE("a run whose ingredients come back goes on from what was kept", "[unit][work]") {
  const test::TemporaryFolder work;
  for (const char* value : {"1 g/ml", "2 g/ml", "3 g/ml"})
    interrupted(work, value);
  const fs::path part = stage(work, "2 g/ml").begin();
  CHECK(read_file(part / "checkpoint.bin") == "2 g/ml");
  CHECK(read_file(work / "03_beat.other/checkpoint.bin") == "1 g/ml");
  CHECK(read_file(work / "03_beat.other3/checkpoint.bin") == "3 g/ml");
}

TEST_CASE("an unfinished stage without any file but its record leaves nothing behind",
          "[unit][work]") {
  const test::TemporaryFolder work;
  static_cast<void>(stage(work, "1 g/ml").begin());
  static_cast<void>(stage(work, "2 g/ml").begin());
  CHECK(work.file_count() == 1);
}

TEST_CASE("another remark makes a stage run again, and outdates none after it", "[unit][work]") {
  const test::TemporaryFolder work;
  const auto finish = [&](const char* name, const work::Ingredients& ingredients) {
    const work::StageFolder folder(work / "", name, ingredients);
    write_file(folder.begin() / "made.bin", "made");
    folder.finish();
  };
  const auto anatomy = [](const char* remark, const char* value) {
    return work::Ingredients{{work::remark_start + "whether x is set", remark}, {"x", value}};
  };
  const auto is_outdated = [&] {
    for (const std::string& sentence : work::state_of(work / ""))
      if (sentence.find("02_mesh was made from another 01_anatomy") != std::string::npos)
        return true;
    return false;
  };
  finish("02_mesh", {{"result of anatomy", work::fingerprint_of_result(anatomy("no", "1"))}});
  finish("01_anatomy", anatomy("no", "1"));
  CHECK_FALSE(is_outdated());
  CHECK_FALSE(work::StageFolder(work / "", "01_anatomy", anatomy("yes", "1")).up_to_date());
  finish("01_anatomy", anatomy("yes", "1"));
  CHECK_FALSE(is_outdated());
  finish("01_anatomy", anatomy("yes", "2"));
  CHECK(is_outdated());
}

TEST_CASE("contents do not depend on where a study lies", "[unit][work]") {
  const test::TemporaryFolder folder;
  for (const char* place : {"here", "there"}) {
    fs::create_directories(folder / place / "dicom" / "series");
    write_file(folder / place / "dicom" / "series" / "IM1", "image");
    write_file(folder / place / "labels.nii", "labels");
  }
  CHECK(contents(folder / "here/labels.nii") == contents(folder / "there/labels.nii"));
  CHECK(contents(folder / "here/dicom") == contents(folder / "there/dicom"));
  fs::current_path(folder / "here");
  CHECK(contents("labels.nii") == contents(folder / "there/labels.nii"));
  write_file(folder / "there/dicom/series/IM1", "another");
  CHECK(contents("dicom") != contents(folder / "there/dicom"));
  write_file(folder / "here/dicom/series/IM2", "");
  CHECK(contents("dicom") != contents(folder / "there/dicom"));
  fs::current_path(fs::temp_directory_path());
}

TEST_CASE("a work folder is no part of the study that it lies in", "[unit][work]") {
  const test::TemporaryFolder study;
  write_file(study / "IM1", "image");
  const auto now = [&] {
    work::FileContents files({study / "case.work", study / "case.toml"});
    return files.of(study / "");
  };
  const std::string before = now();
  fs::create_directories(study / "case.work");
  write_file(study / "case.work/log.txt", "a line");
  write_file(study / "case.toml", "name = \"a\"");
  CHECK(now() == before);
  write_file(study / "IM2", "image");
  CHECK(now() != before);
}

TEST_CASE("the contents of a header are those of its image too, in any letter case",
          "[unit][work]") {
  for (const auto& [header, image] : {std::pair("a.hdr", "a.img"),
                                      {"a.HDR", "a.IMG"},
                                      {"a.hdr", "a.img.gz"},
                                      {"a.img", "a.hdr"}}) {
    const test::TemporaryFolder folder;
    write_file(folder / header, "header");
    write_file(folder / image, "one");
    write_file(folder / "b.img", "of another");
    const std::string before = contents(folder / header);
    write_file(folder / "b.img", "of another still");
    CHECK(contents(folder / header) == before);
    write_file(folder / image, "two");
    CHECK(contents(folder / header) != before);
  }
}

TEST_CASE("what a mesh includes is among its contents, in any letter case", "[unit][work]") {
  const test::TemporaryFolder folder;
  write_file(folder / "MESH.INP", "*INCLUDE, INPUT=nodes.inc\n");
  write_file(folder / "nodes.inc", "*Node\n1, 0, 0, 0\n");
  case_file::Case c;
  c.file = folder / "case.toml";
  c.anatomy.source = case_file::AnatomySource::mesh;
  c.anatomy.mesh.import.file = "MESH.INP";
  const auto now = [&] {
    work::FileContents files;
    return work::ingredients(c, case_file::Stage::anatomy, files);
  };
  const work::Ingredients before = now();
  REQUIRE(before.contains("contents of nodes.inc"));
  write_file(folder / "nodes.inc", "*Node\n1, 0, 0, 1\n");
  CHECK(now().at("contents of nodes.inc") != before.at("contents of nodes.inc"));
}

TEST_CASE("what has no end or cannot be read has no contents", "[unit][work]") {
  CHECK(contents("/dev/zero") == contents("/dev/null"));
  CHECK(contents("/no/such/file") == "absent");
}
