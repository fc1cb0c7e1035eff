#pragma once

#include "lv/image/picture.hpp"

#include <array>
#include <vector>

namespace lv::image {

/// What of a heart lies in the slab of a slice, on points evenly spread in the slice's plane.
struct SliceTissue {
  struct Point {
    Vec3 x;  ///< image space
    /// Parts of the slab's thickness that are cavity, wall and surroundings.
    std::array<double, 3> parts{0.0, 0.0, 0.0};
  };
  std::vector<Point> points;
  double area = 1.0;  ///< that each stands for [mm^2]
};

/// A move of a picture in its plane.
struct Registration {
  Vec3 move = Vec3::Zero();  ///< image space [mm]
  /// From it to the farthest move that fits as well, to within what chance does [mm].
  double doubt = 0.0;
};

/// The move of a picture in its plane, by at most `largest` [mm], for which its grey values tell
/// most of the tissue: the maximum of their mutual information
///
///   I = sum over tissue L and grey value g of p(L, g) ln(p(L, g) / p(L) p(g))
///
/// (P. Viola, W.M. Wells, Int. J. Comput. Vis. 24:137, 1997; F. Maes et al., IEEE Trans. Med.
/// Imaging 16:187, 1997). It asks of no tissue how bright it is, nor that it is of one brightness.
/// With the number n of pixels that the points stand for, and without any relation, 2 n I is
/// chi-squared of as many freedoms as the histogram has, f = (tissues - 1)(bins - 1). In doubt are
/// moves whose n I is less than the largest by no more than chance makes that of two moves differ,
/// 3.1 standard deviations (99.9%) of sqrt(f).
[[nodiscard]] Registration register_slice(const Picture& picture, const SliceTissue& tissue,
                                          double largest);

}  // namespace lv::image
