#include "lv/geometry/lie_in_patient.hpp"

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace lv::geometry {
namespace {

constexpr double farthest_turn = 60.0;   // of a heart against the usual one [degrees]
constexpr double explained_turn = 35.0;  // what is left when an error is undone
constexpr double clear_gain = 20.0;

/// As hearts usually lie.
Lie usual() {
  const Vec3 apex = Vec3(0.6, -0.6, -0.53).normalized();
  const Vec3 septum(-0.75, -0.66, 0.0);
  return {apex, (septum - septum.dot(apex) * apex).normalized()};
}

double degrees_of(double cosine) {
  return std::acos(std::clamp(cosine, -1.0, 1.0)) * 180.0 / std::numbers::pi;
}

Mat3 axes_of(const Lie& lie) {
  Mat3 axes;
  axes << lie.apex, *lie.septum, *lie.anterior();
  return axes;
}

/// The angle by which a heart is turned against the usual one; of the apex alone where no septum is
/// shown [degrees].
double turn(const Lie& lie) {
  const Lie other = usual();
  if (!lie.septum)
    return degrees_of(lie.apex.dot(other.apex));
  return degrees_of(0.5 * ((axes_of(other).transpose() * axes_of(lie)).trace() - 1.0));
}

std::string place_of(const Vec3& direction) {
  return fmt::format("({:.2f}, {:.2f}, {:.2f})", direction.x(), direction.y(), direction.z());
}

/// Which walls face where none does.
std::vector<std::string> odd_directions(const Lie& lie) {
  std::vector<std::string> odd;
  const auto add = [&](bool is_odd, const char* what) {
    if (is_odd)
      odd.emplace_back(what);
  };
  add(lie.apex.z() > 0.2, "the apex points to the patient's head");
  add(lie.apex.x() < -0.3, "the apex points to the patient's right");
  add(lie.apex.y() > 0.3, "the apex points to the patient's back");
  if (!lie.septum)
    return odd;
  add(lie.septum->x() > 0.5, "the septum faces the patient's left");
  add(lie.septum->y() > 0.5, "the septum faces the patient's back");
  const Vec3 up_and_front = Vec3(0.0, -1.0, 1.0).normalized();
  add(lie.anterior()->dot(up_and_front) < -0.5,
      "the anterior wall faces the patient's back and feet");
  return odd;
}

/// An error of a header or an export, undone, and what it does.
struct Cause {
  Lie undone;
  std::string what;
};

constexpr const char* exchanges =
    ", and anterior and inferior regions are exchanged, or septal and lateral ones";
constexpr const char* keeps =
    "; the regions keep their names, but lie elsewhere than in its images";

std::vector<Cause> causes_of(const Lie& lie) {
  std::vector<Cause> causes;
  const auto add = [&](const Vec3& signs, const std::string& what) {
    std::optional<Vec3> septum;
    if (lie.septum)
      septum = signs.cwiseProduct(*lie.septum);
    causes.push_back({{signs.cwiseProduct(lie.apex), septum}, what});
  };
  add({-1, -1, 1}, fmt::format("turned by half, as where RAS is taken for LPS{}", keeps));
  add({-1, 1, 1}, fmt::format("mirrored, right for left{}", exchanges));
  add({1, -1, 1}, fmt::format("mirrored, back for front{}", exchanges));
  add({1, 1, -1}, fmt::format("mirrored, head for feet{}", exchanges));
  add({-1, 1, -1}, fmt::format("turned by half, right for left and head for feet{}", keeps));
  add({1, -1, -1}, fmt::format("turned by half, back for front and head for feet{}", keeps));
  add({-1, -1, -1}, fmt::format("mirrored along all three axes{}", exchanges));
  if (!lie.septum)
    return causes;
  causes.push_back(
      {{-lie.apex, lie.septum},
       fmt::format("mirrored along the long axis, its slices in the reverse order{}", exchanges)});
  causes.push_back({{lie.apex, -*lie.septum},
                    "mirrored from septum to free wall, or what was named as its septum or right "
                    "ventricle lies on the other side, and the regions bear the names of those "
                    "opposite"});
  return causes;
}

std::string explained(const Lie& lie) {
  const std::vector<Cause> causes = causes_of(lie);
  const auto best = std::min_element(
      causes.begin(), causes.end(),
      [](const Cause& a, const Cause& b) { return turn(a.undone) < turn(b.undone); });
  const double left = turn(best->undone);
  if (!lie.septum)
    return ": it seems mirrored or turned; which of both, and so whether regions are exchanged, "
           "only its septum would tell";
  if (left > explained_turn || left > turn(lie) - clear_gain)
    return ": it seems mirrored or turned, and anterior and inferior regions exchanged";
  return fmt::format(": it seems {}", best->what);
}

}  // namespace

std::optional<Vec3> Lie::anterior() const {
  if (!septum)
    return std::nullopt;
  return septum->cross(apex);
}

std::string describe(const Lie& lie) {
  std::string text = fmt::format("apex {}", place_of(lie.apex));
  if (lie.septum)
    text += fmt::format(", septum {}, anterior wall {}", place_of(*lie.septum),
                        place_of(*lie.anterior()));
  return text;
}

std::string oddity(const Lie& lie) {
  std::vector<std::string> odd = odd_directions(lie);
  if (odd.empty() && turn(lie) > farthest_turn)
    odd.push_back(
        fmt::format("the heart is turned by {:.0f} degrees against how hearts lie", turn(lie)));
  if (odd.empty())
    return {};
  return fmt::format("{} (left, back, head: {}){}", fmt::join(odd, ", "), describe(lie),
                     explained(lie));
}

}  // namespace lv::geometry
