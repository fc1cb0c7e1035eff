#include "lv/cine/strain_targets.hpp"

#include "lv/base/check.hpp"
#include "lv/base/table.hpp"
#include "lv/case_file/read_case.hpp"

#include <catch2/catch.hpp>

#include <filesystem>

namespace {

using namespace lv;
using Catch::Matchers::Contains;

/// One element in segment ant of slice 3, segment 7 of the AHA; one in inflat of slice 1.
mesh::Regions two_elements() {
  return {{3, 1}, {1, 5}, {7, 5}};
}

case_file::Case with_strains(const std::string& lines) {
  const auto folder = std::filesystem::temp_directory_path();
  write_file(folder / "strains.csv", "slice,segment,strain\n" + lines);
  case_file::Case c;
  c.file = folder / "case.toml";
  c.calibration.strains = "strains.csv";
  return c;
}

}  // namespace

TEST_CASE("strains are read for slices and for AHA segments", "[cine]") {
  const auto targets =
      cine::strain_targets(with_strains("3,Ant,-0.2\n\nAHA, 5, -0.1\r\n"), two_elements());
  REQUIRE(targets.size() == 2);
  CHECK(targets[0].region == "3 ant");
  CHECK(targets[0].strain == -0.2);
  CHECK(targets[0].cells == std::vector<int>{0});
  CHECK(targets[1].cells == std::vector<int>{1});
}

TEST_CASE("wrong strains are refused with their line", "[cine]") {
  const auto refused = [](const std::string& lines, const std::string& message) {
    CHECK_THROWS_WITH(cine::strain_targets(with_strains(lines), two_elements()),
                      Contains("strains.csv:") && Contains(message));
  };
  refused("3,ant,-0.2\n3,ant,-0.2\n", "strains.csv:3: segment 3 ant is there twice");
  refused("8,ant,-0.2\n", "slice \"8\" is neither 1 to 7 nor aha");
  refused("3,lat,-0.2\n", "slice 3 has no segment \"lat\"");
  refused("aha,18,-0.2\n", "segment \"18\" is not of 1 to 17");
  refused("3,ant,-20\n", "strain \"-20\" is not a number above -0.5");
  refused("3,ant,nan\n", "strain \"nan\" is not a number");
  refused("3,ant\n", "has 2 values instead of 3");
  refused("2,ant,-0.2\n", "the mesh has no element in segment 2 ant");
  refused("", "the file holds no strains");
}
