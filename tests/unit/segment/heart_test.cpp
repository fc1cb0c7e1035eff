#include "lv/segment/heart.hpp"

#include "lv/phantom/study.hpp"

#include "segment/agreement.hpp"
#include <catch2/catch.hpp>

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
