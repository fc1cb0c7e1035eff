#include "lv/segment/heart.hpp"

#include "lv/phantom/study.hpp"

#include "segment/agreement.hpp"
#include <catch2/catch.hpp>

#include <cmath>

using namespace lv;

TEST_CASE("a large ventricle, whose middle is still, is found", "[segment]") {
  phantom::Ventricle v;
  v.shape = {.endo_radius = 35.0, .endo_length = 95.0, .epi_radius = 45.0, .epi_length = 103.0};
  v.squeeze = 0.3;
  phantom::Scan scan = test::noisy_scan(4);
  scan.pixel = 2.5;
  scan.field_of_view = 170.0;
  scan.gap = 2.0;
  const phantom::ScanPlanes planes = phantom::planes(v, scan);
  const image::Cine cine = phantom::short_axis_cine(v, scan, planes);
  const segment::Heart heart = segment::find_heart(cine, {});
  for (const std::size_t slice : {3U, 4U, 5U, 6U, 7U}) {
    const phantom::ScanPlane& plane = planes.short_axis.at(slice);
    const segment::Pixel& at = heart.centres.at(slice).at;
    const Vec3 middle = phantom::pose(scan).to_image(plane.height * Vec3::UnitZ()) + plane.shift;
    CHECK((plane.plane.point(at.x(), at.y()) - middle).norm() < 5.0);
  }
}

namespace {

/// A disc of blood in muscle of 8 mm that is as bright as a part of blood.
struct Disc {
  segment::Pixel at;
  double muscle = 0.0;
};

/// A slice that shows lung and discs that shrink and grow.
image::CineSlice moving_discs(const std::vector<Disc>& discs, double height) {
  image::CineSlice slice{"slice", {}, {}, 0.0};
  for (const double radius : {24.0, 22.0, 18.0, 20.0, 23.0}) {
    image::Picture picture;
    picture.plane.columns = picture.plane.rows = 120;
    picture.plane.spacing_i = picture.plane.spacing_j = 1.5;
    picture.plane.origin.z() = height;
    picture.values.assign(120UL * 120UL, 60.0F);
    for (const auto& [at, muscle] : discs)
      for (int j = 0; j < 120; ++j)
        for (int i = 0; i < 120; ++i) {
          const double r = 1.5 * std::hypot(i - at.x(), j - at.y());
          if (r < radius + 8.0)
            picture.values[static_cast<std::size_t>(j) * 120 + i] =
                static_cast<float>(r < radius ? 1000.0 : 1000.0 * muscle);
        }
    slice.frames.push_back(picture);
  }
  return slice;
}

}  // namespace

TEST_CASE("what a single slice shows that looks most like the heart is not it", "[segment]") {
  const segment::Pixel heart(40.0, 60.0);
  const segment::Pixel other(88.0, 60.0);
  image::Cine cine;
  for (int s = 0; s < 6; ++s)
    cine.slices.push_back(moving_discs({{heart, 0.45}}, 10.0 * s));
  cine.slices.push_back(moving_discs({{other, 0.3}}, 60.0));
  CHECK((segment::find_heart(cine, {}).centres[2].at - heart).norm() < 2.0);
  cine.slices.assign(3, moving_discs({{heart, 0.45}, {other, 0.3}}, 0.0));
  CHECK((segment::find_heart(cine, {}).centres[0].at - other).norm() < 2.0);
}

TEST_CASE("blood is found within its wall though fluid as bright lies outside", "[segment]") {
  image::Picture picture;
  picture.plane.columns = picture.plane.rows = 100;
  picture.plane.spacing_i = picture.plane.spacing_j = 1.4;
  for (int j = 0; j < 100; ++j)
    for (int i = 0; i < 100; ++i) {
      const double r = 1.4 * std::hypot(i - 50, j - 50);
      const bool muscle = r > 20.0 && r < 28.0;
      picture.values.push_back(muscle ? 300.0F : r < 40.0 ? 1000.0F : 50.0F);
    }
  const segment::Centre found = segment::judge({&picture}, {50.0, 50.0});
  CHECK(found.radius == Approx(20.0).margin(1.0));
  CHECK(found.likeness > 0.5);
}
