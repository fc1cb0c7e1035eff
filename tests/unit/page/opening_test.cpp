#include "lv/page/opening.hpp"

#include "lv/base/table.hpp"

#include "support/temporary_folder.hpp"
#include <catch2/catch.hpp>

#include <filesystem>

namespace {

using namespace lv;
using Frames = std::vector<std::optional<std::size_t>>;

constexpr const char* head =
    "state,scheme,region,quantity,unit,volume_ml,mean,sd,p1,p50,p99,segment\n";

/// A work folder whose circumferential strain lies between two percentiles.
std::filesystem::path with_strain(const std::filesystem::path& work, const char* p1,
                                  const char* p99) {
  std::filesystem::create_directories(work / "04_results");
  write_file(work / "04_results" / "regions.csv",
             std::string(head) + "end_systole,whole,wall,circumferential_strain,1,100,-0.1,0.1," +
                 p1 + ",-0.1," + p99 +
                 ",\nend_systole,whole,wall,fibre_stress,kPa,100,50,9,-9,50,99,\n");
  return work;
}

}  // namespace

TEST_CASE("a page opens at end-systole, or at the last moment of a beat that has none", "[page]") {
  const page::Course whole{{0.0, 0.3, 0.5, 0.6}, 0.49};
  CHECK(page::opening_frames({whole}) == Frames{2});
  CHECK(page::opening_frames({{{0.0, 0.1, 0.2}, {}}}) == Frames{2});
  CHECK(page::opening_frames({page::Course{}}) == Frames{std::nullopt});
}

TEST_CASE("two cases open at their own end-systoles, or both at their last moments", "[page]") {
  const page::Course one{{0.0, 0.3, 0.5, 0.6}, 0.5};
  const page::Course other{{0.0, 1.0, 1.8}, 1.8};
  const page::Course filling{{0.0, 0.1}, {}};
  CHECK(page::opening_frames({one, other}) == Frames{2, 2});
  CHECK(page::opening_frames({one, filling}) == Frames{3, 1});
  CHECK(page::opening_frames({one, {{}, 0.5}}) == Frames{2, std::nullopt});
  CHECK(page::opening_frames({one, {{0.0, 0.1}, 0.5}}) == Frames{3, 1});  // frames are missing
}

TEST_CASE("two cases of heartbeats open where the first one's ejection ends", "[page]") {
  const page::Course one{{2.0, 2.2, 2.4, 2.6, 2.8}, 2.4, true};
  const page::Course other{{0.0, 0.1, 0.5, 0.9, 1.0}, 0.9, true};
  CHECK(page::opening_frames({one, other}) == Frames{2, 2});
  CHECK(page::opening_frames({other, one}) == Frames{3, 4});  // 72 of 80 steps
  CHECK(page::opening_frames({one}) == Frames{2});
}

TEST_CASE("pictures of two cases have one scale", "[page]") {
  const test::TemporaryFolder folder;
  const auto small = with_strain(folder / "small", "-0.2", "0.05");
  const auto large = with_strain(folder / "large", "-0.25", "0.4");
  CHECK(page::opening_scale({small})->max == Approx(0.2));
  CHECK(page::opening_scale({small, large})->max == Approx(0.4));
  CHECK(page::opening_scale({small, large})->min == Approx(-0.4));
  CHECK(page::opening_scale({folder / "none", small})->max == Approx(0.2));
  CHECK_FALSE(page::opening_scale({folder / "none"}));
}
