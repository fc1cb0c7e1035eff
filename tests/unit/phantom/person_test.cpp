#include "lv/phantom/person.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace lv;
using namespace lv::phantom;
using geometry::Side;

namespace {

/// Of the pixels of cavity, and of muscle and cavity [mm^2].
double area(const LabelPicture& picture, Side side) {
  const auto is_inside = [&](std::uint8_t label) {
    return label == person_cavity || (side == Side::epi && label == person_muscle);
  };
  const auto pixels = std::count_if(picture.values.begin(), picture.values.end(), is_inside);
  return static_cast<double>(pixels) * picture.plane.spacing_i * picture.plane.spacing_j;
}

double area(const geometry::Contour& loop) {
  Vec3 twice = Vec3::Zero();
  for (std::size_t k = 0; k < loop.points.size(); ++k)
    twice += (loop.points[k] - loop.points[0])
                 .cross(loop.points[(k + 1) % loop.points.size()] - loop.points[0]);
  return 0.5 * twice.norm();
}

}  // namespace

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

TEST_CASE("loops of a person surround the labels of every slice that has a cavity", "[phantom]") {
  for (const std::uint32_t seed : {22U, 23U, 26U}) {
    const PersonStudy study = study_of(person(seed));
    for (std::size_t t = 0; t < 2; ++t)
      for (std::size_t n = 0; n < study.slices.size(); ++n) {
        CAPTURE(seed, t, n);
        for (const Side side : {Side::endo, Side::epi}) {
          const geometry::Contour* loop =
              geometry::find(study.contours[t], static_cast<int>(n) + 1, side);
          const double pixels = area(study.labels[t][n], side);
          if (area(study.labels[t][n], Side::endo) > 100.0)
            REQUIRE(loop != nullptr);
          if (loop != nullptr)  // pixels are what lies at their centres
            CHECK(area(*loop) == Approx(pixels).epsilon(0.02).margin(20.0));
        }
      }
  }
}
