#include "lv/beating_wall/beating_wall.hpp"

#include "lv/base/check.hpp"
#include "lv/base/log.hpp"
#include "lv/base/parallel.hpp"
#include "lv/base/time_left.hpp"
#include "lv/base/units.hpp"
#include "lv/beating_wall/activation.hpp"
#include "lv/beating_wall/base_motion.hpp"
#include "lv/calibrate/klotz.hpp"
#include "lv/case_file/family.hpp"
#include "lv/circulation/circuit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>

namespace lv::beating_wall {
namespace {

using case_file::BeatDatum;
using case_file::BeatFit;
using case_file::BeatParameter;
using case_file::Case;
using circulation::BeatMeasures;
using circulation::Cycle;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Of a circulation with a stand-in for the wall.
constexpr double tolerance_alone = 1e-5;
constexpr int most_beats_alone = 200;
constexpr double least_filling = 1.0 * units::mmHg;  // of Klotz's curve, for its exponent

/// Between values of the same search on other ranks, which differ by rounding.
constexpr double same_place = 1e-4;

heartbeat::Archive archived_beats(const HeartbeatsAt& e) {
  heartbeat::Archive archive;
  archive.set("x", {e.x.begin(), e.x.end()});
  archive.set("asked", {e.accuracy, e.found ? 1.0 : 0.0});
  if (e.found) {
    store(e.cycle, archive);
    store(e.end, archive);
  } else {
    archive.set_words("why", {e.why});
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
  if (e.found) {
    e.cycle = heartbeat::load_cycle(archive);
    e.end = heartbeat::load_begin(std::move(archive));
  } else {
    e.why = fmt::format("{}", fmt::join(archive.get_words("why"), " "));
  }
  return e;
}

/// y + now - then.
std::vector<double> moved(std::vector<double> y, const std::vector<double>& then,
                          const std::vector<double>& now) {
  for (std::size_t i = 0; i < y.size(); ++i)
    y[i] += now[i] - then[i];
  return y;
}

double arterial_pressure_after(const Cycle& cycle) {
  return cycle.samples.back().signals.aortic_pressure;
}

}  // namespace

BeatingWall::BeatingWall(const Case& c, const anatomy::MeshResult& wall, const BeatFit& fit,
                         std::filesystem::path folder)
    : case_(c),
      wall_(wall),
      fit_(fit),
      folder_(std::move(folder)),
      activated_(activation_times(c, wall)),
      base_motion_(base_motion(c, wall.mesh)) {}

double BeatingWall::arterial_pressure(const VectorXd& x) const {
  return arterial_pressure_after(nearest(x).cycle);
}

const case_file::Parameter& BeatingWall::parameter(Index j) const {
  return *fit_.parameters[static_cast<std::size_t>(j)].parameter;
}

Case BeatingWall::case_at(const VectorXd& x) const {
  Case c = case_;
  for (Index j = 0; j < x.size(); ++j)
    case_file::set_value(parameter(j), c,
                         std::exp(x[j]) * case_file::value_of(parameter(j), case_));
  return c;
}

std::filesystem::path BeatingWall::record_of(std::size_t n) const {
  return folder_ / fmt::format("evaluation_{}.bin", n + 1);
}

std::filesystem::path BeatingWall::folder_of(std::size_t n) const {
  return folder_ / fmt::format("evaluation_{}", n + 1);
}

void BeatingWall::remove_records() const {
  for (std::size_t n = 0; n < asked_; ++n)
    std::filesystem::remove(record_of(n));
}

const HeartbeatsAt& BeatingWall::at(const VectorXd& x, double accuracy, const char* purpose,
                                    double to_come) {
  const std::size_t n = asked_++;
  if (!is_recorded(n, x)) {
    const auto began = std::chrono::steady_clock::now();
    known_.push_back(run(n, x, accuracy));
    seconds_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
    parallel::on_root([&] {
      archived_beats(known_.back()).write(record_of(n));
      std::filesystem::remove_all(folder_of(n));  // a checkpoint is of no more use
    });
  }
  tell(known_.back(), purpose, to_come);
  return known_.back();
}

/// Whether that evaluation was made before; then it is known.
bool BeatingWall::is_recorded(std::size_t n, const VectorXd& x) {
  if (!parallel::root_says(std::filesystem::exists(record_of(n))))
    return false;
  HeartbeatsAt e = read_beats(record_of(n), x.size());
  if (!((e.x - x).cwiseAbs().maxCoeff() < same_place))
    return false;
  known_.push_back(std::move(e));
  return true;
}

const HeartbeatsAt& BeatingWall::nearest(const VectorXd& x) const {
  const HeartbeatsAt* best = nullptr;
  for (const HeartbeatsAt& e : known_)
    if (e.found && (best == nullptr || (e.x - x).norm() <= (best->x - x).norm()))
      best = &e;
  LV_CHECK(best != nullptr);
  return *best;
}

bool BeatingWall::has_beaten() const {
  return std::any_of(known_.begin(), known_.end(), [](const auto& e) { return e.found; });
}

VectorXd BeatingWall::logarithms(const BeatMeasures& beat) const {
  VectorXd r(static_cast<Index>(fit_.parameters.size()));
  for (Index j = 0; j < r.size(); ++j) {
    const BeatDatum& d = fit_.data[fit_.parameters[static_cast<std::size_t>(j)].datum];
    r[j] = std::log(beat.*d.of_beat / d.measured);
  }
  return r;
}

heartbeat::CycleSetup BeatingWall::setup(const Case& c, double accuracy) const {
  heartbeat::CycleSetup setup{wall_.mesh,
                              case_file::static_model(c),
                              c.quasi_static.solver,
                              c.protocol.calcium,
                              c.circulation,
                              c.protocol.cycle,
                              c.circulation.period * c.protocol.cycle.beats,  // no frames
                              activated_,
                              {},
                              base_motion_};
  setup.cycle.tolerance = accuracy;
  if (arterial_pressure_ > 0.0 && c.circulation.kind == circulation::Kind::windkessel)
    setup.circuit.start.p_ar_sys = arterial_pressure_;
  return setup;
}

HeartbeatsAt BeatingWall::run(std::size_t n, const VectorXd& x, double accuracy) const {
  const Case c = case_at(x);
  std::optional<heartbeat::BeatBegin> begin;
  if (has_beaten())
    begin = begin_at(x, c);
  parallel::on_root([&] { std::filesystem::create_directories(folder_of(n)); });
  const auto beats =
      heartbeat::measure_beats(setup(c, accuracy), begin ? &*begin : nullptr, folder_of(n));
  if (!beats)
    return {x, accuracy, false, beats.why().what, {}, {}};
  const bool ejects = logarithms(beats->cycle.beats.back()).allFinite();
  return {x,
          accuracy,
          ejects,
          ejects ? "" : "the aortic valve does not open and close",
          beats->cycle,
          beats->end};
}

/// Where the nearest beats had come to, changed as a circulation with a stand-in for the wall: the
/// arteries' pressure, in a closed loop all but the wall's volume.
heartbeat::BeatBegin BeatingWall::begin_at(const VectorXd& x, const Case& c) const {
  const HeartbeatsAt& from = nearest(x);
  circulation::Circuit circuit(c.circulation);
  circuit.start_from(from.end.circuit);
  const circulation::CycleAlone now = beats_alone(from, x);
  const circulation::CycleAlone then = beats_alone(from, from.x);
  if (c.circulation.kind == circulation::Kind::closed_loop) {
    circuit.fill_to(blood(c));
    circuit.leap_to(moved(from.end.circuit, then.states, now.states));
  } else if (const double ratio =
                 arterial_pressure_after(now.cycle) / arterial_pressure_after(then.cycle);
             std::isfinite(ratio)) {
    circuit.scale_arterial_pressure(ratio);
  }
  const auto states = circuit.states();
  return {from.end.wall, {states.begin(), states.end()}};
}

/// What the first evaluation, which began with a filled wall, would have with other values.
double BeatingWall::blood(const Case& c) const {
  circulation::Circuit circuit(c.circulation);
  circuit.start_around(known_.front().cycle.samples.front().signals.volume);
  return circuit.blood();
}

MatrixXd BeatingWall::slopes(const VectorXd& x) const {
  const HeartbeatsAt& there = nearest(x);
  const auto alone = [&](const VectorXd& at) {
    return logarithms(beats_alone(there, at).cycle.beats.back());
  };
  const VectorXd now = alone(there.x);
  MatrixXd J(now.size(), x.size());
  for (Index j = 0; j < x.size(); ++j) {
    VectorXd moved = there.x;
    moved[j] += difference_of_logarithms;
    J.col(j) = (alone(moved) - now) / difference_of_logarithms;
  }
  if (!J.allFinite())
    throw RunError("The circulation with a stand-in for the wall does not beat",
                   "Look at the last beats in cycle.csv of a run without calibrate.cycle");
  return J;
}

circulation::CycleAlone BeatingWall::beats_alone(const HeartbeatsAt& from,
                                                 const VectorXd& x) const {
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

circulation::StandIn BeatingWall::stand_in(const HeartbeatsAt& from, const VectorXd& x) const {
  const double V = from.last().end_diastolic_volume;
  const double p = std::max(from.last().end_diastolic_pressure, least_filling);
  circulation::StandIn wall(
      circulation::samples_of(from.cycle, static_cast<int>(from.cycle.beats.size()) - 1), V,
      {p, calibrate::klotz(V, p).beta});
  for (Index j = 0; j < x.size(); ++j)
    if (parameter(j).name == case_file::levers(case_).contractility)
      return wall.with_contractility(std::exp(x[j] - from.x[j]));
  return wall;
}

void BeatingWall::tell(const HeartbeatsAt& e, const char* purpose, double to_come) const {
  const bool is_known = seconds_ >= 0.0 && to_come >= 0.0;
  log::info("{:<12}{}{}", purpose, in_words(e), time_left(is_known ? to_come * seconds_ : -1.0));
}

std::string BeatingWall::in_words(const HeartbeatsAt& e) const {
  const Case c = case_at(e.x);
  std::string text;
  for (const BeatParameter& p : fit_.parameters)
    text += fmt::format("{} {:.4g} {}  ", p.words, case_file::value_of(*p.parameter, c),
                        p.parameter->unit);
  if (!e.found)
    return text + fmt::format("no heartbeats: {}", e.why);
  text += ": ";
  for (const BeatDatum& d : fit_.data)
    text +=
        fmt::format("{} {:.2f}{} {}, ", d.name, d.shown(e.last().*d.of_beat),
                    d.is_measured() ? fmt::format(" of {:.2f}", d.shown(d.measured)) : "", d.unit);
  return text + fmt::format("{} beats{}", e.cycle.beats.size(),
                            e.cycle.is_limit ? "" : ", which are no limit cycle");
}

}  // namespace lv::beating_wall
