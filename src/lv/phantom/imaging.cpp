#include "lv/phantom/imaging.hpp"

#include "lv/phantom/papillary.hpp"
#include "lv/phantom/random.hpp"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <array>
#include <cmath>

namespace lv::phantom {
namespace {

using geometry::Contour;
using geometry::Side;
using std::numbers::pi;

/// Signals, with the muscle of a cine at 300.
namespace signals {
constexpr double blood = 900.0, muscle = 300.0, lung = 60.0;
constexpr double enhanced_blood = 450.0, nulled_muscle = 60.0, scar = 900.0;
}  // namespace signals

constexpr double image_turn = 25.0 * pi / 180.0;  ///< of the short-axis images about the long axis

image::Plane centred_plane(const Scan& scan, const Vec3& centre, const Vec3& along_row,
                           const Vec3& along_column) {
  image::Plane plane;
  plane.along_row = along_row.normalized();
  plane.along_column = along_column.normalized();
  plane.spacing_i = plane.spacing_j = scan.pixel;
  plane.columns = plane.rows = static_cast<int>(std::lround(scan.field_of_view / scan.pixel));
  plane.origin = centre - 0.5 * (plane.columns - 1) * scan.pixel * plane.along_row -
                 0.5 * (plane.rows - 1) * scan.pixel * plane.along_column;
  return plane;
}

Vec3 direction(double angle) {
  return {std::cos(angle), std::sin(angle), 0.0};
}

/// The heart's right chamber at end-diastole: a crescent on the septum. It is grown together with
/// the left one and moves as the left one's motion goes on outside.
bool in_right_ventricle(const Ventricle& v, const Vec3& x) {
  const double a = v.shape.epi_radius;
  const double depth = -v.apex();
  const Vec3 d((x.x() - 0.75 * a) / (1.05 * a), (x.y() - 0.1 * a) / (1.15 * a),
               (x.z() - 5.0) / (0.82 * depth));
  return x.z() < 5.0 && d.squaredNorm() < 1.0;
}

/// Blood above the moving base: outflow tract and left atrium as one chamber.
bool in_atrium(const Ventricle& v, const Motion& motion, const Vec3& x) {
  const double R = motion.radius(Side::endo, motion.z(0.0), std::atan2(x.y(), x.x()));
  const double height = (x.z() - motion.z(0.0)) / (1.3 * v.shape.endo_radius);
  return height < 1.0 && x.head<2>().squaredNorm() < R * R * (1.0 - height * height);
}

Contour loop(const Motion& motion, const ScanPlane& plane, const geometry::Frame& pose, int slice,
             Side side) {
  constexpr int points = 60;
  Contour c{slice, side, {}, {}, {}};
  for (int k = 0; k < points; ++k) {
    const double theta = 2.0 * pi * k / points;
    const Vec3 x =
        motion.radius(side, plane.height, theta) * direction(theta) + plane.height * Vec3::UnitZ();
    c.points.emplace_back(pose.to_image(x) + plane.shift);
  }
  return c;
}

/// From the base on one side over the apex to the other, evenly in the ellipse's angle.
Contour curve(const Ventricle& v, const Motion& motion, const ScanPlane& plane,
              const geometry::Frame& pose, int slice, Side side) {
  constexpr int points = 61;
  const double length = side == Side::endo ? v.shape.endo_length : v.shape.epi_length;
  const double end = pi - std::acos(v.shape.base_height / length);
  Contour c{slice, side, {}, {}, {}};
  for (int k = 0; k < points; ++k) {
    const double angle = end * (2.0 * k / (points - 1) - 1.0);
    const double z = motion.z(-v.shape.base_height - length * std::cos(angle));
    const double theta = angle < 0.0 ? plane.angle : plane.angle + pi;
    const Vec3 x = motion.radius(side, z, theta) * direction(theta) + z * Vec3::UnitZ();
    c.points.emplace_back(pose.to_image(x) + plane.shift);
  }
  return c;
}

}  // namespace

geometry::Frame pose(const Scan& scan) {
  geometry::Frame frame;
  frame.origin = Vec3(20.0, -30.0, 15.0);
  if (!scan.oblique)
    return frame;
  const Vec3 z = Vec3(-0.64, 0.56, 0.53).normalized();
  const Vec3 septum = Vec3(-0.75, -0.66, 0.1);
  const Vec3 x = (septum - septum.dot(z) * z).normalized();
  frame.axes.col(0) = x;
  frame.axes.col(1) = z.cross(x);
  frame.axes.col(2) = z;
  return frame;
}

ScanPlanes planes(const Ventricle& v, const Scan& scan) {
  const geometry::Frame frame = pose(scan);
  Random random(scan.seed);
  ScanPlanes all;
  const double spacing = scan.thickness + scan.gap;
  const Vec3 row = frame.axes * direction(pi + image_turn);
  const Vec3 column = frame.axes * direction(1.5 * pi + image_turn);
  for (double height = 1.3 * spacing; height > v.apex() - spacing; height -= spacing) {
    ScanPlane p;
    p.name = fmt::format("short axis {}", all.short_axis.size() + 1);
    p.height = height;
    p.plane = centred_plane(scan, frame.to_image(height * Vec3::UnitZ()), row, column);
    const double a = random.normal();
    const double b = random.normal();
    p.shift = scan.shift * std::sqrt(0.5) * (a * row + b * column);
    all.short_axis.push_back(p);
  }
  const std::array<std::pair<const char*, double>, 3> views{
      {{"four chambers", -20.0}, {"two chambers", 70.0}, {"three chambers", 35.0}}};
  for (const auto& [name, degrees] : views) {
    ScanPlane p;
    p.name = name;
    p.angle = degrees * pi / 180.0;
    p.plane = centred_plane(scan, frame.to_image(0.5 * v.apex() * Vec3::UnitZ()),
                            frame.axes * direction(p.angle), frame.axes.col(2));
    all.long_axis.push_back(p);
  }
  return all;
}

Scanner::Scanner(const Ventricle& ventricle, const Scan& scan)
    : ventricle_(ventricle), scan_(scan), pose_(pose(scan)), trabeculae_(ventricle, scan.seed) {
  constexpr int waves = 40;
  Random random(scan.seed + 0x100000000ULL);
  for (int n = 0; n < waves; ++n) {
    // 7 to 20 mm across the long axis, 60 to 160 mm along it: trabeculae run lengthwise
    const double across = 2.0 * pi / (7.0 + 13.0 * random.uniform());
    const double along = 2.0 * pi / (60.0 + 100.0 * random.uniform());
    const Vec3 k = across * direction(2.0 * pi * random.uniform()) + along * Vec3::UnitZ();
    waves_.push_back({k, 2.0 * pi * random.uniform()});
  }
}

Vec3 Scanner::in_model(const ScanPlane& plane, double i, double j, double across) const {
  return pose_.to_model(plane.plane.point(i, j) + across * plane.plane.normal() - plane.shift);
}

Scanner::Place Scanner::place(const Motion& motion, const Vec3& x) const {
  const Vec3 X = motion.inverse(x);
  if (X.z() > 0.0)
    return {in_atrium(ventricle_, motion, x) ? cavity : background,
            in_right_ventricle(ventricle_, X), X};
  const double theta = std::atan2(x.y(), x.x());
  const double r = std::hypot(x.x(), x.y());
  if (r < motion.radius(Side::endo, x.z(), theta))
    return {cavity, false, X,
            in_papillary(ventricle_, motion, x) || trabeculae_.contain(motion, x, X)};
  if (r >= motion.radius(Side::epi, x.z(), theta))
    return {background, in_right_ventricle(ventricle_, X), X};
  return {ventricle_.in_scar(X) ? scar : muscle, false, X};
}

double Scanner::texture(const Vec3& X) const {
  double sum = 0.0;
  for (const Wave& wave : waves_)
    sum += std::cos(wave.k.dot(X) + wave.phase);
  return std::sqrt(2.0 / static_cast<double>(waves_.size())) * sum;
}

double Scanner::signal(const Place& at, const Vec3& x, Contrast contrast) const {
  const bool cine = contrast == Contrast::cine;
  const double blood = cine ? signals::blood : signals::enhanced_blood;
  if (at.in_cavity)
    return cine ? signals::muscle : signals::nulled_muscle;
  if (at.label == cavity || at.right_ventricle)
    return blood;
  if (at.label == background)
    return signals::lung * (1.0 + 0.3 * std::sin(0.2 * x.x()) * std::cos(0.17 * x.y()));
  if (!cine)
    return at.label == scar ? signals::scar : signals::nulled_muscle;
  return signals::muscle * std::max(0.0, 1.0 + scan_.texture * texture(at.X));
}

double Scanner::mean_signal(const ScanPlane& plane, const Motion& motion, int i, int j,
                            Contrast contrast) const {
  // The ends of a scar lie flat in the slab: all pixels change at one height. Few points across
  // would move them, by up to a twelfth of the slab with six.
  const int across = contrast == Contrast::late_enhancement ? 48 : 6;
  constexpr int within = 2;
  double sum = 0.0;
  for (int k = 0; k < across; ++k)
    for (int a = 0; a < within; ++a)
      for (int b = 0; b < within; ++b) {
        const Vec3 x = in_model(plane, i - 0.5 + (a + 0.5) / within, j - 0.5 + (b + 0.5) / within,
                                scan_.thickness * ((k + 0.5) / across - 0.5));
        sum += signal(place(motion, x), x, contrast);
      }
  return sum / (across * within * within);
}

image::Picture Scanner::picture(const ScanPlane& plane, double time, Contrast contrast,
                                std::uint32_t number) const {
  const Motion motion(ventricle_, contraction(time));
  Random random((static_cast<std::uint64_t>(scan_.seed) << 32U) + number);
  const double sigma = scan_.snr > 0.0 ? signals::muscle / scan_.snr : 0.0;
  image::Picture picture{plane.plane, {}};
  for (int j = 0; j < plane.plane.rows; ++j)
    for (int i = 0; i < plane.plane.columns; ++i) {
      const double mean = mean_signal(plane, motion, i, j, contrast);
      const double real = mean + sigma * random.normal();
      const double imaginary = sigma * random.normal();
      picture.values.push_back(static_cast<float>(std::hypot(real, imaginary)));
    }
  return picture;
}

LabelPicture Scanner::labels(const ScanPlane& plane, double time) const {
  const Motion motion(ventricle_, contraction(time));
  LabelPicture picture{plane.plane, {}};
  for (int j = 0; j < plane.plane.rows; ++j)
    for (int i = 0; i < plane.plane.columns; ++i) {
      const Vec3 x = in_model(plane, i, j, 0.0);
      const bool ventricle = x.z() <= motion.z(0.0);
      picture.values.push_back(ventricle ? place(motion, x).label : background);
    }
  return picture;
}

geometry::Contours contours(const Ventricle& v, const Scan& scan, const ScanPlanes& planes,
                            double time) {
  constexpr double smallest_cavity = 3.0;  // radius that an observer still draws
  const Motion motion(v, contraction(time));
  const geometry::Frame frame = pose(scan);
  geometry::Contours all;
  for (std::size_t s = 0; s < planes.short_axis.size(); ++s) {
    const ScanPlane& plane = planes.short_axis[s];
    if (plane.height > motion.z(0.0) ||
        motion.radius(Side::endo, plane.height, 0.0) < smallest_cavity)
      continue;
    for (const Side side : {Side::endo, Side::epi})
      all.short_axis.push_back(loop(motion, plane, frame, static_cast<int>(s) + 1, side));
  }
  for (std::size_t s = 0; s < planes.long_axis.size(); ++s)
    for (const Side side : {Side::endo, Side::epi}) {
      const ScanPlane& plane = planes.long_axis[s];
      const int number = static_cast<int>(s) + 1;
      all.long_axis.push_back(curve(v, motion, plane, frame, number, side));
      const double tip = side == Side::endo ? v.cavity_apex() : v.apex();
      all.apex.push_back(
          {number, side, {frame.to_image(motion.z(tip) * Vec3::UnitZ()) + plane.shift}, {}, {}});
    }
  return all;
}

}  // namespace lv::phantom
