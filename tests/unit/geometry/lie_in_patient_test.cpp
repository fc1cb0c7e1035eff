#include "lv/geometry/lie_in_patient.hpp"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include <numbers>

namespace {

using Catch::Matchers::Contains;
using lv::Vec3;
using lv::geometry::Lie;
using lv::geometry::oddity;

Lie lie_of(const Vec3& apex, const Vec3& septum) {
  const Vec3 a = apex.normalized();
  return {a, (septum - septum.dot(a) * a).normalized()};
}

/// As a failing heart lies, its long axis near the horizontal.
Lie failing() {
  return lie_of({0.68, -0.67, -0.30}, {-0.72, -0.69, -0.05});
}

Lie healthy() {
  return lie_of({0.59, -0.56, -0.59}, {-0.74, -0.66, -0.11});
}

Lie upright() {
  return lie_of({0.41, -0.55, -0.73}, {-0.82, -0.57, -0.04});
}

Lie mirrored(const Lie& lie, const Vec3& signs) {
  return {signs.cwiseProduct(lie.apex), Vec3(signs.cwiseProduct(*lie.septum))};
}

}  // namespace

TEST_CASE("hearts of patients and volunteers lie as hearts do, turned by 20 degrees too",
          "[unit][geometry]") {
  for (const Lie& lie : {failing(), healthy(), upright()}) {
    CHECK(oddity(lie) == "");
    CHECK(oddity({lie.apex, {}}) == "");
    CHECK(lie.anterior()->z() > 0.5);
  }
  for (const Vec3& about : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)})
    for (const double turn : {-20.0, 20.0}) {
      const Eigen::AngleAxisd by(turn * std::numbers::pi / 180.0, about);
      CHECK(oddity({by * healthy().apex, Vec3(by * *healthy().septum)}) == "");
    }
}

TEST_CASE("a mirrored or turned heart is told, with the axis", "[unit][geometry]") {
  for (const Lie& lie : {failing(), healthy(), upright()}) {
    CHECK_THAT(oddity(mirrored(lie, {-1, 1, 1})),
               Contains("the septum faces the patient's left") && Contains("right for left"));
    CHECK_THAT(oddity(mirrored(lie, {1, -1, 1})),
               Contains("the apex points to the patient's back") && Contains("back for front"));
    CHECK_THAT(oddity(mirrored(lie, {1, 1, -1})),
               Contains("the apex points to the patient's head") && Contains("head for feet"));
    CHECK_THAT(oddity(mirrored(lie, {-1, -1, 1})),
               Contains("as where RAS is taken for LPS") && Contains("keep their names"));
    CHECK_THAT(oddity(mirrored(lie, {-1, -1, -1})), Contains("the patient's head"));
    CHECK_THAT(oddity({lie.apex, Vec3(-*lie.septum)}),
               Contains("the septum faces the patient's left") && Contains("on the other side"));
    CHECK_THAT(oddity({-lie.apex, lie.septum}), Contains("its slices in the reverse order"));
  }
}

TEST_CASE("without a septum the apex alone is judged, and what it cannot tell is said",
          "[unit][geometry]") {
  CHECK_THAT(
      oddity({mirrored(healthy(), {1, 1, -1}).apex, {}}),
      Contains("the apex points to the patient's head") && Contains("only its septum would tell"));
}
