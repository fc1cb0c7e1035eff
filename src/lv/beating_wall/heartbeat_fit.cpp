#include "lv/beating_wall/heartbeat_fit.hpp"

#include "lv/base/check.hpp"
#include "lv/base/log.hpp"
#include "lv/base/parallel.hpp"
#include "lv/base/table.hpp"
#include "lv/beating_wall/beating_wall.hpp"
#include "lv/beating_wall/filling_reach.hpp"
#include "lv/calibrate/root_search.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace lv::beating_wall {
namespace {

using case_file::BeatDatum;
using case_file::BeatFit;
using case_file::BeatParameter;
using case_file::Case;
using circulation::BeatMeasures;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double first_beats = 0.1;          // change of the last beat, of a first look
constexpr double rough_beats = 0.02;         // the same far from the data
constexpr double usual_beats = 1e-3;         // where the case's beats never end by it
constexpr double share_of_tolerance = 0.25;  // that the search ends with: beats scatter by less
constexpr double longest_change = 0.5;       // of a logarithm, in a step of the search
constexpr int most_searched = 30;            // evaluations
constexpr double usual_fall = 1.2;           // of the misfit's logarithm, in a step of the search
constexpr double at_bound = 1e-6;
constexpr double foreseen_far = 0.1;  // misfit that slopes foresee, of a logarithm

/// What a coarser wall has shown.
struct Nearby {
  VectorXd x;                      ///< logarithms of the factors that fit there
  MatrixXd sensitivity;            ///< of all data there
  double arterial_pressure = 0.0;  ///< at the beginning of a beat [kPa]
};

/// A wall whose heartbeats are brought to the data.
class HeartbeatFitter {
 public:
  /// `near`: what is known of a coarser wall; null: nothing. `is_last`: of the walls of this fit.
  HeartbeatFitter(const Case& c, const anatomy::MeshResult& wall,
                  const std::filesystem::path& folder, const Nearby* near, bool is_last)
      : case_(c),
        fit_(case_file::beat_fit(c)),
        accuracy_(c.protocol.cycle.tolerance > 0.0 ? c.protocol.cycle.tolerance : usual_beats),
        near_(near),
        is_last_(is_last),
        wall_(c, wall, fit_, folder) {
    if (near != nullptr)
      wall_.begin_with(near->arterial_pressure);
  }

  /// The logarithms of the factors with which the data are met.
  [[nodiscard]] VectorXd search() {
    const auto n = static_cast<Index>(fit_.parameters.size());
    const calibrate::RootSearch search{bounds(case_.calibration.factor.low, false),
                                       bounds(case_.calibration.factor.high, true),
                                       share_of_tolerance * case_.calibration.tolerance,
                                       accuracy_,
                                       std::max(rough_beats, accuracy_),
                                       longest_change,
                                       most_searched};
    const calibrate::CostlyModel model{
        [&](const VectorXd& x, double accuracy) -> Outcome<VectorXd> {
          const HeartbeatsAt& e = wall_.at(x, accuracy, "search", evaluations_to_come());
          if (!e.found)
            return Unsolved{e.why, ""};
          misfit_ = wall_.logarithms(e.last()).cwiseAbs().maxCoeff();
          return wall_.logarithms(e.last());
        },
        [&](const VectorXd& x) {
          MatrixXd J = near_ == nullptr ? wall_.slopes(x) : slopes_nearby();
          foresee(J, x, search, foreseen_far);
          return J;
        }};
    const VectorXd start = near_ == nullptr ? VectorXd(VectorXd::Zero(n)) : near_->x;
    if (near_ == nullptr)
      look(start, search);
    const auto root = calibrate::search_root(model, start, search);
    if (!root)
      throw RunError(fmt::format("The case's own values make no heartbeats to begin a fit with: {}",
                                 root.why().what),
                     "Run it without calibrate.cycle and look at its cycle.csv");
    if (!root->found && root->r.cwiseAbs().maxCoeff() > case_.calibration.tolerance)
      refuse(*root, search);
    if (const auto& cycle = wall_.nearest(root->x).cycle; !cycle.is_limit)
      log::warn(
          "the heartbeats that meet the data are no limit cycle after {} beats: the last changed "
          "the states by {:.2g} of themselves; cycle.beats allows more",
          cycle.beats.size(), cycle.change);
    return root->x;
  }

  /// d ln datum/d ln parameter of the wall at a place that was evaluated; NaN where there are no
  /// heartbeats beside it.
  [[nodiscard]] MatrixXd sensitivity(const VectorXd& x) {
    const BeatMeasures there = wall_.nearest(x).last();
    MatrixXd S(static_cast<Index>(fit_.data.size()), x.size());
    for (Index j = 0; j < x.size(); ++j) {
      VectorXd moved = x;
      moved[j] += difference_of_logarithms;
      const double to_come = is_last_ ? static_cast<double>(x.size() - j - 1) : -1.0;
      const HeartbeatsAt& e = wall_.at(moved, accuracy_, "sensitivity", to_come);
      for (Index k = 0; k < S.rows(); ++k) {
        const BeatDatum& d = fit_.data[static_cast<std::size_t>(k)];
        S(k, j) =
            e.found ? std::log(e.last().*d.of_beat / (there.*d.of_beat)) / difference_of_logarithms
                    : std::numeric_limits<double>::quiet_NaN();
      }
    }
    return S;
  }

  [[nodiscard]] HeartbeatFit result(const VectorXd& x, const MatrixXd& sensitivity) const {
    const BeatMeasures& there = wall_.nearest(x).last();
    HeartbeatFit fit{{}, {}, sensitivity, fit_.left_alone, case_.calibration.tolerance, 0, 0};
    for (const BeatDatum& d : fit_.data)
      fit.data.push_back(
          {d.name, d.unit,
           d.is_measured() ? d.shown(d.measured) : std::numeric_limits<double>::quiet_NaN(),
           d.shown(there.*d.of_beat)});
    const Case fitted = wall_.case_at(x);
    for (const BeatParameter& p : fit_.parameters)
      fit.parameters.push_back({p.parameter->name, p.words, p.parameter->unit,
                                fit_.data[p.datum].name, case_file::value_of(*p.parameter, case_),
                                case_file::value_of(*p.parameter, fitted)});
    return fit;
  }

  [[nodiscard]] double arterial_pressure(const VectorXd& x) const {
    return wall_.arterial_pressure(x);
  }

  /// Evaluations and beats, added to a fit's.
  void count(HeartbeatFit& fit) const {
    fit.evaluations += static_cast<int>(wall_.known().size());
    for (const HeartbeatsAt& e : wall_.known())
      fit.beats += static_cast<int>(e.cycle.beats.size());
  }

  [[nodiscard]] Table empty_history() const {
    std::vector<std::string> columns{"wall"};
    for (const BeatParameter& p : fit_.parameters)
      columns.emplace_back(p.parameter->name);
    for (const BeatDatum& d : fit_.data)
      columns.push_back(fmt::format("{}_{}", d.name, d.unit));
    columns.insert(columns.end(), {"beats", "change_of_last_beat"});
    return Table(columns);
  }

  void add_history(const char* wall, Table& table) const {
    for (const HeartbeatsAt& e : wall_.known()) {
      std::vector<std::string> row{wall};
      const Case c = wall_.case_at(e.x);
      for (const BeatParameter& p : fit_.parameters)
        row.push_back(Table::number(case_file::value_of(*p.parameter, c)));
      for (const BeatDatum& d : fit_.data)
        row.push_back(e.found ? Table::number(d.shown(e.last().*d.of_beat)) : "");
      row.push_back(std::to_string(e.cycle.beats.size()));
      row.push_back(e.found ? Table::number(e.cycle.change) : "");
      table.add_row(std::move(row));
    }
  }

  void remove_records() const { wall_.remove_records(); }

 private:
  /// Logarithms of the least or largest factors: the case's, or those that a parameter may have.
  [[nodiscard]] VectorXd bounds(double factor, bool upper) const {
    VectorXd all(static_cast<Index>(fit_.parameters.size()));
    for (Index j = 0; j < all.size(); ++j) {
      const case_file::Parameter& p = *fit_.parameters[static_cast<std::size_t>(j)].parameter;
      const double value = case_file::value_of(p, case_);
      const double range = upper ? p.range.high / value : p.range.low / value;
      all[j] = std::log(upper ? std::min(factor, range) : std::max(factor, range));
    }
    return all;
  }

  /// Those of a search that goes well after the one that is asked for now, and of the
  /// sensitivities.
  [[nodiscard]] double evaluations_to_come() const {
    if (!is_last_)
      return -1.0;
    const double usual = near_ == nullptr ? 5.0 : 2.0;
    const double tolerance = share_of_tolerance * case_.calibration.tolerance;
    const double searched =
        misfit_ < 0.0 ? usual
                      : std::max(0.0, std::ceil(std::log(misfit_ / tolerance) / usual_fall) - 1.0);
    return searched + (near_ == nullptr ? static_cast<double>(fit_.parameters.size()) : 0.0);
  }

  /// Of the measured data.
  [[nodiscard]] MatrixXd slopes_nearby() const {
    MatrixXd J(near_->x.size(), near_->x.size());
    for (Index j = 0; j < J.rows(); ++j)
      J.row(j) = near_->sensitivity.row(
          static_cast<Index>(fit_.parameters[static_cast<std::size_t>(j)].datum));
    return J;
  }

  /// Foresees with the first beats, from which those of the search go on.
  void look(const VectorXd& start, const calibrate::RootSearch& search) {
    if (wall_.at(start, first_beats, "first look", -1.0).found)
      foresee(wall_.slopes(start), start, search, foreseen_far + first_beats);
  }

  /// Says that data are out of reach if what follows goes as these slopes say: those of logarithms,
  /// whose answers grow less than that far away. `far`: the misfit that counts, of a logarithm.
  void foresee(const MatrixXd& J, const VectorXd& x, const calibrate::RootSearch& search,
               double far) {
    if (has_warned_)
      return;
    const BeatMeasures& there = wall_.nearest(x).last();
    const VectorXd r = wall_.logarithms(there);
    const VectorXd left = calibrate::least_within(J, r, search.low - x, search.high - x);
    Index missed = 0;
    if (left.cwiseAbs().maxCoeff(&missed) < std::max(far, case_.calibration.tolerance))
      return;
    has_warned_ = true;
    Index worst = 0;
    r.cwiseAbs().maxCoeff(&worst);
    const BeatDatum& d = datum(worst);
    log::warn(
        "{}: {} is {:.1f} {}, and heartbeats have {:.1f} {}: it probably cannot be reached, since "
        "with what is fitted between calibrate.factor_min and factor_max times the case's values "
        "{} is expected to be missed by {:.0f}%; the fit looks for what comes nearest",
        case_file::place_of(case_, d.key), d.key, d.shown(d.measured), d.unit,
        d.shown(there.*d.of_beat), d.unit, missed == worst ? "it" : datum(missed).key,
        100.0 * std::abs(std::expm1(left[missed])));
  }

  /// That a parameter is fitted to.
  [[nodiscard]] const BeatDatum& datum(Index parameter) const {
    return fit_.data[fit_.parameters[static_cast<std::size_t>(parameter)].datum];
  }

  /// The datum that is missed most, and why nothing brings the model nearer.
  [[noreturn]] void refuse(const calibrate::FoundRoot& root,
                           const calibrate::RootSearch& search) const {
    Index worst = 0;
    root.r.cwiseAbs().maxCoeff(&worst);
    const BeatDatum& d = datum(worst);
    const std::string what = fmt::format(
        "{} is {:.1f} {}, and the nearest that the heartbeats come to is {:.1f} {}", d.key,
        d.shown(d.measured), d.unit, d.shown(std::exp(root.r[worst]) * d.measured), d.unit);
    const std::string ends = ends_reached(root.x, search);
    if (ends.empty())
      throw RunError(fmt::format("{}{}", what,
                                 root.last_failure ? fmt::format("; beyond there are none: {}",
                                                                 root.last_failure->what)
                                                   : ", where the search comes to no end"),
                     "Check what was measured and its units, and the case's own values, which the "
                     "search begins with");
    throw InputError(case_file::place_of(case_, d.key), fmt::format("{}, with {}", what, ends),
                     "Check what was measured, its units and circulation.period; a stiffness that "
                     "is not this heart's (calibrate.passive) shows here too; calibrate.factor_min "
                     "and factor_max allow more");
  }

  /// The parameters that stand at an end of their range, in words.
  [[nodiscard]] std::string ends_reached(const VectorXd& x,
                                         const calibrate::RootSearch& search) const {
    std::vector<std::string> ends;
    const Case there = wall_.case_at(x);
    for (Index j = 0; j < x.size(); ++j) {
      const bool low = x[j] - search.low[j] < at_bound;
      if (!low && search.high[j] - x[j] >= at_bound)
        continue;
      const case_file::Parameter& p = *fit_.parameters[static_cast<std::size_t>(j)].parameter;
      ends.push_back(fmt::format("{} at its {}, {:.4g} {}", p.name, low ? "least" : "largest",
                                 case_file::value_of(p, there), p.unit));
    }
    return fmt::format("{}", fmt::join(ends, " and "));
  }

  const Case& case_;
  BeatFit fit_;
  double accuracy_;
  const Nearby* near_;
  double misfit_ = -1.0;  ///< largest of the last evaluation; negative: there was none
  bool is_last_;
  bool has_warned_ = false;  ///< of a datum out of reach
  BeatingWall wall_;
};

}  // namespace

HeartbeatFit fit_heartbeats(const Case& asked, const anatomy::MeshResult& wall,
                            const anatomy::MeshResult* coarse,
                            const std::filesystem::path& folder) {
  const Case c = case_file::begin_of_beat_fit(asked);
  check_filling(c, coarse != nullptr ? *coarse : wall);
  std::optional<HeartbeatFitter> first;
  std::optional<Nearby> near;
  if (coarse != nullptr) {
    log::info("heartbeats are fitted on a coarser wall first");
    first.emplace(c, *coarse, folder / coarse_wall_name, nullptr, false);
    const VectorXd x = first->search();
    near = Nearby{x, first->sensitivity(x), first->arterial_pressure(x)};
    if (!near->sensitivity.allFinite())
      near.reset();  // no heartbeats beside it: nothing to go by
    else
      log::info("now on the wall of the case");
  }
  HeartbeatFitter last(c, wall, folder, near ? &*near : nullptr, true);
  const VectorXd x = last.search();
  HeartbeatFit fit = last.result(x, near ? near->sensitivity : last.sensitivity(x));
  Table history = last.empty_history();
  if (first) {
    first->add_history("coarse", history);
    first->count(fit);
  }
  last.add_history("case", history);
  last.count(fit);
  parallel::on_root([&] {
    history.write_csv(folder / "heartbeats.csv");
    write_file(folder / heartbeats_text, text(fit));
    write_file(folder / heartbeats_json, json(fit));
    write_heartbeats(fit, folder / heartbeats_name);
    last.remove_records();
  });
  return fit;
}

std::optional<Case> with_coarse_wall(const Case& c) {
  constexpr double edge_length = 14.0;  // of a beat in a fraction of a minute [mm]
  const bool has_other_elements = c.anatomy.source == case_file::AnatomySource::mesh ||
                                  c.quasi_static.order == 1 ||
                                  c.activation.kind == activation::Kind::file;
  if (!c.calibration.cycle || has_other_elements || case_file::is_loaded(c) ||
      c.quasi_static.edge_length > 0.75 * edge_length)
    return {};
  Case coarse = c;
  coarse.quasi_static.edge_length = edge_length;
  return coarse;
}

}  // namespace lv::beating_wall
