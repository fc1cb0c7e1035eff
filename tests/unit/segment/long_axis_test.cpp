#include "lv/segment/long_axis.hpp"

#include "lv/geometry/contour_measures.hpp"
#include "lv/geometry/long_axis.hpp"
#include "lv/phantom/study.hpp"

#include "segment/agreement.hpp"
#include <Eigen/Eigenvalues>
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>
#include <vector>

using namespace lv;

namespace {

/// A phantom with its cines, short and long axes.
struct LongAxisPhantom {
  phantom::Ventricle v;
  phantom::Scan scan;
  phantom::ScanPlanes planes;
  image::Cine cine;
  std::vector<image::CineSlice> views;
};

LongAxisPhantom scanned(const phantom::Ventricle& v, const phantom::Scan& scan) {
  LongAxisPhantom p{v, scan, phantom::planes(v, scan), {}, {}};
  p.cine = phantom::short_axis_cine(p.v, p.scan, p.planes);
  p.views = phantom::long_axis_cine(p.v, p.scan, p.planes).slices;
  return p;
}

/// That of test::phantom_study, whose base descends by a part of the axis.
LongAxisPhantom usual_phantom(std::uint32_t seed, double shortening) {
  phantom::Ventricle v;
  v.papillary = 4.0;
  v.scar.transmurality = 0.0;
  v.shortening = shortening;
  return scanned(v, test::noisy_scan(seed));
}

/// One of another size, wall, motion, resolution and noise, all drawn evenly.
LongAxisPhantom varied_phantom(std::uint32_t seed) {
  std::mt19937 random(seed);
  const auto between = [&](double a, double b) {
    return std::uniform_real_distribution<double>(a, b)(random);
  };
  phantom::Ventricle v;
  const double wall = between(7.0, 13.0);
  v.shape.endo_radius = between(20.0, 34.0);
  v.shape.endo_length = v.shape.endo_radius * between(2.2, 2.9);
  v.shape.epi_radius = v.shape.endo_radius + wall;
  v.shape.epi_length = v.shape.endo_length + 0.9 * wall;
  v.squeeze = between(0.25, 0.65);
  v.shortening = between(0.04, 0.16);
  v.papillary = between(2.5, 5.0);
  v.trabeculae = seed % 2 == 0 ? between(2.0, 4.0) : 0.0;
  v.scar.transmurality = 0.0;
  phantom::Scan scan = test::noisy_scan(seed);
  scan.snr = between(12.0, 30.0);
  scan.pixel = between(1.1, 1.8);
  scan.thickness = between(6.0, 10.0);
  scan.gap = between(0.0, 2.0);
  scan.field_of_view = std::max(4.2 * v.shape.epi_radius, -1.7 * v.apex());
  return scanned(v, scan);
}

/// How far what was found lies from the truth [mm], [degrees]; nan where nothing was found.
struct EndErrors {
  double annulus = 0.0;  ///< root mean square of its points
  double worst = 0.0;    ///< of them
  int points = 0;
  double height = 0.0;  ///< of the base plane, positive if too high
  double tilt = 0.0;    ///< of the plane of least squares through the points
  double apex = 0.0, apex_height = 0.0;
  double slab = 0.0;       ///< of the base plane of the most basal slice's slab
  double rule_apex = 0.0;  ///< height of the tip without long axes
};

/// The normal of the plane of least squares through points, against the axis [degrees].
double tilt_of(const std::vector<Vec3>& points) {
  Mat3 scatter = Mat3::Zero();
  const Vec3 middle = geometry::mean_of(points);
  for (const Vec3& x : points)
    scatter += (x - middle) * (x - middle).transpose();
  const Vec3 n = Eigen::SelfAdjointEigenSolver<Mat3>(scatter).eigenvectors().col(0);
  return std::acos(std::min(1.0, std::abs(n.z()))) * 180.0 / std::numbers::pi;
}

EndErrors errors_of(const LongAxisPhantom& p, const segment::Segmentation& found,
                    const segment::LongAxisEnds& ends, std::size_t frame) {
  const double time = phantom::phase_times(p.scan)[frame];
  const phantom::Motion motion(p.v, phantom::contraction(time));
  const geometry::Frame frame_of = phantom::pose(p.scan);
  const geometry::Contours truth = phantom::contours(p.v, p.scan, p.planes, time);
  std::vector<Vec3> corners;
  for (const geometry::Contour& curve : truth.long_axis)
    if (curve.side == geometry::Side::endo)
      for (const Vec3& x : {curve.points.front(), curve.points.back()})
        corners.push_back(frame_of.to_model(x));
  EndErrors e;
  std::vector<Vec3> points;
  for (const segment::AnnulusPoint& found_point : segment::annulus_at(ends, frame)) {
    points.push_back(frame_of.to_model(found_point.at));
    double away = 1e9;
    for (const Vec3& c : corners)
      away = std::min(away, (points.back() - c).norm());
    e.annulus += away * away;
    e.worst = std::max(e.worst, away);
  }
  e.points = static_cast<int>(points.size());
  e.annulus = std::sqrt(e.annulus / e.points);
  e.height = points.empty() ? std::nan("") : geometry::mean_of(points).z() - motion.z(0.0);
  e.tilt = points.size() < 3 ? std::nan("") : tilt_of(points);
  const Vec3 tip(0.0, 0.0, motion.z(p.v.cavity_apex()));
  const auto apex = segment::apex_at(ends, frame);
  e.apex = apex ? (frame_of.to_model(apex->at) - tip).norm() : std::nan("");
  e.apex_height = apex ? frame_of.to_model(apex->at).z() - tip.z() : std::nan("");
  const geometry::Contours loops = segment::contours_at(p.cine, found, frame);
  const auto basal = geometry::loops_from_base(loops, geometry::Side::endo).front();
  e.slab = frame_of.to_model(geometry::mean_of(basal->points) + geometry::basal_slab(loops)).z() -
           motion.z(0.0);
  e.rule_apex = frame_of.to_model(geometry::endo_apex(loops)).z() - tip.z();
  return e;
}

/// The same ends looked for in the images of a frame, not followed from end-diastole.
segment::LongAxisEnds looked_for(const LongAxisPhantom& p, const segment::Segmentation& found,
                                 std::size_t frame) {
  const std::size_t frames = found.volumes.size();
  segment::LongAxisEnds ends;
  for (const image::CineSlice& view : p.views) {
    ends.views.emplace_back(frames);
    ends.views.back()[frame] = segment::find_marks(
        view.frames[segment::picture_of(view, frame, frames)],
        segment::contours_at(p.cine, found, frame), {found.spacing, found.fall});
  }
  return ends;
}

void tell_errors(const std::string& name, const EndErrors& e) {
  fmt::print(
      "{:30} annulus {} {:5.2f} {:5.2f}  base {:+5.2f} tilt {:4.1f}  apex {:5.2f} {:+5.2f}  | slab "
      "{:+5.2f} tip {:+5.2f}\n",
      name, e.points, e.annulus, e.worst, e.height, e.tilt, e.apex, e.apex_height, e.slab,
      e.rule_apex);
}

void tell_ends(const std::string& name, const LongAxisPhantom& p) {
  const segment::Segmentation found = segment::segment(p.cine, {}, name);
  const segment::LongAxisEnds ends = segment::find_ends(p.cine, found, p.views);
  for (const auto& [moment, at] :
       {std::pair{"ED", found.phases.end_diastole}, std::pair{"ES", found.phases.end_systole},
        std::pair{"early", found.phases.early_diastole}}) {
    const auto frame = static_cast<std::size_t>(at);
    tell_errors(fmt::format("{} {}", name, moment), errors_of(p, found, ends, frame));
    if (at != found.phases.end_diastole)
      tell_errors(fmt::format("{} {} looked for", name, moment),
                  errors_of(p, found, looked_for(p, found, frame), frame));
  }
  for (const std::string& doubt : ends.doubts)
    fmt::print("    {}\n", doubt);
}

int long_axis_seeds() {
  const char* set = std::getenv("VENTRICLE_SEEDS");
  return set != nullptr ? std::atoi(set) : 3;
}

}  // namespace

TEST_CASE("a table of what long axes tell of the ends of phantoms", "[.][long_axis_table]") {
  for (int seed = 1; seed <= long_axis_seeds(); ++seed) {
    const auto number = static_cast<std::uint32_t>(seed);
    tell_ends(fmt::format("usual {}", seed), usual_phantom(number, 0.12));
    tell_ends(fmt::format("varied {}", seed), varied_phantom(number));
  }
}

namespace {

/// Ends of two views in one frame, which a test spoils.
segment::LongAxisEnds two_views() {
  segment::LongAxisMarks marks;
  marks.annulus = {segment::FoundPoint{{-20.0, 0.0, 1.0}, 0.9},
                   segment::FoundPoint{{20.0, 0.0, -1.0}, 0.8}};
  marks.apex = segment::FoundPoint{{0.0, 1.0, -70.0}, 0.7};
  segment::LongAxisMarks other = marks;
  other.apex = segment::FoundPoint{{0.0, 3.0, -72.0}, 1.0};
  return {{{marks}, {other}}, {}};
}

}  // namespace

TEST_CASE("long axes of phantoms show the height of the base and the tip to 2 mm", "[segment]") {
  for (const std::uint32_t seed : {1U, 2U}) {
    const LongAxisPhantom p = usual_phantom(seed, 0.12);
    const segment::Segmentation found = segment::segment(p.cine, {}, "phantom");
    const segment::LongAxisEnds ends = segment::find_ends(p.cine, found, p.views);
    for (const int at : {found.phases.end_diastole, found.phases.end_systole}) {
      const EndErrors e = errors_of(p, found, ends, static_cast<std::size_t>(at));
      tell_errors(fmt::format("phantom {}, phase {}", seed, at + 1), e);
      CHECK(e.points >= 4);
      CHECK(e.annulus < 3.0);
      CHECK(std::abs(e.height) < 2.0);
      CHECK(e.apex < 2.0);
    }
  }
}

TEST_CASE("a slice between tip and annulus that has no border is named", "[segment]") {
  const LongAxisPhantom p = usual_phantom(1, 0.12);
  segment::Segmentation found = segment::segment(p.cine, {}, "phantom");
  const auto named = [&] {
    const segment::LongAxisEnds ends = segment::find_ends(p.cine, found, p.views);
    return std::count_if(ends.doubts.begin(), ends.doubts.end(), [](const std::string& doubt) {
      return doubt.find("has no border") != std::string::npos;
    });
  };
  CHECK(named() == 0);
  const auto shown = std::find_if(found.shows.rbegin(), found.shows.rend(),
                                  [](const std::vector<char>& slice) { return slice[0] != 0; });
  shown->assign(shown->size(), 0);  // the most apical one
  CHECK(named() == 1);
}

TEST_CASE("doubtful ends of long axes are not used, and no annulus without both sides of a view",
          "[segment]") {
  segment::LongAxisEnds ends = two_views();
  CHECK(segment::annulus_at(ends, 0).size() == 4);
  REQUIRE(segment::apex_at(ends, 0));
  CHECK(segment::apex_at(ends, 0)->at.isApprox(Vec3(0.0, 2.0, -71.0)));
  CHECK(segment::apex_at(ends, 0)->view == 1);
  ends.views[0][0].annulus[1]->confidence = 0.5;
  ends.views[1][0].apex->confidence = 0.5;
  CHECK(segment::annulus_at(ends, 0).size() == 3);
  CHECK(segment::apex_at(ends, 0)->at.isApprox(Vec3(0.0, 1.0, -70.0)));
  ends.views[1][0].annulus[0].reset();
  CHECK(segment::annulus_at(ends, 0).empty());
  ends.views[0][0].apex.reset();
  CHECK_FALSE(segment::apex_at(ends, 0));
}

TEST_CASE("pictures of a long axis of another number cover the same cycle", "[segment]") {
  image::CineSlice view;
  view.frames.resize(30);
  CHECK(segment::picture_of(view, 0, 20) == 0);
  CHECK(segment::picture_of(view, 10, 20) == 15);
  CHECK(segment::picture_of(view, 19, 20) == 29);
  view.frames.resize(8);
  CHECK(segment::picture_of(view, 19, 20) == 0);  // 7.6 is nearer to the next cycle's first
}

TEST_CASE("a long axis that shows no muscle round blood, or lies beside the cavity, tells nothing",
          "[segment]") {
  geometry::Contours loops;
  for (int s = 0; s < 6; ++s)
    for (const auto side : {geometry::Side::endo, geometry::Side::epi}) {
      geometry::Contour loop;
      loop.slice = s + 1;
      loop.side = side;
      const double radius = (side == geometry::Side::endo ? 22.0 : 30.0) - 2.0 * s;
      for (int k = 0; k < 40; ++k)
        loop.points.emplace_back(radius * std::cos(0.157 * k), radius * std::sin(0.157 * k),
                                 -10.0 * s);
      loops.short_axis.push_back(loop);
    }
  image::Picture picture;
  picture.plane.origin = {-75.0, 0.0, -100.0};
  picture.plane.along_column = Vec3::UnitZ();
  picture.plane.columns = picture.plane.rows = 150;
  picture.values.assign(22500, 500.0F);
  const auto nothing = [](const segment::LongAxisMarks& marks) {
    return !marks.apex && !marks.annulus[0] && !marks.annulus[1];
  };
  CHECK(nothing(segment::find_marks(picture, loops, {10.0, 0.5})));
  picture.plane.origin.y() = 40.0;
  CHECK(nothing(segment::find_marks(picture, loops, {10.0, 0.5})));
}
