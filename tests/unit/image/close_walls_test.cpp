#include "lv/image/close_walls.hpp"

#include "lv/base/check.hpp"
#include "lv/geometry/contour_checks.hpp"

#include "geometry/drawn_ellipsoid.hpp"
#include <catch2/catch.hpp>
#include <fmt/format.h>

namespace {

using namespace drawn;
using Catch::Matchers::Contains;
using lv::InputError;
using namespace lv::image;

/// A heart with a wall of 20 mm whose most basal slice shows `thickness` [mm] of it, over part of
/// the way round.
Contours thick_heart(double thickness, double part) {
  Drawing drawing;
  drawing.shape.epi_radius = drawing.shape.endo_radius + 20.0;
  drawing.shape.epi_length = drawing.shape.endo_length + 20.0;
  Contours contours = draw(drawing);
  Contour& epi = contours.short_axis[1];
  const Contour& endo = contours.short_axis[0];
  const auto n = static_cast<double>(epi.points.size());
  for (std::size_t i = 0; i < epi.points.size(); ++i)
    if (static_cast<double>(i) < part * n)
      epi.points[i] = endo.points[i] + thickness * endo.points[i].normalized();
  return contours;
}

void move_epicardium(Contours& contours, int slice, const Vec3& by) {
  for (Contour& c : contours.short_axis)
    if (c.side == Side::epi && (slice == 0 || c.slice == slice))
      for (Vec3& x : c.points)
        x += by;
}

}  // namespace

TEST_CASE("a most basal slice that muscle surrounds over less than half is left out",
          "[unit][image]") {
  std::vector<std::string> notes;
  Contours thin = thick_heart(3.0, 1.0);
  drop_open_base(thin, 1.0, notes);
  CHECK(lv::geometry::find(thin.short_axis, 1, Side::endo) == nullptr);
  CHECK(lv::geometry::find(thin.short_axis, 1, Side::epi) == nullptr);
  CHECK(lv::geometry::find(thin.short_axis, 2, Side::endo) != nullptr);
  REQUIRE(notes.size() == 1);
  CHECK_THAT(notes.front(), Contains("slice 1, the most basal: muscle (6.6 mm and more) surrounds "
                                     "0% of the cavity"));
  for (const double part : {0.6, 0.4}) {  // open over that part of the way round
    Contours open = thick_heart(0.0, part);
    drop_open_base(open, 1.0, notes);
    CHECK((lv::geometry::find(open.short_axis, 1, Side::endo) == nullptr) == (part > 0.5));
  }
  Contours without = thick_heart(3.0, 1.0);
  without.short_axis.erase(without.short_axis.begin() + 1);
  drop_open_base(without, 1.0, notes);
  CHECK(lv::geometry::find(without.short_axis, 1, Side::endo) != nullptr);
}

TEST_CASE("outer contours that lie off the heart are named as such", "[unit][image]") {
  Contours one = draw({});
  move_epicardium(one, 3, Vec3(0.0, 45.0, 0.0));
  std::vector<std::string> notes;
  drop_strays(one, notes);
  REQUIRE(notes.size() == 1);
  CHECK_THAT(notes.front(),
             Contains("slice 3: the outer contour lies off the heart, its middle 45 mm"));
  CHECK(lv::geometry::find(one.short_axis, 3, Side::epi) == nullptr);
  CHECK(lv::geometry::find(one.short_axis, 4, Side::epi) != nullptr);
  Contours every = draw({});
  move_epicardium(every, 0, Vec3(0.0, 45.0, 0.0));
  CHECK_THROWS_WITH(drop_strays(every, notes),
                    Contains("slice 1: the outer contour lies off the heart") &&
                        Contains("so do all 8") && !Contains("missing"));
}
