#include "lv/drawing/figure.hpp"

#include "lv/base/check.hpp"

#include "support/pixels.hpp"
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <sstream>

namespace {

using namespace lv::drawing;
using lv::test::decoded;
using lv::test::Pixels;
constexpr double missing = std::numeric_limits<double>::quiet_NaN();

std::uint32_t packed(const Colour& c) {
  const auto byte = [](double part) { return static_cast<std::uint32_t>(std::lround(255 * part)); };
  return byte(c.r) << 16U | byte(c.g) << 8U | byte(c.b);
}

Figure of(const Panel& panel) {
  return {.panels = {panel}, .columns = 1, .panel_width = 240.0, .panel_height = 200.0};
}

BullsEye bulls_eye(double third) {
  BullsEye plot{.scale = {sequential(), 0.0, 10.0}, .decimals = -1};
  plot.values.assign(17, 5.0);
  plot.values[2] = third;
  return plot;
}

Picture triangle() {
  Patch patch{{{0, 0, 0}, {10, 0, 0}, {0, 0, 10}}, {{0, 1, 2}}, {}};
  Scene scene{{{.patch = patch, .paint = hex(0xff0000), .shaded = false}}};
  return {scene, fitted(scene, lv::Vec3::UnitY())};
}

LineChart chart_with_gap() {
  LineChart chart{.x = {"time [s]"}, .y = {"pressure [kPa]"}};
  chart.series.push_back({.label = "", .x = {0, 1, 2, 3, 4}, .y = {1, 1, missing, 1, 1}});
  return chart;
}

}  // namespace

TEST_CASE("ticks are round numbers with the decimals of their step", "[unit][drawing]") {
  CHECK(ticks_within({0.0, 1.0}).labels ==
        std::vector<std::string>{"0.0", "0.2", "0.4", "0.6", "0.8", "1.0"});
  CHECK(ticks_within({-60.0, 60.0}).labels ==
        std::vector<std::string>{"\u221260", "\u221240", "\u221220", "0", "20", "40", "60"});
  CHECK(ticks_within({0.0, 3e-6}).labels[1] == "1\u00d710\u207b\u2076");
  CHECK(ticks_within({7.0, 7.0}).values.size() >= 2);
  CHECK(number(-0.04, 1) == "0.0");
  CHECK(round_down(38.0) == Approx(20.0));
  CHECK(round_down(50.0) == Approx(50.0));
}

TEST_CASE("every axis has three to nine ticks", "[unit][drawing]") {
  for (int i = 0; i < 60; ++i) {
    const double span = 0.013 * std::pow(1.37, i);
    const auto count = ticks_within({0.3 * span, 1.3 * span}).values.size();
    CHECK(count >= 3);
    CHECK(count <= 9);
  }
}

TEST_CASE("a PNG file is one, of the right size, and shows something", "[unit][drawing]") {
  const std::string bytes = png(of({.title = "triangle", .content = triangle()}), 2.0);
  CHECK(bytes.substr(0, 8) == "\x89PNG\r\n\x1a\n");
  const Pixels p = decoded(bytes);
  CHECK(p.width == 2 * (240 + 24));
  auto counts = p.counts();
  CHECK(counts[0xffffff] > counts[0xff0000]);
  CHECK(counts[0xff0000] > 10000);  // half of a square of 350 pixels, about
}

TEST_CASE("missing values of a bull's-eye are striped and never a colour of the scale",
          "[unit][drawing]") {
  const auto stripes = [](double value) {
    const Panel panel{.content = bulls_eye(value)};
    auto counts = decoded(png(of(panel))).counts();
    const std::uint32_t zero = packed(sequential()(0.0));
    CHECK(counts[zero] < (value == 0.0 ? 100000 : 20));
    return counts[packed(missing_ground)];
  };
  CHECK(stripes(missing) > 500);
  CHECK(stripes(0.0) < 20);  // letters have some grey pixels
}

TEST_CASE("a bull's-eye and its colour bar show what is below the floor", "[unit][drawing]") {
  const auto grey = [](double floor) {
    BullsEye plot = bulls_eye(0.05);
    plot.scale.floor = floor;
    const Panel panel{.content = plot, .colour_bar = ColourBar{"stress [kPa]", plot.scale}};
    return decoded(png(of(panel))).counts()[packed(uncoloured)];
  };
  CHECK(grey(0.0) == 0);
  CHECK(grey(0.1) > 200);              // a segment
  CHECK(grey(2.0) > grey(0.1) + 300);  // and a fifth of the bar
}

TEST_CASE("a bull's-eye counts anticlockwise from the top", "[unit][drawing]") {
  BullsEye plot{.values = std::vector<double>(17, 0.0), .decimals = -1};
  plot.colours.assign(17, hex(0xcccccc));
  plot.colours[0] = hex(0xff0000);
  plot.colours[1] = hex(0x00ff00);
  const Pixels p = decoded(png(of({.content = plot})));
  double x[2] = {0.0, 0.0};
  double y[2] = {0.0, 0.0};
  int count[2] = {0, 0};
  for (std::size_t i = 0; i < p.rgb.size(); ++i) {
    const int k = p.rgb[i] == 0xff0000 ? 0 : p.rgb[i] == 0x00ff00 ? 1 : -1;
    if (k < 0)
      continue;
    const int at = static_cast<int>(i);
    x[k] += at % p.width;
    y[k] += at / p.width;  // NOLINT(bugprone-integer-division): the row
    ++count[k];
  }
  CHECK(x[0] / count[0] == Approx(0.5 * p.width).margin(2.0));  // anterior: top
  CHECK(y[0] / count[0] < 0.25 * p.height);
  CHECK(x[1] / count[1] < 0.4 * p.width);  // anteroseptal: upper left
  CHECK(y[1] / count[1] < 0.5 * p.height);
}

TEST_CASE("a bull's-eye has its sectors' numbers in them and the arteries' names beside them",
          "[unit][drawing]") {
  BullsEye plot = bulls_eye(5.0);
  plot.decimals = 1;
  plot.is_numbered = true;
  plot.territories = coronary_territories();
  const std::string text = svg(of({.content = plot}));
  const auto place = [&](const std::string& words) {
    const std::size_t end = text.find(">" + words + "</text>");
    REQUIRE(end != std::string::npos);
    const std::string translate = "translate(";
    std::istringstream numbers(text.substr(text.rfind(translate, end) + translate.size()));
    Point at;
    numbers >> at.x >> at.y;
    return at;
  };
  const Point apex = place("17");
  const auto away = [&](const std::string& words) {
    const Point p = place(words);
    return std::hypot(p.x - apex.x, p.y - apex.y);
  };
  CHECK(place("1").y < place("7").y);  // anterior, from the base to the apex
  CHECK(place("7").y < place("13").y);
  CHECK(place("13").y < apex.y);
  CHECK(place("14").x < apex.x);  // septal
  CHECK(place("16").x > apex.x);  // lateral
  for (const char* artery : {"LAD", "RCA", "LCX"})
    CHECK(away(artery) > away("1") + 5.0);
  CHECK(place("LAD").y < apex.y);
  CHECK(place("RCA").x < apex.x);
  CHECK(place("LCX").x > apex.x);
}

TEST_CASE("a missing point interrupts its curve", "[unit][drawing]") {
  const Pixels p = decoded(png(of({.content = chart_with_gap()})));
  const std::uint32_t blue = packed(category(0));
  std::vector<int> columns;
  for (int x = 0; x < p.width; ++x)
    for (int y = 0; y < p.height; ++y)
      if (p.rgb[y * p.width + x] == blue && (columns.empty() || columns.back() != x))
        columns.push_back(x);
  REQUIRE(columns.size() > 20);
  int widest_gap = 0;
  for (std::size_t i = 1; i < columns.size(); ++i)
    widest_gap = std::max(widest_gap, columns[i] - columns[i - 1]);
  CHECK(widest_gap > (columns.back() - columns.front()) * 0.45);
}

TEST_CASE("in SVG charts and bull's-eyes are vectors, scenes are bitmaps", "[unit][drawing]") {
  const auto has_bitmap = [](const Panel& panel) {
    const std::string text = svg(of(panel));
    CHECK(text.find("<svg") != std::string::npos);
    return text.find("<image") != std::string::npos;
  };
  CHECK_FALSE(has_bitmap({.content = chart_with_gap()}));
  CHECK_FALSE(has_bitmap({.content = bulls_eye(missing),
                          .colour_bar = ColourBar{"stress [kPa]", {sequential(), 0.0, 10.0}}}));
  CHECK(has_bitmap({.content = triangle()}));
}

TEST_CASE("an SVG figure is the same bytes whatever was drawn before it", "[unit][drawing]") {
  const Figure figure = of({.content = bulls_eye(missing),
                            .colour_bar = ColourBar{"stress [kPa]", {sequential(), 0.0, 10.0}}});
  const std::string first = svg(figure);
  static_cast<void>(svg(of({.content = triangle()})));
  CHECK(svg(figure) == first);
  std::set<std::string> ids;  // every part that is named is there, once
  for (std::size_t at = first.find("id=\""); at != std::string::npos;
       at = first.find("id=\"", at + 4))
    CHECK(ids.insert(first.substr(at + 4, first.find('"', at + 4) - at - 4)).second);
  for (const char* use : {"href=\"#", "url(#"}) {
    const std::size_t length = std::string(use).size();
    for (std::size_t at = first.find(use); at != std::string::npos; at = first.find(use, at + 1))
      CHECK(ids.contains(
          first.substr(at + length, first.find_first_of("\")", at + length) - at - length)));
  }
}

TEST_CASE("two figures of one document share no id", "[unit][drawing]") {
  const auto ids = [](double value) {
    const std::string text =
        svg(of({.content = bulls_eye(value),
                .colour_bar = ColourBar{"stress [kPa]", {sequential(), 0.0, 10.0}}}));
    std::set<std::string> found;
    for (std::size_t at = text.find("id=\""); at != std::string::npos;
         at = text.find("id=\"", at + 4))
      found.insert(text.substr(at + 4, text.find('"', at + 4) - at - 4));
    return found;
  };
  const auto first = ids(2.0);
  REQUIRE_FALSE(first.empty());
  for (const std::string& id : ids(3.0))
    CHECK_FALSE(first.contains(id));
}

TEST_CASE("in SVG text is text", "[unit][drawing]") {
  LineChart chart = chart_with_gap();
  chart.y.label = "a < b & c [µM]";
  const std::string text = svg(of({.title = "title", .content = chart}));
  CHECK(text.find(">title</text>") != std::string::npos);
  CHECK(text.find(">a &lt; b &amp; c [µM]</text>") != std::string::npos);
  CHECK(text.find("<symbol") == std::string::npos);  // of glyphs
}

TEST_CASE("no curve lies on the frame, and a lone point between gaps shows", "[unit][drawing]") {
  const Pixels p = decoded(
      png(of({.content = LineChart{.series = {{.x = {0.0, 1.0}, .y = {0.0, 0.0}, .width = 1.0},
                                              {.x = {0.5, 0.6}, .y = {2.0, missing}}}}})));
  const auto lowest = [&](const Colour& colour) {
    int row = -1;
    for (int y = 0; y < p.height; ++y)
      for (int x = 0; x < p.width; ++x)
        if (p.rgb[y * p.width + x] == packed(colour))
          row = y;
    return row;
  };
  const auto darkest_row = [&] {  // the axis
    std::pair<int, int> most{0, 0};
    for (int y = 0; y < p.height; ++y) {
      const auto row = p.rgb.begin() + static_cast<std::ptrdiff_t>(y) * p.width;
      const auto dark = std::count_if(
          row, row + p.width, [](auto rgb) { return (rgb & 255U) < 140U && rgb >> 16U < 140U; });
      most = std::max(most, {static_cast<int>(dark), y});
    }
    return most.second;
  };
  REQUIRE(lowest(category(0)) > 0);
  CHECK(lowest(category(0)) + 4 < darkest_row());
  CHECK(lowest(category(1)) > 0);
}

TEST_CASE("a figure that cannot be written names its file", "[unit][drawing]") {
  const std::filesystem::path file = "/no/such/folder/figure.png";
  CHECK_THROWS_AS(write(of({.content = triangle()}), file), lv::RunError);
  CHECK_THROWS_WITH(write(of({.content = triangle()}), file), Catch::Contains(file.string()));
}

TEST_CASE("a figure is written whole under its own name only", "[unit][drawing]") {
  const auto folder = std::filesystem::temp_directory_path() / "lv_figure_test";
  std::filesystem::create_directories(folder);
  for (const char* name : {"a.png", "a.svg"}) {
    write(of({.content = chart_with_gap()}), folder / name);
    CHECK(std::filesystem::file_size(folder / name) > 1000);
    CHECK_FALSE(std::filesystem::exists(folder / (std::string(name) + ".part")));
  }
  std::filesystem::remove_all(folder);
}
