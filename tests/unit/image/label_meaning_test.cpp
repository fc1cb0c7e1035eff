#include "lv/image/label_meaning.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace {

using namespace lv;
using Labels = std::vector<int>;

/// What the numbers of a map mean: cavity, muscle, right ventricle, scar, core of the scar.
struct Numbers {
  int cavity, muscle, right, scar, core;
};

/// A left ventricle with its right neighbour in slices of 8 mm; the wall is open on the basal
/// slice, and a transmural scar with a core lies opposite to the septum.
image::Volume map_of(const Numbers& n, double half_scar = 0.5) {
  image::Volume map;
  map.size = {80, 80, 8};
  map.spacing = {1.4, 1.4, 8.0};
  for (int k = 0; k < 8; ++k)
    for (int j = 0; j < 80; ++j)
      for (int i = 0; i < 80; ++i) {
        const double x = 1.4 * (i - 45);
        const double y = 1.4 * (j - 40);
        const double r = std::hypot(x, y);
        const double angle = std::atan2(y, x);
        const bool open = k == 7 && std::abs(angle) < 0.6;
        const bool in_wall = r >= 22.0 && r < 32.0 && !open;
        const bool scarred = std::abs(angle) < half_scar && k < 4;
        const bool core = scarred && r > 24.0 && r < 27.0 && std::abs(angle) < 0.3;
        const bool right = std::hypot(x + 30.0, y) < 27.0 && r >= 32.0;
        map.values.push_back(static_cast<float>(r < 22.0             ? n.cavity
                                                : in_wall && core    ? n.core
                                                : in_wall && scarred ? n.scar
                                                : in_wall            ? n.muscle
                                                : right              ? n.right
                                                                     : 0));
      }
  return map;
}

Labels sorted(Labels labels) {
  std::sort(labels.begin(), labels.end());
  labels.erase(std::unique(labels.begin(), labels.end()), labels.end());
  return labels;
}

}  // namespace

TEST_CASE("cavity, muscle and right ventricle are found whatever their numbers", "[unit][image]") {
  const std::array<std::array<int, 3>, 5> conventions{
      {{3, 2, 1}, {1, 2, 3}, {7, 40, 200}, {2, 3, 1}, {500, 205, 600}}};
  for (const auto& [cavity, muscle, right] : conventions) {
    const auto meaning = image::propose_meaning(map_of({cavity, muscle, right, muscle, muscle}));
    CHECK(meaning.cavity == Labels{cavity});
    CHECK(meaning.muscle == Labels{muscle});
    CHECK(meaning.right_ventricle == Labels{right});
  }
}

TEST_CASE("scar and its core count to the muscle, without a right ventricle too", "[unit][image]") {
  const auto meaning = image::propose_meaning(map_of({1, 2, 0, 3, 4}));
  CHECK(meaning.cavity == Labels{1});
  CHECK(sorted(meaning.muscle) == Labels{2, 3, 4});
  CHECK(meaning.right_ventricle.empty());
}

TEST_CASE("a wide scar across the whole wall counts to the muscle", "[unit][image]") {
  const auto meaning = image::propose_meaning(map_of({1, 2, 0, 3, 3}, 1.5));
  CHECK(sorted(meaning.muscle) == Labels{2, 3});
}

TEST_CASE("of two ventricles with walls of their own the thicker one is the left",
          "[unit][image]") {
  constexpr int right_wall = 5;
  image::Volume map = map_of({1, 2, 3, 2, 2});
  for (int k = 0; k < 8; ++k)
    for (int j = 0; j < 80; ++j)
      for (int i = 0; i < 80; ++i) {
        // a dilated right ventricle with a wall of 3 mm
        const double r = std::hypot(1.4 * (i - 45) + 30.0, 1.4 * (j - 40));
        float& value = map.values[static_cast<std::size_t>((k * 80 + j) * 80 + i)];
        if (value == 0.0F && r < 37.0)
          value = r < 34.0 ? 3.0F : static_cast<float>(right_wall);
      }
  const auto count = [&](int label) {
    return std::count(map.values.begin(), map.values.end(), static_cast<float>(label));
  };
  REQUIRE(count(3) > count(1));
  const auto meaning = image::propose_meaning(map);
  CHECK(meaning.cavity == Labels{1});
  CHECK(sorted(meaning.muscle) == Labels{2});
  CHECK(meaning.right_ventricle == Labels{3});
}

TEST_CASE("nothing is proposed where no label lies inside another", "[unit][image]") {
  const auto meaning = image::propose_meaning(map_of({5, 5, 0, 5, 5}));
  CHECK(meaning.cavity.empty());
  CHECK(meaning.muscle.empty());
  image::Volume grey = map_of({3, 2, 1, 2, 2});
  grey.values[17] = 0.5F;
  CHECK_FALSE(image::seems_labels(grey));
  CHECK(image::propose_meaning(grey).cavity.empty());
}

TEST_CASE("few whole values are labels, however large; many beyond 255 are an image",
          "[unit][image]") {
  image::Volume map = map_of({500, 205, 600, 205, 205});
  CHECK(image::seems_labels(map));
  for (int k = 0; k < 100; ++k)
    map.values[k] = static_cast<float>(3 * k);
  CHECK_FALSE(image::seems_labels(map));
  map.values.assign(map.values.size(), -1.0F);
  CHECK_FALSE(image::seems_labels(map));
}
