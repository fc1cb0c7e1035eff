#pragma once

#include "lv/base/tensor.hpp"
#include "lv/drawing/colour_map.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <variant>
#include <vector>

namespace lv::drawing {

/// A plane; what lies on the side its normal points to is cut away.
struct Plane {
  Vec3 point = Vec3::Zero();
  Vec3 normal = Vec3::UnitX();

  /// Distance above the plane [mm].
  [[nodiscard]] double height(const Vec3& x) const { return normal.normalized().dot(x - point); }
};

/// Triangles in space [mm]. `outlined[k][i]` says whether the side of triangle k from corner i to
/// corner i+1 is an edge of an element (and not the diagonal of a quadrilateral).
struct Patch {
  std::vector<Vec3> points{};
  std::vector<std::array<int, 3>> triangles{};
  std::vector<std::array<bool, 3>> outlined{};
};

/// Values at a patch's points, interpolated linearly in each triangle and coloured by a scale.
struct PointValues {
  std::vector<double> values{};  ///< NaN: missing, and so are the triangles around it
  ColourScale scale{};
};

/// One colour per triangle; nothing: missing.
using FaceColours = std::vector<std::optional<Colour>>;

/// How a patch is coloured.
using Paint = std::variant<Colour, PointValues, FaceColours>;

struct Item {
  Patch patch{};
  Paint paint = hex(0xcccccc);
  double outline_width = 0.0;  ///< of element edges [points]; 0: none
  Colour outline = hex(0x262626);
  bool shaded = true;  ///< by a light near the viewer; without it colours are those of the scale
  std::vector<double> border{};  ///< at the patch's points: a white line with dark rims is drawn
                                 ///< where this is 0.5; empty: none
};

struct Scene {
  std::vector<Item> items{};
  std::optional<Plane> cut{};
};

/// An orthographic camera. The part of space shown is at least `width` x `height` mm.
struct Camera {
  Vec3 view = Vec3::UnitY();  ///< the direction in which the viewer looks
  Vec3 up = Vec3::UnitZ();
  Vec3 centre = Vec3::Zero();
  double width = 100.0;   ///< [mm]
  double height = 100.0;  ///< [mm]
};

/// The camera that shows everything that is not cut away, and some points besides. Use one camera
/// for pictures to be compared.
[[nodiscard]] Camera fitted(const Scene& scene, const Vec3& view, const Vec3& up = Vec3::UnitZ(),
                            const std::vector<Vec3>& besides = {});

/// Where a camera sees a point: to the right of and below the middle of its picture, and away from
/// the viewer [mm].
[[nodiscard]] Vec3 seen(const Camera& camera, const Vec3& x);

struct Resolution {
  int width = 600;  ///< [pixels]
  int height = 600;
  double pixels_per_point = 1.0;  ///< scales outlines and the stripes of missing values
  int supersampling = 3;          ///< samples per pixel in each direction
};

/// Pixels row by row from the top, as alpha, red, green, blue from the highest byte down; colours
/// are multiplied by alpha. Where nothing is drawn alpha is 0.
struct Image {
  int width = 0;
  int height = 0;
  std::vector<std::uint32_t> argb{};
  double mm_per_pixel = 0.0;

  [[nodiscard]] double opacity(int x, int y) const;
  [[nodiscard]] Colour colour(int x, int y) const;  ///< over white
};

/// Pixels per mm when a camera fills a picture of width x height pixels (or points).
[[nodiscard]] double magnification(const Camera& camera, double width, double height);

/// Draws with a depth buffer, in software: no display, no graphics card.
[[nodiscard]] Image render(const Scene& scene, const Camera& camera, const Resolution& resolution);

}  // namespace lv::drawing
