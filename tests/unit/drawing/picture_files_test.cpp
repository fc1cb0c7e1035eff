#include "lv/drawing/picture_files.hpp"

#include "lv/base/table.hpp"
#include "lv/page/page_pictures.hpp"

#include "support/temporary_folder.hpp"
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <filesystem>

using namespace lv;

namespace {

/// 40 x 30 pixels of 2 x 1.5 mm, askew in space; the value is the number of the pixel.
image::Picture picture() {
  image::Picture p;
  p.plane = {Vec3(5.0, -3.0, 7.0), Vec3(0.6, 0.8, 0.0), Vec3(0.0, 0.0, -1.0), 2.0, 1.5, 40, 30};
  for (int i = 0; i < 40 * 30; ++i)
    p.values.push_back(static_cast<float>(i));
  return p;
}

}  // namespace

TEST_CASE("a cut image has its pixels where they were", "[drawing]") {
  const image::Picture whole = picture();
  const image::Picture part =
      drawing::cut_around(whole, {whole.plane.point(20, 15), whole.plane.point(22, 16)});
  CHECK(part.plane.columns < whole.plane.columns);
  CHECK(part.values.size() == static_cast<std::size_t>(part.plane.columns) * part.plane.rows);
  const Vec3 there = whole.plane.pixel(part.plane.point(3, 2));
  CHECK(there.z() == Approx(0.0).margin(1e-9));
  CHECK(part.at(3, 2) == whole.at(static_cast<int>(std::lround(there.x())),
                                  static_cast<int>(std::lround(there.y()))));
  CHECK(drawing::cut_around(whole, {}).values == whole.values);
}

TEST_CASE("grey runs from the darkest pixel to all but the brightest hundredth", "[drawing]") {
  image::Picture p = picture();
  p.values.back() = 1e6F;
  const auto levels = drawing::grey_levels(p);
  CHECK(levels.front() == 0);
  CHECK(levels.back() == 255);
  CHECK(levels.at(600) == Approx(255.0 * 600 / 1187).margin(1.0));  // 99% of 1199
}

TEST_CASE("outlines lie on the page's image where they lie in space", "[drawing]") {
  const test::TemporaryFolder folder;
  const std::filesystem::path results = folder / "work" / "04_results";
  std::filesystem::create_directories(results);
  const image::Picture p = picture();
  drawing::write_pictures({{"end_systole", "4", 9, p}, {"end_systole", "long axis 1", 9, p}},
                          results / "pictures");
  const auto read = drawing::read_pictures(results / "pictures");
  REQUIRE(read.size() == 2);
  CHECK(read[0].file.filename() == "end_systole_04.png");
  CHECK(read[1].file.filename() == "end_systole_long_axis_1.png");
  CHECK((read[0].plane.origin - p.plane.origin).norm() < 1e-5);
  CHECK((read[0].plane.along_column - p.plane.along_column).norm() < 1e-6);

  Table outlines({"state", "slice", "source", "contour", "line", "point", "x_mm", "y_mm", "z_mm"});
  const auto add = [&](const std::string& slice, double column) {
    const Vec3 x = p.plane.point(column, 2.0);
    outlines.add_row({"end_systole", slice, "model", "endo", "1", "1", Table::number(x.x()),
                      Table::number(x.y()), Table::number(x.z())});
  };
  add("4", 0.0);
  add("4", 3.0);
  add("long axis 1", 5.0);
  outlines.write_csv(results / "outlines.csv");
  const auto json = nlohmann::json::parse(page::pictures_json(folder / "work"));
  CHECK(json.at(0).at("phase") == 9);
  CHECK(json.at(0).at("png").get<std::string>().starts_with("iVBORw0KGgo"));  // of every PNG
  // the centre of pixel (0, 2) is half a pixel from the image's left edge
  CHECK(json.at(0).at("lines").at(0).at("points") == nlohmann::json::array({0.5, 2.5, 3.5, 2.5}));
  CHECK(json.at(1).at("slice") == "long axis 1");
  CHECK(json.at(1).at("lines").at(0).at("points") == nlohmann::json::array({5.5, 2.5}));
}

TEST_CASE("a case without images has none on its page", "[drawing]") {
  const test::TemporaryFolder folder;
  std::filesystem::create_directories(folder / "work" / "04_results");
  CHECK(page::pictures_json(folder / "work").empty());
}
