#include "lv/base/names_alone.hpp"

#include <catch2/catch.hpp>

using lv::NamesAlone;

TEST_CASE("folders are taken out of texts and names stay", "[unit][base]") {
  const NamesAlone names({"/home/study/anna", "/home/study/anna/dicom", "../anna"});
  CHECK(names("/home/study/anna/labels.nii: damaged") == "labels.nii: damaged");
  CHECK(names("see /home/study/anna/dicom/IM1.dcm and ../anna/a.csv.") == "see IM1.dcm and a.csv.");
  CHECK(names("/home/study/anna/dicom: holds no image") == "(folder): holds no image");
  CHECK(names("nothing lies in /home/study/anna.") == "nothing lies in (folder).");
  CHECK(names("written to /home/study/anna/") == "written to (folder)/");
}

TEST_CASE("what only looks like a folder stays", "[unit][base]") {
  const NamesAlone names({"dicom", "a"});
  CHECK(names("anatomy.sunnybrook.dicom in kPa/mm, a_f") ==
        "anatomy.sunnybrook.dicom in kPa/mm, a_f");
  CHECK(names("dicom/IM1.dcm") == "IM1.dcm");
  CHECK(names("the run ended early: dicom: holds no image") ==
        "the run ended early: (folder): holds no image");
  CHECK(NamesAlone({"mesh"})("mesh runs, because it was interrupted") ==
        "mesh runs, because it was interrupted");
  CHECK(NamesAlone({std::filesystem::path(), "/", "."})("a/b ./c /d") == "a/b ./c /d");
}
