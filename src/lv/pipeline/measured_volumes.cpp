#include "lv/pipeline/measured_volumes.hpp"

#include "lv/base/check.hpp"
#include "lv/base/units.hpp"
#include "lv/calibrate/klotz.hpp"
#include "lv/calibrate/one_fibre.hpp"
#include "lv/mesh/quality.hpp"
#include "lv/solid/endocardial_surface.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace lv::pipeline {
namespace {

using calibrate::FittedPassive;
using case_file::Case;
using units::ml;
using units::mmHg;

constexpr double longest_fibres = 1.5;

/// At which the law of the case bears no tension any more.
double shortest_fibres(const Case& c) {
  if (c.active_law != case_file::ActiveChoice::land2017)
    return 0.8;
  constexpr double least = 0.5;  // of a law that hardly depends on stretch
  return std::max(least, 0.5 * (1.87 - 1.0 / c.land2017.beta_0));  // h = 0, below 0.87
}

/// What the endocardium encloses below the base plane, and the wall around it [mm^3].
struct Volumes {
  double cavity, wall;
};

Volumes volumes_of(const anatomy::Shape& shape) {
  constexpr double edge_length = 3.0;  // of quadratic elements: right to a thousandth [mm]
  const mesh::Mesh wall =
      shape.given ? *shape.given
                  : mesh::wall_mesh(shape.wall, {.edge_length = edge_length, .order = 2});
  return {solid::EndocardialSurface(wall).volume(wall.nodes), mesh::quality(wall).wall_volume};
}

/// A measured volume in words, with its line.
struct Measured {
  const char* parameter;
  double volume;
};

[[noreturn]] void refuse(const Case& c, const Measured& measured, const std::string& why,
                         const std::string& remedy) {
  throw InputError(
      case_file::place_of(c, measured.parameter),
      fmt::format("{} is {:.1f} ml, and {}", measured.parameter, measured.volume / ml, why),
      remedy);
}

void check_edv(const Case& c, const Measured& edv, double cavity) {
  if (edv.volume > (1.0 + c.calibration.tolerance) * cavity)
    return;
  if (!c.calibration.fits_muscle())
    refuse(c, edv,
           fmt::format("the shape of the anatomy, which is taken as free of stress, holds {:.1f} "
                       "ml already: no pressure fills it to less",
                       cavity / ml),
           "If the shape is that of end-diastole, it bears a pressure: set unloaded.pressure to "
           "it; else give the shape of early diastole");
  const double p = c.protocol.ed_pressure / mmHg;
  refuse(c, edv,
         fmt::format(
             "the shape of the anatomy, which is taken as free of stress, holds {:.1f} ml already: "
             "under protocol.ed_pressure ({:g} mmHg) no stiffness fills it to that volume",
             cavity / ml, p),
         fmt::format(
             "If the shape is that of end-diastole, it bears the pressure: set unloaded.pressure = "
             "\"{0:g} mmHg\", and calibrate.passive = \"klotz\" without calibrate.edv, since a "
             "wall that was unloaded from {0:g} mmHg fills to its own volume whatever its "
             "stiffness. To fit the stiffness to a volume, give the shape of early diastole",
             p));
}

void check_esv(const Case& c, const Measured& esv, double cavity) {
  if (esv.volume >= cavity)
    refuse(c, esv,
           fmt::format("the shape of end-diastole holds {:.1f} ml: nothing would be ejected",
                       cavity / ml),
           "Give the cavity's volume at end-systole, and check that the shape is that of "
           "end-diastole");
}

/// The volumes between which the mean fibre has a length that it can have.
void check_fibres(const Case& c, const Measured& measured, double V_0, double V_w) {
  const double least = calibrate::one_fibre_volume(V_0, V_w, shortest_fibres(c));
  const double most = calibrate::one_fibre_volume(V_0, V_w, longest_fibres);
  const std::string wall =
      fmt::format("this heart's ({:.1f} ml of muscle around {:.1f} ml{})", V_w / ml, V_0 / ml,
                  case_file::is_loaded(c) ? " without load, by Klotz's curve" : " without load");
  const char* remedy =
      "Check the volume, its unit and its moment, and the drawn borders: muscle too thick or a "
      "cavity too small shows here too";
  if (measured.volume < least)
    refuse(c, measured,
           fmt::format("no contractility brings {} below {:.1f} ml: its fibres have then shortened "
                       "by {} in the mean, where they bear no tension any more",
                       wall, least / ml,
                       c.active_law == case_file::ActiveChoice::land2017
                           ? fmt::format("{:.0f}%", 100.0 * (1.0 - shortest_fibres(c)))
                           : "a fifth"),
           remedy);
  if (measured.volume > most)
    refuse(c, measured,
           fmt::format("no muscle fills {} beyond {:.1f} ml: its fibres are then half as long "
                       "again as without load, in the mean",
                       wall, most / ml),
           remedy);
}

}  // namespace

void check_measured_volumes(const Case& c, const anatomy::Shape& shape) {
  const case_file::Calibration& k = c.calibration;
  const bool klotz = k.passive == FittedPassive::klotz;
  const bool loaded = case_file::is_loaded(c);
  if (k.shape && shape.end_systole.empty())
    throw InputError(case_file::place_of(c, "calibrate.shape"),
                     "calibrate.shape is true, and the source of the anatomy shows no surface at "
                     "end-systole to fit to",
                     "Give loops at end-systole (anatomy.contours.es_short_axis), or a source with "
                     "both moments; or set calibrate.shape = false");
  if (!k.asked() || (loaded && !klotz))
    return;  // what a loaded wall holds without load is not known before, but for Klotz's curve
  const auto [cavity, wall] = volumes_of(shape);
  const double V_0 = loaded ? calibrate::klotz(cavity, c.unloaded.pressure).V0 : cavity;
  const Measured edv{"calibrate.edv", k.edv};
  const Measured esv{"calibrate.esv", k.esv};
  if ((k.passive != FittedPassive::none && !klotz) || (k.cycle && k.edv > 0.0)) {
    if (!loaded)
      check_edv(c, edv, cavity);
    check_fibres(c, edv, V_0, wall);
  }
  if (!k.active && !(k.cycle && k.esv > 0.0))
    return;
  if (klotz)
    check_esv(c, esv, cavity);
  check_fibres(c, esv, V_0, wall);
}

std::string little_ejection(const Case& c, const anatomy::Shape& shape) {
  constexpr double least = 0.1;
  const case_file::Calibration& k = c.calibration;
  if (!(k.esv > 0.0) || !(k.edv > 0.0 || case_file::is_loaded(c)))
    return {};
  const double diastolic = k.edv > 0.0 ? k.edv : volumes_of(shape).cavity;
  if (k.esv <= (1.0 - least) * diastolic)
    return {};
  return fmt::format(
      "calibrate.esv is {:.1f} ml, and the cavity holds {:.1f} ml at end-diastole: an ejection "
      "fraction of {:.0f}%, with which nobody lives; check that both volumes are of one heart, and "
      "the moment of each",
      k.esv / ml, diastolic / ml, 100.0 * (1.0 - k.esv / diastolic));
}

}  // namespace lv::pipeline
