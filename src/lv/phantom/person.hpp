#pragma once

#include "lv/geometry/contours.hpp"
#include "lv/geometry/ellipsoid.hpp"
#include "lv/geometry/frame.hpp"
#include "lv/image/picture.hpp"
#include "lv/phantom/imaging.hpp"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace lv::phantom {

enum class PersonKind { healthy, dilated, hypertrophic, infarcted, small, large };
[[nodiscard]] std::string name(PersonKind kind);

/// One wave around the ventricle: amplitude cos(order theta + phase + twist Z/Z_apex).
struct WallWave {
  int order = 2;
  double amplitude = 0.0, phase = 0.0, twist = 0.0;
};

/// A person's ventricle at end-diastole: an ellipsoid whose wall is irregular and whose long axis
/// is bent and lies askew in the stack of slices.
struct Person {
  std::uint32_t seed = 1;
  PersonKind kind = PersonKind::healthy;
  geometry::Ellipsoid shape;
  std::array<WallWave, 3> outline;      ///< of the cavity's radius, as a fraction
  std::array<WallWave, 4> thickness;    ///< as a fraction
  double septal = 0.0;                  ///< the septum is thicker by this fraction
  double bend = 0.0, bend_angle = 0.0;  ///< of the apex off the axis [mm], and where to [rad]
  double tilt = 0.0, tilt_angle = 0.0;  ///< of the axis against the slices' normal [rad]
  Scar scar;                            ///< transmurality 0: none
  double scar_thinning = 0.0;           ///< part of the wall's thickness lost there
  double ejection = 0.6;                ///< part of the cavity that healthy muscle ejects
  double shortening = 0.1;              ///< of the long axis at end-systole
  double ed_pressure = 0.0;             ///< end-diastolic [kPa]
  double cuff_systolic = 0.0;           ///< [kPa]
  double slice_spacing = 8.0, pixel = 1.4, breath_hold = 0.0;  ///< of the images [mm]

  /// Squared radius about the bent axis at height Z and angle theta at end-diastole [mm^2];
  /// negative beyond the surface's apex.
  [[nodiscard]] double radius_squared(geometry::Side side, double theta, double Z) const;
  [[nodiscard]] double apex() const { return -shape.base_height - shape.epi_length; }
};

/// The person of a seed. Kinds take turns: 1 healthy, 2 dilated, 3 hypertrophic, 4 infarcted, 5
/// small, 6 large, 7 healthy, ... Within each, all is drawn evenly from ranges which hold what is
/// seen: volumes and masses of healthy people as in S. E. Petersen et al., J. Cardiovasc. Magn.
/// Reson. 19:18, 2017; ejection of dilated ones as in P. Shams & F. A. Sultan, J. Clin. Imaging
/// Sci. 11:40, 2021 (29 +- 12%); hypertrophic walls from 15 mm, the limit of the guidelines (P. M.
/// Elliott et al., Eur. Heart J. 35:2733, 2014). The widths of the others (sphericity, bend, tilt,
/// irregularity, scars, pressures) are choices.
[[nodiscard]] Person person(std::uint32_t seed);

/// End-diastole or end-systole: which frame of the label map.
enum class PersonTime { diastole, systole };

/// Volumes of the ventricle without images, by integration below the base plane [mm^3].
struct PersonVolumes {
  double edv = 0.0, esv = 0.0, wall = 0.0, scar = 0.0;
};
[[nodiscard]] PersonVolumes volumes(const Person& person);

/// What images and observers show of a person.
struct PersonStudy {
  std::vector<ScanPlane> slices;                    ///< from the base to the apex
  std::array<std::vector<LabelPicture>, 2> labels;  ///< by PersonTime
  std::vector<LabelPicture> scar;                   ///< at end-diastole; label 4 within the muscle
  std::array<std::vector<geometry::Contour>, 2> contours;  ///< loops on the slices, by PersonTime
  std::array<double, 2> label_volume{};                    ///< of the cavity's pixels [mm^3]
};
[[nodiscard]] PersonStudy study_of(const Person& person);

/// Labels of these maps: right ventricle, muscle and cavity as in the ACDC and M&Ms challenges.
enum PersonLabel : std::uint8_t {
  person_rv = 1,
  person_muscle = 2,
  person_cavity = 3,
  person_scar = 4
};

/// Writes case.toml (from labels), case_contours.toml, labels.nii.gz of two frames, scar.nii.gz
/// where there is one, contours/ and truth.json into a new folder. Throws InputError for a folder
/// that is not empty and RunError when files cannot be written. Returns what to tell the user.
std::string write_person(std::uint32_t seed, const std::filesystem::path& folder);

}  // namespace lv::phantom
