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

TEST_CASE("the nearest number is the first of those equally near", "[unit][base]") {
  const std::vector<double> times{0.0, 0.1, 0.2, 0.2, 0.7};
  CHECK(lv::nearest_number(-1.0, times) == 0);
  CHECK(lv::nearest_number(0.16, times) == 2);
  CHECK(lv::nearest_number(0.2, times) == 2);
  CHECK(lv::nearest_number(9.0, times) == 4);
}
