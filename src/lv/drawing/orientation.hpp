#pragma once

#include "lv/drawing/scene.hpp"
#include "lv/geometry/fit_report.hpp"

#include <array>
#include <initializer_list>
#include <string>
#include <vector>

namespace lv::drawing {

/// How a ventricle lies in the model frame (its long axis along z, the base up), and what of its
/// anatomy was taken for granted.
struct Orientation {
  double septum_angle = 0.0;  ///< as mesh::RegionParameters has it [rad]
  std::vector<geometry::Assumption> assumed{};
  /// The wall that is free of stress was found by unloading the one that was seen; else it is taken
  /// as that of early diastole.
  bool is_unloaded = false;

  [[nodiscard]] Vec3 septal() const;
  [[nodiscard]] Vec3 anterior() const;  ///< a quarter turn further, anticlockwise from the base
  [[nodiscard]] bool assumes(const std::string& part) const;
  /// The label with a star where the part was assumed: "septal*".
  [[nodiscard]] std::string starred(const std::string& label, const std::string& part) const;
  /// The same where any of these parts was.
  [[nodiscard]] std::string starred(const std::string& label,
                                    std::initializer_list<const char*> parts) const;

  /// What the wall that is free of stress is called: "early diastole", with a star where that was
  /// assumed, or "the wall without load".
  [[nodiscard]] std::string at_rest() const;

  /// A letter for a wall, with a star where the septum is assumed, and the way to it from the axis.
  struct WallDirection {
    std::string letter;
    Vec3 direction;
  };
  /// A, S, I and L.
  [[nodiscard]] std::array<WallDirection, 4> walls() const;
};

/// What the stars of a figure mean, of those of the given parts that were assumed; empty if none.
[[nodiscard]] std::string star_note(const Orientation& orientation,
                                    const std::vector<std::string>& parts);

/// A direction in which a viewer looks, and what is up for it.
struct Look {
  Vec3 view, up;
};

/// The clinical short axis, seen from the apex: anterior up, septum left.
[[nodiscard]] Look short_axis(const Orientation& orientation);

/// Long axes with the base up, seen a little from above: the four-chamber view has the septum on
/// the left and the lateral wall on the right, the two-chamber view the inferior wall on the left
/// and the anterior wall on the right.
[[nodiscard]] Look four_chamber(const Orientation& orientation);
[[nodiscard]] Look two_chamber(const Orientation& orientation);

/// The planes of these views through the long axis; what is nearer to the viewer is cut away.
[[nodiscard]] Plane four_chamber_plane(const Orientation& orientation);
[[nodiscard]] Plane two_chamber_plane(const Orientation& orientation);

/// The plane across the long axis at a height; the apical part is cut away.
[[nodiscard]] Plane short_axis_plane(double z);

/// A short text at a place in space, drawn over a scene.
struct Letter {
  std::string text;
  Vec3 at;
};

/// A, S, I and L around the base of a wall whose points are given, outside of it and a little
/// above; without those that lie in line with the view, before or behind what is seen.
[[nodiscard]] std::vector<Letter> wall_letters(const Orientation& orientation,
                                               const std::vector<Vec3>& points, const Vec3& view);

/// "apex*" below the wall and "base*" above it, each where it was assumed.
[[nodiscard]] std::vector<Letter> assumed_ends(const Orientation& orientation,
                                               const std::vector<Vec3>& points);

}  // namespace lv::drawing
