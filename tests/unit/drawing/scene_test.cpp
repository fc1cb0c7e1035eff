#include "lv/drawing/scene.hpp"

#include "lv/drawing/sticks.hpp"

#include <catch2/catch.hpp>

#include <limits>
#include <set>

namespace {

using namespace lv::drawing;
using lv::Vec3;

constexpr Colour red = hex(0xff0000);
constexpr Colour blue = hex(0x0000ff);

/// A square in the plane y = `depth`, centred at (x, z), seen by a camera that looks along y.
Item square(double side, double depth, const Paint& paint, double x = 0.0, double z = 0.0) {
  const double h = 0.5 * side;
  Item item{.paint = paint, .shaded = false};
  item.patch.points = {
      {x - h, depth, z - h}, {x + h, depth, z - h}, {x + h, depth, z + h}, {x - h, depth, z + h}};
  item.patch.triangles = {{0, 1, 2}, {0, 2, 3}};
  item.patch.outlined = {{true, true, false}, {false, true, true}};
  return item;
}

constexpr int pixels = 40;
const Camera front{.width = 20.0, .height = 20.0};

/// 20 x 20 mm on 40 x 40 pixels.
Image picture(const Scene& scene) {
  return render(scene, front, {.width = pixels, .height = pixels});
}

bool same(const Colour& a, const Colour& b) {
  return std::abs(a.r - b.r) + std::abs(a.g - b.g) + std::abs(a.b - b.b) < 0.01;
}

double covered_area(const Image& image) {
  double area = 0.0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      area += image.opacity(x, y) * image.mm_per_pixel * image.mm_per_pixel;
  return area;
}

}  // namespace

TEST_CASE("a square covers its area and nothing else", "[unit][drawing]") {
  const Image image = picture({{square(10.0, 0.0, red)}});
  CHECK(image.mm_per_pixel == Approx(0.5));
  CHECK(covered_area(image) == Approx(100.0));
  CHECK(same(image.colour(20, 20), red));
  CHECK(same(image.colour(2, 2), hex(0xffffff)));
  // 10.2 mm: the border pixels are covered in part
  CHECK(covered_area(picture({{square(10.3, 0.0, red)}})) == Approx(10.3 * 10.3).epsilon(0.03));
}

TEST_CASE("the nearer surface hides the farther one in any order", "[unit][drawing]") {
  const Item near = square(4.0, -5.0, red);
  const Item far = square(12.0, 5.0, blue);
  for (const Scene& scene : {Scene{{near, far}}, Scene{{far, near}}}) {
    const Image image = picture(scene);
    CHECK(same(image.colour(20, 20), red));
    CHECK(same(image.colour(12, 20), blue));
  }
}

TEST_CASE("x points to the right and z up for a viewer who looks along y", "[unit][drawing]") {
  const Image image =
      picture({{square(4.0, 0.0, red, 6.0, 0.0), square(4.0, 0.0, blue, 0.0, 6.0)}});
  CHECK(same(image.colour(32, 20), red));
  CHECK(same(image.colour(20, 8), blue));
}

TEST_CASE("a cut plane removes what lies on its normal's side", "[unit][drawing]") {
  const Plane at_zero{.point = Vec3::Zero(), .normal = -Vec3::UnitY()};
  const Image image = picture({{square(4.0, -5.0, red), square(12.0, 5.0, blue)}, at_zero});
  CHECK(same(image.colour(20, 20), blue));
  const Plane half{.point = Vec3::Zero(), .normal = Vec3::UnitX()};
  const Image left = picture({{square(10.0, 0.0, red)}, half});
  CHECK(covered_area(left) == Approx(50.0));
  CHECK(left.opacity(24, 20) == 0.0);
  const Plane in_it{.point = Vec3::Zero(), .normal = Vec3::UnitY()};
  CHECK(covered_area(picture({{square(10.0, 0.0, red)}, in_it})) == Approx(100.0));
}

TEST_CASE("unshaded values have exactly the colours of their scale", "[unit][drawing]") {
  const ColourScale scale{.min = 0.0, .max = 1.0};
  const Image image = picture({{square(20.0, 0.0, PointValues{{0.0, 1.0, 1.0, 0.0}, scale})}});
  CHECK(same(image.colour(20, 20), scale.map((20.5) / pixels)));
  CHECK(same(image.colour(30, 7), scale.map((30.5) / pixels)));
  const Image faces = picture({{square(20.0, 0.0, FaceColours{red, blue})}});
  CHECK(same(faces.colour(30, 30), red));
  CHECK(same(faces.colour(10, 10), blue));
}

TEST_CASE("outlines run along sides of elements, not along diagonals", "[unit][drawing]") {
  Item item = square(18.0, 0.0, red);
  item.outline_width = 2.0;
  item.outline = blue;
  const Image image = picture({{item}});
  CHECK(same(image.colour(2, 20), blue));
  CHECK(same(image.colour(20, 37), blue));
  CHECK(same(image.colour(20, 19), red));
  CHECK(same(image.colour(10, 29), red));  // on the diagonal
}

TEST_CASE("a surface is brighter towards the lamp, on both of its sides alike", "[unit][drawing]") {
  Item item = square(10.0, 0.0, red);
  item.shaded = true;
  const auto brightness = [](const Item& i, const Vec3& view) {
    const Scene scene{{i}};
    const Image image = render(scene, {.view = view, .width = 40.0, .height = 40.0}, {60, 60});
    return image.colour(30, 30).r;
  };
  CHECK(brightness(item, Vec3::UnitY()) == Approx(brightness(item, -Vec3::UnitY())));
  CHECK(brightness(item, Vec3::UnitY()) > brightness(item, {0.0, 0.5, -1.0}) + 0.3);
}

TEST_CASE("missing values are striped in two greys", "[unit][drawing]") {
  const double missing = std::numeric_limits<double>::quiet_NaN();
  const std::vector<double> values{missing, missing, missing, missing};
  for (const Paint& paint : {Paint(PointValues{values, {}}), Paint(FaceColours{{}, {}})}) {
    Image image = render({{square(20.0, 0.0, paint)}}, front,
                         {.width = pixels, .height = pixels, .supersampling = 1});
    const std::set<std::uint32_t> colours(image.argb.begin(), image.argb.end());
    CHECK(colours == std::set<std::uint32_t>{0xffd9d9d9, 0xff9a9a9a});
  }
}

TEST_CASE("a fitted camera shows all that is not cut away", "[unit][drawing]") {
  Scene scene{{square(10.0, 0.0, red, 50.0, -30.0)}};
  const Camera camera = fitted(scene, Vec3::UnitY());
  CHECK(camera.width == Approx(10.3));
  const Image image = render(scene, camera, {.width = 103, .height = 206});
  CHECK(covered_area(image) == Approx(100.0));
  scene.cut = Plane{{50.0, 0.0, 0.0}, Vec3::UnitX()};
  CHECK(fitted(scene, Vec3::UnitY()).centre.x() == Approx(45.0));
}

TEST_CASE("a fibre's stick has its length, direction and thickness", "[unit][drawing]") {
  const std::vector<Vec3> points{{1.0, 2.0, 3.0}};
  const std::vector<Vec3> directions{{2.0, 0.0, 0.0}};
  const auto segments = sticks(points, directions, 8.0);
  CHECK((segments[0].b - segments[0].a - Vec3(8.0, 0.0, 0.0)).norm() < 1e-12);
  CHECK((segments[0].a + segments[0].b - 2.0 * points[0]).norm() < 1e-12);
  const Patch tube = tubes(segments, 0.5);
  CHECK(tube.triangles.size() == tube_triangles);
  const Scene scene{{{.patch = tube, .paint = red}}};
  const Image image = render(scene, fitted(scene, Vec3::UnitY()), {.width = 900, .height = 200});
  CHECK(covered_area(image) == Approx(8.0).epsilon(0.02));  // length x diameter
}

TEST_CASE("a border is a white line with dark rims where its number is 0.5", "[unit][drawing]") {
  Item item = square(20.0, 0.0, red);
  item.border = {0.0, 1.0, 1.0, 0.0};  // from left to right: 0.5 between pixels 19 and 20
  const Image image = picture({{item}});
  for (const int y : {5, 20, 35}) {
    CHECK(same(image.colour(5, y), red));
    CHECK(image.colour(18, y).r < 0.5);
    CHECK(image.colour(19, y).b > 0.6);
    CHECK(image.colour(20, y).b > 0.6);
    CHECK(image.colour(21, y).r < 0.5);
    CHECK(same(image.colour(34, y), red));
  }
  item.border = {1.0, 1.0, 1.0, 1.0};
  CHECK(same(picture({{item}}).colour(20, 20), red));
}
