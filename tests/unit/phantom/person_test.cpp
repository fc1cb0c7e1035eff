#include "lv/phantom/person.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

using namespace lv;
using namespace lv::phantom;
using geometry::Side;

TEST_CASE("a person is the same for the same number, and kinds take turns", "[phantom]") {
  const Person a = person(3);
  const Person b = person(3);
  CHECK(a.shape.endo_radius == b.shape.endo_radius);
  CHECK(a.kind == PersonKind::hypertrophic);
  CHECK(person(1).kind == PersonKind::healthy);
  CHECK(person(6).kind == PersonKind::large);
  CHECK(person(7).kind == PersonKind::healthy);
  CHECK(person(7).shape.endo_radius != person(1).shape.endo_radius);
}

TEST_CASE("a person's volumes are within what its kind holds, and its wall is one everywhere",
          "[phantom]") {
  for (std::uint32_t seed = 1; seed <= 60; ++seed) {
    const Person p = person(seed);
    const PersonVolumes v = volumes(p);
    CAPTURE(seed);
    CHECK(v.edv > 55e3);
    CHECK(v.edv < 400e3);
    CHECK(v.esv > 0.15 * v.edv);
    CHECK(v.esv < 0.9 * v.edv);
    CHECK(v.wall > 40e3);
    CHECK((v.scar > 0.0) == (p.kind == PersonKind::infarcted));
    CHECK(v.scar < 0.6 * v.wall);
    double thinnest = 1e9;
    for (int k = 1; k < 40; ++k)
      for (int n = 0; n < 72; ++n) {
        const double Z = 0.95 * k / 40.0 * p.apex();
        const double theta = 2.0 * std::numbers::pi * n / 72.0;
        const double outer = std::sqrt(p.radius_squared(Side::epi, theta, Z));
        const double inner = std::sqrt(std::max(0.0, p.radius_squared(Side::endo, theta, Z)));
        thinnest = std::min(thinnest, outer - inner);
      }
    CHECK(thinnest > 2.0);
  }
}

TEST_CASE("labels and contours of a person show its volumes", "[phantom]") {
  for (const std::uint32_t seed : {1U, 4U}) {
    const Person p = person(seed);
    const PersonStudy study = study_of(p);
    const PersonVolumes v = volumes(p);
    // a slice is drawn whole or not at all: up to one is missing at the base
    CHECK(study.label_volume[0] == Approx(v.edv).epsilon(0.2));
    CHECK(study.label_volume[1] == Approx(v.esv).epsilon(0.25));
    CHECK(study.label_volume[1] < study.label_volume[0]);
    CHECK(study.contours[0].size() >= 10);
    CHECK(study.scar.empty() == (v.scar == 0.0));
    for (const geometry::Contour& c : study.contours[0])
      CHECK(c.points.size() == 60);
  }
}
