#include "lv/base/check.hpp"
#include "lv/base/table.hpp"
#include "lv/case_file/case.hpp"

#include "support/temporary_folder.hpp"
#include <catch2/catch.hpp>

using namespace lv;
using Catch::Matchers::Contains;

TEST_CASE("factors of contractility are read by segment, and those that were fitted taken instead",
          "[unit][case_file]") {
  const test::TemporaryFolder folder;
  case_file::Case c;
  c.file = folder / "case.toml";
  CHECK(case_file::segment_factors(c) == mesh::even_segments());
  c.contractility_file = "factors.csv";
  write_file(folder / "factors.csv", "segment,name,factor\n7,mid anterior,0.3\n17,apex,1.5\n");
  mesh::SegmentFactors expected = mesh::even_segments();
  expected[6] = 0.3;
  expected[16] = 1.5;
  CHECK(case_file::segment_factors(c) == expected);
  CHECK(case_file::cardiac_model(c).contractility == expected);
  CHECK(case_file::static_model(c).heart.contractility == expected);
  expected[0] = 2.0;
  c.fitted_contractility = expected;
  CHECK(case_file::segment_factors(c) == expected);
}

TEST_CASE("wrong factors of contractility are refused with their line", "[unit][case_file]") {
  const test::TemporaryFolder folder;
  case_file::Case c;
  c.file = folder / "case.toml";
  c.contractility_file = "factors.csv";
  const auto refused = [&](const std::string& text, const std::string& message) {
    write_file(folder / "factors.csv", text);
    CHECK_THROWS_WITH(case_file::segment_factors(c), Contains("factors.csv") && Contains(message));
  };
  CHECK_THROWS_WITH(case_file::segment_factors(c), Contains("cannot be opened"));
  refused("segment,T\n7,0.3\n", "there is no column factor");
  refused("segment,factor\n", "the file holds no factors");
  refused("segment,factor\n18,0.3\n", "factors.csv:2: segment \"18\" is not of 1 to 17");
  refused("segment,factor\n7,0.3\n7,0.4\n", "factors.csv:3: segment 7 is there twice");
  refused("segment,factor\n7,-0.3\n", "factor \"-0.3\" is no number from 0 to 100");
  refused("segment,factor\n7\n", "has 1 values instead of 2");
}
