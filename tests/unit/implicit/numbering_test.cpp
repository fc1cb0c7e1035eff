#include "lv/implicit/numbering.hpp"

#include <catch2/catch.hpp>

#include <set>

namespace {

using namespace lv::implicit;

/// Four elements in a row, of two nodes and one pressure each, on ranks that do not go in order.
Pattern row() {
  Pattern pattern;
  pattern.nodes = 5;
  pattern.pressures = 4;
  pattern.owners = {2, 0, 2, 1};
  for (int e = 0; e < 4; ++e) {
    pattern.groups.emplace_back();
    for (const int node : {e, e + 1})
      for (int i = 0; i < 3; ++i)
        pattern.groups.back().push_back(3 * node + i);
    pattern.groups.back().push_back(pattern.displacements() + e);
  }
  return pattern;
}

}  // namespace

TEST_CASE("things of a rank are numbered in one run, in their order", "[unit][implicit]") {
  const Runs runs({1, 0, 1, 2, 0}, 3);
  CHECK(runs.size() == 5);
  CHECK((std::vector{runs[0], runs[1], runs[2], runs[3], runs[4]} == std::vector{2, 0, 3, 4, 1}));
  for (int thing = 0; thing < 5; ++thing) {
    CHECK(runs[thing] >= runs.begin(runs.owner(thing)));
    CHECK(runs[thing] < runs.end(runs.owner(thing)));
  }
}

TEST_CASE("every unknown has a number of its own, a node's displacements three in a row",
          "[unit][implicit]") {
  const Pattern pattern = row();
  for (const int ranks : {3, 4}) {  // one rank may have nothing
    const Numbering numbers(pattern, ranks);
    std::set<int> taken;
    for (int u = 0; u < pattern.size(); ++u)
      taken.insert(numbers[u]);
    CHECK(taken.size() == static_cast<std::size_t>(pattern.size()));
    CHECK(*taken.begin() == 0);
    CHECK(*taken.rbegin() == pattern.size() - 1);
    for (int a = 0; a < pattern.nodes; ++a)
      for (int i = 1; i < 3; ++i)
        CHECK(numbers[3 * a + i] == numbers[3 * a] + i);
  }
}

TEST_CASE("a node that elements share belongs to the lowest of their ranks", "[unit][implicit]") {
  const Numbering numbers(row(), 3);
  const std::vector<int> expected{2, 0, 0, 1, 1};
  for (int a = 0; a < 5; ++a)
    CHECK(numbers.nodes().owner(a) == expected[a]);
  for (int e = 0; e < 4; ++e)
    CHECK(numbers.pressures().owner(e) == row().owners[e]);
}

TEST_CASE("each rank's displacements come before its pressures", "[unit][implicit]") {
  const Pattern pattern = row();
  const Numbering numbers(pattern, 3);
  for (int a = 0; a < pattern.nodes; ++a)
    for (int p = 0; p < pattern.pressures; ++p)
      if (numbers.nodes().owner(a) <= numbers.pressures().owner(p))
        CHECK(numbers[3 * a] < numbers[pattern.displacements() + p]);
      else
        CHECK(numbers[3 * a] > numbers[pattern.displacements() + p]);
}
