#include "lv/geometry/contour_checks.hpp"
#include "lv/geometry/drawn_wall.hpp"
#include "lv/image/close_walls.hpp"
#include "lv/image/guide_points.hpp"

#include <catch2/catch.hpp>

#include <cstdlib>
#include <filesystem>

namespace {

using namespace lv;

/// Guide points of a real person, if the folder is there: not part of the project.
std::filesystem::path person() {
  const char* set = std::getenv("VENTRICLE_DATA");
  return std::filesystem::path(set != nullptr ? set : LV_DATA_DIR) / "bivme_patient1";
}

geometry::FitReport fitted(const std::string& file) {
  image::GuidePoints read =
      image::read_guide_points(person() / file, std::nullopt, geometry::Side::epi);
  geometry::SplineFitParameters fit;
  fit.frame.base_at = geometry::BaseAt::annulus;
  fit.frame.septum = read.septum;
  image::drop_strays(read.contours, read.notes);
  image::drop_open_base(read.contours, read.notes);
  image::close_walls(read.contours, fit.thinnest_wall, read.notes);
  geometry::check_contours(read.contours);
  return geometry::fit_drawn_wall(read.contours, fit, {.base = true}).wall.report();
}

}  // namespace

// 160.7 ml is the volume of the model that the points' makers fitted. Muscle keeps its volume, so
// that the two times must agree about the wall.
TEST_CASE("a person's guide points give a wall as they are", "[unit][image][data]") {
  if (!std::filesystem::exists(person())) {
    WARN("skipped: no folder " << person() << "; set VENTRICLE_DATA to the folder that holds it");
    return;
  }
  const auto diastole = fitted("GPFile_000.txt");
  const auto early = fitted("GPFile_012.txt");
  CHECK(diastole.volume_cavity == Approx(160.7e3).epsilon(0.05));
  CHECK(early.volume_cavity == Approx(61.2e3).epsilon(0.1));
  CHECK(diastole.volume_wall == Approx(early.volume_wall).epsilon(0.05));
}
