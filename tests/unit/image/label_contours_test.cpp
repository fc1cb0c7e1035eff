#include "lv/image/label_contours.hpp"

#include "lv/base/check.hpp"
#include "lv/geometry/contour_checks.hpp"
#include "lv/geometry/ellipsoid.hpp"
#include "lv/geometry/spline_wall.hpp"
#include "lv/image/close_walls.hpp"
#include "lv/image/nifti.hpp"
#include "lv/image/plane_mask.hpp"
#include "lv/phantom/ventricle.hpp"

#include "geometry/drawn_ellipsoid.hpp"
#include "image/nifti_files.hpp"
#include "support/scanner_files.hpp"
#include "support/temporary_folder.hpp"
#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

namespace {

using namespace lv;
using namespace lv::image;
using Catch::Matchers::Contains;
using geometry::Side;
using std::numbers::pi;

/// A ventricle of the model frame: cavity 1, muscle 2 up to the base plane.
int ventricle(const geometry::Ellipsoid& e, const Vec3& X) {
  if (X.z() > 0.0)
    return 0;
  const auto inside = [&](double a, double c) {
    return Vec3(X.x() / a, X.y() / a, (X.z() + e.base_height) / c).norm() < 1.0;
  };
  return inside(e.endo_radius, e.endo_length) ? 1 : inside(e.epi_radius, e.epi_length) ? 2 : 0;
}

/// The map of a ventricle that lies askew, slices 8 mm apart across axis `along`, so many pixels
/// wide.
Volume askew(int along, const std::function<int(const Vec3&, int)>& change, int wide = 60) {
  const geometry::Ellipsoid e;
  const geometry::Frame frame = drawn::oblique_frame();
  Mat3 directions;
  directions.col(along) = -frame.axes.col(2);
  directions.col((along + 1) % 3) = frame.axes.col(0);
  directions.col((along + 2) % 3) = -frame.axes.col(1);
  Vec3 spacing(1.4, 1.4, 1.4);
  spacing[along] = 8.0;
  std::array<int, 3> size{wide, wide, wide};
  size[along] = 14;
  Vec3 middle = Vec3::Constant(0.5 * wide);
  middle[along] = 0.0;
  const Vec3 origin =
      frame.to_image({0.0, 0.0, 4.0 + 8.0}) - directions * spacing.cwiseProduct(middle);
  const test::NiftiSpec spec =
      test::label_map(size, directions, spacing, origin, [&](const Vec3& x) {
        const Vec3 X = frame.to_model(x);
        return change(X, ventricle(e, X));
      });
  return test::read_back(spec);
}

int unchanged(const Vec3&, int label) {
  return label;
}

LabelContours traced(const std::function<int(const Vec3&, int)>& change, int along = 2) {
  return trace_labels(askew(along, change), {{1}, {2}, {}}, 0);
}

std::string all(const std::vector<std::string>& notes) {
  return fmt::format("{}", fmt::join(notes, "|"));
}

/// Volume of the ellipsoid of one side below the base plane.
double volume(const geometry::Ellipsoid& e, double a, double c) {
  const double h = e.base_height / c;  // of the cut above the centre
  return pi * a * a * c * (2.0 / 3.0 + h - h * h * h / 3.0);
}

}  // namespace

TEST_CASE("the outline of pixels runs half way to their neighbours", "[unit][image]") {
  PlaneMask mask(40, 30);
  for (int j = 5; j < 15; ++j)
    for (int i = 10; i < 30; ++i)
      mask.inside[j * 40 + i] = 1;
  const PixelLoop loop = outline(mask);
  CHECK(area(loop) == Approx(200.0 - 0.5));
  for (const auto& x : loop) {
    CHECK(x.x() >= 9.5);
    CHECK(x.x() <= 29.5);
    CHECK(x.y() >= 4.5);
    CHECK(x.y() <= 14.5);
  }
  CHECK(outline(PlaneMask(5, 5)).empty());
  mask.inside[7 * 40 + 12] = 0;
  CHECK(filled(mask).count() == 200);
  mask.inside[0] = 1;
  CHECK(parts(mask).size() == 2);
  CHECK(parts(mask).front().count() == 199);
}

TEST_CASE("labels of a ventricle that lies askew become its wall, whatever the order of axes",
          "[unit][image]") {
  const geometry::Ellipsoid e;
  for (const int along : {0, 1, 2}) {
    const LabelContours labels = traced(unchanged, along);
    geometry::check_contours(labels.contours);
    geometry::SplineFitParameters fit;
    fit.frame.base_at = geometry::BaseAt::slab;
    const auto report = geometry::fit_spline_wall(labels.contours, fit).report();
    const double cavity = volume(e, e.endo_radius, e.endo_length);
    const double wall = volume(e, e.epi_radius, e.epi_length) - cavity;
    CHECK(report.volume_cavity == Approx(cavity).epsilon(0.02));
    CHECK(report.volume_wall == Approx(wall).epsilon(0.03));
    CHECK(report.contour_cavity == Approx(labels.cavity).epsilon(0.01));
    CHECK(report.base_height == Approx(4.0).margin(0.1));
  }
}

TEST_CASE("papillary muscles, holes and islands are told and do not move the borders",
          "[unit][image]") {
  const LabelContours plain = traced(unchanged);
  const LabelContours labels = traced([](const Vec3& X, int label) {
    if (label == 1 && X.z() > -35.0 && (X - Vec3(8.0, 5.0, X.z())).norm() < 3.0)
      return 2;  // a papillary muscle
    if (label == 2 && (X - Vec3(0.0, 27.0, -10.0)).norm() < 2.0)
      return 0;  // a hole in the wall
    if (label == 0 && std::abs(X.z() + 28.0) < 4.0 && std::abs(X.x() - 40.0) < 2.0 &&
        std::abs(X.y()) < 2.0)
      return 1;  // an island of cavity
    return label;
  });
  REQUIRE(labels.contours.short_axis.size() == plain.contours.short_axis.size());
  for (std::size_t c = 0; c < plain.contours.short_axis.size(); ++c)
    CHECK(labels.contours.short_axis[c].points.size() ==
          plain.contours.short_axis[c].points.size());
  CHECK_THAT(all(labels.notes), Contains("inside the cavity (papillary muscles or holes)"));
  CHECK_THAT(all(labels.notes), Contains("1 island of the cavity"));
}

TEST_CASE("muscle beyond the cavity's apex shows the epicardium", "[unit][image]") {
  const LabelContours labels =
      traced([](const Vec3& X, int label) { return label == 1 && X.z() < -50.0 ? 2 : label; });
  CHECK_THAT(all(labels.notes), Contains("muscle without cavity: beyond the apex"));
  geometry::check_contours(labels.contours);
  geometry::SplineFitParameters fit;
  fit.frame.base_at = geometry::BaseAt::slab;
  const auto report = geometry::fit_spline_wall(labels.contours, fit).report();
  const geometry::Ellipsoid e;
  CHECK(report.volume_cavity + report.volume_wall ==
        Approx(volume(e, e.epi_radius, e.epi_length)).epsilon(0.03));
}

namespace {

/// The map of a ventricle that stands upright, of cubic voxels turned about x by an angle.
Volume turned(double angle, double voxel) {
  const geometry::Ellipsoid e;
  const Mat3 directions = Eigen::AngleAxisd(angle, Vec3::UnitX()).toRotationMatrix();
  const Vec3 spacing = Vec3::Constant(voxel);
  const int n = static_cast<int>(120.0 / voxel);
  const std::array<int, 3> size{n, n, n};
  const Vec3 origin = Vec3(0.0, 0.0, -35.0) - directions * (0.5 * (n - 1) * spacing);
  return test::read_back(test::label_map(size, directions, spacing, origin,
                                         [&](const Vec3& X) { return ventricle(e, X); }));
}

}  // namespace

TEST_CASE("thick slices that do not lie across the long axis are noted, then refused",
          "[unit][image]") {
  const double degree = pi / 180.0;
  const auto notes = [&](double angle) {
    return all(trace_labels(turned(angle * degree, 4.0), {{1}, {2}, {}}, 0).notes);
  };
  CHECK_THAT(notes(0.0), !Contains("from the long axis"));
  CHECK_THAT(notes(10.0), !Contains("from the long axis"));
  CHECK_THAT(notes(20.0), Contains("lies 20 degrees from the long axis of the cavity"));
  for (const double angle : {30.0, 60.0, 90.0})
    CHECK_THROWS_WITH(notes(angle), Contains("map.nii: the normal of the slices lies ") &&
                                        Contains("at most 25 are allowed"));
}

TEST_CASE("one slice shifted by the breath does not make the long axis oblique", "[unit][image]") {
  const geometry::Ellipsoid e;
  const auto angle_noted = [&](double jump) {
    const Volume volume = askew(2, [&](const Vec3& X, int label) {
      if (X.z() < -58.0 && X.z() > -66.0)
        return ventricle(e, X - Vec3(jump, 0.0, 0.0));
      return label;
    });
    return all(trace_labels(volume, {{1}, {2}, {}}, 0).notes);
  };
  CHECK_THAT(angle_noted(0.0), !Contains("from the long axis"));
  CHECK_THAT(angle_noted(18.0), !Contains("from the long axis"));
}

TEST_CASE("the borders of cubic voxels are loops that do not cross themselves", "[unit][image]") {
  // straight runs of pixels, turned in space: segments in one line, but for rounding
  for (const double angle : {0.0, 3.0, 7.0, 11.0}) {
    LabelContours labels = trace_labels(turned(angle * pi / 180.0, 2.5), {{1}, {2}, {}}, 0);
    close_walls(labels.contours, 1.0, labels.notes);  // at the base, which the slices cut askew
    CHECK_NOTHROW(geometry::check_contours(labels.contours));
  }
}

TEST_CASE("a map of small voxels along the patient's axes is resampled across the long axis",
          "[unit][image]") {
  const phantom::Ventricle v;
  const phantom::Motion motion(v, 0.7);  // with a scar that moves less than the rest
  const geometry::Frame frame = drawn::oblique_frame();
  const auto label = [&](const Vec3& x) {
    const Vec3 X = frame.to_model(x);
    const double r = std::hypot(X.x(), X.y());
    const double theta = std::atan2(X.y(), X.x());
    if (X.z() > motion.z(0.0) || r >= motion.radius(Side::epi, X.z(), theta))
      return 0;
    return r < motion.radius(Side::endo, X.z(), theta) ? 4 : 9;
  };
  const std::array<int, 3> size{90, 90, 90};
  const Vec3 spacing = Vec3::Constant(1.5);
  const Vec3 origin = frame.to_image({0.0, 0.0, -38.0}) - 0.5 * 89.0 * spacing;
  const Volume map =
      test::read_back(test::label_map(size, Mat3::Identity(), spacing, origin, label));
  LabelContours labels = trace_labels(map, {{4}, {9}, {}}, 0);
  CHECK_THAT(all(labels.notes), Contains("the labels were resampled to"));
  CHECK(labels.cavity == Approx(motion.cavity_volume()).epsilon(0.01));  // voxels of the map itself
  close_walls(labels.contours, 1.0, labels.notes);
  geometry::SplineFitParameters fit;
  fit.frame.base_at = geometry::BaseAt::slab;
  const geometry::SplineWall wall = geometry::fit_spline_wall(labels.contours, fit);
  CHECK(wall.report().volume_cavity == Approx(motion.cavity_volume()).epsilon(0.02));
  CHECK(wall.report().volume_wall == Approx(phantom::wall_volume(v)).epsilon(0.02));
  CHECK(wall.frame().axes.col(2).dot(frame.axes.col(2)) > std::cos(3.0 * pi / 180.0));
}

TEST_CASE("a wall that the edge of the image cuts is noted", "[unit][image]") {
  Volume map = turned(0.0, 2.5);
  const int cut = 14;  // columns of pixels: 35 mm, where the epicardium starts 25 mm from the edge
  Volume narrow = map;
  narrow.size[0] -= cut;
  narrow.values.clear();
  for (int k = 0; k < map.size[2]; ++k)
    for (int j = 0; j < map.size[1]; ++j)
      for (int i = cut; i < map.size[0]; ++i)
        narrow.values.push_back(map.at(i, j, k));
  CHECK_THAT(all(trace_labels(map, {{1}, {2}, {}}, 0).notes), !Contains("edge of the image"));
  CHECK_THAT(all(trace_labels(narrow, {{1}, {2}, {}}, 0).notes),
             Contains("the wall reaches the edge of the image"));
}

TEST_CASE("swapped labels and a cavity in two parts are refused", "[unit][image]") {
  const Volume map = askew(2, unchanged);
  CHECK_THROWS_WITH(trace_labels(map, {{2}, {1}, {}}, 0),
                    Contains("cavity and muscle seem swapped"));
  CHECK_THROWS_WITH(traced([](const Vec3& X, int label) {
                      return label == 1 && std::abs(X.x()) < 4.0 ? 0 : label;
                    }),
                    Contains("the cavity is in 2 parts"));
  CHECK_THROWS_WITH(
      traced([](const Vec3& X, int label) { return X.z() < -20.0 && X.z() > -45.0 ? 0 : label; }),
      Contains("more than one slice apart"));
}

TEST_CASE("a wall that closes round the right ventricle, or round a large hole, is refused",
          "[unit][image]") {
  // a chamber beside the ventricle, with a wall of its own
  const auto chamber = [](const Vec3& X, int label, int blood) {
    const double r = (X - Vec3(-45.0, 0.0, X.z())).norm();
    if (label != 0 || X.z() > 0.0 || X.z() < -45.0 || r > 24.0)
      return label;
    return r < 20.0 ? blood : 2;
  };
  const auto with_right = [&](const std::vector<int>& right, const auto& change) {
    return trace_labels(askew(2, change, 110), {{1}, {2}, right}, 0);
  };
  const auto named = [&](const Vec3& X, int label) { return chamber(X, label, 3); };
  CHECK_THROWS_WITH(with_right({3}, named),
                    Contains("slice ") &&
                        Contains("of what anatomy.labels.right_ventricle names "
                                 "(label 3)") &&
                        Contains("the right ventricle's muscle"));
  CHECK_THROWS_WITH(with_right({}, named),
                    Contains("the wall encloses a hole of ") && Contains("(label 3)"));
  CHECK_THROWS_WITH(with_right({}, [&](const Vec3& X, int label) { return chamber(X, label, 0); }),
                    Contains("the wall encloses a hole of ") && Contains("(label 0)"));
  // slips of the brush beside a right ventricle whose own wall is not labelled
  const LabelContours slips = with_right({3}, [](const Vec3& X, int label) {
    if (label == 2 && (X - Vec3(0.0, 27.0, -12.0)).norm() < 2.0)
      return 3;
    return label == 0 && X.z() < 0.0 && (X - Vec3(-50.0, 0.0, X.z())).norm() < 12.0 ? 3 : label;
  });
  CHECK_THAT(all(slips.notes), Contains("of them labelled as right ventricle (label 3)"));
}

TEST_CASE("a wall that is open over a sector is bridged, over more it is left to other slices",
          "[unit][image]") {
  const auto open = [](double angle) {
    return [angle](const Vec3& X, int label) {
      return label == 2 && X.z() > -8.0 && std::abs(std::atan2(X.y(), X.x())) < 0.5 * angle ? 0
                                                                                            : label;
    };
  };
  for (const bool narrow : {true, false}) {
    LabelContours labels = traced(open(narrow ? 1.0 : 3.0));
    close_walls(labels.contours, 1.0, labels.notes);
    geometry::check_contours(labels.contours);
    const int basal = labels.contours.short_axis.front().slice;
    CHECK((geometry::find(labels.contours.short_axis, basal, Side::epi) != nullptr) == narrow);
    CHECK_THAT(all(labels.notes),
               Contains(narrow ? "its thickness is interpolated there" : "epicardium is left out"));
  }
}

TEST_CASE("phases are proposed from the volume curve", "[unit][image]") {
  const Phases p = propose_phases({100.0, 80.0, 60.0, 50.0, 52.0, 58.0, 70.0, 90.0});
  CHECK(p.end_diastole == 0);
  CHECK(p.end_systole == 3);
  CHECK(p.early_diastole == 5);
  CHECK(propose_phases({70.0}).early_diastole == 0);
}

namespace {

/// Overwrites one slice across the third axis with another.
Volume copied(Volume map, int from, int to) {
  const auto n = static_cast<std::ptrdiff_t>(map.size[0]) * map.size[1];
  std::copy_n(map.values.begin() + n * from, n, map.values.begin() + n * to);
  return map;
}

/// So many copies of each slice, so much thinner.
Volume resampled(const Volume& map, int copies) {
  Volume thin = map;
  const auto n = static_cast<std::ptrdiff_t>(map.size[0]) * map.size[1];
  thin.size[2] *= copies;
  thin.spacing[2] /= copies;
  thin.values.clear();
  for (int k = 0; k < thin.size[2]; ++k)
    thin.values.insert(thin.values.end(), map.values.begin() + n * (k / copies),
                       map.values.begin() + n * (k / copies + 1));
  return thin;
}

}  // namespace

TEST_CASE("two neighbouring slices that are the same are warned of, many are a resampled map",
          "[unit][image]") {
  const Volume map = askew(2, unchanged);
  const LabelMeaning meaning{{1}, {2}, {}};
  CHECK(trace_labels(map, meaning, 0).alike.empty());
  CHECK_THAT(trace_labels(copied(map, 4, 5), meaning, 0).alike,
             Contains("slices 5 and 6 of ") && Contains("8.0 mm longer"));
  const LabelContours twice = trace_labels(resampled(map, 2), meaning, 0);  // 4 mm
  CHECK(twice.alike.empty());
  CHECK_THAT(all(twice.notes), Contains("seems to be resampled"));
  const LabelContours thin = trace_labels(resampled(map, 4), meaning, 0);  // 2 mm
  CHECK(thin.alike.empty());
  CHECK_THAT(all(thin.notes), !Contains("resampled"));
}

namespace {

/// A ventricle that a plane base cuts, tilted by an angle about y and lifted.
LabelContours cut_by_base(double degrees, double lift = 0.0) {
  const double slope = std::tan(degrees * pi / 180.0);
  return traced([slope, lift](const Vec3& X, int) {
    const geometry::Ellipsoid e;
    const auto inside = [&](double a, double c) {
      return Vec3(X.x() / a, X.y() / a, (X.z() + e.base_height) / c).norm() < 1.0;
    };
    if (X.z() + slope * X.x() > lift)
      return 0;
    return inside(e.endo_radius, e.endo_length) ? 1 : inside(e.epi_radius, e.epi_length) ? 2 : 0;
  });
}

}  // namespace

TEST_CASE("slices that a tilted base cuts are made whole or left out", "[unit][image]") {
  const geometry::Ellipsoid e;
  const double cavity = volume(e, e.endo_radius, e.endo_length);
  const double wall = volume(e, e.epi_radius, e.epi_length) - cavity;
  CHECK_THAT(all(cut_by_base(0.0).notes), !Contains("the base cuts it"));
  for (const double angle : {15.0, 18.0, 21.0, 25.0}) {
    LabelContours labels = cut_by_base(angle);
    CHECK_THAT(all(labels.notes), Contains("slice 2: the base cuts it") && Contains("left out"));
    CHECK(labels.cut_base.empty());
    close_walls(labels.contours, 1.0, labels.notes);
    geometry::check_contours(labels.contours);
    geometry::SplineFitParameters fit;
    fit.frame.base_at = geometry::BaseAt::slab;
    const auto report = geometry::fit_spline_wall(labels.contours, fit).report();
    CHECK(report.volume_cavity == Approx(cavity).epsilon(0.03));
    CHECK(report.volume_wall == Approx(wall).epsilon(0.04));
  }
  CHECK_THAT(all(cut_by_base(25.0).notes),
             Contains("slice 3: the base cuts it") && Contains("the wall is taken as on the slices "
                                                               "below"));
  CHECK_THAT(cut_by_base(25.0, 3.5).cut_base, Contains("the base is tilted to the slices of ") &&
                                                  Contains("of the cavity's voxels"));
}

TEST_CASE("cavity and right ventricle exchanged are named", "[unit][image]") {
  const auto change = [](const Vec3& X, int label) {
    if (label != 0 || X.z() > 0.0)
      return label;
    return (X - Vec3(-38.0, 0.0, X.z())).norm() < 18.0 ? 3 : label;
  };
  const Volume map = askew(2, change, 110);
  CHECK_NOTHROW(trace_labels(map, {{1}, {2}, {3}}, 0));
  CHECK_THROWS_WITH(trace_labels(map, {{3}, {2}, {1}}, 0),
                    Contains("muscle surrounds what anatomy.labels.right_ventricle names (label "
                             "1)") &&
                        Contains("seem exchanged"));
}

TEST_CASE("a slice in mid-ventricle that is cut is not the base's", "[unit][image]") {
  const LabelContours half = traced([](const Vec3& X, int label) {
    return X.z() > -30.0 && X.z() < -26.0 && X.x() > -5.0 ? 0 : label;
  });
  CHECK_THAT(all(half.notes), !Contains("the base cuts it"));
  CHECK_THROWS_WITH(traced([](const Vec3& X, int label) {
                      const bool stray = std::abs(X.x()) > 12.0;
                      return X.z() > -30.0 && X.z() < -26.0 && !stray ? 0 : label;
                    }),
                    Contains("the cavity is in 2 parts"));
}
