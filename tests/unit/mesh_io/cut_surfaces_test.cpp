#include "lv/mesh_io/cut_surfaces.hpp"

#include "lv/base/check.hpp"
#include "lv/geometry/contour_checks.hpp"
#include "lv/geometry/spline_wall.hpp"

#include "mesh_io/surface_files.hpp"
#include "support/temporary_folder.hpp"
#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace {

using namespace lv;
using Catch::Matchers::Contains;
using mesh_io::Triangles;

const Vec3 aside(40.0, -30.0, 120.0);

Mat3 turned_axes() {
  return Eigen::AngleAxisd(1.1, Vec3(0.4, 0.5, -0.6).normalized()).toRotationMatrix();
}

Triangles written(const test::Bowl& bowl, const std::string& name = "x.obj",
                  const std::string& space = "LPS") {
  const test::TemporaryFolder folder;
  test::write_bytes(folder / name,
                    name.ends_with("obj") ? test::obj_text(bowl) : test::stl_text(bowl));
  return mesh_io::read_triangles((folder / name).string(), 1.0, space);
}

test::Bowl bowl(double radius, double length, bool lid) {
  test::Bowl made = test::half_ellipsoid(radius, length, 1.0 / 3.0, lid);
  for (Vec3& x : made.points)
    x = aside + turned_axes() * x;
  return made;
}

/// Volume between the apex and the plane at the height b of an ellipsoid of semi-axes r and l.
double cut_volume(double r, double l, double b) {
  return std::numbers::pi * r * r * (2.0 / 3.0 * l + b - b * b * b / (3.0 * l * l));
}

}  // namespace

TEST_CASE("open and lidded surfaces are cut into the wall that they enclose", "[unit][mesh_io]") {
  for (const bool lid : {false, true}) {
    const mesh_io::CutSurfaces cut =
        mesh_io::cut_across(written(bowl(25.0, 60.0, lid)), written(bowl(35.0, 70.0, lid)));
    CHECK_THAT(cut.notes.at(1), Contains(lid ? "flat lid is taken off" : "is open at the base"));
    geometry::check_contours(cut.contours);
    const geometry::FitReport report = geometry::fit_spline_wall(cut.contours, {}).report();
    // both bowls end at a third of their length: the lower rim is that of the endocardium
    const double cavity = cut_volume(25.0, 60.0, 20.0);
    CHECK(report.volume_cavity == Approx(cavity).epsilon(0.02));
    CHECK(report.volume_wall == Approx(cut_volume(35.0, 70.0, 20.0) - cavity).epsilon(0.03));
  }
}

TEST_CASE("coordinates in RAS are turned to LPS", "[unit][mesh_io]") {
  const test::Bowl made = bowl(25.0, 60.0, false);
  const Triangles lps = written(made);
  const Triangles ras = written(made, "x.obj", "RAS");
  CHECK(ras.nodes.front().isApprox(Vec3(-1, -1, 1).cwiseProduct(lps.nodes.front())));
  CHECK(written(made, "x.stl").faces.size() == lps.faces.size());
}

TEST_CASE("surfaces that show no base, or no wall, are refused", "[unit][mesh_io]") {
  const Triangles endo = written(bowl(25.0, 60.0, false));
  const Triangles epi = written(bowl(35.0, 70.0, false));
  CHECK_THROWS_WITH(mesh_io::cut_across(epi, endo),
                    Contains("does not reach below") && Contains("Exchange anatomy.surfaces.endo"));
  Triangles holed = epi;
  holed.faces.nodes.erase(holed.faces.nodes.begin() + 900, holed.faces.nodes.begin() + 903);
  CHECK_THROWS_WITH(mesh_io::cut_across(endo, holed),
                    Contains("has 2 openings: ") && Contains(" mm around at ("));
  test::Bowl round = test::half_ellipsoid(25.0, 60.0, 0.999, true);
  CHECK_THROWS_WITH(mesh_io::cut_across(written(round), epi),
                    Contains("closed without a flat lid"));
}

TEST_CASE("points that differ in their last digits are one", "[unit][mesh_io]") {
  const test::Bowl made = bowl(25.0, 60.0, false);
  test::Bowl apart;  // every triangle has its own corners
  for (const auto& face : made.faces) {
    std::array<int, 3> corners{};
    for (int i = 0; i < 3; ++i) {
      corners[i] = static_cast<int>(apart.points.size());
      apart.points.push_back(made.points[face[i]] + 1e-9 * Vec3(i, corners[i] % 3, -i));
    }
    apart.faces.push_back(corners);
  }
  CHECK(written(apart).nodes.size() == written(made).nodes.size());
  CHECK(written(apart).faces.size() == written(made).faces.size());
}

TEST_CASE("a binary STL file that lacks triangles is refused", "[unit][mesh_io]") {
  const test::TemporaryFolder folder;
  const std::string whole = test::binary_stl(bowl(25.0, 60.0, false));
  const auto triangles = [&](std::size_t lacking) {
    test::write_bytes(folder / "x.stl", whole.substr(0, whole.size() - lacking));
    return mesh_io::read_triangles((folder / "x.stl").string(), 1.0, "LPS").faces.size();
  };
  CHECK(triangles(0) == static_cast<int>((whole.size() - 84) / 50));
  for (const std::size_t lacking : {1, 50, 1000})
    CHECK_THROWS_WITH(triangles(lacking), Contains("the file is truncated"));
}

TEST_CASE("what of the cavity lies above the base plane is said, warned of or refused",
          "[unit][mesh_io]") {
  const double whole = cut_volume(25.0, 60.0, 20.0);
  const auto cut_at = [](double part) {  // of the epicardium's length
    test::Bowl epi = test::half_ellipsoid(35.0, 70.0, part, false);
    for (Vec3& x : epi.points)
      x = aside + turned_axes() * x;
    return mesh_io::cut_across(written(bowl(25.0, 60.0, false)), written(epi, "epi.obj"));
  };
  const mesh_io::CutSurfaces high = cut_at(1.0 / 3.0);
  CHECK(high.warning.empty());
  CHECK_THAT(high.notes.front(), Contains("0.0 ml of it (0%) lie above the base plane"));
  const double left_out = whole - cut_volume(25.0, 60.0, 7.0);  // the rim at a tenth of 70 mm
  CHECK(left_out / whole == Approx(0.21).margin(0.01));
  CHECK_THAT(cut_at(0.1).warning,
             Contains("(21%) lie above") && Contains("epi.obj") && Contains("are left out"));
  CHECK_THROWS_WITH(cut_at(-0.1), Contains("lie above") && Contains("rims must lie at one height"));
}

TEST_CASE("the cavity of a surface counts whichever way its triangles are turned",
          "[unit][mesh_io]") {
  const Triangles epi = written(bowl(35.0, 70.0, false));
  Triangles endo = written(bowl(25.0, 60.0, false));
  const std::string said = mesh_io::cut_across(endo, epi).notes.front();
  for (std::size_t f = 0; f < endo.faces.nodes.size(); f += 6)  // every other triangle
    std::swap(endo.faces.nodes[f], endo.faces.nodes[f + 1]);
  CHECK(mesh_io::cut_across(endo, epi).notes.front() == said);
}

TEST_CASE("a vertex that is no place is refused in every form of surface", "[unit][mesh_io]") {
  const test::TemporaryFolder folder;
  test::Bowl made = bowl(25.0, 60.0, false);
  const auto read = [&](const std::string& name, const std::string& bytes) {
    test::write_bytes(folder / name, bytes);
    return mesh_io::read_triangles((folder / name).string(), 1.0, "LPS");
  };
  for (const double wrong : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    made.points[700].x() = wrong;
    CHECK_THROWS_WITH(read("x.obj", test::obj_text(made)),
                      Contains("x.obj:701") && Contains("vertex 701 is not a place"));
    CHECK_THROWS_WITH(read("x.stl", test::stl_text(made)), Contains("is not a place"));
    CHECK_THROWS_WITH(read("y.stl", test::binary_stl(made)), Contains("is not a place"));
  }
  CHECK_THROWS_WITH(read("x.obj", "v 1 2\n"), Contains("x.obj:1") && Contains("not a place"));
}
