#include "lv/case_file/read_case.hpp"

#include "lv/activation/sites.hpp"
#include "lv/base/check.hpp"
#include "lv/base/files.hpp"
#include "lv/base/lines.hpp"
#include "lv/base/nearest.hpp"
#include "lv/base/printable.hpp"
#include "lv/base/table.hpp"
#include "lv/case_file/beat_fit.hpp"
#include "lv/case_file/case_lines.hpp"
#include "lv/case_file/parameter_values.hpp"
#include "lv/circulation/heart_rate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <limits>

namespace lv::case_file {
namespace {

/// Unloaded volume by Klotz et al.: V (0.6 - 0.006 p/mmHg), which falls to none at 100 mmHg.
constexpr double most_of_klotz = 50.0 * units::mmHg;

/// Walks a parsed file and sets what it finds, gathering mistakes.
class CaseReader {
 public:
  explicit CaseReader(const std::filesystem::path& file) : file_(file) { case_.file = file; }

  explicit CaseReader(Case c) : file_(c.file), case_(std::move(c)) {}

  Case read(const toml::table& root) {
    walk(root, "");
    case_.name = printable(case_.name);
    check_together();
    check_that_all_count();
    throw_mistakes();
    return std::move(case_);
  }

  Case change(const std::vector<Change>& changes) {
    for (const Change& change : changes)
      try {
        multiply(*find_parameter(change.parameter), case_, change.factor);
        case_.origin[change.parameter] = change.place;
      } catch (const std::invalid_argument& mistake) {
        mistakes_.emplace_back(
            change.place, fmt::format("{}, multiplied by {:g}, {}", change.parameter, change.factor,
                                      mistake.what()));
      }
    check_together();
    throw_mistakes();
    return std::move(case_);
  }

 private:
  void walk(const toml::table& table, const std::string& prefix) {
    for (const auto& [key, node] : table) {
      const std::string name =
          prefix.empty() ? std::string(key.str()) : prefix + "." + std::string(key.str());
      const auto line = place(key.source().begin.line);
      if (const auto* parameter = find_parameter(name))
        set(*parameter, node, line);
      else if (node.is_table() && is_section(name))
        walk(*node.as_table(), name);
      else if (node.is_array_of_tables() && is_section(name))
        mistakes_.emplace_back(line, fmt::format("[[{0}]] has double brackets, which begin one of "
                                                 "several tables: there is one, [{0}]",
                                                 name));
      else
        mistakes_.emplace_back(line, unknown(name, node.is_table()));
    }
  }

  [[nodiscard]] std::string place(toml::source_index line) const {
    return fmt::format("{}:{}", file_.string(), line);
  }

  static bool is_section(const std::string& name) {
    const auto& all = sections();
    return std::any_of(all.begin(), all.end(), [&](const auto& s) { return s.name == name; });
  }

  static std::string unknown(const std::string& name, bool table) {
    std::vector<std::string> known;
    for (const Parameter& p : parameters())
      known.emplace_back(p.name);
    for (const Section& s : sections())
      if (table && !s.name.empty())
        known.push_back(s.name);
    const std::string nearest = nearest_name(name, known);
    return fmt::format("{} is not a {}{} (`ventricle parameters` lists them all)", name,
                       table ? "table" : "parameter",
                       nearest.empty() ? "" : fmt::format("; did you mean {}?", nearest));
  }

  void set(const Parameter& parameter, const toml::node& node, const std::string& line) {
    if (node.is_string() && fmt::format("\"{}\"", *node.value<std::string>()) == fill_in) {
      const std::string rule = parameter.rule();
      mistakes_.emplace_back(line, fmt::format("{} is to be filled in: {}{}", parameter.name,
                                               parameter.help, rule == "any" ? "" : "; " + rule));
      return;
    }
    try {
      case_file::set(parameter, case_, node);
      case_.origin[parameter.name] = line;
    } catch (const std::invalid_argument& mistake) {
      mistakes_.emplace_back(line, fmt::format("{} {}", parameter.name, mistake.what()));
    }
  }

  /// The end-systolic pressure from that of a cuff.
  void take_cuff() {
    const double cuff = case_.cuff_systolic;
    if (cuff == 0.0)
      return;
    rule(!case_.origin.contains("protocol.es_pressure"), "protocol.es_pressure",
         "and protocol.cuff_systolic are both set: the end-systolic pressure is measured, or taken "
         "from the cuff");
    case_.protocol.es_pressure = systolic_share * cuff;
  }

  /// Of contraction against less than the muscle was filled with.
  void check_pressures() {
    const heartbeat::Protocol& p = case_.protocol;
    const double ed = p.ed_pressure / units::mmHg;
    const double es = p.es_pressure / units::mmHg;
    if (case_.cuff_systolic > 0.0)
      rule(es >= ed, "protocol.cuff_systolic",
           fmt::format("of {:g} mmHg makes an end-systolic pressure of {:.1f} mmHg, which is below "
                       "the end-diastolic one (protocol.ed_pressure, {:g} mmHg): check both",
                       case_.cuff_systolic / units::mmHg, es, ed));
    else
      rule(
          es >= ed,
          case_.origin.contains("protocol.es_pressure") ? "protocol.es_pressure"
                                                        : "protocol.ed_pressure",
          fmt::format("does not go with the other pressure: {:g} mmHg at end-systole (es_pressure) "
                      "are less than {:g} mmHg at end-diastole (ed_pressure); check both",
                      es, ed));
  }

  void check_slices() {
    constexpr double least = 0.5;  // [mm]; seven of 1 mm are the ventricle of a mouse
    const double spacing = case_.regions.slice_spacing;
    rule(spacing == 0.0 || spacing >= least, "regions.slice_spacing",
         fmt::format("is {:g} mm: seven slices so near to each other lie in the base; give {:g} mm "
                     "or more, or 0 for the wall's length / 6.5",
                     spacing, least));
  }

  /// A pressure that may be off by more than half of itself tells nothing; the default error does
  /// not say that of a small one.
  void limit_pressure_error() {
    if (!case_.origin.contains("calibrate.pressure_error") && is_loaded(case_))
      case_.calibration.pressure_error =
          std::min(case_.calibration.pressure_error, 0.5 * case_.unloaded.pressure);
  }

  /// Times of chambers that the case does not set are those of its heart rate.
  void follow_heart_rate() {
    Case usual;
    usual.circulation = circulation::with_times_at(case_.circulation.period, usual.circulation);
    for (const char* chamber : {"left_ventricle", "closed_loop.left_atrium",
                                "closed_loop.right_atrium", "closed_loop.right_ventricle"})
      for (const char* time : {"T_C", "T_R", "t_C"}) {
        const std::string name = fmt::format("circulation.{}.{}", chamber, time);
        if (!case_.origin.contains(name))
          copy(*find_parameter(name), usual, case_);
      }
  }

  /// Rules that concern several parameters.
  void check_together() {
    take_cuff();
    check_pressures();
    check_slices();
    limit_pressure_error();
    follow_heart_rate();
    const geometry::Ellipsoid& e = case_.anatomy.ellipsoid;
    together(e.epi_radius > e.endo_radius,
             {"anatomy.ellipsoid.epi_radius", "anatomy.ellipsoid.endo_radius"},
             "must be larger than endo_radius");
    together(e.epi_length > e.endo_length,
             {"anatomy.ellipsoid.epi_length", "anatomy.ellipsoid.endo_length"},
             "must be larger than endo_length");
    together(std::abs(e.base_height) < e.endo_length,
             {"anatomy.ellipsoid.base_height", "anatomy.ellipsoid.endo_length"},
             "must be between -endo_length and endo_length");
    const mesh::InfarctParameters& scar = case_.scar;
    together(scar.described.bottom <= scar.described.top,
             {"infarct.described.bottom", "infarct.described.top"}, "must not be larger than top");
    const bool elements = scar.source == mesh::InfarctSource::elements;
    rule(!elements || case_.anatomy.source == AnatomySource::mesh, "infarct.source",
         "can be \"elements\" only with anatomy.source = \"mesh\"");
    rule(!elements || !scar.set.empty(), "infarct.source",
         "is \"elements\", but infarct.elements.set is not set");
    const auto& A = case_.active.A;
    together(A[0] + A[1] + A[2] > 0.0, {"active.A_1", "active.A_2", "active.A_3"},
             "and A_2 and A_3 must have a positive sum");
    const heartbeat::Protocol& p = case_.protocol;
    together(p.filling_longest >= p.filling_ramp + p.filling_window,
             {"protocol.filling_longest", "protocol.filling_ramp", "protocol.filling_window"},
             "must leave time for filling_ramp and filling_window");
    together(p.contraction_longest >= p.contraction_ramp + p.contraction_window,
             {"protocol.contraction_longest", "protocol.contraction_ramp",
              "protocol.contraction_window"},
             "must leave time for contraction_ramp and contraction_window");
    const auto& q = case_.quasi_static;
    rule(
        q.order == 2 || q.solver.newton.linear.method == implicit::LinearMethod::direct,
        "quasi_static.linear_solver",
        "is iterative, which does not converge with the linear elements of quasi_static.order = 1");
    together(p.calcium.Ca_max > p.calcium.Ca_0, {"calcium.Ca_max", "calcium.Ca_0"},
             "must be larger than Ca_0");
    together(p.calcium.t_2 > p.calcium.t_1, {"calcium.t_2", "calcium.t_1"},
             "must be longer than t_1");
    check_land2017();
    check_calibration();
    check_circulation();
    check_supports();
    check_base_motion();
    check_cycle();
    check_study();
    check_activation();
    const double fall = case_.anatomy.cine.segmentation.fall;
    rule(fall == 0.0 || fall >= 0.5, "segment.fall",
         fmt::format("is {:g}; it must be 0, for the study's own edges, or between 0.5 and 0.95",
                     fall));
    const StrainStudy& study = case_.strain;
    rule(study.measured.empty() || !study.measured_column.empty(), "strain.measured",
         "needs strain.measured_column, the name of the column that holds end-systole");
  }

  void check_land2017() {
    const material::Land2017& law = case_.land2017;
    together(law.k_uw * (1.0 / law.r_w - 1.0) >= law.k_ws,
             {"active.land2017.k_ws", "active.land2017.k_uw", "active.land2017.r_w"},
             "must not be larger than k_uw (1/r_w - 1), the rate at which cross-bridges leave the "
             "state W: some must go back");
    together(law.Ca_50ref + law.beta_1 * (law.longest - 1.0) > 0.0,
             {"active.land2017.beta_1", "active.land2017.Ca_50ref"},
             "must leave a calcium at half activation above zero at a stretch of 1.2: Ca_50ref + "
             "0.2 beta_1 > 0");
  }

  /// What is set and does nothing would be taken for something that it is not. The mesh is told
  /// apart: its edge length stays in a case that is given to either engine, and is warned of.
  void check_that_all_count() {
    for (const auto& [name, place] : case_.origin) {
      const std::string where = counts_only(*find_parameter(name), case_);
      if (where.empty())
        continue;
      const std::string what = fmt::format("{} does nothing here: it counts only {}", name, where);
      if (name.starts_with("mesh."))
        case_.without_effect.push_back(what);
      else
        mistakes_.emplace_back(
            place,
            what + ". Remove this line, or make it a comment, if the case is meant to be another");
    }
  }

  void check_calibration() {
    const Calibration& k = case_.calibration;
    const bool klotz = k.passive == calibrate::FittedPassive::klotz;
    const bool passive = k.passive != calibrate::FittedPassive::none && !klotz;
    rule(!klotz || is_loaded(case_), "calibrate.passive",
         "is \"klotz\", which takes the shape of end-diastole: set the pressure that it bears, "
         "pressure = \"... mmHg\" under [unloaded]");
    rule(!klotz || !is_loaded(case_) ||
             std::abs(case_.unloaded.pressure - case_.protocol.ed_pressure) <
                 1e-6 * case_.unloaded.pressure,
         "protocol.ed_pressure",
         "is not unloaded.pressure: the shape that calibrate.passive = \"klotz\" takes is that of "
         "end-diastole, so set both alike");
    rule(!klotz || !is_loaded(case_) || k.pressure_error < case_.unloaded.pressure,
         "calibrate.pressure_error",
         fmt::format("is {:g} mmHg, and must be less than the pressure that it is the error of, "
                     "unloaded.pressure ({:g} mmHg): the fit is made again with as much less",
                     k.pressure_error / units::mmHg, case_.unloaded.pressure / units::mmHg));
    rule(
        !klotz || case_.unloaded.pressure <= most_of_klotz, "unloaded.pressure",
        fmt::format(
            "is {:g} mmHg: the curve that calibrate.passive = \"klotz\" takes is of hearts with up "
            "to 30 mmHg, and is not stretched beyond {:g} mmHg; check the pressure and its unit",
            case_.unloaded.pressure / units::mmHg, most_of_klotz / units::mmHg));
    rule(!klotz || case_.passive.law == PassiveChoice::holzapfel_ogden, "calibrate.passive",
         "fits the Holzapfel-Ogden law alone; passive.law is another");
    rule(!passive || k.edv > 0.0, "calibrate.passive",
         "needs the measured volume calibrate.edv: add edv = \"... ml\" under [calibrate]");
    rule(!k.active || k.esv > 0.0, "calibrate.active",
         "needs the measured volume calibrate.esv: add esv = \"... ml\" under [calibrate]");
    rule(!(passive || k.cycle) || k.edv == 0.0 || k.esv < k.edv, "calibrate.esv",
         fmt::format("is {:g} ml, and must be less than calibrate.edv, {:g} ml: the heart ejects "
                     "what is between them; check both, and which is which",
                     k.esv / units::ml, k.edv / units::ml));
    rule(!passive || case_.passive.law == PassiveChoice::holzapfel_ogden, "calibrate.passive",
         "fits the Holzapfel-Ogden law alone; passive.law is another");
    rule(!passive || case_.protocol.ed_pressure > 0.0, "protocol.ed_pressure",
         "must be above zero for a passive fit");
    rule(!k.active || case_.active_law == ActiveChoice::niederer, "calibrate.active",
         "fits T_scale of active.law = \"niederer\"; the case has another");
    rule(k.contractility == FittedContractility::even || case_.contractility_file.empty() ||
             case_.fitted_contractility,
         "muscle.contractility",
         "is what calibrate.contractility = \"segments\" fits: leave one of the two out");
    rule(
        !is_loaded(case_) || !passive ||
            case_.unloaded.pressure < 0.95 * case_.protocol.ed_pressure,
        "unloaded.pressure",
        "is (nearly) protocol.ed_pressure: the wall then fills to the shape that was seen whatever "
        "its stiffness, and edv says nothing about calibrate.passive; set calibrate.passive = "
        "\"klotz\" for a shape of end-diastole, or give that of early diastole with its pressure");
    together(k.stiffness.low < k.stiffness.high,
             {"calibrate.stiffness_max", "calibrate.stiffness_min"},
             "must be larger than stiffness_min");
    together(k.exponent.low < k.exponent.high, {"calibrate.exponent_max", "calibrate.exponent_min"},
             "must be larger than exponent_min");
    together(k.T_scale.low < k.T_scale.high, {"calibrate.T_scale_max", "calibrate.T_scale_min"},
             "must be larger than T_scale_min");
    check_beat_fit();
  }

  void check_beat_fit() {
    const Calibration& k = case_.calibration;
    if (!k.cycle)
      return;
    rule(case_.engine == EngineChoice::quasi_static, "calibrate.cycle",
         "fits heartbeats of engine = \"quasi_static\" alone: those of engine = \"immersed\" are "
         "too long to be repeated so often; fit with the other engine and take its "
         "02b_calibrate/calibrated.toml, or leave it out");
    rule(std::max({k.edv, k.esv, k.cuff_systolic, k.cuff_diastolic}) > 0.0, "calibrate.cycle",
         "needs what was measured of a heartbeat, one or more of calibrate.edv, calibrate.esv, "
         "calibrate.cuff_systolic and calibrate.cuff_diastolic");
    rule(!k.active, "calibrate.active",
         "and calibrate.cycle both fit contractility to calibrate.esv: leave calibrate.active out, "
         "which does it outside of the heartbeats");
    rule(k.cuff_systolic == 0.0 || k.cuff_diastolic < k.cuff_systolic, "calibrate.cuff_diastolic",
         fmt::format("is {:g} mmHg, and must be less than calibrate.cuff_systolic, {:g} mmHg; "
                     "check both, and which is which",
                     k.cuff_diastolic / units::mmHg, k.cuff_systolic / units::mmHg));
    const Case begin = begin_of_beat_fit(case_);
    for (const BeatParameter& p : beat_fit(case_).parameters)
      rule(value_of(*p.parameter, begin) > 0.0, p.parameter->name,
           "is 0, and calibrate.cycle looks for a multiple of it: set it to a value to begin with, "
           "or leave it at its default");
    together(
        k.factor.low <= 1.0 && k.factor.high >= 1.0 && k.factor.low < k.factor.high,
        {"calibrate.factor_max", "calibrate.factor_min"},
        "must not be less than 1, nor factor_min more: the search begins at the case's values");
  }

  void check_circulation() {
    const circulation::CircuitParameters& p = case_.circulation;
    together(p.step <= 0.05 * p.period, {"circulation.step", "circulation.period"},
             "must be at most a twentieth of the period");
    together(p.step >= 1e-4 * p.period, {"circulation.step", "circulation.period"},
             "must be at least a ten-thousandth of the period, where the steps' own error is some "
             "millionths");
    together(p.left_ventricle.t_C < p.period,
             {"circulation.left_ventricle.t_C", "circulation.period"},
             "must lie within a beat (circulation.period)");
    together(p.valves.closed_resistance >=
                 100.0 * std::max({p.windkessel.R_mv, p.windkessel.R_ao + p.windkessel.R_c,
                                   p.closed_loop.valve_resistance}),
             {"circulation.valves.closed_resistance", "circulation.windkessel.R_mv",
              "circulation.windkessel.R_ao", "circulation.windkessel.R_c",
              "circulation.closed_loop.valve_resistance"},
             "must be at least a hundred times that of every open valve");
    check_blood();
    const auto fits = [&](const circulation::ElastanceParameters& e, const std::string& chamber) {
      const double share = p.period / (e.T_C + e.T_R);
      together(e.T_C + e.T_R <= p.period,
               {"circulation." + chamber + ".T_R", "circulation." + chamber + ".T_C",
                "circulation.period"},
               fmt::format("and T_C take longer together than a beat (circulation.period): T_C = "
                           "{:.2g} s and T_R = {:.2g} s would fit",
                           0.9 * share * e.T_C, 0.9 * share * e.T_R));
    };
    fits(p.left_ventricle, "left_ventricle");
    fits(p.closed_loop.left_atrium, "closed_loop.left_atrium");
    fits(p.closed_loop.right_atrium, "closed_loop.right_atrium");
    fits(p.closed_loop.right_ventricle, "closed_loop.right_ventricle");
  }

  /// More than chambers hold without pressure, so that vessels are filled.
  void check_blood() {
    const circulation::CircuitParameters& p = case_.circulation;
    const circulation::ClosedLoopParameters& loop = p.closed_loop;
    const double unstressed =
        p.start.V_lv + loop.left_atrium.V_0 + loop.right_atrium.V_0 + loop.right_ventricle.V_0;
    rule(loop.blood == 0.0 || loop.blood > unstressed, "circulation.closed_loop.blood",
         fmt::format("is {:g} ml, but the left ventricle (circulation.start.V_lv) and the other "
                     "chambers without pressure (V_0) hold {:g} ml of it, so that nothing fills "
                     "the vessels; blood without unstressed vessels is 1200 to 2000 ml of an adult",
                     loop.blood / units::ml, unstressed / units::ml));
  }

  void check_base_motion() {
    const heartbeat::BaseMotionParameters& motion = case_.base_motion;
    using Source = heartbeat::BaseMotionSource;
    rule(motion.source != Source::table || !motion.file.empty(), "base.motion",
         "is \"table\", but base.motion_file is not set");
    rule(motion.source != Source::cine ||
             (case_.strain.asked() && !case_.strain.long_axis_cine.empty()),
         "base.motion",
         "is \"cine\", but there is no long-axis cine to follow: set strain.cine, "
         "strain.long_axis_cine and the contours on them, or give the motion as a table");
    rule(motion.source == Source::none || case_.base.kind != solid::BasalSupport::Kind::elastic ||
             (case_.surroundings.base.normal_stiffness > 0.0 &&
              case_.surroundings.base.tangential_stiffness > 0.0),
         "base.motion",
         "needs springs at the base that take the wall along: set base.normal_stiffness and "
         "base.tangential_stiffness, or base.support = \"sliding\" or \"fixed\"");
    together(motion.zero < case_.circulation.period, {"base.motion_zero", "circulation.period"},
             "must be a time within a beat (circulation.period)");
  }

  void check_supports() {
    if (case_.base.kind != solid::BasalSupport::Kind::elastic)
      return;
    const solid::Support& base = case_.surroundings.base;
    const solid::Support& pericardium = case_.surroundings.epicardium;
    rule(base.tangential_stiffness > 0.0 || pericardium.tangential_stiffness > 0.0, "base.support",
         "is \"elastic\", but no spring keeps the wall from turning about its axis: set "
         "base.tangential_stiffness or pericardium.tangential_stiffness");
    rule(base.normal_stiffness > 0.0 || !pericardium.is_none(), "base.support",
         "is \"elastic\", but no spring holds the wall along its axis: set base.normal_stiffness "
         "or a pericardium");
  }

  void check_activation() {
    const activation::ActivationParameters& p = case_.activation;
    rule(p.kind != activation::Kind::file || !p.file.empty(), "activation.kind",
         "is \"file\", but activation.file is not set");
    for (const std::string& words : p.sites)
      try {
        static_cast<void>(activation::site_of(words));
      } catch (const std::invalid_argument& mistake) {
        rule(false, "activation.sites", mistake.what());
      }
  }

  void check_cycle() {
    const heartbeat::Protocol& p = case_.protocol;
    if (!is_cycle(case_))
      return;
    rule(case_.circulation.asked(), "protocol.kind",
         "is \"cycle\", which needs a circulation: set circulation.kind to \"windkessel\" or "
         "\"closed_loop\"");
    rule(case_.active_law == ActiveChoice::land2017 || case_.active_law == ActiveChoice::niederer,
         "active.law",
         "prescribes a tension, which knows no time: a cycle takes \"land2017\" (or \"niederer\")");
    together(p.cycle.step <= 0.05 * case_.circulation.period, {"cycle.step", "circulation.period"},
             "must be at most a twentieth of circulation.period");
    if (p.calcium.Ca_max <= p.calcium.Ca_0 || p.calcium.t_2 <= p.calcium.t_1)
      return;  // no transient, which is told already
    material::Calcium calcium = p.calcium;
    calcium.mode = material::Calcium::Mode::transient;
    constexpr double most = 0.25;  // of its rise, when the next beat begins it anew
    const double period = case_.circulation.period;
    const double left = (calcium.at(period) - calcium.Ca_0) / (calcium.Ca_max - calcium.Ca_0);
    rule(period > calcium.peak_time() && left <= most, "circulation.period",
         fmt::format(
             "is shorter than the calcium of a beat: after {:g} s it still stands at {:.0f}% of "
             "its rise (at most {:.0f}%); make the beat longer, or calcium.tau or t_2 shorter",
             period, 100.0 * left, 100.0 * most));
  }

  void check_study() {
    const Study& s = case_.study;
    const auto check = [&](const std::string& name, std::vector<double> factors) {
      rule(std::find(factors.begin(), factors.end(), 1.0) == factors.end(), "study." + name,
           "has the factor 1, which is the case itself and runs anyway: leave it out");
      std::sort(factors.begin(), factors.end());
      const auto twice = std::adjacent_find(factors.begin(), factors.end());
      rule(twice == factors.end(), "study." + name, "has a factor twice");
    };
    check("preload", s.preload);
    check("afterload", s.afterload);
    check("contractility", s.contractility);
    check("heart_rate", s.heart_rate);
  }

  /// A rule of a parameter that does not count says nothing.
  void rule(bool holds, const std::string& name, const std::string& what) {
    if (!holds && counts_only(*find_parameter(name), case_).empty())
      mistakes_.emplace_back(place_of(case_, name), fmt::format("{} {}", name, what));
  }

  /// A rule of the first parameter that also depends on the others: told at the first of them that
  /// the case sets, with the values of all that count.
  void together(bool holds, const std::vector<std::string>& names, const std::string& what) {
    if (holds || !counts_only(*find_parameter(names.front()), case_).empty())
      return;
    std::string where = case_.file.string();
    std::vector<std::string> values;
    for (const std::string& name : names) {
      const Parameter& parameter = *find_parameter(name);
      if (!counts_only(parameter, case_).empty())
        continue;
      const bool is_set = case_.origin.contains(name);
      if (is_set && where == case_.file.string())
        where = place_of(case_, name);
      values.push_back(fmt::format("{} = {}{}", key_of(name), parameter.get(case_),
                                   is_set ? "" : " by default"));
    }
    mistakes_.emplace_back(
        where, fmt::format("{} {}; here {}", names.front(), what, fmt::join(values, ", ")));
  }

  /// In the order of the file's lines, which is not that of the parsed table; what has no line is
  /// told last.
  void throw_mistakes() {
    if (mistakes_.empty())
      return;
    std::stable_sort(mistakes_.begin(), mistakes_.end(), [](const auto& a, const auto& b) {
      return line_of(a.first) < line_of(b.first);
    });
    constexpr std::size_t most_told = 20;
    std::string text = mistakes_.front().second;
    for (std::size_t i = 1; i < std::min(mistakes_.size(), most_told); ++i)
      text += fmt::format("\n{}: {}", mistakes_[i].first, mistakes_[i].second);
    if (mistakes_.size() > most_told)
      text += fmt::format("\nand {} more mistakes", mistakes_.size() - most_told);
    throw InputError(mistakes_.front().first, text, "");
  }

  static int line_of(const std::string& place) {
    const char* number = place.c_str() + place.rfind(':') + 1;  // of npos: the beginning
    int line = std::numeric_limits<int>::max();
    std::from_chars(number, place.c_str() + place.size(), line);
    return line;
  }

  std::filesystem::path file_;
  Case case_;
  std::vector<std::pair<std::string, std::string>> mistakes_;  ///< place and what is wrong there
};

/// Whether a text contains another, in capitals or not.
bool contains(const std::string& text, const std::string& part) {
  if (part.empty())
    return true;
  const auto same = [](unsigned char a, unsigned char b) {
    return std::tolower(a) == std::tolower(b);
  };
  return std::search(text.begin(), text.end(), part.begin(), part.end(), same) != text.end();
}

/// Throws InputError unless some parameter contains the filter.
void require_match(const std::string& filter) {
  std::vector<std::string> names;
  for (const Parameter& p : parameters()) {
    if (contains(p.name, filter) || contains(p.help, filter))
      return;
    names.emplace_back(p.name);
    names.emplace_back(key_of(p.name));
  }
  const std::string nearest = nearest_name(filter, names);
  throw InputError(
      "parameters " + filter, "no parameter has this in its name or meaning",
      nearest.empty() ? "Try a shorter word" : fmt::format("Did you mean {}?", nearest));
}

std::string where_in_paper(const Parameter& p) {
  return *p.equation == '\0' ? "" : fmt::format(" ({})", p.equation);
}

/// What a parameter means and where it counts.
std::string meaning(const Parameter& p) {
  std::vector<std::string> conditions;
  for (const Condition* condition : p.conditions)
    if (condition != nullptr)
      conditions.emplace_back(condition->words);
  return conditions.empty() ? p.help
                            : fmt::format("{} (only {})", p.help, fmt::join(conditions, " and "));
}

/// Tells of all files and folders that a case names and that are not there or cannot be read.
void require_files(const Case& c) {
  std::string first, text;  // place, what
  std::error_code failed;
  for (const Parameter& p : parameters()) {
    if (!counts_only(p, c).empty())
      continue;
    for (const std::string& name : paths(p, c)) {
      if (!names_file(p, c, name))
        continue;
      const std::filesystem::path path = beside(c, name);
      const bool is_folder = p.text == Text::path && std::filesystem::is_directory(path, failed);
      const std::string reason = is_folder ? "" : unreadable(path);
      if (reason.empty())
        continue;
      const std::string place = place_of(c, p.name);
      text += first.empty() ? "" : fmt::format("\n{}: ", place);
      text += fmt::format("{}: {}: {}", p.name, path.string(), reason);
      if (first.empty())
        first = place;
    }
  }
  if (!text.empty())
    throw InputError(first, text, "Check the name; it is read beside the case");
}

/// Where what a line defines a second time stands first, in words; empty if it is not found. Tables
/// are looked for in all lines before, keys in those of their table.
std::string first_place(const std::string& text, std::size_t line) {
  std::vector<std::string_view> lines = fields_of(text, '\n');
  if (line < 1 || line > lines.size())
    return "";
  for (std::string_view& l : lines)
    l = trimmed(l);
  const auto key_of = [](std::string_view l) { return trimmed(l.substr(0, l.find('='))); };
  const std::string_view second = lines[line - 1];
  const bool is_table = second.starts_with('[');
  const std::string_view name = is_table ? second.substr(0, second.find(']') + 1) : key_of(second);
  for (std::size_t i = line - 1; i-- > 0;) {
    const bool is_it =
        is_table ? lines[i].starts_with(name)
                 : lines[i].find('=') != std::string_view::npos && key_of(lines[i]) == name;
    if (is_it)
      return fmt::format(" (first in line {})", i + 1);
    if (!is_table && lines[i].starts_with('['))
      return "";
  }
  return "";
}

/// What to do about a mistake of the parser of TOML.
std::string remedy_of(const std::string& what) {
  if (contains(what, "utf-8"))
    return "Save the file as UTF-8";
  // not of a table's or a parameter's name, nor of what is too deep or too large
  for (const char* other :
       {"table header", "redefine", "parsing key:", "expected '='", "nested", "representable"})
    if (contains(what, other))
      return "";
  return "Texts and quantities stand in quotation marks: key = \"8 mmHg\"";
}

}  // namespace

Case parse_case(const std::string& text, const std::filesystem::path& file) {
  toml::table root;
  try {
    root = toml::parse(text, file.string());
  } catch (const toml::parse_error& error) {
    const std::string what(error.description());
    const auto line = error.source().begin.line;
    throw InputError(fmt::format("{}:{}", file.string(), line),
                     what + (contains(what, "redefine") ? first_place(text, line) : ""),
                     remedy_of(what));
  }
  return CaseReader(file).read(root);
}

Case read_case(const std::filesystem::path& file) {
  Case c = parse_case(read_text(file), file);
  if (c.origin.empty())
    throw InputError(
        file.string(), "sets no parameter: it is empty, or no case file",
        "The default case, an idealised healthy ventricle, is a line such as name = \"healthy\"");
  require_files(c);
  return c;
}

Case changed(const Case& c, const std::vector<Change>& changes) {
  return CaseReader(c).change(changes);
}

std::string starter_case(const std::string& name) {
  static const std::vector<std::string> shown{"anatomy.source",
                                              "anatomy.ellipsoid.endo_radius",
                                              "anatomy.ellipsoid.endo_length",
                                              "anatomy.ellipsoid.epi_radius",
                                              "anatomy.ellipsoid.epi_length",
                                              "anatomy.ellipsoid.base_height",
                                              "mesh.edge_length",
                                              "passive.holzapfel_ogden.a",
                                              "passive.holzapfel_ogden.b",
                                              "passive.holzapfel_ogden.a_f",
                                              "passive.holzapfel_ogden.b_f",
                                              "passive.holzapfel_ogden.a_s",
                                              "passive.holzapfel_ogden.b_s",
                                              "passive.holzapfel_ogden.a_fs",
                                              "passive.holzapfel_ogden.b_fs",
                                              "active.T_scale",
                                              "calcium.mode",
                                              "box.size",
                                              "box.cells",
                                              "protocol.ed_pressure",
                                              "protocol.es_pressure",
                                              "time.longest_step",
                                              "output.frame_interval"};
  const Case defaults;
  std::string text =
      "# A case of ventricle. Every quantity carries its unit. What is not set here has its "
      "default;\n"
      "# `ventricle parameters` lists all parameters with unit, range, default and meaning.\n"
      "# `ventricle new --from SOURCE` fills in what a label map, contours or a mesh show.\n\n" +
      first_lines(name);
  for (const Section& section : sections()) {
    std::vector<CaseLine> lines;
    for (const Parameter& p : parameters())
      if (table_of(p.name) == section.name &&
          std::find(shown.begin(), shown.end(), p.name) != shown.end())
        lines.push_back({p.name, p.get(defaults), fmt::format("{}; {}", meaning(p), p.rule())});
    if (!lines.empty())
      text += fmt::format("\n# {}\n{}", section.help, case_lines(lines));
  }
  return text;
}

std::string manual(bool markdown, const std::string& filter) {
  require_match(filter);
  const Case defaults;
  const auto wanted = [&](const Section& section, const Parameter& p) {
    return table_of(p.name) == section.name &&
           (contains(p.name, filter) || contains(p.help, filter));
  };
  std::string text =
      markdown
          ? "# Parameters\n\nPrinted by `ventricle parameters --markdown`. Any unit of the same "
            "dimension may be written. A parameter that is set where it does not count is refused, "
            "of [mesh] named in a warning. The last column names the paper's equation or section.\n"
          : "";
  for (const Section& s : sections()) {
    if (std::none_of(parameters().begin(), parameters().end(),
                     [&](const Parameter& p) { return wanted(s, p); }))
      continue;
    const std::string title = s.name.empty() ? "top level" : fmt::format("[{}]", s.name);
    text += markdown ? fmt::format(
                           "\n## {}\n\n{}.\n\n| parameter | default | allowed | meaning | paper "
                           "|\n|---|---|---|---|---|\n",
                           title, s.help)
                     : fmt::format("\n{}  {}\n", title, s.help);
    for (const Parameter& p : parameters()) {
      if (!wanted(s, p))
        continue;
      text += markdown ? fmt::format("| `{}` | `{}` | {} | {} | {} |\n", key_of(p.name),
                                     p.get(defaults), p.rule(), meaning(p), p.equation)
                       : fmt::format("  {} = {}\n      {}{}; {}\n", key_of(p.name), p.get(defaults),
                                     meaning(p), where_in_paper(p), p.rule());
    }
  }
  return text;
}

}  // namespace lv::case_file
