#include "lv/phantom/person.hpp"

#include "lv/base/check.hpp"
#include "lv/base/units.hpp"
#include "lv/phantom/random.hpp"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

namespace lv::phantom {
namespace {

using geometry::Side;
using std::numbers::pi;
using units::degree;
using units::mmHg;

struct Bounds {
  double low, high;
};

/// What persons of a kind are between.
struct KindRanges {
  Bounds edv;        ///< [ml]
  Bounds thickness;  ///< at the equator [mm]
  Bounds length;     ///< of the cavity, base to apex, in its largest diameters
  Bounds ejection;   ///< of healthy muscle
  Bounds pressure;   ///< end-diastolic [mmHg]
};

KindRanges ranges(PersonKind kind) {
  switch (kind) {
    case PersonKind::healthy:
      return {{100, 200}, {6.0, 9.0}, {1.6, 2.0}, {0.52, 0.68}, {4, 12}};
    case PersonKind::dilated:
      return {{200, 380}, {6.0, 10.0}, {1.3, 1.7}, {0.17, 0.41}, {8, 25}};
    case PersonKind::hypertrophic:
      return {{80, 160}, {13.0, 22.0}, {1.6, 2.1}, {0.60, 0.78}, {8, 22}};
    case PersonKind::infarcted:
      return {{120, 240}, {7.0, 10.0}, {1.4, 1.8}, {0.45, 0.60}, {8, 22}};
    case PersonKind::small:
      return {{60, 100}, {5.0, 7.5}, {1.6, 2.0}, {0.55, 0.70}, {4, 12}};
    case PersonKind::large:
      return {{200, 280}, {8.0, 12.0}, {1.6, 2.0}, {0.50, 0.65}, {4, 12}};
  }
  LV_CHECK(false);
}

double draw(Random& random, const Bounds& b) {
  return random.uniform(b.low, b.high);
}

/// The ellipsoid of a cavity's volume: pi a^2 b (2/3 + eta - eta^3/3) below a base at height eta b,
/// with b (1 + eta) = length 2 a.
geometry::Ellipsoid ellipsoid(double volume, double length, double eta, double thickness,
                              double apical) {
  const double k = 2.0 / 3.0 + eta - eta * eta * eta / 3.0;
  const double a = std::cbrt(volume * (1.0 + eta) / (2.0 * pi * length * k));
  const double b = 2.0 * a * length / (1.0 + eta);
  return {.endo_radius = a,
          .endo_length = b,
          .epi_radius = a + thickness,
          .epi_length = b + apical * thickness,
          .base_height = eta * b};
}

WallWave wave(Random& random, int order, double largest) {
  return {order, random.uniform(0.0, largest), random.uniform(0.0, 2.0 * pi),
          random.uniform(-2.0, 2.0)};
}

double sum(std::span<const WallWave> waves, double theta, double height) {
  double s = 0.0;
  for (const WallWave& w : waves)
    s += w.amplitude * std::cos(w.order * theta + w.phase + w.twist * height);
  return s;
}

double turned(double angle) {
  return std::remainder(angle, 2.0 * pi);
}

/// 1 in the middle of the scar, smoothly to 0 at its borders.
double scar_share(const Person& p, double theta, double Z) {
  const Scar& s = p.scar;
  if (s.transmurality == 0.0 || Z <= s.bottom || Z >= s.top)
    return 0.0;
  const double around = std::abs(turned(theta - s.angle)) / (0.5 * s.width);
  const double along = std::abs(Z - 0.5 * (s.bottom + s.top)) / (0.5 * (s.top - s.bottom));
  const auto bump = [](double x) { return x < 1.0 ? 0.5 + 0.5 * std::cos(pi * x) : 0.0; };
  return std::sqrt(bump(around) * bump(along));
}

void add_scar(Person& p, Random& random) {
  p.scar.transmurality = random.uniform(0.4, 1.0);
  p.scar.angle = random.uniform(0.0, 2.0 * pi);
  p.scar.width = random.uniform(40.0, 180.0) * degree;
  const double length = random.uniform(0.3, 0.8) * -p.apex();
  p.scar.bottom = random.uniform(p.apex(), -length);
  p.scar.top = p.scar.bottom + length;
  p.scar_thinning = random.uniform(0.0, 0.4);
}

/// The ventricle at one time, in the frame of the slices: z along their normal.
class Heart {
 public:
  Heart(const Person& p, PersonTime time)
      : p_(p),
        squeeze_(time == PersonTime::systole ? p.ejection : 0.0),
        stretch_(time == PersonTime::systole ? 1.0 - p.shortening : 1.0) {
    const Vec3 axis(std::cos(p.tilt_angle), std::sin(p.tilt_angle), 0.0);
    turn_ = Eigen::AngleAxisd(p.tilt, axis).toRotationMatrix();
  }

  /// Height, angle and radius about the bent axis at end-diastole and now.
  struct Place {
    double Z, theta, r;
  };
  [[nodiscard]] Place place(const Vec3& slices) const {
    const Vec3 x = turn_.transpose() * (slices - middle()) + middle();
    const double Z = (x.z() - (1.0 - stretch_) * p_.apex()) / stretch_;
    const double part = Z / p_.apex();
    const double off = p_.bend * part * part;
    const double u = x.x() - off * std::cos(p_.bend_angle);
    const double v = x.y() - off * std::sin(p_.bend_angle);
    return {Z, std::atan2(v, u), std::hypot(u, v)};
  }

  /// See Motion.
  [[nodiscard]] double radius_now(Side side, double theta, double Z) const {
    const double squared = p_.radius_squared(side, theta, Z);
    if (squared <= 0.0)
      return 0.0;
    const double lost = 1.0 - 0.9 * scar_share(p_, theta, Z);
    const double c = squeeze_ * lost * std::max(0.0, p_.radius_squared(Side::endo, theta, Z));
    return std::sqrt(std::max(0.0, squared - c) / stretch_);
  }
  [[nodiscard]] bool inside(Side side, const Vec3& slices) const {
    const Place at = place(slices);
    return at.r < radius_now(side, at.theta, at.Z);
  }
  /// Where the bent axis passes a slice's height, nearly.
  [[nodiscard]] Vec3 centre(double height) const {
    const double part = std::clamp(height / p_.apex(), 0.0, 1.0);
    Vec3 x(p_.bend * part * part * std::cos(p_.bend_angle),
           p_.bend * part * part * std::sin(p_.bend_angle), height);
    x = turn_ * (x - middle()) + middle();
    x.z() = height;
    return x;
  }
  [[nodiscard]] double stretch() const { return stretch_; }

 private:
  [[nodiscard]] Vec3 middle() const { return 0.5 * p_.apex() * Vec3::UnitZ(); }

  const Person& p_;
  double squeeze_, stretch_;
  Mat3 turn_;
};

/// The border on a slice: points at even angles about the axis; empty where the axis is outside.
std::vector<Vec3> border(const Heart& heart, Side side, double height) {
  constexpr int points = 60;
  constexpr double farthest = 120.0;
  const Vec3 centre = heart.centre(height);
  std::vector<Vec3> loop;
  if (!heart.inside(side, centre))
    return loop;
  for (int k = 0; k < points; ++k) {
    const double angle = 2.0 * pi * k / points;
    const Vec3 ray(std::cos(angle), std::sin(angle), 0.0);
    double in = 0.0;
    double out = farthest;
    while (out - in > 1e-3)
      (heart.inside(side, centre + 0.5 * (in + out) * ray) ? in : out) = 0.5 * (in + out);
    loop.emplace_back(centre + in * ray);
  }
  return loop;
}

/// Whether an observer draws a slice: where the axis passes it below the base, which cuts at most
/// half of the muscle's ring off.
bool is_drawn(const Heart& heart, double height) {
  const Vec3 centre = heart.centre(height);
  return heart.place(centre).Z < 0.0 && heart.inside(Side::epi, centre);
}

bool in_right_ventricle(const Person& p, const Heart::Place& at) {
  const double a = p.shape.epi_radius;
  const Vec3 d((at.r * std::cos(at.theta) - 0.75 * a) / (1.05 * a),
               (at.r * std::sin(at.theta) - 0.1 * a) / (1.15 * a),
               (at.Z - 5.0) / (0.82 * -p.apex()));
  return at.Z < 5.0 && d.squaredNorm() < 1.0;
}

/// Mean thickness of the labels' edge is none: each pixel is what lies at its centre.
std::uint8_t label_at(const Person& p, const Heart& heart, const Vec3& x, bool with_scar) {
  const Heart::Place at = heart.place(x);
  const double inner = heart.radius_now(Side::endo, at.theta, at.Z);
  const double outer = heart.radius_now(Side::epi, at.theta, at.Z);
  if (at.r < inner)
    return person_cavity;
  if (at.r >= outer)
    return in_right_ventricle(p, at) ? std::uint8_t{person_rv} : std::uint8_t{0};
  const Scar& s = p.scar;
  const bool in_scar = s.transmurality > 0.0 && at.Z > s.bottom && at.Z < s.top &&
                       std::abs(turned(at.theta - s.angle)) < 0.5 * s.width &&
                       at.r < inner + s.transmurality * (outer - inner);
  return with_scar && in_scar ? person_scar : person_muscle;
}

LabelPicture labels(const Person& p, const Heart& heart, const ScanPlane& plane,
                    const geometry::Frame& frame, bool with_scar) {
  LabelPicture picture{plane.plane, {}};
  const bool drawn = is_drawn(heart, plane.height);
  for (int j = 0; j < plane.plane.rows; ++j)
    for (int i = 0; i < plane.plane.columns; ++i) {
      const Vec3 x = frame.to_model(plane.plane.point(i, j) - plane.shift);
      picture.values.push_back(drawn ? label_at(p, heart, x, with_scar) : std::uint8_t{0});
    }
  return picture;
}

std::vector<ScanPlane> slices_of(const Person& p, const geometry::Frame& frame) {
  Random random(p.seed + 0x200000000ULL);
  const Vec3 row = frame.axes.col(0);
  const Vec3 column = frame.axes.col(1);
  std::vector<ScanPlane> slices;
  const double first = random.uniform(0.6, 1.6) * p.slice_spacing;
  const double side = 3.4 * p.shape.epi_radius + 2.0 * p.bend;
  for (double height = first; height > p.apex() - 1.5 * p.slice_spacing;
       height -= p.slice_spacing) {
    ScanPlane plane;
    plane.name = fmt::format("short axis {}", slices.size() + 1);
    plane.height = height;
    plane.plane.along_row = row;
    plane.plane.along_column = column;
    plane.plane.spacing_i = plane.plane.spacing_j = p.pixel;
    plane.plane.columns = plane.plane.rows = static_cast<int>(std::lround(side / p.pixel));
    const double half = 0.5 * (plane.plane.columns - 1) * p.pixel;
    plane.plane.origin = frame.to_image(height * Vec3::UnitZ()) - half * (row + column);
    const double a = random.normal();
    const double b = random.normal();
    plane.shift = p.breath_hold * std::sqrt(0.5) * (a * row + b * column);
    slices.push_back(plane);
  }
  return slices;
}

double area_of_pixels(const LabelPicture& picture, std::uint8_t label) {
  return picture.plane.spacing_i * picture.plane.spacing_j *
         static_cast<double>(std::count(picture.values.begin(), picture.values.end(), label));
}

}  // namespace

std::string name(PersonKind kind) {
  switch (kind) {
    case PersonKind::healthy:
      return "healthy";
    case PersonKind::dilated:
      return "dilated";
    case PersonKind::hypertrophic:
      return "hypertrophic";
    case PersonKind::infarcted:
      return "infarcted";
    case PersonKind::small:
      return "small";
    case PersonKind::large:
      return "large";
  }
  LV_CHECK(false);
}

double Person::radius_squared(Side side, double theta, double Z) const {
  const auto of_ellipsoid = [&](double radius, double length) {
    const double zeta = (Z + shape.base_height) / length;
    return radius * radius * (1.0 - zeta * zeta);
  };
  const double height = Z / apex();
  const double inner = of_ellipsoid(shape.endo_radius, shape.endo_length);
  const double grown = 1.0 + sum(outline, theta, height);
  if (side == Side::endo)
    return inner > 0.0 ? inner * grown * grown : inner;
  const double outer = of_ellipsoid(shape.epi_radius, shape.epi_length);
  if (outer <= 0.0)
    return outer;
  const double r = std::sqrt(std::max(0.0, inner));
  const double at_septum = std::exp(-0.5 * std::pow(turned(theta) / 0.7, 2.0));
  const double thick = (std::sqrt(outer) - r) * (1.0 + sum(thickness, theta, height)) *
                       (1.0 + septal * at_septum * std::min(1.0, r / (0.6 * shape.endo_radius))) *
                       (1.0 - scar_thinning * scar_share(*this, theta, Z));
  return std::pow(r * grown + thick, 2.0);
}

Person person(std::uint32_t seed) {
  constexpr int kinds = 6;
  Random random(seed);
  Person p;
  p.seed = seed;
  p.kind = static_cast<PersonKind>((seed + kinds - 1) % kinds);
  const KindRanges range = ranges(p.kind);
  const double thickness = draw(random, range.thickness);
  p.scar.transmurality = 0.0;
  p.shape = ellipsoid(1e3 * draw(random, range.edv), draw(random, range.length),
                      random.uniform(0.2, 0.45), thickness, random.uniform(0.6, 1.0));
  p.outline = {wave(random, 2, 0.06), wave(random, 3, 0.03), wave(random, 4, 0.015)};
  p.thickness = {wave(random, 1, 0.12), wave(random, 2, 0.08), wave(random, 3, 0.05),
                 wave(random, 5, 0.03)};
  if (p.kind == PersonKind::hypertrophic)
    p.septal = random.uniform(0.0, 0.6);
  p.bend = random.uniform(0.0, 10.0);
  p.bend_angle = random.uniform(0.0, 2.0 * pi);
  p.tilt = random.uniform(0.0, 10.0) * degree;
  p.tilt_angle = random.uniform(0.0, 2.0 * pi);
  if (p.kind == PersonKind::infarcted)
    add_scar(p, random);
  p.ejection = draw(random, range.ejection);
  p.shortening = 0.25 * p.ejection;
  p.ed_pressure = draw(random, range.pressure) * mmHg;
  p.cuff_systolic = random.uniform(100.0, 150.0) * mmHg;
  p.slice_spacing = random.uniform(6.0, 10.0);
  p.pixel = random.uniform(1.2, 1.8);
  p.breath_hold = random.uniform(0.0, 3.0);
  return p;
}

PersonVolumes volumes(const Person& p) {
  constexpr int heights = 400, angles = 180;
  const Heart systole(p, PersonTime::systole);
  const double dZ = -p.apex() / heights;
  const double sector = 0.5 * (2.0 * pi / angles) * dZ;  // of r^2
  PersonVolumes v;
  for (int k = 0; k < heights; ++k)
    for (int n = 0; n < angles; ++n) {
      const double Z = p.apex() + (k + 0.5) * dZ;
      const double theta = turned(2.0 * pi * (n + 0.5) / angles);
      const double inner = std::max(0.0, p.radius_squared(Side::endo, theta, Z));
      const double outer = std::max(0.0, p.radius_squared(Side::epi, theta, Z));
      const double now = systole.radius_now(Side::endo, theta, Z);
      v.edv += sector * inner;
      v.esv += sector * systole.stretch() * now * now;
      v.wall += sector * (outer - inner);
      const Scar& s = p.scar;
      if (s.transmurality > 0.0 && Z > s.bottom && Z < s.top &&
          std::abs(turned(theta - s.angle)) < 0.5 * s.width) {
        const double r = std::sqrt(inner);
        v.scar += sector * (std::pow(r + s.transmurality * (std::sqrt(outer) - r), 2.0) - inner);
      }
    }
  return v;
}

PersonStudy study_of(const Person& p) {
  const geometry::Frame frame = pose(Scan{});
  PersonStudy study;
  study.slices = slices_of(p, frame);
  for (const PersonTime time : {PersonTime::diastole, PersonTime::systole}) {
    const Heart heart(p, time);
    const auto t = static_cast<std::size_t>(time);
    for (std::size_t n = 0; n < study.slices.size(); ++n) {
      const ScanPlane& plane = study.slices[n];
      study.labels[t].push_back(labels(p, heart, plane, frame, false));
      study.label_volume[t] +=
          p.slice_spacing * area_of_pixels(study.labels[t].back(), person_cavity);
      if (time == PersonTime::diastole && p.scar.transmurality > 0.0)
        study.scar.push_back(labels(p, heart, plane, frame, true));
      const std::vector<Vec3> endo = border(heart, Side::endo, plane.height);
      if (!is_drawn(heart, plane.height) || endo.empty())
        continue;
      for (const Side side : {Side::endo, Side::epi}) {
        geometry::Contour c{static_cast<int>(n) + 1, side, {}, {}, {}};
        for (const Vec3& x : side == Side::endo ? endo : border(heart, side, plane.height))
          c.points.emplace_back(frame.to_image(x) + plane.shift);
        study.contours[t].push_back(std::move(c));
      }
    }
  }
  return study;
}

}  // namespace lv::phantom
