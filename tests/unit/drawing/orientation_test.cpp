#include "lv/drawing/orientation.hpp"

#include "lv/analysis/wall_fields.hpp"
#include "lv/geometry/ellipsoid.hpp"
#include "lv/mesh/wall_mesh.hpp"
#include "lv/report/heart_figures.hpp"
#include "lv/report/paraview_script.hpp"

#include "support/pixels.hpp"
#include <catch2/catch.hpp>

#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <regex>

namespace {

using namespace lv;
using drawing::Figure;
using drawing::Orientation;

constexpr double septum_angle = 0.7;  // not along an axis [rad]

/// An ellipsoid with an infarct within 40 degrees of a direction about the long axis.
mesh::Mesh phantom(const Vec3& infarct) {
  const geometry::Ellipsoid e;
  mesh::Mesh m = mesh::wall_mesh(
      [&](double u, double theta, double t) { return e.point(u, theta, t); }, {.edge_length = 6.0});
  m.infarct.clear();
  for (const Vec3& x : m.nodes) {
    const Vec3 across = Vec3(x.x(), x.y(), 0.0);
    const double along = across.norm() > 1.0 ? across.normalized().dot(infarct) : -1.0;
    m.infarct.push_back(along > std::cos(40.0 * std::numbers::pi / 180.0) ? 1.0 : 0.0);
  }
  return m;
}

/// A panel of the figure of the phantom's infarct as a figure of its own.
Figure panel(const Vec3& infarct, std::size_t number) {
  const Figure all = report::infarct_figure(phantom(infarct), {septum_angle, {}});
  Figure one{.panels = {all.panels.at(number)}, .columns = 1};
  one.panels.front().title.clear();
  return one;
}

/// The middle of the yellow pixels, in fractions of the picture from its middle: right, down.
std::array<double, 2> yellow(const test::Pixels& p) {
  double x = 0.0;
  double y = 0.0;
  int count = 0;
  for (int row = 0; row < p.height; ++row)
    for (int column = 0; column < p.width; ++column) {
      const std::uint32_t pixel = p.rgb[static_cast<std::size_t>(row) * p.width + column];
      const auto part = [&](unsigned shift) { return static_cast<int>(pixel >> shift & 255U); };
      if (part(16) < part(0) + 60 || part(8) < part(0) + 60)
        continue;
      x += column;
      y += row;
      ++count;
    }
  REQUIRE(count > 100);
  return {x / count / p.width - 0.5, y / count / p.height - 0.5};
}

/// Where an SVG file has its letters [points].
std::map<std::string, std::array<double, 2>> letters(const std::string& svg) {
  static const std::regex element(
      R"(translate\(([-\d.]+) ([-\d.]+)\)[^>]*>([ASIL]\*?|apex\*|base\*)</text>)");
  std::map<std::string, std::array<double, 2>> found;
  for (std::sregex_iterator match(svg.begin(), svg.end(), element); match != std::sregex_iterator();
       ++match)
    found[(*match)[3]] = {std::stod((*match)[1]), std::stod((*match)[2])};
  return found;
}

const Orientation turned{septum_angle, {}};

}  // namespace

TEST_CASE("in a short axis an anterior infarct is up and a septal one left, in PNG and in SVG",
          "[drawing]") {
  for (const bool is_svg : {false, true}) {
    const auto seen = [&](const Vec3& infarct) {
      const Figure figure = panel(infarct, 1);
      return yellow(
          test::decoded(is_svg ? test::embedded_png(drawing::svg(figure)) : drawing::png(figure)));
    };
    const auto [x, y] = seen(turned.anterior());
    CHECK(y < -0.1);
    CHECK(std::abs(x) < 0.08);
    const auto [left, level] = seen(turned.septal());
    CHECK(left < -0.1);
    CHECK(std::abs(level) < 0.08);
  }
}

TEST_CASE(
    "in the four-chamber view a septal infarct is left, in the two-chamber view an anterior "
    "one right",
    "[drawing]") {
  CHECK(yellow(test::decoded(drawing::png(panel(turned.septal(), 2))))[0] < -0.1);
  CHECK(yellow(test::decoded(drawing::png(panel(turned.anterior(), 3))))[0] > 0.03);
}

TEST_CASE("letters stand where the walls are", "[drawing]") {
  const auto across = letters(drawing::svg(panel(turned.anterior(), 1)));
  REQUIRE(across.size() == 4);
  CHECK(across.at("A")[1] < across.at("I")[1] - 100.0);
  CHECK(across.at("A")[0] == Approx(across.at("I")[0]).margin(1.0));
  CHECK(across.at("S")[0] < across.at("L")[0] - 100.0);
  CHECK(across.at("S")[1] == Approx(across.at("L")[1]).margin(1.0));
  const auto four = letters(drawing::svg(panel(turned.anterior(), 2)));
  CHECK(four.at("S")[0] < four.at("L")[0] - 100.0);
  CHECK(four.size() == 2);  // a letter over the open cavity would name the wall that is cut away
  const auto two = letters(drawing::svg(panel(turned.anterior(), 3)));
  CHECK(two.at("I")[0] < two.at("A")[0] - 100.0);
}

TEST_CASE("a septum that was assumed has stars and a note", "[drawing]") {
  const Orientation assumed{septum_angle, {{"septum", "nothing shows it"}, {"apex", "not drawn"}}};
  Figure figure = report::infarct_figure(phantom(turned.anterior()), assumed);
  CHECK_THAT(figure.footnote, Catch::Contains("* assumed: nothing shows it"));
  figure.panels.resize(2);
  CHECK(letters(drawing::svg(figure)).contains("S*"));
  const auto four = letters(drawing::svg(
      Figure{.panels = {report::infarct_figure(phantom(turned.anterior()), assumed).panels[2]}}));
  REQUIRE(four.contains("apex*"));
  CHECK(four.at("apex*")[1] > four.at("S*")[1] + 100.0);
  CHECK_FALSE(four.contains("base*"));
  const auto across = letters(drawing::svg(Figure{.panels = {figure.panels[1]}}));
  CHECK_FALSE(across.contains("apex*"));  // it would lie in the cavity
  const Figure mesh = report::mesh_figure(phantom(turned.anterior()), assumed);
  CHECK_THAT(mesh.title, Catch::Contains("apex*"));
  CHECK_THAT(mesh.title, !Catch::Contains("base*"));
  CHECK(drawing::star_note(turned, {"septum"}).empty());
}

TEST_CASE("the name of an assumed base stands above the base as it is seen", "[drawing]") {
  const Orientation assumed{septum_angle, {{"base", "not drawn"}}};
  const auto four = letters(drawing::svg(
      Figure{.panels = {report::infarct_figure(phantom(turned.anterior()), assumed).panels[2]}}));
  REQUIRE(four.contains("base*"));
  CHECK(four.at("base*")[1] < four.at("S")[1] - 10.0);  // which stands as high as the far rim
}

TEST_CASE("a wall that was unloaded is not called early diastole", "[drawing]") {
  CHECK(turned.at_rest() == "early diastole");
  CHECK(Orientation{0.0, {{"early diastole", "nobody knows"}}}.at_rest() == "early diastole*");
  CHECK(Orientation{0.0, {}, true}.at_rest() == "the wall without load");
}

TEST_CASE("a picture of the undeformed wall whose moment was assumed has a star for its note",
          "[drawing]") {
  const Orientation assumed{septum_angle, {{"early diastole", "nobody knows when"}}};
  const mesh::Mesh wall = phantom(turned.anterior());
  const std::vector<analysis::CellFields> at_rest = analysis::FieldAnalysis(wall, {}).at_rest();
  const std::array figures{report::mesh_figure(wall, assumed),
                           report::infarct_figure(wall, assumed),
                           report::fibre_figure(wall, at_rest, assumed)};
  for (const Figure& figure : figures) {
    CHECK_THAT(figure.footnote, Catch::Contains("* assumed: nobody knows when"));
    CHECK_THAT(figure.title, Catch::Contains("early diastole*"));
  }
  CHECK_THAT(report::mesh_figure(wall, turned).title, !Catch::Contains("diastole"));
}

TEST_CASE("an infarct that no image shows has a star", "[drawing]") {
  const Orientation assumed{septum_angle, {{"infarct", "the case says so"}}};
  const Figure figure = report::infarct_figure(phantom(turned.anterior()), assumed);
  CHECK(figure.title == "infarct*");
  CHECK(figure.footnote == "* assumed: the case says so");
  CHECK(report::infarct_figure(phantom(turned.anterior()), turned).title == "infarct");
}

TEST_CASE("the script for ParaView knows where the walls are", "[drawing]") {
  const std::string script = report::paraview_script("../03_beat", turned);
  CHECK_THAT(script, Catch::Contains("os.path.join(here, \"../03_beat\")"));
  CHECK_THAT(script, Catch::Contains("{time:.3f}"));
  CHECK_THAT(script, Catch::Contains("anterior, septal = [-0.644218, 0.764842, 0.000000], "
                                     "[0.764842, 0.644218, 0.000000]"));
  CHECK_THAT(
      script,
      Catch::Contains(
          R"((("A", 48.0, anterior), ("S", 48.0, septal), ("I", -48.0, anterior), ("L", -48.0, septal)))"));
}
