#include "lv/pipeline/heartbeat_fit.hpp"

#include "lv/base/check.hpp"
#include "lv/base/log.hpp"
#include "lv/base/parallel.hpp"
#include "lv/base/table.hpp"
#include "lv/base/time_left.hpp"
#include "lv/base/units.hpp"
#include "lv/calibrate/klotz.hpp"
#include "lv/calibrate/root_search.hpp"
#include "lv/circulation/circuit.hpp"
#include "lv/heartbeat/cycle.hpp"
#include "lv/pipeline/activation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <deque>
#include <limits>
#include <optional>

namespace lv::pipeline {
namespace {

using case_file::BeatDatum;
using case_file::BeatFit;
using case_file::BeatParameter;
using case_file::Case;
using circulation::BeatMeasures;
using circulation::Cycle;
using Eigen::Index;
using Eigen::VectorXd;

constexpr double rough_beats = 0.02;         // change of the last beat, far from the data
constexpr double usual_beats = 1e-3;         // where the case's beats never end by it
constexpr double share_of_tolerance = 0.25;  // that the search ends with: beats scatter by less
constexpr double longest_change = 0.5;       // of a logarithm, in a step of the search
constexpr int most_searched = 30;            // evaluations
constexpr double difference_of_logarithms = 0.05;  // of sensitivities: well above the scatter
constexpr double at_bound = 1e-6;

/// Of a circulation with a stand-in for the wall.
constexpr double tolerance_alone = 1e-5;
constexpr int most_beats_alone = 200;
constexpr double least_filling = 1.0 * units::mmHg;  // of Klotz's curve, for its exponent

/// Heartbeats up to their limit cycle, with some values of the fitted parameters.
struct HeartbeatsAt {
  VectorXd x;  ///< logarithms of the factors
  double accuracy = 0.0;
  bool found = false;
  std::string why;  ///< there are none, if so
  Cycle cycle;
  heartbeat::BeatBegin end;

  [[nodiscard]] const BeatMeasures& last() const { return cycle.beats.back(); }
};

heartbeat::Archive archived_beats(const HeartbeatsAt& e) {
  heartbeat::Archive archive;
  archive.set("x", {e.x.begin(), e.x.end()});
  archive.set("asked", {e.accuracy, e.found ? 1.0 : 0.0});
  if (e.found) {
    store(e.cycle, archive);
    store(e.end, archive);
  }
  return archive;
}

HeartbeatsAt read_beats(const std::filesystem::path& file, Index unknowns) {
  heartbeat::Archive archive = heartbeat::Archive::read(file);
  HeartbeatsAt e;
  const auto& x = archive.get_rows("x", 1, static_cast<std::size_t>(unknowns));
  e.x = Eigen::Map<const VectorXd>(x.data(), unknowns);
  const auto& asked = archive.get_rows("asked", 1, 2, heartbeat::not_negative);
  e.accuracy = asked[0];
  e.found = archive.whole_number(asked[1], {0.0, 1.0}) == 1;
  e.why = "there are none, as was found before";
  if (e.found) {
    e.cycle = heartbeat::load_cycle(archive);
    e.end = heartbeat::load_begin(std::move(archive));
  }
  return e;
}

/// What a coarser wall has shown.
struct Nearby {
  VectorXd x;                      ///< logarithms of the factors that fit there
  Eigen::MatrixXd sensitivity;     ///< of all data there
  double arterial_pressure = 0.0;  ///< at the beginning of a beat [kPa]
};

/// The wall of a case and its heartbeats with other values of what is fitted, each evaluation kept
/// in a file. The same questions in the same order get the same answers.
class BeatingWall {
 public:
  BeatingWall(const Case& c, const anatomy::MeshResult& wall, const BeatFit& fit,
              std::filesystem::path folder)
      : case_(c),
        wall_(wall),
        fit_(fit),
        folder_(std::move(folder)),
        activated_(activation_times(c, wall)) {}

  /// Of the first beats of all [kPa]; a closed loop begins as it is told, for its blood's sake.
  void begin_with(double arterial_pressure) { arterial_pressure_ = arterial_pressure; }
  [[nodiscard]] double arterial_pressure(const VectorXd& x) const {
    return nearest(x).cycle.samples.back().signals.aortic_pressure;
  }

  [[nodiscard]] Case case_at(const VectorXd& x) const {
    Case c = case_;
    for (Index j = 0; j < x.size(); ++j)
      case_file::set_value(*parameter(j), c,
                           std::exp(x[j]) * case_file::value_of(*parameter(j), case_));
    return c;
  }

  /// `purpose` and the evaluations that are still to come, roughly (negative: nobody knows), are
  /// for the log.
  const HeartbeatsAt& at(const VectorXd& x, double accuracy, const char* purpose, double to_come) {
    const std::size_t n = asked_++;
    const auto file = folder_ / fmt::format("evaluation_{}.bin", n + 1);
    if (parallel::root_says(std::filesystem::exists(file))) {
      known_.push_back(read_beats(file, x.size()));
    } else {
      known_.push_back(run(n, x, accuracy));
      parallel::on_root([&] {
        archived_beats(known_.back()).write(file);
        std::filesystem::remove_all(folder_of(n));  // a checkpoint is of no more use
      });
    }
    tell(known_.back(), purpose, to_come);
    return known_.back();
  }

  /// What the data's logarithms change by with those of the parameters, for a stand-in that beats
  /// as the wall did there.
  [[nodiscard]] Eigen::MatrixXd slopes(const VectorXd& x) const {
    const HeartbeatsAt& there = nearest(x);
    const VectorXd now = logarithms(alone(there, there.x));
    Eigen::MatrixXd J(now.size(), x.size());
    for (Index j = 0; j < x.size(); ++j) {
      VectorXd moved = there.x;
      moved[j] += difference_of_logarithms;
      J.col(j) = (logarithms(alone(there, moved)) - now) / difference_of_logarithms;
    }
    if (!J.allFinite())
      throw RunError("The circulation with a stand-in for the wall does not beat",
                     "Look at the last beats in cycle.csv of a run without calibrate.cycle");
    return J;
  }

  [[nodiscard]] const std::deque<HeartbeatsAt>& known() const { return known_; }
  [[nodiscard]] const HeartbeatsAt& nearest(const VectorXd& x) const {
    const HeartbeatsAt* best = nullptr;
    for (const HeartbeatsAt& e : known_)  // of the same place, the last: it is known best
      if (e.found && (best == nullptr || (e.x - x).norm() <= (best->x - x).norm()))
        best = &e;
    LV_CHECK(best != nullptr);
    return *best;
  }

  /// ln(model/measured) of the measured data.
  [[nodiscard]] VectorXd logarithms(const BeatMeasures& beat) const {
    VectorXd r(static_cast<Index>(fit_.parameters.size()));
    for (Index j = 0; j < r.size(); ++j) {
      const BeatDatum& d = datum(j);
      r[j] = std::log(beat.*d.of_beat / d.measured);
    }
    return r;
  }

  void remove_records() const {
    for (std::size_t n = 0; n < asked_; ++n)
      std::filesystem::remove(folder_ / fmt::format("evaluation_{}.bin", n + 1));
  }

 private:
  [[nodiscard]] const case_file::Parameter* parameter(Index j) const {
    return fit_.parameters[static_cast<std::size_t>(j)].parameter;
  }
  [[nodiscard]] const BeatDatum& datum(Index j) const {
    return fit_.data[fit_.parameters[static_cast<std::size_t>(j)].datum];
  }
  [[nodiscard]] std::filesystem::path folder_of(std::size_t n) const {
    return folder_ / fmt::format("evaluation_{}", n + 1);
  }

  HeartbeatsAt run(std::size_t n, const VectorXd& x, double accuracy) {
    const auto began = std::chrono::steady_clock::now();
    const Case c = case_at(x);
    heartbeat::CycleSetup setup{wall_.mesh,
                                case_file::static_model(c),
                                c.quasi_static.solver,
                                c.protocol.calcium,
                                c.circulation,
                                c.protocol.cycle,
                                c.circulation.period * c.protocol.cycle.beats,  // no frames
                                activated_};
    setup.cycle.tolerance = accuracy;
    if (arterial_pressure_ > 0.0 && c.circulation.kind == circulation::Kind::windkessel)
      setup.circuit.start.p_ar_sys = arterial_pressure_;
    const bool any =
        std::any_of(known_.begin(), known_.end(), [](const auto& e) { return e.found; });
    std::optional<heartbeat::BeatBegin> begin;
    if (any)
      begin = begin_at(x, c);
    parallel::on_root([&] { std::filesystem::create_directories(folder_of(n)); });
    auto beats = heartbeat::measure_beats(setup, begin ? &*begin : nullptr, folder_of(n));
    HeartbeatsAt e{x, accuracy, static_cast<bool>(beats), beats ? "" : beats.why().what, {}, {}};
    if (beats) {
      e.cycle = beats->cycle;
      e.end = beats->end;
      e.found = logarithms(e.last()).allFinite();
      if (!e.found)
        e.why = "the aortic valve does not open and close";
    }
    seconds_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
    return e;
  }

  /// Where the nearest beats had come to, with as much blood as is now there, and the arteries'
  /// pressure changed as that of a circulation with a stand-in for the wall.
  [[nodiscard]] heartbeat::BeatBegin begin_at(const VectorXd& x, const Case& c) const {
    const HeartbeatsAt& from = nearest(x);
    heartbeat::BeatBegin begin = from.end;
    circulation::Circuit circuit(c.circulation);
    circuit.start_from(begin.circuit);
    const auto pressure = [](const Cycle& cycle) {
      return cycle.samples.back().signals.aortic_pressure;
    };
    const double ratio = pressure(beats_alone(from, x)) / pressure(beats_alone(from, from.x));
    if (std::isfinite(ratio))
      circuit.scale_arterial_pressure(ratio);
    circuit.fill_to(blood(c));
    begin.circuit.assign(circuit.states().begin(), circuit.states().end());
    return begin;
  }

  /// What the first evaluation, which began with a filled wall, would have with other values.
  [[nodiscard]] double blood(const Case& c) const {
    circulation::Circuit circuit(c.circulation);
    circuit.start_around(known_.front().cycle.samples.front().signals.volume);
    return circuit.blood();
  }

  [[nodiscard]] Cycle beats_alone(const HeartbeatsAt& from, const VectorXd& x) const {
    const Case c = case_at(x);
    circulation::CircuitParameters p = c.circulation;
    p.step = c.protocol.cycle.step;
    p.beats = most_beats_alone;
    p.tolerance = tolerance_alone;
    circulation::Circuit circuit(p);
    circuit.start_from(from.end.circuit);
    circuit.fill_to(blood(c));
    p.start = circulation::start_of(circuit.states());
    return circulation::run_alone(p, stand_in(from, x));
  }

  [[nodiscard]] BeatMeasures alone(const HeartbeatsAt& from, const VectorXd& x) const {
    return beats_alone(from, x).beats.back();
  }

  [[nodiscard]] circulation::StandIn stand_in(const HeartbeatsAt& from, const VectorXd& x) const {
    const double V = from.last().end_diastolic_volume;
    const double p = std::max(from.last().end_diastolic_pressure, least_filling);
    const circulation::StandIn wall(
        circulation::samples_of(from.cycle, static_cast<int>(from.cycle.beats.size()) - 1), V,
        {p, calibrate::klotz(V, p).beta});
    for (std::size_t j = 0; j < fit_.parameters.size(); ++j)
      if (fit_.parameters[j].words == case_file::contractility_words)
        return wall.with_contractility(
            std::exp(x[static_cast<Index>(j)] - from.x[static_cast<Index>(j)]));
    return wall;
  }

  void tell(const HeartbeatsAt& e, const char* purpose, double to_come) const {
    std::string text = fmt::format("{:<12}", purpose);
    const Case c = case_at(e.x);
    for (const BeatParameter& p : fit_.parameters)
      text += fmt::format("{} {:.4g} {}  ", p.words, case_file::value_of(*p.parameter, c),
                          p.parameter->unit);
    if (!e.found) {
      log::info("{}no heartbeats: {}", text, e.why);
      return;
    }
    text += ": ";
    for (const BeatDatum& d : fit_.data)
      text += fmt::format(
          "{} {:.2f}{} {}, ", d.name, e.last().*d.of_beat / units::parse_unit(d.unit).factor,
          d.measured > 0.0
              ? fmt::format(" of {:.2f}", d.measured / units::parse_unit(d.unit).factor)
              : "",
          d.unit);
    log::info("{}{} beats{}{}", text, e.cycle.beats.size(),
              e.cycle.is_limit ? "" : ", which are no limit cycle",
              time_left(seconds_ < 0.0 || to_come < 0.0 ? -1.0 : to_come * seconds_));
  }

  const Case& case_;
  const anatomy::MeshResult& wall_;
  const BeatFit& fit_;
  std::filesystem::path folder_;
  std::vector<double> activated_;
  std::deque<HeartbeatsAt> known_;
  std::size_t asked_ = 0;
  double seconds_ = -1.0;           ///< that the last evaluation of this process took
  double arterial_pressure_ = 0.0;  ///< to begin with [kPa]; 0: the case's
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
    for (const BeatParameter& p : fit_.parameters)
      if (!(case_file::value_of(*p.parameter, c) > 0.0))
        throw InputError(case_file::place_of(c, p.parameter->name),
                         fmt::format("{} is 0, and calibrate.cycle looks for a multiple of it",
                                     p.parameter->name),
                         "Set it to a value to begin with, or leave it at its default");
  }

  /// The logarithms of the factors with which the data are met.
  [[nodiscard]] VectorXd search() {
    const auto n = static_cast<Index>(fit_.parameters.size());
    const calibrate::CostlyModel model{
        [&](const VectorXd& x, double accuracy) -> Outcome<VectorXd> {
          const HeartbeatsAt& e = wall_.at(x, accuracy, "search", evaluations_to_come());
          if (!e.found)
            return Unsolved{e.why, ""};
          misfit_ = wall_.logarithms(e.last()).cwiseAbs().maxCoeff();
          return wall_.logarithms(e.last());
        },
        [&](const VectorXd& x) { return near_ == nullptr ? wall_.slopes(x) : slopes_nearby(); }};
    const calibrate::RootSearch search{bounds(case_.calibration.factor.low, false),
                                       bounds(case_.calibration.factor.high, true),
                                       share_of_tolerance * case_.calibration.tolerance,
                                       accuracy_,
                                       std::max(rough_beats, accuracy_),
                                       longest_change,
                                       most_searched};
    const auto root = calibrate::search_root(
        model, near_ == nullptr ? VectorXd(VectorXd::Zero(n)) : near_->x, search);
    if (!root)
      throw RunError(fmt::format("The case's own values make no heartbeats to begin a fit with: {}",
                                 root.why().what),
                     "Run it without calibrate.cycle and look at its cycle.csv");
    if (!root->found && root->r.cwiseAbs().maxCoeff() > case_.calibration.tolerance)
      refuse(*root, search);
    return root->x;
  }

  /// d ln datum/d ln parameter of the wall at a place that was evaluated; NaN where there are no
  /// heartbeats beside it.
  [[nodiscard]] Eigen::MatrixXd sensitivity(const VectorXd& x) {
    const BeatMeasures there = wall_.nearest(x).last();
    Eigen::MatrixXd S(static_cast<Index>(fit_.data.size()), x.size());
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

  [[nodiscard]] HeartbeatFit result(const VectorXd& x, const Eigen::MatrixXd& sensitivity) const {
    const BeatMeasures& there = wall_.nearest(x).last();
    HeartbeatFit fit{{}, {}, sensitivity, fit_.left_alone, case_.calibration.tolerance, 0, 0};
    for (const BeatDatum& d : fit_.data)
      fit.data.push_back(
          {d.name, d.unit,
           d.measured > 0.0 ? shown(d, d.measured) : std::numeric_limits<double>::quiet_NaN(),
           shown(d, there.*d.of_beat)});
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
        row.push_back(e.found ? Table::number(shown(d, e.last().*d.of_beat)) : "");
      row.push_back(std::to_string(e.cycle.beats.size()));
      row.push_back(e.found ? Table::number(e.cycle.change) : "");
      table.add_row(std::move(row));
    }
  }

  void remove_records() const { wall_.remove_records(); }

 private:
  static double shown(const BeatDatum& d, double value) {
    return value / units::parse_unit(d.unit).factor;
  }

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

  /// Those of a search that goes well, and of the sensitivities.
  [[nodiscard]] double evaluations_to_come() const {
    if (!is_last_)
      return -1.0;
    const double usual = near_ == nullptr ? 5.0 : 2.0;
    const double tolerance = share_of_tolerance * case_.calibration.tolerance;
    const double searched =
        misfit_ < 0.0 ? usual : std::max(0.0, std::ceil(std::log(misfit_ / tolerance) / 1.2));
    return searched + (near_ == nullptr ? static_cast<double>(fit_.parameters.size()) : 0.0);
  }

  /// Of the measured data.
  [[nodiscard]] Eigen::MatrixXd slopes_nearby() const {
    Eigen::MatrixXd J(near_->x.size(), near_->x.size());
    for (Index j = 0; j < J.rows(); ++j)
      J.row(j) = near_->sensitivity.row(
          static_cast<Index>(fit_.parameters[static_cast<std::size_t>(j)].datum));
    return J;
  }

  /// The datum that is missed most, and why nothing brings the model nearer.
  [[noreturn]] void refuse(const calibrate::FoundRoot& root,
                           const calibrate::RootSearch& search) const {
    Index worst = 0;
    root.r.cwiseAbs().maxCoeff(&worst);
    const BeatDatum& d = fit_.data[fit_.parameters[static_cast<std::size_t>(worst)].datum];
    const double factor = units::parse_unit(d.unit).factor;
    const std::string what = fmt::format(
        "{} is {:.1f} {}, and the nearest that the heartbeats come to is {:.1f} {}", d.key,
        d.measured / factor, d.unit, std::exp(root.r[worst]) * d.measured / factor, d.unit);
    const std::string ends = ends_reached(root.x, search);
    if (ends.empty())
      throw RunError(
          fmt::format("{}{}", what,
                      root.last_failure
                          ? fmt::format("; beyond there are none: {}", root.last_failure->what)
                          : ", where the search comes to no end"),
          "Check what was measured and its units, and the case's own values, which the search "
          "begins with");
    throw InputError(
        case_file::place_of(case_, d.key), fmt::format("{}, with {}", what, ends),
        "Check what was measured, its units and circulation.period; a stiffness that is not this "
        "heart's (calibrate.passive) shows here too; calibrate.factor_min and factor_max allow "
        "more");
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
  bool is_last_;
  BeatingWall wall_;
  double misfit_ = -1.0;  ///< largest of the last evaluation; negative: there was none
};

}  // namespace

HeartbeatFit fit_heartbeats(const Case& c, const anatomy::MeshResult& wall,
                            const anatomy::MeshResult* coarse,
                            const std::filesystem::path& folder) {
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
    write_file(folder / heartbeats_name, json(fit));
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

}  // namespace lv::pipeline
