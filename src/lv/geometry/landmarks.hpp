#pragma once

#include "lv/geometry/contours.hpp"

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lv::geometry {

/// What an observer can name: a point of the blood; the insertions of the right ventricle's wall,
/// between which the septum lies; the tips; up to eight points of the mitral annulus.
inline constexpr std::array landmark_names{
    "centre",    "septum_anterior", "septum_inferior", "apex_endo", "apex_epi",
    "annulus_1", "annulus_2",       "annulus_3",       "annulus_4", "annulus_5",
    "annulus_6", "annulus_7",       "annulus_8"};

/// A point that an observer named.
struct Landmark {
  std::string name;        ///< one of landmark_names
  int slice = 0;           ///< on which it was set
  Vec3 at = Vec3::Zero();  ///< image space (scanner, LPS) [mm]
  std::string by, when;    ///< see Provenance
};

/// Reads a CSV file of the columns landmark, slice, x_mm, y_mm, z_mm, by and when. Throws
/// InputError naming file and line and what is wrong: an unknown name, one that is there twice, a
/// number that is none.
[[nodiscard]] std::vector<Landmark> read_landmarks(const std::filesystem::path& file);

/// The landmark of a name, or null.
[[nodiscard]] const Landmark* find(const std::vector<Landmark>& landmarks, std::string_view name);

/// Writes such a file.
void write_landmarks(const std::vector<Landmark>& landmarks, const std::filesystem::path& file);

/// Where the septum is, and what is odd about it.
struct Septum {
  Vec3 middle = Vec3::Zero();  ///< image space [mm]
  /// The anterior insertion is reached from the inferior one clockwise, seen from the base, as in
  /// no heart that lies where hearts do.
  bool mirrored = false;
};

/// A point of the middle of the septum, half way in angle about the long axis p + s u of contours
/// between the insertions A and B:
///
///   p + h u + r (a + b)/|a + b|,   a, b the unit vectors across u towards A and B,
///
/// r their mean distance from the axis and h their mean height. None if neither insertion is named.
/// Throws InputError, with `where` naming the landmarks, if one is without the other, or they lie
/// on opposite sides of the axis.
[[nodiscard]] std::optional<Septum> septum_of(const std::vector<Landmark>& landmarks,
                                              const Contours& contours, const std::string& where);

}  // namespace lv::geometry
