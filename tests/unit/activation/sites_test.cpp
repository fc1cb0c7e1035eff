#include "lv/activation/sites.hpp"

#include "lv/base/check.hpp"
#include "lv/verify/small_ventricle.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <stdexcept>

namespace {

using namespace lv;
using activation::Site;
using activation::site_of;

/// The default ventricle in few elements.
struct Ventricle {
  mesh::Mesh mesh = verify::ideal_mesh({.edge_length = 9.0});
  mesh::Regions regions = mesh::divide(mesh, {});

  [[nodiscard]] activation::ActivatedWall wall() const {
    activation::ActivatedWall wall{mesh, regions, {}, "case.toml:3"};
    for (const Mat3& frame : activation::cell_frames(mesh))
      wall.metrics.push_back(activation::travel_metric(frame, {}));
    return wall;
  }
};

}  // namespace

TEST_CASE("sites are named in words", "[unit][activation]") {
  CHECK(std::get<activation::Segment>(site_of("mid anterior")).number == 7);
  CHECK(std::get<activation::Segment>(site_of("17")).number == 17);
  CHECK(std::get<activation::Segment>(site_of("apex")).number == 17);
  CHECK(std::holds_alternative<activation::Endocardium>(site_of("endocardium")));
  CHECK(std::get<activation::Point>(site_of("1.2 -0.4 -3 cm")).x.isApprox(Vec3(12, -4, -30)));
  CHECK_THROWS_WITH(site_of("mid anterio"), Catch::Contains("did you mean \"mid anterior\"?"));
  CHECK_THROWS_AS(site_of("18"), std::invalid_argument);
  CHECK_THROWS_WITH(site_of("1 2 3 s"), Catch::Contains("no length"));
}

TEST_CASE("every segment has a site on the endocardium", "[unit][activation]") {
  const Ventricle ventricle;
  const activation::ActivatedWall wall = ventricle.wall();
  const std::vector<int> endo = mesh::surface_nodes(ventricle.mesh.endo);
  for (int s = 1; s <= 17; ++s) {
    const auto starts = activation::starts_at(activation::Segment{s}, wall);
    const auto first = std::min_element(starts.begin(), starts.end(),
                                        [](auto& a, auto& b) { return a.time < b.time; });
    REQUIRE(first != starts.end());
    CHECK(first->time == 0.0);
    CHECK(std::binary_search(endo.begin(), endo.end(), first->node));
  }
  CHECK(activation::starts_at(activation::Endocardium{}, wall).size() == endo.size());
}

TEST_CASE("a point far from the wall is refused with its distance", "[unit][activation]") {
  const Ventricle ventricle;
  CHECK_THROWS_WITH(activation::starts_at(activation::Point{{0.0, 0.0, 30.0}}, ventricle.wall()),
                    Catch::Contains("case.toml:3") && Catch::Contains("mm from the nearest node"));
}

TEST_CASE("a front from the endocardium crosses the wall in the time of its layers",
          "[unit][activation]") {
  const Ventricle ventricle;
  const activation::ActivatedWall wall = ventricle.wall();
  const auto times = activation::arrival_times(
      ventricle.mesh, wall.metrics, {}, activation::starts_at(activation::Endocardium{}, wall));
  for (const int node : ventricle.mesh.epi.nodes) {
    CHECK(times[node] > 8.0 / 670.0);   // nowhere faster than along fibres
    CHECK(times[node] < 16.0 / 170.0);  // nor slower than across the sheets
  }
}
