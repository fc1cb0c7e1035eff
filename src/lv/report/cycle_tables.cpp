#include "lv/report/cycle_tables.hpp"

#include "lv/base/units.hpp"
#include "lv/heartbeat/cycle_record.hpp"
#include "lv/report/plausibility.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace lv::report {
namespace {

using circulation::BeatMeasures;
using circulation::Sample;

/// "ml_per_s" of "ml/s": a unit as part of a column's name.
std::string in_name(std::string unit) {
  const auto slash = unit.find('/');
  if (slash != std::string::npos)
    unit.replace(slash, 1, "_per_");
  std::replace(unit.begin(), unit.end(), ' ', '_');
  return unit;
}

std::string number_in(double value, const std::string& unit) {
  return Table::number(value / units::parse_unit(unit).factor);
}

/// A measure of a beat: column, what it is in words, unit, definition.
struct Measure {
  double BeatMeasures::*value;
  const char* name;
  const char* words;
  const char* unit;
  const char* meaning;
};

constexpr const char* event_meaning =
    "from the beat's beginning, where the pressure across the valve changes its sign; negative: "
    "before it, by the same beat's end; empty: not in this beat, or before it";

constexpr Measure measures[]{
    {&BeatMeasures::end_diastolic_volume, "edv", "end-diastolic volume", "ml",
     "EDV, where the mitral valve closes"},
    {&BeatMeasures::end_systolic_volume, "esv", "end-systolic volume", "ml",
     "ESV, where the aortic valve closes"},
    {&BeatMeasures::stroke_volume, "stroke_volume", "stroke volume", "ml", "SV = EDV - ESV"},
    {&BeatMeasures::ejection_fraction, "ejection_fraction", "ejection fraction", "", "EF = SV/EDV"},
    {&BeatMeasures::end_diastolic_pressure, "end_diastolic_pressure", "end-diastolic pressure",
     "mmHg", "of the cavity, where the mitral valve closes"},
    {&BeatMeasures::end_systolic_pressure, "end_systolic_pressure", "end-systolic pressure", "mmHg",
     "of the cavity, where the aortic valve closes"},
    {&BeatMeasures::peak_pressure, "peak_pressure", "peak pressure", "mmHg",
     "the highest in the cavity"},
    {&BeatMeasures::aortic_systolic, "aortic_systolic", "aortic systolic pressure", "mmHg",
     "the highest at the root of the aorta"},
    {&BeatMeasures::aortic_diastolic, "aortic_diastolic", "aortic diastolic pressure", "mmHg",
     "the lowest there"},
    {&BeatMeasures::aortic_mean, "aortic_mean", "aortic mean pressure", "mmHg",
     "the mean there over the beat"},
    {&BeatMeasures::stroke_work, "stroke_work", "stroke work", "mmHg ml",
     "area of the loop, the integral of -p dV over the beat"},
    {&BeatMeasures::early_filling, "early_filling", "early filling", "ml",
     "inflow from the mitral valve's opening until the atrium contracts, or it closes"},
    {&BeatMeasures::early_filling_flow, "early_filling_flow", "greatest early inflow", "ml/s",
     "through the mitral valve in that time, E"},
    {&BeatMeasures::late_filling, "late_filling", "late filling", "ml",
     "inflow from the atrium's contraction until the mitral valve closes"},
    {&BeatMeasures::late_filling_flow, "late_filling_flow", "greatest late inflow", "ml/s",
     "through the mitral valve in that time, A"},
    {&BeatMeasures::largest_pressure_rate, "dp_dt_max", "largest dp/dt", "mmHg/s",
     "the steepest rise of the cavity's pressure between two steps"},
    {&BeatMeasures::least_pressure_rate, "dp_dt_min", "least dp/dt", "mmHg/s", "its steepest fall"},
    {&BeatMeasures::mitral_closes, "mitral_closes", "mitral valve closes at", "ms", event_meaning},
    {&BeatMeasures::aortic_opens, "aortic_opens", "aortic valve opens at", "ms", event_meaning},
    {&BeatMeasures::aortic_closes, "aortic_closes", "aortic valve closes at", "ms", event_meaning},
    {&BeatMeasures::mitral_opens, "mitral_opens", "mitral valve opens at", "ms", event_meaning},
    {&BeatMeasures::isovolumic_contraction, "isovolumic_contraction", "isovolumic contraction",
     "ms", "from the closing of the mitral valve to the opening of the aortic valve"},
    {&BeatMeasures::ejection_time, "ejection_time", "ejection time", "ms",
     "the aortic valve is open"},
    {&BeatMeasures::isovolumic_relaxation, "isovolumic_relaxation", "isovolumic relaxation", "ms",
     "from the closing of the aortic valve to the opening of the mitral valve"},
    {&BeatMeasures::relaxation_constant, "tau", "relaxation constant tau", "ms",
     "of p = p_0 exp(-t/tau), least squares of log p over the time from the steepest fall to the "
     "opening of the mitral valve, both found between steps"}};

/// What is instead of a measure that a beat does not have.
const char* why_unseen(double BeatMeasures::*measure, const BeatMeasures& beat) {
  const bool begins_in_ejection = std::isnan(beat.aortic_opens) && !std::isnan(beat.aortic_closes);
  const bool begins_closed =
      std::isnan(beat.mitral_closes) && !std::isnan(beat.end_diastolic_volume);
  const bool contracts = !is_open_in_diastole(beat);
  if (measure == &BeatMeasures::aortic_opens && begins_in_ejection)
    return "is open when the beat begins";
  if (measure == &BeatMeasures::mitral_closes && begins_closed)
    return "is closed when the beat begins";
  if (measure == &BeatMeasures::mitral_opens && !std::isnan(beat.mitral_closes))
    return "not again in this beat";
  if ((measure == &BeatMeasures::ejection_time && begins_in_ejection) ||
      (measure == &BeatMeasures::isovolumic_contraction && contracts &&
       (begins_in_ejection || begins_closed)))
    return "began before the beat";
  return "did not happen";
}

/// A column of the signals of the ventricle.
struct SignalColumn {
  double circulation::Signals::*value;
  const char* name;
  const char* unit;
};

constexpr SignalColumn signal_columns[]{
    {&circulation::Signals::volume, "volume", "ml"},
    {&circulation::Signals::pressure, "pressure", "mmHg"},
    {&circulation::Signals::filling_pressure, "filling_pressure", "mmHg"},
    {&circulation::Signals::aortic_pressure, "aortic_pressure", "mmHg"},
    {&circulation::Signals::mitral_gradient, "mitral_gradient", "mmHg"},
    {&circulation::Signals::aortic_gradient, "aortic_gradient", "mmHg"},
    {&circulation::Signals::mitral_flow, "mitral_flow", "ml/s"},
    {&circulation::Signals::aortic_flow, "aortic_flow", "ml/s"}};

std::string column_name(const std::string& name, const std::string& unit) {
  return unit.empty() ? name : name + "_" + in_name(unit);
}

/// The rows of one beat in a column, or all.
class Beats {
 public:
  explicit Beats(const Table& cycle) : cycle_(cycle), beat_(cycle.whole_numbers("beat")) {}

  [[nodiscard]] int count() const { return beat_.empty() ? 0 : beat_.back(); }

  /// With the last row before the beat, where it begins.
  [[nodiscard]] std::vector<double> of(int beat, const std::string& column) const {
    const auto all = cycle_.numbers(column);
    std::vector<double> mine;
    for (std::size_t i = 0; i < all.size(); ++i)
      if (beat_[i] == beat || (i + 1 < all.size() && beat_[i] < beat && beat_[i + 1] == beat))
        mine.push_back(all[i]);
    return mine;
  }

 private:
  const Table& cycle_;
  std::vector<int> beat_;
};

/// A valve's event: the column of beats.csv, and its sign on a loop.
struct Event {
  const char* column;
  const char* words;
  int colour;
  drawing::Marker marker;
};

constexpr std::array<Event, 4> events{
    {{"mitral_closes_ms", "mitral valve closes", 2, drawing::Marker::circle},
     {"aortic_opens_ms", "aortic valve opens", 1, drawing::Marker::triangle},
     {"aortic_closes_ms", "aortic valve closes", 1, drawing::Marker::circle},
     {"mitral_opens_ms", "mitral valve opens", 2, drawing::Marker::triangle}}};

/// A curve between its samples.
double value_at(const std::vector<double>& x, const std::vector<double>& y, double at) {
  const auto next = std::find_if(x.begin() + 1, x.end(), [&](double t) { return t >= at; });
  const auto i = static_cast<std::size_t>((next == x.end() ? next - 1 : next) - x.begin());
  return std::lerp(y[i - 1], y[i], (at - x[i - 1]) / (x[i] - x[i - 1]));
}

/// The events of the last beat on its loop, the last series.
void mark_events(const Beats& beats, const Table& measured, drawing::LineChart& chart) {
  const drawing::Series loop = chart.series.back();
  const auto time = beats.of(beats.count(), "time_s");
  for (const Event& e : events) {
    const auto column = measured.numbers(e.column);
    if (static_cast<int>(column.size()) != beats.count() || std::isnan(column.back()))
      continue;
    const double after = 1e-3 * column.back();
    const double at = after < 0.0 ? time.back() + after : time.front() + after;
    chart.series.push_back({.label = e.words,
                            .x = {value_at(time, loop.x, at)},
                            .y = {value_at(time, loop.y, at)},
                            .colour = drawing::category(e.colour),
                            .width = 0.0,
                            .marker = e.marker});
  }
}

/// What the valves are doing: the phase that ends with what the open one does next, or with the
/// opening of the one that comes next.
std::string phase_name(double mitral, double aortic, bool has_ejected) {
  const auto before = [](double circulation::Signals::*gradient, bool opens) {
    return std::find_if(heartbeat::valve_events.begin(), heartbeat::valve_events.end(),
                        [&](const heartbeat::ValveEvent& e) {
                          return e.gradient == gradient && e.opens == opens;
                        })
        ->ends;
  };
  if (mitral > 0.0)
    return before(&circulation::Signals::mitral_gradient, false);
  if (aortic > 0.0)
    return before(&circulation::Signals::aortic_gradient, false);
  return has_ejected ? before(&circulation::Signals::mitral_gradient, true)
                     : before(&circulation::Signals::aortic_gradient, true);
}

std::vector<drawing::Phase> valve_phases(const std::vector<double>& time,
                                         const std::vector<double>& mitral,
                                         const std::vector<double>& aortic) {
  std::vector<drawing::Phase> phases;
  bool has_ejected = false;
  for (std::size_t i = 0; i < time.size(); ++i) {
    has_ejected = has_ejected || aortic[i] > 0.0;
    const std::string name = phase_name(mitral[i], aortic[i], has_ejected);
    if (phases.empty() || phases.back().label != name)
      phases.push_back({name, i == 0 ? time[i] : time[i - 1], time[i]});
    phases.back().end = time[i];
  }
  return phases;
}

/// A column of curves.csv, where it has any number.
void add_curve(const Table& curves, const char* column, const char* label,
               std::vector<drawing::LineChart>& charts) {
  const auto values = curves.numbers(column);
  if (std::any_of(values.begin(), values.end(), [](double x) { return std::isfinite(x); }))
    charts.push_back({.y = {label}, .series = {{.x = curves.numbers("time_s"), .y = values}}});
}

/// Charts over one time, one below the other: phases are named above them, the time below.
drawing::Figure stacked(std::vector<drawing::LineChart> charts, drawing::Axis time,
                        std::vector<drawing::Phase> phases) {
  drawing::Figure figure{.columns = 1, .panel_width = 520.0, .panel_height = 170.0};
  const std::string words = std::exchange(time.label, "");
  for (std::size_t i = 0; i < charts.size(); ++i) {
    if (i + 1 == charts.size())
      time.label = words;
    charts[i].x = time;
    charts[i].phases = phases;
    figure.panels.push_back({.content = std::move(charts[i])});
    for (drawing::Phase& phase : phases)
      phase.label.clear();
  }
  return figure;
}

}  // namespace

Table cycle_table(std::span<const Sample> samples, const std::vector<circulation::Column>& columns,
                  double period) {
  std::vector<std::string> names{"time_s", "beat"};
  for (const SignalColumn& c : signal_columns)
    names.push_back(column_name(c.name, c.unit));
  for (const circulation::Column& c : columns)
    names.push_back(column_name(c.name, c.unit));
  Table table(names);
  for (const Sample& s : samples) {
    const int beat = static_cast<int>(std::ceil(s.time / period - 1e-9));  // a start is beat 0
    std::vector<std::string> row{Table::number(s.time), std::to_string(beat)};
    for (const SignalColumn& c : signal_columns)
      row.push_back(number_in(s.signals.*c.value, c.unit));
    for (std::size_t i = 0; i < columns.size(); ++i)
      row.push_back(number_in(s.signals.others[i], columns[i].unit));
    table.add_row(std::move(row));
  }
  return table;
}

Table beats_table(std::span<const BeatMeasures> beats) {
  std::vector<std::string> names{"beat"};
  for (const Measure& m : measures)
    names.push_back(column_name(m.name, m.unit));
  Table table(names);
  for (std::size_t b = 0; b < beats.size(); ++b) {
    std::vector<std::string> row{std::to_string(b + 1)};
    for (const Measure& m : measures)
      row.push_back(number_in(beats[b].*m.value, m.unit));
    table.add_row(std::move(row));
  }
  return table;
}

std::vector<std::pair<std::string, double>> beat_numbers(const BeatMeasures& beat) {
  std::vector<std::pair<std::string, double>> numbers;
  for (const Measure& m : measures)
    numbers.emplace_back(column_name(m.name, m.unit),
                         beat.*m.value / units::parse_unit(m.unit).factor);
  return numbers;
}

std::string beat_text(const BeatMeasures& beat) {
  std::string text;
  for (const Measure& m : measures) {
    const double value = beat.*m.value / units::parse_unit(m.unit).factor;
    text += fmt::format(
        "  {:<26} {}\n", m.words,
        std::isnan(value) ? why_unseen(m.value, beat) : fmt::format("{:.4g} {}", value, m.unit));
  }
  return text;
}

const std::vector<BeatMeasure>& beat_measures() {
  static const std::vector<BeatMeasure> all = [] {
    std::vector<BeatMeasure> list;
    for (const Measure& m : measures)
      list.push_back({column_name(m.name, m.unit), m.words, m.unit, m.meaning});
    return list;
  }();
  return all;
}

drawing::Figure pressure_volume_figure(const Table& cycle, const Table& measured) {
  const Beats beats(cycle);
  drawing::LineChart chart{.x = {"volume [ml]"}, .y = {"pressure [mmHg]"}};
  for (int b = 1; b <= beats.count(); ++b) {
    const bool last = b == beats.count();
    chart.series.push_back({.label = last     ? fmt::format("beat {}", b)
                                     : b == 1 ? "beats before"
                                              : "",
                            .x = beats.of(b, "volume_ml"),
                            .y = beats.of(b, "pressure_mmHg"),
                            .colour = last ? drawing::category(0) : drawing::hex(0xb0b0b0),
                            .width = last ? 2.4 : 0.8});
  }
  if (beats.count() > 0)
    mark_events(beats, measured, chart);
  return {.panels = {{.content = chart}}, .columns = 1};
}

drawing::Figure wiggers_figure(const Table& cycle, const std::optional<Table>& curves) {
  const Beats beats(cycle);
  const auto of_last = [&](const char* column) { return beats.of(beats.count(), column); };
  const auto time = of_last("time_s");
  const auto series = [&](const char* label, const char* column) {
    return drawing::Series{.label = label, .x = time, .y = of_last(column)};
  };
  std::vector<drawing::LineChart> charts{
      {.y = {"pressure [mmHg]"},
       .series = {series("ventricle", "pressure_mmHg"), series("aorta", "aortic_pressure_mmHg"),
                  series("before the mitral valve", "filling_pressure_mmHg")}},
      {.y = {"volume [ml]"}, .series = {series("", "volume_ml")}},
      {.y = {"flow [ml/s]"},
       .series = {series("mitral valve", "mitral_flow_ml_per_s"),
                  series("aortic valve", "aortic_flow_ml_per_s")}}};
  if (curves) {
    add_curve(*curves, "calcium_uM", "calcium [µM]", charts);
    add_curve(*curves, "mean_active_tension_kPa", "tension [kPa]", charts);
  }
  drawing::Axis axis{"time [s]"};
  if (!time.empty())
    axis.range = drawing::Range{time.front(), time.back()};
  drawing::Figure figure =
      stacked(std::move(charts), axis,
              valve_phases(time, of_last("mitral_gradient_mmHg"), of_last("aortic_gradient_mmHg")));
  figure.title = fmt::format("beat {}", beats.count());
  return figure;
}

}  // namespace lv::report
