#include "lv/report/study_tables.hpp"

#include "lv/circulation/parameters.hpp"
#include "lv/report/cycle_tables.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace lv::report {
namespace {

using circulation::Contractility;
using circulation::Factors;
using circulation::Line;
using circulation::LoadedBeat;
using circulation::LoopPoint;
using units::mmHg;

constexpr double in_mmHg_ml = mmHg * units::ml;

/// "contractility 1.2" or "the case", whatever the loads.
std::string state_words(const Contractility& state) {
  const Factors& f = state.beats.front().factors;
  std::vector<std::string> parts;
  if (f.contractility != 1.0)
    parts.push_back(fmt::format("contractility {:g}", f.contractility));
  if (f.heart_rate != 1.0)
    parts.push_back(fmt::format("heart rate {:g}", f.heart_rate));
  return parts.empty() ? "the case" : fmt::format("{}", fmt::join(parts, ", "));
}

std::vector<std::string> study_columns() {
  std::vector<std::string> names{"name",      "contractility", "heart_rate",    "preload",
                                 "afterload", "beats",         "is_limit_cycle"};
  for (const BeatMeasure& m : beat_measures())
    names.push_back(m.column);
  names.insert(names.end(), {"greatest_elastance_volume_ml", "greatest_elastance_pressure_mmHg",
                             "arterial_elastance_mmHg_per_ml", "E_es_mmHg_per_ml", "V_0_ml",
                             "E_es_deviation_mmHg", "M_w_mmHg", "V_w_ml", "M_w_deviation_mmHg_ml",
                             "no_beat_because"});
  return names;
}

std::vector<std::string> named_factors(const std::string& name, const Factors& f) {
  std::vector<std::string> row{name};
  for (const double factor : {f.contractility, f.heart_rate, f.preload, f.afterload})
    row.push_back(Table::number(factor));
  return row;
}

std::vector<std::string> study_row(const Contractility& state, std::size_t b) {
  const LoadedBeat& beat = state.beats[b];
  std::vector<std::string> row = named_factors(beat.name, beat.factors);
  row.insert(row.end(), {std::to_string(beat.beats), beat.is_limit ? "yes" : "no"});
  for (const auto& [name, value] : beat_numbers(beat.measures))
    row.push_back(Table::number(value));
  const LoopPoint& point = state.end_systole.points[b];
  const Line& e = state.end_systole.line;
  const Line& w = state.stroke_work;
  for (const double value :
       {point.volume / units::ml, point.pressure / mmHg,
        circulation::arterial_elastance(beat.measures) / circulation::elastance,
        e.slope / circulation::elastance, e.intercept / units::ml, e.deviation / mmHg,
        w.slope / mmHg, w.intercept / units::ml, w.deviation / in_mmHg_ml})
    row.push_back(Table::number(value));
  row.emplace_back();
  return row;
}

std::vector<std::string> missing_row(const circulation::MissingBeat& beat, std::size_t columns) {
  std::vector<std::string> row = named_factors(beat.name, beat.factors);
  row.resize(columns);
  row.back() = beat.why;
  return row;
}

/// "2 of 4 loads did not come to a limit cycle"; empty where all did.
std::string words_of_unfinished(std::span<const LoadedBeat> beats) {
  const auto unfinished = std::ranges::count(beats, false, &LoadedBeat::is_limit);
  return unfinished == 0 ? ""
                         : fmt::format("{} of {} load{} did not come to a limit cycle", unfinished,
                                       beats.size(), beats.size() == 1 ? "" : "s");
}

std::vector<std::string> names_of_unfinished(std::span<const LoadedBeat> beats) {
  std::vector<std::string> names;
  for (const LoadedBeat& beat : beats)
    if (!beat.is_limit)
      names.push_back(beat.name);
  return names;
}

/// Points of beats: circles, and triangles of those that are no limit cycles.
struct Points {
  drawing::Series limits, others;

  Points(drawing::Colour colour, const std::string& label)
      : limits{.label = label, .colour = colour, .width = 0.0, .marker = drawing::Marker::circle},
        others{.colour = colour, .width = 0.0, .marker = drawing::Marker::triangle} {}

  void add(bool is_limit, double x, double y) {
    drawing::Series& to = is_limit ? limits : others;
    to.x.push_back(x);
    to.y.push_back(y);
  }

  void draw(drawing::LineChart& chart) {
    if (limits.x.empty())
      others.label = std::exchange(limits.label, "");
    for (drawing::Series* series : {&limits, &others})
      if (!series->x.empty())
        chart.series.push_back(std::move(*series));
  }
};

/// A line from where it is zero to a little beyond the farthest of its points.
drawing::Series drawn(const Line& line, double farthest, double y_unit, drawing::Colour colour) {
  const double end = line.intercept + 1.08 * (farthest - line.intercept);
  return {.x = {line.intercept / units::ml, end / units::ml},
          .y = {0.0, line.slope * (end - line.intercept) / y_unit},
          .colour = colour,
          .width = 1.2,
          .dashed = true};
}

void add_loops(const Contractility& state, drawing::Colour colour, drawing::LineChart& chart) {
  Points points(colour, "");
  double farthest = 0.0;
  for (std::size_t b = 0; b < state.beats.size(); ++b) {
    drawing::Series loop{
        .label = b == 0 ? state_words(state) : "", .colour = colour, .width = b == 0 ? 2.0 : 0.9};
    for (const LoopPoint& p : state.beats[b].loop) {
      loop.x.push_back(p.volume / units::ml);
      loop.y.push_back(p.pressure / mmHg);
    }
    chart.series.push_back(std::move(loop));
    const LoopPoint& point = state.end_systole.points[b];
    points.add(state.beats[b].is_limit, point.volume / units::ml, point.pressure / mmHg);
    farthest = std::max(farthest, point.volume);
  }
  points.draw(chart);
  if (!std::isnan(state.end_systole.line.slope))
    chart.series.push_back(drawn(state.end_systole.line, farthest, mmHg, colour));
}

void add_works(const Contractility& state, drawing::Colour colour, drawing::LineChart& chart) {
  Points points(colour, state_words(state));
  double farthest = 0.0;
  for (const LoadedBeat& beat : state.beats) {
    if (!beat.factors.is_preload())
      continue;
    points.add(beat.is_limit, beat.measures.end_diastolic_volume / units::ml,
               beat.measures.stroke_work / in_mmHg_ml);
    farthest = std::max(farthest, beat.measures.end_diastolic_volume);
  }
  points.draw(chart);
  if (!std::isnan(state.stroke_work.slope))
    chart.series.push_back(drawn(state.stroke_work, farthest, in_mmHg_ml, colour));
}

/// A line of numbers in these units, and how far its points are off.
struct LineWords {
  const char* what;
  const char* slope_unit;
  double slope;
  const char* intercept;
  const char* unit;  ///< of the deviation
  double deviation;
  const char* points;
};

std::string line_text(const Line& line, const LineWords& w) {
  std::string text = fmt::format("    {:<36} ", w.what);
  if (std::isnan(line.slope))
    return text + fmt::format("not known: it takes at least two {}\n", w.points);
  text += fmt::format("{:.3g} {}, {} {:.3g} ml, of {} {}", line.slope / w.slope, w.slope_unit,
                      w.intercept, line.intercept / units::ml, line.points, w.points);
  if (!std::isnan(line.deviation))
    text += fmt::format(", {:.2g} {} off (root mean square)", line.deviation / w.deviation, w.unit);
  return text + "\n";
}

constexpr LineWords elastance_words{
    "end-systolic elastance E_es", "mmHg/ml", circulation::elastance, "V_0", "mmHg", mmHg, "loads"};
constexpr LineWords work_words{
    "preload-recruitable stroke work M_w", "mmHg", mmHg, "V_w", "mmHg ml", in_mmHg_ml, "preloads"};

}  // namespace

Table study_table(std::span<const Contractility> family,
                  std::span<const circulation::MissingBeat> missing) {
  Table table(study_columns());
  for (const Contractility& state : family)
    for (std::size_t b = 0; b < state.beats.size(); ++b)
      table.add_row(study_row(state, b));
  for (const circulation::MissingBeat& beat : missing)
    table.add_row(missing_row(beat, study_columns().size()));
  return table;
}

drawing::Figure study_figure(std::span<const Contractility> family) {
  drawing::LineChart loops{.x = {"volume [ml]"}, .y = {"pressure [mmHg]"}};
  drawing::LineChart works{.x = {"end-diastolic volume [ml]"}, .y = {"stroke work [mmHg ml]"}};
  int category = 0;
  std::vector<std::string> unfinished;
  for (const Contractility& state : family) {
    if (const std::string words = words_of_unfinished(state.beats); !words.empty())
      unfinished.push_back(fmt::format("{}: {}", state_words(state), words));
    const drawing::Colour colour = drawing::category(category++);
    add_loops(state, colour, loops);
    add_works(state, colour, works);
  }
  return {.panels = {{.title = "loops, end-systolic relation", .content = loops},
                     {.title = "preload-recruitable stroke work", .content = works}},
          .panel_width = 380.0,
          .footnote = unfinished.empty() ? ""
                                         : fmt::format("{} (triangles); the lines rest on them",
                                                       fmt::join(unfinished, "; "))};
}

std::string study_text(std::span<const Contractility> family,
                       std::span<const circulation::MissingBeat> missing) {
  std::string text;
  for (const Contractility& state : family) {
    text += fmt::format("  {}\n", state_words(state)) +
            line_text(state.end_systole.line, elastance_words) +
            line_text(state.stroke_work, work_words);
    if (const std::string words = words_of_unfinished(state.beats); !words.empty())
      text += fmt::format("    warning: {}, and these lines rest on them: {}\n", words,
                          fmt::join(names_of_unfinished(state.beats), ", "));
  }
  for (const circulation::MissingBeat& beat : missing)
    text += fmt::format("  {} has no beat: {}\n", beat.name, beat.why);
  return text;
}

}  // namespace lv::report
