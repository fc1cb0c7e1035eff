#pragma once

#include "lv/image/picture.hpp"
#include "lv/strain/ring.hpp"

#include <memory>
#include <vector>

namespace lv::strain {

/// How images are registered.
enum class Template {
  direct,      ///< every image to the one at end-diastole
  incremental  ///< every image to the one before
};

/// Parameters of the registration; how the defaults were chosen is in docs/strain.md.
struct RegistrationParameters {
  Template scheme = Template::direct;
  double knot_spacing = 8.0;  ///< of the B-spline [mm]
  double bending = 2.0;       ///< beta, weight of the bending energy [mm^2]
  double smoothing = 1.0;     ///< of the images: standard deviation of a Gaussian [mm]
  double margin = 6.0;        ///< pixels up to this distance outside the epicardium count [mm]
};

/// How well one image was matched.
struct Match {
  double residual = 0.0;  ///< root mean square of the grey values' difference / their deviation
  int iterations = 0;
};

/// Follows the points of one image through others of its plane by deformable registration:
///
///   phi(X) = X + sum_a p_a B_a(X),  B_a tensor products of cubic B-splines on a regular grid,
///
///   minimise over p   mean_X (I_k(phi(X)) - T(X))^2 / var T  +  beta mean_X |D^2 phi|^2
///
/// with the mean over the pixels of the heart, T the first image (or, incrementally, the image
/// before, followed so far), and the bending energy after D. Rueckert et al., IEEE Trans. Med.
/// Imaging 18:712, 1999. The transform, the interpolation and the smoothing are ITK's. The sum of
/// squares is minimised by Levenberg and Marquardt's method, which needs some ten evaluations where
/// a gradient method needs a hundred, on images smoothed less and less, from the map of the image
/// before.
///
/// Points are in the plane: columns and rows times spacing [mm].
class Tracker {
 public:
  /// `outline` is the epicardium on the first image.
  Tracker(const image::Picture& first, const std::vector<Vec2>& outline,
          const RegistrationParameters& parameters);
  ~Tracker();
  Tracker(Tracker&&) noexcept;
  Tracker& operator=(Tracker&&) noexcept;

  /// Matches the next image. Throws InputError if it has another size than the first.
  Match follow(const image::Picture& next);

  /// Where a point of the first image is in the last one followed.
  [[nodiscard]] Moved operator()(const Vec2& X) const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace lv::strain
