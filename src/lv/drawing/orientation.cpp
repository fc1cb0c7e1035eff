#include "lv/drawing/orientation.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lv::drawing {
namespace {

/// Horizontal unit vector at an angle from x towards y.
Vec3 across(double angle) {
  return {std::cos(angle), std::sin(angle), 0.0};
}

constexpr double tilt = 0.25;  // of long-axis views: the base is seen as a narrow ellipse

}  // namespace

Vec3 Orientation::septal() const {
  return across(septum_angle);
}

Vec3 Orientation::anterior() const {
  return across(septum_angle + 0.5 * std::numbers::pi);
}

bool Orientation::assumes(const std::string& part) const {
  return std::any_of(assumed.begin(), assumed.end(),
                     [&](const geometry::Assumption& a) { return a.part == part; });
}

std::string Orientation::starred(const std::string& label, const std::string& part) const {
  return assumes(part) ? label + "*" : label;
}

std::string Orientation::starred(const std::string& label,
                                 std::initializer_list<const char*> parts) const {
  const bool any =
      std::any_of(parts.begin(), parts.end(), [&](auto* part) { return assumes(part); });
  return any ? label + "*" : label;
}

std::string Orientation::at_rest() const {
  return is_unloaded ? "the wall without load" : starred("early diastole", "early diastole");
}

std::array<Orientation::WallDirection, 4> Orientation::walls() const {
  const auto wall = [&](const char* letter, const Vec3& direction) {
    return WallDirection{starred(letter, "septum"), direction};
  };
  return {wall("A", anterior()), wall("S", septal()), wall("I", -anterior()), wall("L", -septal())};
}

std::string star_note(const Orientation& orientation, const std::vector<std::string>& parts) {
  std::string note;
  for (const geometry::Assumption& a : orientation.assumed)
    if (std::find(parts.begin(), parts.end(), a.part) != parts.end())
      note += (note.empty() ? "* assumed: " : "; ") + a.text;
  return note;
}

Look short_axis(const Orientation& orientation) {
  return {Vec3::UnitZ(), orientation.anterior()};
}

Look four_chamber(const Orientation& orientation) {
  return {-orientation.anterior() - tilt * Vec3::UnitZ(), Vec3::UnitZ()};
}

Look two_chamber(const Orientation& orientation) {
  return {-orientation.septal() - tilt * Vec3::UnitZ(), Vec3::UnitZ()};
}

Plane four_chamber_plane(const Orientation& orientation) {
  return {Vec3::Zero(), orientation.anterior()};
}

Plane two_chamber_plane(const Orientation& orientation) {
  return {Vec3::Zero(), orientation.septal()};
}

Plane short_axis_plane(double z) {
  return {z * Vec3::UnitZ(), -Vec3::UnitZ()};
}

std::vector<Letter> wall_letters(const Orientation& orientation, const std::vector<Vec3>& points,
                                 const Vec3& view) {
  constexpr double in_line = 0.8;  // cosine
  double radius = 0.0;
  double base = points.empty() ? 0.0 : points.front().z();
  for (const Vec3& x : points) {
    radius = std::max(radius, std::hypot(x.x(), x.y()));
    base = std::max(base, x.z());
  }
  const Vec3 height = (base + 0.25 * radius) * Vec3::UnitZ();
  std::vector<Letter> letters;
  for (const auto& [letter, direction] : orientation.walls())
    if (std::abs(view.normalized().dot(direction)) < in_line)
      letters.push_back({letter, height + 1.2 * radius * direction});
  return letters;
}

std::vector<Letter> assumed_ends(const Orientation& orientation, const std::vector<Vec3>& points) {
  constexpr double apart = 7.0;  // from the wall [mm]
  double lowest = 0.0;
  double highest = 0.0;
  double radius = 0.0;
  for (const Vec3& x : points) {
    lowest = std::min(lowest, x.z());
    highest = std::max(highest, x.z());
    radius = std::max(radius, std::hypot(x.x(), x.y()));
  }
  highest += tilt * radius;  // where the far side of the base is seen
  std::vector<Letter> letters;
  if (orientation.assumes("apex"))
    letters.push_back({"apex*", (lowest - apart) * Vec3::UnitZ()});
  if (orientation.assumes("base"))
    letters.push_back({"base*", (highest + apart) * Vec3::UnitZ()});
  return letters;
}

}  // namespace lv::drawing
