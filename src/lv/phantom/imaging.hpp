#pragma once

#include "lv/geometry/contours.hpp"
#include "lv/geometry/frame.hpp"
#include "lv/image/picture.hpp"
#include "lv/phantom/trabeculae.hpp"
#include "lv/phantom/ventricle.hpp"

#include <cstdint>
#include <vector>

namespace lv::phantom {

/// How the study's images are made.
struct Scan {
  double pixel = 1.4;          ///< spacing in the plane [mm]
  double field_of_view = 200;  ///< [mm]
  double thickness = 8.0;      ///< of slices [mm]
  double gap = 0.0;            ///< between short-axis slices [mm]
  int phases = 25;
  double rr = 0.9;       ///< length of the heart's cycle [s]
  double snr = 0.0;      ///< mean signal of muscle / standard deviation of the noise; 0: no noise
  double shift = 0.0;    ///< root mean square of the slices' breath-hold shifts [mm]
  double texture = 0.2;  ///< of muscle, standard deviation / mean
  bool oblique = true;   ///< the heart lies in the chest as hearts do; else along the scanner's z
  std::uint32_t seed = 1;
};

/// The model frame of the phantom in image space.
[[nodiscard]] geometry::Frame pose(const Scan& scan);

/// A plane of the study and how far the heart lies from its place in that breath-hold.
struct ScanPlane {
  std::string name;
  image::Plane plane;
  double height = 0.0;        ///< of a short-axis plane in the model frame [mm]
  double angle = 0.0;         ///< of a long-axis plane's row about the long axis [rad]
  Vec3 shift = Vec3::Zero();  ///< of the heart, image space [mm]
};

struct ScanPlanes {
  std::vector<ScanPlane> short_axis;  ///< from the base to the apex
  std::vector<ScanPlane> long_axis;   ///< four, two and three chambers
};
[[nodiscard]] ScanPlanes planes(const Ventricle& ventricle, const Scan& scan);

/// Voxels of a label map.
enum Label : std::uint8_t { background = 0, cavity = 1, muscle = 2, scar = 3 };

/// A label per pixel, of what lies at its centre in the middle of the slice.
struct LabelPicture {
  image::Plane plane;
  std::vector<std::uint8_t> values;
};

enum class Contrast { cine, late_enhancement };

/// Makes images: the mean signal over each pixel and the slice's thickness, then Rician noise.
/// Blood is bright; muscle is darker with a smooth texture that moves with it; a right ventricle
/// lies along the septum, lung around. In late enhancement healthy muscle is nulled and scar
/// bright.
class Scanner {
 public:
  Scanner(const Ventricle& ventricle, const Scan& scan);

  /// One image at a time in the cycle (a fraction of it). `number` tells its noise from others'.
  [[nodiscard]] image::Picture picture(const ScanPlane& plane, double time, Contrast contrast,
                                       std::uint32_t number) const;

  [[nodiscard]] LabelPicture labels(const ScanPlane& plane, double time) const;

 private:
  /// What is at a point of the model frame.
  struct Place {
    Label label;
    bool right_ventricle;
    Vec3 X;                  ///< at end-diastole
    bool in_cavity = false;  ///< papillary or trabecular muscle, which counts to the cavity
  };
  [[nodiscard]] Place place(const Motion& motion, const Vec3& x) const;
  [[nodiscard]] double signal(const Place& at, const Vec3& x, Contrast contrast) const;
  [[nodiscard]] double texture(const Vec3& X) const;
  [[nodiscard]] double mean_signal(const ScanPlane& plane, const Motion& motion, int i, int j,
                                   Contrast contrast) const;
  [[nodiscard]] Vec3 in_model(const ScanPlane& plane, double i, double j, double across) const;

  struct Wave {
    Vec3 k;
    double phase;
  };
  const Ventricle& ventricle_;
  const Scan& scan_;
  geometry::Frame pose_;
  Trabeculae trabeculae_;
  std::vector<Wave> waves_;
};

/// Contours that an observer without error draws on the images of one time: on every short-axis
/// slice whose middle cuts the cavity, on the long axes, and the two apex points of each long axis.
/// On shifted slices they lie where the heart lies in the image.
[[nodiscard]] geometry::Contours contours(const Ventricle& ventricle, const Scan& scan,
                                          const ScanPlanes& planes, double time);

}  // namespace lv::phantom
