#pragma once

#include "lv/geometry/contours.hpp"
#include "lv/image/picture.hpp"
#include "lv/phantom/imaging.hpp"
#include "lv/phantom/ventricle.hpp"

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

/// Borders that the program drew beside those that are true, or that observers drew.
namespace lv::test {

/// How drawn loops of a side agree with others of the same slices.
struct Agreement {
  double dice = 0.0;      ///< mean over slices; a missed loop counts 0
  double pooled = 0.0;    ///< Dice of the areas of all slices together
  double distance = 0.0;  ///< mean over slices [mm]
  double volume = 0.0;    ///< relative difference of the areas' sum
  int loops = 0, missed = 0;
};

[[nodiscard]] Agreement agreement(const geometry::Contours& found, const geometry::Contours& truth,
                                  geometry::Side side);

/// The mean Dice of what lies between the loops; of slices where both have both.
[[nodiscard]] double dice_of_muscle(const geometry::Contours& found,
                                    const geometry::Contours& truth);

/// A cine, and the loops that are true of some frames, counted from 0.
struct KnownCine {
  std::string name;
  image::Cine cine;
  int end_diastole = 0, end_systole = 0;
  std::map<int, geometry::Contours> truth;
};

/// Eight phases with noise (SNR 20) and slices that breath-holds shift by 3 mm.
[[nodiscard]] phantom::Scan noisy_scan(std::uint32_t seed);

/// A phantom of a ventricle, its largest and its smallest phase known.
[[nodiscard]] KnownCine phantom_study(const std::string& name, const phantom::Scan& scan,
                                      const phantom::Ventricle& ventricle);

/// A phantom with papillary muscles of 4 mm and without scar, of eight phases; `trabeculae`: the
/// depth of a rim [mm].
[[nodiscard]] KnownCine phantom_study(const std::string& name, const phantom::Scan& scan,
                                      double trabeculae);

/// A hypertrophic ventricle: a narrow cavity in a wall of this thickness, papillary muscles of this
/// radius and a rim of trabeculae of this depth [mm].
[[nodiscard]] phantom::Ventricle hypertrophic(double wall, double papillary, double trabeculae);

/// A study of the Sunnybrook data with phases in its observers' count; none where it is not there.
[[nodiscard]] std::optional<KnownCine> patient(const std::string& name, const std::string& images,
                                               int diastole, int systole);

}  // namespace lv::test
