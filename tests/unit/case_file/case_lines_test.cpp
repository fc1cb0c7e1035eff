#include "lv/case_file/case_lines.hpp"

#include "lv/base/check.hpp"
#include "lv/case_file/read_case.hpp"

#include <catch2/catch.hpp>

using namespace lv;
using Catch::Matchers::Contains;

TEST_CASE("lines of a case file stand under their tables, in comments where they are proposals",
          "[unit][case_file]") {
  CHECK(case_file::case_lines({{"anatomy.source", "\"labels\"", ""},
                               {"unloaded.pressure", "\"8 mmHg\"", "why", false},
                               {"anatomy.labels.cavity", case_file::listed({1, 2}), "blood"},
                               {"anatomy.labels.file", case_file::quoted("a \"b\".nii"), ""}}) ==
        "[anatomy]\nsource = \"labels\"\n\n# [unloaded]\n# pressure = \"8 mmHg\"  # why\n\n"
        "[anatomy.labels]\ncavity = [1, 2]  # blood\nfile = \"a \\\"b\\\".nii\"\n");
  CHECK_THROWS_AS(case_file::quoted("\xff"), InputError);
}

TEST_CASE("what is missing is told at once, with lines under the tables that the case has",
          "[unit][case_file]") {
  const case_file::Case c = case_file::parse_case(
      "[anatomy]\nsource = \"labels\"\n[anatomy.labels]\nfile = \"m.nii\"\n", "c");
  case_file::Missing missing;
  CHECK_NOTHROW(missing.raise(c, "c:4"));
  missing.add({"anatomy.labels.cavity", "[1]", ""});
  missing.add({"anatomy.labels.muscle", "[2]", ""});
  missing.add({"infarct.labels.file", case_file::fill_in, "the map"});
  CHECK_THROWS_WITH(
      missing.raise(c, "c:4", "there are 0 and 1"),
      Contains("c:4: anatomy.labels.cavity, anatomy.labels.muscle and infarct.labels.file are not "
               "set; there are 0 and 1") &&
          Contains("\nAdd under [anatomy.labels]:\ncavity = [1]\nmuscle = [2]\n") &&
          Contains("\nAdd:\n[infarct.labels]\nfile = \"FILL IN\"  # the map\n"));
}

TEST_CASE("a case with lines to fill in is refused, naming all of them", "[unit][case_file]") {
  CHECK_THROWS_WITH(case_file::parse_case(
                        "[strain]\ncine = \"FILL IN\"\n[unloaded]\npressure = \"FILL IN\"\n", "c"),
                    Contains("c:2: strain.cine is to be filled in: ") &&
                        Contains("c:4: unloaded.pressure is to be filled in: ") &&
                        !Contains("; any"));
}

TEST_CASE("parameters are found by a part of their name or meaning", "[unit][case_file]") {
  const std::string found = case_file::manual(false, "CALCIUM");
  CHECK_THAT(found, Contains("[calcium]") && Contains("Ca_max"));
  CHECK_THAT(found, !Contains("edge_length"));
  CHECK_THROWS_WITH(case_file::manual(false, "edge_lenth"), Contains("Did you mean edge_length?"));
}
