#include "lv/page/views.hpp"

#include "lv/base/units.hpp"

#include <catch2/catch.hpp>

#include <numbers>

namespace {

using namespace lv;

constexpr int around = 36;
constexpr int levels = 12;

/// A tube of one layer of hexahedra, 60 mm long and 10 mm thick, whose infarct is a sector of 80
/// degrees about an angle from x [rad].
page::WallSeries tube(double infarct) {
  page::WallSeries wall;
  const auto node = [](int k, int i, int layer) { return 2 * (k * around + i % around) + layer; };
  for (int k = 0; k <= levels; ++k)
    for (int i = 0; i < around; ++i)
      for (const double radius : {20.0, 30.0}) {
        const double angle = 2.0 * std::numbers::pi * i / around;
        wall.undeformed.emplace_back(radius * std::cos(angle), radius * std::sin(angle), -5.0 * k);
        const bool is_in = std::cos(angle - infarct) > std::cos(40.0 * units::degree);
        wall.infarct.push_back(is_in ? 1.0F : 0.0F);
      }
  const auto side = [&](std::initializer_list<int> nodes) {
    wall.skin.nodes.insert(wall.skin.nodes.end(), nodes.begin(), nodes.end());
    wall.skin.cells.push_back(static_cast<int>(wall.cells.size() / 8));
  };
  for (int k = 0; k < levels; ++k)
    for (int i = 0; i < around; ++i) {
      for (const int layer : {0, 1})
        side({node(k, i, layer), node(k, i + 1, layer), node(k + 1, i + 1, layer),
              node(k + 1, i, layer)});
      for (const int layer : {0, 1})
        for (const auto& [dk, di] : {std::pair{0, 0}, {0, 1}, {1, 1}, {1, 0}})
          wall.cells.push_back(node(k + dk, i + di, layer));
    }
  wall.times = {0.0};
  wall.displacement = {std::vector<float>(3 * wall.undeformed.size(), 0.0F)};
  return wall;
}

/// The view in which a page of that tube opens, with the infarct at an angle from the septum [deg].
std::string_view opened(double septum, double infarct) {
  const auto wall = tube((septum + infarct) * units::degree);
  const auto shown = page::infarct_shown(wall, 0, {.septum_angle = septum * units::degree});
  return page::views.at(page::opening_view(shown)).name;
}

}  // namespace

TEST_CASE("a page opens where its infarct is seen, wherever the septum is", "[page]") {
  for (const double septum : {0.0, 70.0}) {
    CHECK(opened(septum, 90.0) == "anterior");    // no long axis keeps it
    CHECK(opened(septum, 270.0) == "4-chamber");  // its endocardium in front
    CHECK(opened(septum, 180.0) == "2-chamber");  // the same of a lateral one
    CHECK(opened(septum, 240.0) == "2-chamber");  // and its section
  }
}

TEST_CASE("what a view shows of an infarct is its area in the picture", "[page]") {
  const auto shown = page::infarct_shown(tube(0.0), 0, {});
  const auto at = [&](std::string_view name) {
    for (std::size_t i = 0; i < page::views.size(); ++i)
      if (page::views.at(i).name == name)
        return shown.at(i);
    return -1.0;
  };
  const double width = 2.0 * 30.0 * std::sin(35.0 * units::degree);  // whole elements are infarcted
  CHECK(at("septal") == Approx(width * 60.0 * std::cos(8.0 * units::degree)).epsilon(0.08));
  CHECK(at("lateral") < 0.15 * at("septal"));  // behind the wall, but for what is seen over the rim
  CHECK(at("short axis") == 0.0);
  CHECK(at("4-chamber") > 10.0 * 55.0);  // the section of the septum, and more behind it
}

TEST_CASE("a long axis is preferred where it shows at least half as much", "[page]") {
  std::vector<double> shown(page::views.size(), 0.0);
  CHECK(page::opening_view(shown) == 0);  // without an infarct: four chambers
  shown[5] = 100.0;                       // septal
  CHECK(page::opening_view(shown) == 5);
  shown[2] = 49.0;  // two chambers
  CHECK(page::opening_view(shown) == 5);
  shown[1] = 50.0;  // three chambers
  CHECK(page::opening_view(shown) == 1);
}
