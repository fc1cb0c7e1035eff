#include "lv/pipeline/circulation.hpp"

#include "lv/base/log.hpp"
#include "lv/base/periodic.hpp"
#include "lv/beating_wall/base_motion.hpp"
#include "lv/circulation/cycle.hpp"
#include "lv/circulation/heart_rate.hpp"
#include "lv/heartbeat/cycle.hpp"
#include "lv/heartbeat/immersed_cycle.hpp"
#include "lv/report/cycle_tables.hpp"
#include "lv/report/plausibility.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace lv::pipeline {

using case_file::Case;

namespace {

/// How long atria may contract before the ventricles without a warning [s]: far beyond the time
/// that the front takes in people.
constexpr double shortest_lead = 0.05, longest_lead = 0.3;

std::string words_of_what_is_to_come(const circulation::Cycle& cycle) {
  if (cycle.to_come >= 1.0)
    return ", but the circuit is still as far from where beats would take it as the states are "
           "large, or how far is not known";
  return cycle.to_come > 0.0 ? fmt::format(", and beats to come would add {:.2g}", cycle.to_come)
                             : "";
}

/// How long the chambers contract in beats of another period than the usual one.
std::string times_of_rate(const Case& c) {
  const double ratio = circulation::relative_systole(c.circulation.period);
  if (ratio == 1.0)
    return "";
  return fmt::format(
      "times of chambers that the case does not set are those of {:.0f} beats a minute, {:.3f} of "
      "the usual ones (`ventricle parameters circulation`)",
      60.0 / c.circulation.period, ratio);
}

}  // namespace

void make_circulation(const Case& c, const std::filesystem::path& folder) {
  const circulation::Cycle cycle = circulation::run_alone(c.circulation);
  const std::string end = cycle_end(cycle);
  if (!cycle.is_limit)
    log::warn("circulation: {}", end);
  std::vector<std::string> odd = report::unlike_any_patient(cycle.beats.back());
  if (std::string beyond = chamber_beyond_beat(c); !beyond.empty())
    odd.insert(odd.begin(), std::move(beyond));
  std::string remarks;
  if (const std::string times = times_of_rate(c); !times.empty()) {
    log::info("circulation: {}", times);
    remarks = times + "\n";
  }
  for (const std::string& sentence : odd) {
    log::warn("circulation: {}", sentence);
    remarks += fmt::format("warning: {}\n", sentence);
  }
  write_cycle_tables(cycle, folder);
  write_cycle(cycle, {}, folder);
  write_file(folder / "circulation.txt",
             fmt::format("circulation with an elastance for the left ventricle\n{}\n{}\n{}", end,
                         remarks, report::beat_text(cycle.beats.back())));
}

heartbeat::Beat make_cycle(const Case& c, const mesh::Mesh& mesh,
                           const std::vector<double>& activation_times,
                           const std::filesystem::path& folder,
                           const heartbeat::Observers& observers) {
  if (const std::string slow = slow_relaxation(c); !slow.empty())
    log::warn("{}", slow);
  if (c.engine == case_file::EngineChoice::immersed) {
    heartbeat::BeatSetup setup = case_file::beat_setup(c, mesh);
    setup.activation_times = activation_times;
    setup.base_motion = beating_wall::base_motion(c, mesh);
    return heartbeat::run_immersed_cycle(setup, c.circulation, folder, observers);
  }
  const std::string& begin = c.protocol.cycle.begin;
  return heartbeat::run_cycle(
      {mesh, case_file::static_model(c), c.quasi_static.solver, c.protocol.calcium, c.circulation,
       c.protocol.cycle, c.output.frame_interval, activation_times,
       begin.empty() ? std::filesystem::path() : case_file::beside(c, begin),
       beating_wall::base_motion(c, mesh)},
      folder, observers);
}

void check_begin(const Case& c, const mesh::Mesh& mesh) {
  if (const std::string& begin = c.protocol.cycle.begin; !begin.empty())
    static_cast<void>(heartbeat::read_end_of_beats(case_file::beside(c, begin), mesh.nodes.size(),
                                                   c.circulation));
}

void write_cycle_tables(const circulation::Cycle& cycle, const std::filesystem::path& folder) {
  report::cycle_table(cycle.samples, cycle.columns, cycle.period).write_csv(folder / "cycle.csv");
  report::beats_table(cycle.beats).write_csv(folder / "beats.csv");
}

void write_cycle(const circulation::Cycle& cycle, const std::optional<Table>& curves,
                 const std::filesystem::path& folder) {
  const Table table = report::cycle_table(cycle.samples, cycle.columns, cycle.period);
  drawing::write(report::pressure_volume_figure(table, report::beats_table(cycle.beats)),
                 folder / "pressure_volume.svg");
  drawing::write(report::wiggers_figure(table, curves), folder / "wiggers.svg");
}

std::string cycle_end(const circulation::Cycle& cycle) {
  return fmt::format(
      "{} after {} beat{} of {:.3g} s{}: the last changed the states by {:.2g} of themselves at "
      "most{}",
      cycle.is_limit ? "limit cycle" : "no limit cycle", cycle.beats.size(),
      cycle.beats.size() == 1 ? "" : "s", cycle.period,
      cycle.leaps > 0 ? fmt::format(", {} of them after a leap", cycle.leaps) : "", cycle.change,
      words_of_what_is_to_come(cycle));
}

std::vector<std::string> cycle_warnings(const Case& c, const circulation::Cycle& cycle) {
  std::vector<std::string> warnings;
  if (cycle.cut_short)
    warnings.push_back(
        fmt::format("the heartbeats end after {} of them: in the next one a step of wall and "
                    "circulation had no solution",
                    cycle.beats.size()));
  if (cycle.gave_way > 0)
    warnings.push_back(
        fmt::format("the wall gave way {} time{}: it came at once to an equilibrium farther off, "
                    "where a beating one is held back by its inertia and viscosity",
                    cycle.gave_way, cycle.gave_way == 1 ? "" : "s"));
  if (!cycle.is_limit)
    warnings.push_back(cycle_end(cycle));
  const std::string open = cycle.beats.empty() ? "" : report::open_aortic_valve(cycle.beats.back());
  for (const std::string& odd : {slow_relaxation(c), chamber_beyond_beat(c), open})
    if (!odd.empty())
      warnings.push_back(odd);
  return warnings;
}

std::string slow_relaxation(const Case& c) {
  if (!case_file::is_cycle(c) || c.active_law != case_file::ActiveChoice::niederer)
    return "";
  return "active.law = \"niederer\" has the rates of a rat at room temperature: its relaxation "
         "does not end within a human beat, so the mitral valve opens late or not at all; "
         "active.law = \"land2017\" is human";
}

std::string calcium_beside_rate(const Case& c) {
  constexpr double worth_a_word = 0.1;
  const double ratio = circulation::relative_systole(c.circulation.period);
  if (!case_file::is_cycle(c) || std::abs(ratio - 1.0) < worth_a_word)
    return "";
  return fmt::format(
      "calcium takes the times that the case says at every heart rate; at {:.0f} beats a minute "
      "healthy systole lasts {:.2f} times as long as at 75: where calcium was that of 75, multiply "
      "calcium.tau, or t_1 and t_2, by as much",
      60.0 / c.circulation.period, ratio);
}

std::string chamber_beyond_beat(const Case& c) {
  if (c.circulation.kind != circulation::Kind::closed_loop)
    return "";
  const circulation::ClosedLoopParameters& loop = c.circulation.closed_loop;
  const double period = c.circulation.period;
  std::string text;
  for (const auto& [name, chamber] :
       {std::pair{"left_atrium", &loop.left_atrium}, std::pair{"right_atrium", &loop.right_atrium},
        std::pair{"right_ventricle", &loop.right_ventricle}}) {
    const double lead = time_in_period(loop.right_ventricle.t_C - chamber->t_C, period);
    const bool is_atrium = chamber != &loop.right_ventricle;
    const char* comma = text.empty() ? "" : ", ";
    if (chamber->t_C >= period)
      text += fmt::format(
          "{}circulation.closed_loop.{}.t_C is {:g} s and begins {:.3g} s after a beat does", comma,
          name, chamber->t_C, std::fmod(chamber->t_C, period));
    else if (is_atrium && (lead < shortest_lead || lead > longest_lead))
      text += fmt::format(
          "{}circulation.closed_loop.{}.t_C is {:g} s, {:.3g} s before the right ventricle "
          "contracts",
          comma, name, chamber->t_C, lead);
  }
  if (text.empty())
    return "";
  return fmt::format(
      "{}, for a beat lasts {:.3g} s (circulation.period): atria contract 0.1 to 0.2 s before the "
      "ventricles (circulation.closed_loop.right_ventricle.t_C is {:g} s); set t_C so, and to less "
      "than the period",
      text, period, loop.right_ventricle.t_C);
}

}  // namespace lv::pipeline
