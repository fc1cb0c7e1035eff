#include "lv/beating_wall/filling_reach.hpp"

#include "lv/base/check.hpp"
#include "lv/base/log.hpp"
#include "lv/calibrate/fit.hpp"
#include "lv/calibrate/model.hpp"
#include "lv/case_file/beat_fit.hpp"
#include "lv/case_file/family.hpp"
#include "lv/case_file/read_case.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace lv::beating_wall {
namespace {

using case_file::Case;
using units::ml;
using units::mmHg;

constexpr double first_pressure = 15.0 * mmHg;  // which fills most walls to their volume

/// The largest pressure before the mitral valve, and why it is that.
struct LargestFilling {
  double pressure;  ///< [kPa]
  std::string why;
  std::string more;  ///< what allows it
};

LargestFilling largest_filling(const Case& c) {
  LargestFilling most{
      most_of_any_filling,
      fmt::format("more than any patient's left ventricle is filled with ({:g} mmHg "
                  "in the worst failure)",
                  worst_filling / mmHg),
      ""};
  if (c.circulation.kind == circulation::Kind::closed_loop)
    return most;
  const std::string name = case_file::levers(c).filling;
  const double own = c.circulation.windkessel.p_ven;
  most.pressure = std::max(most.pressure, own);
  const double range = case_file::find_parameter(name)->range.high * mmHg;
  const double fitted = std::min(c.calibration.factor.high * own, range);
  if (fitted < most.pressure)
    return {fitted,
            fmt::format("the most that {} may come to (calibrate.factor_max times its {:g} mmHg)",
                        name, own / mmHg),
            "; calibrate.factor_max allows more pressure"};
  return most;
}

std::string what_helps(const Case& c) {
  const std::string check = "Check the volume, its unit and that the shape is of the same heart";
  return c.calibration.passive == calibrate::FittedPassive::none
             ? check +
                   "; calibrate.passive = \"scale\" fits the stiffness to it first, at "
                   "protocol.ed_pressure"
             : check + " and time";
}

}  // namespace

FilledWall fill_until(double volume, double most, const Case& c, const mesh::Mesh& mesh) {
  const calibrate::FitParameters as_it_is;
  calibrate::Ventricle ventricle(
      mesh, [&](const calibrate::FitParameters&) { return case_file::static_model(c); },
      c.quasi_static.solver);
  FilledWall filled{0.0, ventricle.volume(as_it_is, {}).value(), ""};
  for (double next = std::min(first_pressure, most);
       filled.volume < volume && filled.pressure < most; next = std::min(2.0 * next, most)) {
    const auto found = ventricle.volume(as_it_is, {next});
    if (!found) {
      filled.why_ended = found.why().what;
      break;
    }
    filled.pressure = next;
    filled.volume = *found;
  }
  return filled;
}

void check_filling(const Case& c, const anatomy::MeshResult& wall) {
  const double edv = c.calibration.edv;
  if (edv == 0.0)
    return;
  const LargestFilling most = largest_filling(c);
  const FilledWall filled = fill_until(edv, most.pressure, c, wall.mesh);
  if (filled.volume >= edv)
    return;
  const bool ended = !filled.why_ended.empty();
  const std::string what = fmt::format(
      "calibrate.edv is {:.1f} ml, and this wall holds {:.1f} ml without any tension under {:.4g} "
      "mmHg, {}",
      edv / ml, filled.volume / ml, filled.pressure / mmHg,
      ended ? fmt::format("and was not filled farther ({})", filled.why_ended) : most.why);
  const bool is_bound = !ended && c.base_motion.source == heartbeat::BaseMotionSource::none;
  if (is_bound && edv > (1.0 + calibrate::reach_margin) * filled.volume)
    throw InputError(case_file::place_of(c, "calibrate.edv"), what, what_helps(c) + most.more);
  log::warn(
      "{}: the target probably cannot be reached, and the fit searches for what comes nearest",
      what);
}

}  // namespace lv::beating_wall
