#include "lv/calibrate/model.hpp"
#include "lv/mesh/distance.hpp"
#include "lv/verify/small_ventricle.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace lv;
using calibrate::FitParameters;

TEST_CASE("to first order a segment's factor moves the wall as its equilibrium does",
          "[unit][calibrate]") {
  mesh::Mesh mesh = verify::ideal_mesh({.edge_length = 9.0, .layers = 2, .order = 2});
  mesh.segment = mesh::divide(mesh, {}).aha;
  const auto model_of = [](const FitParameters& p) -> implicit::StaticModel {
    solid::CardiacModel heart{.base = {.stiffness = implicit::rigid_base}};
    heart.myocardium.active = material::NiedererHunterSmith{.T_scale = p.T_scale};
    heart.contractility = p.segments;
    return heart;
  };
  calibrate::Ventricle ventricle(mesh, model_of, {});
  const solid::Loads loads{4.0, 0.3};
  const FitParameters about{.T_scale = 3.0};
  FitParameters weaker = about;
  weaker.segments[8] = std::exp(-0.02);
  const auto at = ventricle.positions(about, loads).value();
  ventricle.linearise(about, {7, 9});
  const auto foretold = ventricle.positions(weaker, loads).value();
  const double volume = ventricle.volume(weaker, loads).value();
  ventricle.linearise({}, {});
  const auto found = ventricle.positions(weaker, loads).value();
  CHECK(mesh::largest_distance(at, found) > 0.01);
  CHECK(mesh::largest_distance(foretold, found) < 0.03 * mesh::largest_distance(at, found));
  CHECK(volume == Approx(ventricle.volume(weaker, loads).value()).epsilon(1e-5));
}
