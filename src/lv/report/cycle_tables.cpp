#include "lv/report/cycle_tables.hpp"

#include "lv/base/units.hpp"

#include <fmt/format.h>

#include <algorithm>
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

/// A measure of a beat: column, what it is in words, unit.
struct Measure {
  double BeatMeasures::*value;
  const char* name;
  const char* words;
  const char* unit;
};

constexpr Measure measures[]{
    {&BeatMeasures::end_diastolic_volume, "edv", "end-diastolic volume", "ml"},
    {&BeatMeasures::end_systolic_volume, "esv", "end-systolic volume", "ml"},
    {&BeatMeasures::stroke_volume, "stroke_volume", "stroke volume", "ml"},
    {&BeatMeasures::ejection_fraction, "ejection_fraction", "ejection fraction", ""},
    {&BeatMeasures::end_diastolic_pressure, "end_diastolic_pressure", "end-diastolic pressure",
     "mmHg"},
    {&BeatMeasures::end_systolic_pressure, "end_systolic_pressure", "end-systolic pressure",
     "mmHg"},
    {&BeatMeasures::peak_pressure, "peak_pressure", "peak pressure", "mmHg"},
    {&BeatMeasures::aortic_systolic, "aortic_systolic", "aortic systolic pressure", "mmHg"},
    {&BeatMeasures::aortic_diastolic, "aortic_diastolic", "aortic diastolic pressure", "mmHg"},
    {&BeatMeasures::aortic_mean, "aortic_mean", "aortic mean pressure", "mmHg"},
    {&BeatMeasures::stroke_work, "stroke_work", "stroke work", "mmHg ml"},
    {&BeatMeasures::largest_pressure_rate, "dp_dt_max", "largest dp/dt", "mmHg/s"},
    {&BeatMeasures::least_pressure_rate, "dp_dt_min", "least dp/dt", "mmHg/s"},
    {&BeatMeasures::mitral_closes, "mitral_closes", "mitral valve closes at", "ms"},
    {&BeatMeasures::aortic_opens, "aortic_opens", "aortic valve opens at", "ms"},
    {&BeatMeasures::aortic_closes, "aortic_closes", "aortic valve closes at", "ms"},
    {&BeatMeasures::mitral_opens, "mitral_opens", "mitral valve opens at", "ms"},
    {&BeatMeasures::isovolumic_contraction, "isovolumic_contraction", "isovolumic contraction",
     "ms"},
    {&BeatMeasures::ejection_time, "ejection_time", "ejection time", "ms"},
    {&BeatMeasures::isovolumic_relaxation, "isovolumic_relaxation", "isovolumic relaxation", "ms"},
    {&BeatMeasures::relaxation_constant, "tau", "relaxation constant tau", "ms"}};

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

/// What the valves are doing.
std::string phase_name(double mitral, double aortic, bool has_ejected) {
  if (mitral > 0.0)
    return "filling";
  if (aortic > 0.0)
    return "ejection";
  return has_ejected ? "relaxation" : "contraction";
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
    text +=
        fmt::format("  {:<26} {}\n", m.words,
                    std::isnan(value) ? "did not happen" : fmt::format("{:.4g} {}", value, m.unit));
  }
  return text;
}

drawing::Figure pressure_volume_figure(const Table& cycle) {
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
  return {.panels = {{.content = chart}}, .columns = 1};
}

drawing::Figure wiggers_figure(const Table& cycle) {
  const Beats beats(cycle);
  const auto of_last = [&](const char* column) { return beats.of(beats.count(), column); };
  const auto time = of_last("time_s");
  const auto series = [&](const char* label, const char* column, bool second = false) {
    return drawing::Series{
        .label = label, .x = time, .y = of_last(column), .on_second_axis = second};
  };
  const auto phases =
      valve_phases(time, of_last("mitral_gradient_mmHg"), of_last("aortic_gradient_mmHg"));
  const drawing::LineChart pressures{
      .x = {"time [s]"},
      .y = {"pressure [mmHg]"},
      .second_y = {"volume [ml]"},
      .series = {series("ventricle", "pressure_mmHg"), series("aorta", "aortic_pressure_mmHg"),
                 series("before the mitral valve", "filling_pressure_mmHg"),
                 series("volume", "volume_ml", true)},
      .phases = phases};
  const drawing::LineChart flows{.x = {"time [s]"},
                                 .y = {"flow [ml/s]"},
                                 .series = {series("mitral", "mitral_flow_ml_per_s"),
                                            series("aortic", "aortic_flow_ml_per_s")},
                                 .phases = phases};
  return {.panels = {{.title = "pressures and volume", .content = pressures},
                     {.title = "flows", .content = flows}},
          .columns = 1,
          .panel_width = 520.0,
          .title = fmt::format("beat {}", beats.count())};
}

}  // namespace lv::report
