#pragma once

#include "lv/drawing/orientation.hpp"
#include "lv/page/wall_series.hpp"

#include <array>
#include <cmath>
#include <span>
#include <string_view>
#include <vector>

namespace lv::page {

/// What a view of the page cuts open.
enum class Opened { nothing, long_axis, short_axis };

/// A view of the wall that has a name on the page. Angles are about the long axis from the middle
/// of the septum, anticlockwise seen from the base [deg].
struct NamedView {
  std::string_view name;
  double azimuth;      ///< of the viewer; from the apex, that of the wall that is up
  double elevation;    ///< of the viewer above the plane of the base [deg]
  Opened opened;       ///< what lies before the cut is taken away
  double plane = 0.0;  ///< of a long axis

  [[nodiscard]] bool is_from_the_side() const { return std::abs(elevation) < 45.0; }
  /// The direction in which the viewer looks.
  [[nodiscard]] Vec3 view(const drawing::Orientation& orientation) const;
  /// The plane of a long axis, its normal towards the viewer.
  [[nodiscard]] drawing::Plane cut(const drawing::Orientation& orientation) const;
};

/// The clinical views: long axes through the middle of the septum (four chambers), the anteroseptal
/// wall (three) and the anterior wall (two), with the septum, or the inferior wall, on the left;
/// the short axis from the apex; and the whole wall from its sides.
inline constexpr std::array<NamedView, 9> views{{
    {"4-chamber", 90.0, 8.0, Opened::long_axis, 0.0},
    {"3-chamber", 120.0, 8.0, Opened::long_axis, 30.0},
    {"2-chamber", 0.0, 8.0, Opened::long_axis, 90.0},
    {"short axis", 90.0, -89.9, Opened::short_axis},
    {"anterior", 90.0, 8.0, Opened::nothing},
    {"septal", 0.0, 8.0, Opened::nothing},
    {"inferior", 270.0, 8.0, Opened::nothing},
    {"lateral", 180.0, 8.0, Opened::nothing},
    {"apex", 90.0, -89.9, Opened::nothing},
}};

/// Whether any of a wall's nodes has M > 0.5.
[[nodiscard]] bool has_infarct(const WallSeries& wall);

/// How much infarct each view shows of a wall at a frame: the area of the picture in which the
/// surface or section that is seen has M > 0.5 [mm²]. Views along the axis count as 0.
[[nodiscard]] std::vector<double> infarct_shown(const WallSeries& wall, std::size_t frame,
                                                const drawing::Orientation& orientation);

/// The number of the view in which a page opens, by the infarct that each shows: the long axis
/// that shows the most, since it shows the depth too, where that is at least half of what any view
/// shows; else the view that shows the most. Without an infarct the first.
[[nodiscard]] std::size_t opening_view(std::span<const double> shown);

}  // namespace lv::page
