#include "lv/report/stage_facts.hpp"

#include "lv/base/check.hpp"
#include "lv/base/table.hpp"

#include "support/temporary_folder.hpp"
#include <catch2/catch.hpp>

using namespace lv;

namespace {

std::filesystem::path made(const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  return folder;
}

}  // namespace

TEST_CASE("what stages leave for figures and page comes back as it was", "[report]") {
  const test::TemporaryFolder folder;
  const std::filesystem::path work = folder / "work";
  report::write_facts(report::MeshFacts{0.1 + 0.2, 2, true}, made(work / "02_mesh"));
  report::write_facts(report::BeatFacts{true}, made(work / "03_beat.part"));
  const drawing::Orientation written{
      0.0, {{"septum", "nothing shows it"}, {"apex", "12° off, in Zürich's words"}}, true};
  report::write_facts(written, made(work / "04_results"));
  REQUIRE(report::mesh_facts(work));
  CHECK(report::mesh_facts(work)->septum_angle == 0.1 + 0.2);
  CHECK(report::mesh_facts(work)->order == 2);
  CHECK(report::mesh_facts(work)->is_immersed);
  CHECK(report::beat_facts(work)->has_valves);
  const drawing::Orientation read = report::orientation_of(work);
  CHECK(read.septum_angle == 0.1 + 0.2);
  CHECK(read.is_unloaded);
  REQUIRE(read.assumed.size() == 2);
  CHECK(read.assumed[1].part == "apex");
  CHECK(read.assumed[1].text == written.assumed[1].text);
}

TEST_CASE("a finished stage without facts is told, and nothing is taken for known", "[report]") {
  const test::TemporaryFolder folder;
  const std::filesystem::path work = made(folder / "work");
  CHECK_FALSE(report::mesh_facts(work));
  CHECK(report::orientation_of(work).assumed.empty());
  CHECK(report::missing_facts(work).empty());
  write_file(made(work / "02_mesh") / "mesh.bin", "of another version");
  REQUIRE(report::missing_facts(work).size() == 1);
  CHECK_THAT(report::missing_facts(work).front(),
             Catch::Contains("02_mesh") && Catch::Contains("where the septum is"));
  write_file(work / "02_mesh/facts.bin", "damaged");
  CHECK(report::missing_facts(work).empty());
  CHECK_THROWS_AS(report::mesh_facts(work), RunError);
}
