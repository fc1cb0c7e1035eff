#include "lv/verify/arostica.hpp"

#include "lv/base/check.hpp"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>

namespace {

using namespace lv;
using verify::ArosticaWall;

/// A point of the epicardium by its angles.
Vec3 on_epicardium(const ArosticaWall& wall, double mu, double theta) {
  return {wall.epi_radius * std::sin(mu) * std::cos(theta),
          wall.epi_radius * std::sin(mu) * std::sin(theta), wall.epi_length * std::cos(mu)};
}

/// Along the ray from the middle.
Vec3 onto_epicardium(const ArosticaWall& wall, const Vec3& X) {
  return X / std::hypot(X.x() / wall.epi_radius, X.y() / wall.epi_radius, X.z() / wall.epi_length);
}

/// Mean of (n - N)(n - N)^T in an equilateral triangle around a place, its corners put on the
/// epicardium, at the middles of its edges: exact for quadratic polynomials.
Mat3 scatter_in(const ArosticaWall& wall, const Vec3& place, double edge, double turn) {
  const Vec3 N = wall.normal(place, 1.0);
  const Vec3 e = N.unitOrthogonal();
  std::array<Vec3, 3> corner;
  for (int k = 0; k < 3; ++k)
    corner[k] = onto_epicardium(
        wall, place + edge / std::sqrt(3.0) *
                          (Eigen::AngleAxisd(turn + 2.0 * std::numbers::pi * k / 3.0, N) * e));
  const Vec3 n = (corner[1] - corner[0]).cross(corner[2] - corner[0]).normalized();
  Mat3 sum = Mat3::Zero();
  for (int k = 0; k < 3; ++k) {
    const Vec3 d =
        n - wall.normal(onto_epicardium(wall, 0.5 * (corner[k] + corner[(k + 1) % 3])), 1.0);
    sum += d * d.transpose() / 3.0;
  }
  return sum;
}

}  // namespace

TEST_CASE("the scatter of facet normals is that of triangles on the epicardium", "[unit][verify]") {
  const ArosticaWall wall;
  constexpr double edge = 1.0;
  constexpr int turns = 12;
  for (const double mu : {1.4, 2.0, 2.6, 3.1}) {
    const Vec3 place = on_epicardium(wall, mu, 0.7);
    Mat3 mean = Mat3::Zero();
    for (int i = 0; i < turns; ++i)
      mean += scatter_in(wall, place, edge, 2.0 * std::numbers::pi / 3.0 * i / turns) / turns;
    const Mat3 S = wall.facet_scatter(place, edge, ArosticaWall::equilateral_tilt);
    CHECK((S - mean).norm() < 0.01 * mean.norm());
    CHECK((S * wall.normal(place, 1.0)).norm() < 1e-12);
  }
}

TEST_CASE("facets are half as long at the apex as at the base", "[unit][verify]") {
  const ArosticaWall wall;
  CHECK(wall.facet_edge(on_epicardium(wall, std::numbers::pi, 0.0), 5.0) == Approx(2.5));
  CHECK(wall.facet_edge(on_epicardium(wall, std::acos(wall.epi_cosine), 0.0), 5.0) == Approx(5.0));
  CHECK(wall.facet_edge(on_epicardium(wall, 2.0, 0.0), 5.0) > 2.5);
}

TEST_CASE("a table of constants takes units, and refuses what makes no sense", "[unit][verify]") {
  const auto read = [](const std::string& rows, const std::string& head = "constant,value\n") {
    const auto file = std::filesystem::temp_directory_path() / "lv_arostica_constants.csv";
    std::ofstream(file) << head << rows;
    return verify::ArosticaConstants::read(file);
  };
  const auto c = read("a_f,20000 Pa\nhelix_endo,-45 deg\nlayers,3\n");
  CHECK(c.muscle.a_f == Approx(20.0));
  CHECK(c.helix_endo == Approx(-0.25 * std::numbers::pi));
  CHECK(c.layers == 3.0);
  CHECK(c.eta == verify::ArosticaConstants{}.eta);
  CHECK_THROWS_WITH(read("a_f,20\n"),
                    Catch::Contains("is no quantity of its kind. Give it in kPa"));
  CHECK_THROWS_WITH(read("af,20 kPa\n"), Catch::Contains("af: is not one of the benchmark's"));
  CHECK_THROWS_WITH(read("a_f,-20 kPa\n"),
                    Catch::Contains("a_f: is -20 kPa; it must be at least 0"));
  CHECK_THROWS_WITH(read("time_step,0 s\n"), Catch::Contains("must be above 0"));
  CHECK_THROWS_WITH(read("layers,1.5\n"), Catch::Contains("a whole number"));
  CHECK_THROWS_WITH(read("share_at_points,1\n"), Catch::Contains("less than 1"));
  CHECK_THROWS_WITH(read("a,1 kPa\n", "name,value\n"), Catch::Contains("no column \"constant\""));
}
