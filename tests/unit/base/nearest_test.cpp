#include "lv/base/nearest.hpp"

#include <catch2/catch.hpp>

#include <vector>

TEST_CASE("the nearest name ignores case, prefers parts of words, and may be none",
          "[unit][base]") {
  const std::vector<std::string> names{"ENDO", "epi", "Base_plane"};
  CHECK(lv::nearest_name("endo", names) == "ENDO");
  CHECK(lv::nearest_name("epo", names) == "epi");
  CHECK(lv::nearest_name("base", names) == "Base_plane");
  CHECK(lv::nearest_name("septum", names).empty());
  CHECK(lv::nearest_name("endo", std::vector<std::string>{}).empty());
}
