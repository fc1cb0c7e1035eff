#include "lv/report/table_figures.hpp"

#include "lv/analysis/quantities.hpp"
#include "lv/base/nearest.hpp"
#include "lv/heartbeat/beat.hpp"
#include "lv/material/stress_stretch.hpp"
#include "lv/mesh/regions.hpp"
#include "lv/report/cycle_tables.hpp"
#include "lv/report/stage_facts.hpp"
#include "lv/report/work_folder.hpp"
#include "lv/strain/agreement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

namespace lv::report {
namespace {

namespace fs = std::filesystem;

constexpr double missing = std::numeric_limits<double>::quiet_NaN();

// ---- curves ----

/// The phases as curves.csv has them.
std::vector<drawing::Phase> phases_of(const Table& curves) {
  const auto time = curves.numbers("time_s");
  const auto name = curves.words("phase");
  std::vector<drawing::Phase> phases;
  for (std::size_t i = 0; i < name.size(); ++i) {
    if (phases.empty() || phases.back().label != name[i])
      phases.push_back({name[i], i == 0 ? time[i] : time[i - 1], time[i]});
    phases.back().end = time[i];
  }
  return phases;
}

/// What curves are drawn against: the time, or the share of each phase's loads, phase after phase.
struct Abscissa {
  drawing::Axis axis;
  std::vector<double> values;
  std::vector<drawing::Phase> phases;
};

Abscissa abscissa(const Table& curves, const CurveFacts& facts) {
  Abscissa a{{"time [s]"}, curves.numbers("time_s"), phases_of(curves)};
  if (!facts.is_static)
    return a;
  a.axis.label = "load [share of each phase]";
  const std::vector<drawing::Phase> phases = a.phases;
  for (double& value : a.values) {
    std::size_t k = 0;
    while (k + 1 < phases.size() && value > phases[k].end)
      ++k;
    const double length = phases[k].end - phases[k].begin;
    value = static_cast<double>(k) + (length > 0.0 ? (value - phases[k].begin) / length : 0.0);
  }
  for (std::size_t k = 0; k < phases.size(); ++k)
    a.phases[k] = {phases[k].label, static_cast<double>(k), static_cast<double>(k) + 1.0};
  return a;
}

drawing::Panel curve_panel(const Abscissa& a, const std::string& label,
                           std::vector<double> values) {
  return {.content = drawing::LineChart{.x = a.axis,
                                        .y = {label},
                                        .series = {{.x = a.values, .y = std::move(values)}},
                                        .phases = a.phases}};
}

/// A marker for every moment, at the row whose time is the nearest.
void mark(const Table& curves, const std::vector<std::pair<std::string, double>>& moments,
          drawing::LineChart& path) {
  constexpr std::array<drawing::Marker, 3> markers{drawing::Marker::circle, drawing::Marker::square,
                                                   drawing::Marker::triangle};
  const auto times = curves.numbers("time_s");
  if (times.empty())
    return;
  const drawing::Series all = path.series.front();
  for (std::size_t k = 0; k < moments.size(); ++k) {
    const auto& [name, time] = moments[k];
    const std::size_t row = nearest_number(time, times);
    path.series.push_back({.label = heartbeat::title(name),
                           .x = {all.x[row]},
                           .y = {all.y[row]},
                           .width = 0.0,
                           .marker = markers[k % markers.size()]});
  }
}

// ---- bull's-eyes ----

/// A quantity at a state in the regions of one scheme.
std::vector<double> means(const Table& regions, const std::string& quantity,
                          const std::string& state, const std::string& scheme) {
  const auto states = regions.words("state");
  const auto schemes = regions.words("scheme");
  const auto quantities = regions.words("quantity");
  const auto mean = regions.numbers("mean");
  std::vector<double> found;
  for (std::size_t i = 0; i < mean.size(); ++i)
    if (states[i] == state && schemes[i] == scheme && quantities[i] == quantity)
      found.push_back(mean[i]);
  return found;
}

/// At all moments, in slices' sectors and in segments.
std::vector<double> all_means(const Table& regions, const std::string& quantity) {
  const auto schemes = regions.words("scheme");
  const auto quantities = regions.words("quantity");
  const auto mean = regions.numbers("mean");
  std::vector<double> all;
  for (std::size_t i = 0; i < mean.size(); ++i)
    if (quantities[i] == quantity && (schemes[i] == "sector" || schemes[i] == "aha17"))
      all.push_back(mean[i]);
  return all;
}

/// The footnote, and what the stars of a figure of these parts mean.
std::string with_stars(const std::string& footnote, const drawing::Orientation& orientation,
                       const std::vector<std::string>& parts = {"septum", "apex", "base"}) {
  const std::string note = drawing::star_note(orientation, parts);
  return footnote + (footnote.empty() || note.empty() ? "" : ". ") + note;
}

/// What the numbers of the 17 segments mean, and the names of their territories. A segment's number
/// and name stay in one line.
std::string segment_note() {
  std::string names;
  for (int segment = 1; segment <= 17; ++segment) {
    std::string name = fmt::format("{} {}", segment, mesh::aha_name(segment));
    for (std::size_t at = name.find(' '); at != std::string::npos; at = name.find(' '))
      name.replace(at, 1, "\u00a0");
    names += (segment == 1 ? "" : ", ") + name;
  }
  return names +
         ". Dark lines part what the left anterior descending (LAD), the right (RCA) and the "
         "circumflex artery (LCX) usually feed";
}

/// From the least to the greatest value, rounded outwards to a step that ticks can name, with the
/// quantity's own floor.
drawing::ColourScale scale_of(std::vector<double> values, const std::string& quantity) {
  std::erase_if(values, [](double v) { return !std::isfinite(v); });
  const analysis::Quantity& q = analysis::quantity(quantity);
  if (values.empty())
    return {drawing::sequential(), 0.0, 1.0, q.middle, q.floor};
  const auto [least, greatest] = std::minmax_element(values.begin(), values.end());
  double low = *least;
  double high = std::max(*greatest, low + 1e-6);
  if (q.is_signed) {
    const double most = std::max(std::abs(low - q.middle), std::abs(high - q.middle));
    low = q.middle - most;
    high = q.middle + most;
  }
  const double step = std::pow(10.0, std::floor(std::log10(high - low))) / 2.0;
  return {q.is_signed ? drawing::diverging() : drawing::sequential(), step * std::floor(low / step),
          step * std::ceil(high / step), q.middle, q.floor};
}

/// As many as give three digits of the scale's end.
int decimals(const drawing::ColourScale& scale) {
  const double most = std::max(std::abs(scale.min), std::abs(scale.max));
  return std::clamp(2 - static_cast<int>(std::floor(std::log10(std::max(most, 1e-6)))), 0, 3);
}

drawing::Panel bulls_eye_panel(const std::string& title, const std::vector<double>& values,
                               const drawing::ColourScale& scale, int digits,
                               const drawing::Orientation& orientation) {
  drawing::BullsEye plot{.values = values, .scale = scale, .decimals = digits};
  for (std::string& wall : plot.walls)
    wall = orientation.starred(wall, "septum");
  if (values.size() == 17) {
    plot.is_numbered = true;
    plot.territories = drawing::coronary_territories();
    for (drawing::Territory& territory : plot.territories)
      territory.name = orientation.starred(territory.name, "septum");
  } else {
    plot.sectors = drawing::seven_slices();
  }
  // rings are parts of the way from the base to the apex
  return {.title = orientation.starred(title, {"apex", "base"}), .content = plot};
}

/// The value of every AHA segment at end-systole.
drawing::Panel segment_panel(const Table& regions, const std::string& quantity, int digits,
                             const drawing::Orientation& orientation) {
  const std::vector<double> found = means(regions, quantity, heartbeat::end_systole, "aha17");
  const drawing::ColourScale scale = scale_of(found, quantity);
  const std::string label = analysis::label(analysis::quantity(quantity));
  drawing::Panel panel = bulls_eye_panel(label, found, scale, digits, orientation);
  panel.colour_bar = drawing::ColourBar{label, scale};
  return panel;
}

// ---- agreement ----

std::vector<strain::Pair> pairs_of(const Table& table, const std::string& scheme) {
  const auto schemes = table.words("scheme");
  const auto measured = table.numbers("measured");
  const auto model = table.numbers("model");
  std::vector<strain::Pair> pairs;
  for (std::size_t i = 0; i < schemes.size(); ++i)
    if (schemes[i] == scheme)
      pairs.push_back({scheme, 0, "", measured[i], model[i]});
  return pairs;
}

drawing::Series level(const std::string& label, double y, double from, double to, bool dashed) {
  return {.label = label, .x = {from, to}, .y = {y, y}, .width = 1.2, .dashed = dashed};
}

drawing::LineChart bland_altman(const drawing::Series& points, const strain::Agreement& a) {
  const auto [low, high] = std::minmax_element(points.x.begin(), points.x.end());
  return {.x = {"mean of model and images"},
          .y = {"model - images"},
          .series = {points,
                     level(fmt::format("bias {:+.3f}", a.bias), a.bias, *low, *high, false),
                     level(fmt::format("95% limits {:+.3f}, {:+.3f}", a.lower, a.upper), a.lower,
                           *low, *high, true),
                     {.x = {*low, *high},
                      .y = {a.upper, a.upper},
                      .colour = drawing::category(2),
                      .width = 1.2,
                      .dashed = true}}};
}

// ---- files ----

CurveFacts curve_facts(const fs::path& work) {
  const bool has_valves = beat_facts(work).value_or(BeatFacts{}).has_valves;
  const auto mesh = mesh_facts(work);
  return {mesh && !mesh->is_immersed && !has_valves, has_valves, moments_of(work)};
}

/// Writes the figures of what is there.
class FigureFolder {
 public:
  FigureFolder(fs::path work, fs::path folder)
      : work_(std::move(work)), folder_(std::move(folder)) {}

  void curves() const {
    const auto table = table_of(work_, "beat", "curves.csv");
    if (!table)
      return;
    const CurveFacts facts = curve_facts(work_);
    write(curves_figure(*table, facts), "curves");
    if (const auto calcium = calcium_figure(*table, facts))
      write(*calcium, "calcium");
  }

  void heartbeats() const {
    const auto cycle = table_of(work_, "beat", "cycle.csv");
    const auto beats = table_of(work_, "beat", "beats.csv");
    if (!cycle || !beats)
      return;
    write(pressure_volume_figure(*cycle, *beats), "pressure_volume");
    write(wiggers_figure(*cycle, table_of(work_, "beat", "curves.csv")), "wiggers");
  }

  void regions() const {
    const auto table = table_of(work_, "results", "regions.csv");
    if (!table)
      return;
    const drawing::Orientation orientation = orientation_of(work_);
    const auto states = table->words("state");
    const std::set<std::string> moments(states.begin(), states.end());
    for (const analysis::Quantity& q : analysis::quantities())
      for (const std::string& moment : moments)
        if (q.is_shown && !means(*table, q.name, moment, "aha17").empty())
          write(bulls_eyes_figure(*table, q.name, moment, orientation),
                fmt::format("bulls_eyes_{}_{}", q.name, moment));
  }

  void contractility() const {
    if (const auto table = table_of(work_, "results", "contractility.csv"))
      write(contractility_figure(*table, orientation_of(work_)), "contractility");
  }

  void rotation() const {
    if (const auto table = table_of(work_, "results", "rotation.csv"))
      write(rotation_figure(*table, orientation_of(work_)), "rotation");
  }

  void muscle() const {
    if (const auto table = table_of(work_, "results", "stress_stretch.csv"))
      write(muscle_figure(*table), "stress_stretch");
  }

  void agreement() const {
    for (const char* component : {"circumferential", "radial"}) {
      const auto table =
          table_of(work_, "results", fmt::format("strain_comparison_{}.csv", component));
      for (const char* scheme : {"sector", "aha17"})
        if (table && pairs_of(*table, scheme).size() > 1)
          write(agreement_figure(*table, component, scheme, orientation_of(work_)),
                fmt::format("strain_agreement_{}_{}", component, scheme));
    }
  }

 private:
  void write(const drawing::Figure& figure, const std::string& name) const {
    drawing::write(figure, folder_ / (name + ".svg"));
  }

  fs::path work_, folder_;
};

}  // namespace

drawing::Figure curves_figure(const Table& curves, const CurveFacts& facts) {
  const Abscissa a = abscissa(curves, facts);
  const auto pressure = curves.numbers("pressure_mmHg");
  const auto volume = curves.numbers("cavity_volume_ml");
  drawing::LineChart path{.x = {"cavity volume [ml]"},
                          .y = {"pressure [mmHg]"},
                          .series = {{.x = volume, .y = pressure}}};
  mark(curves, facts.moments, path);
  return {
      .panels = {
          curve_panel(a, "pressure [mmHg]", pressure),
          curve_panel(a, "cavity volume [ml]", volume),
          curve_panel(a, "mean active tension [kPa]", curves.numbers("mean_active_tension_kPa")),
          {.title = facts.has_valves ? "pressure-volume loop" : "pressure-volume path (no valves)",
           .content = path}}};
}

std::optional<drawing::Figure> calcium_figure(const Table& curves, const CurveFacts& facts) {
  const auto calcium = curves.numbers("calcium_uM");
  if (std::all_of(calcium.begin(), calcium.end(), [](double c) { return std::isnan(c); }))
    return std::nullopt;
  return drawing::Figure{.panels = {curve_panel(abscissa(curves, facts), "calcium [µM]", calcium)},
                         .columns = 1,
                         .footnote = facts.is_static
                                         ? "Known at rest and at its peak; between them the "
                                           "tension is a mean of both"
                                         : ""};
}

drawing::Figure segments_figure(const Table& regions, const drawing::Orientation& orientation) {
  return {.panels = {segment_panel(regions, "fibre_strain", 3, orientation),
                     segment_panel(regions, "fibre_stress", 1, orientation),
                     segment_panel(regions, "active_tension", 1, orientation),
                     segment_panel(regions, "radial_strain", 2, orientation)},
          .title = "end-systole, 17 segments",
          .footnote = with_stars("Green-Lagrange strain from end-diastole. " + segment_note(),
                                 orientation)};
}

drawing::Figure bulls_eyes_figure(const Table& regions, const std::string& quantity,
                                  const std::string& state,
                                  const drawing::Orientation& orientation) {
  const std::vector<double> slices = means(regions, quantity, state, "sector");
  const std::vector<double> segments = means(regions, quantity, state, "aha17");
  const drawing::ColourScale scale = scale_of(all_means(regions, quantity), quantity);
  const int digits = decimals(scale);
  const std::string label = analysis::label(analysis::quantity(quantity));
  const std::string strain =
      fmt::format("Green-Lagrange strain from {}. ",
                  state == heartbeat::end_diastole ? orientation.at_rest()
                                                   : heartbeat::title(heartbeat::end_diastole));
  std::vector<std::string> parts{"septum", "apex", "base"};
  if (state == heartbeat::end_diastole && analysis::quantity(quantity).is_strain)
    parts.emplace_back("early diastole");
  return {.panels = {bulls_eye_panel("seven slices", slices, scale, digits, orientation),
                     bulls_eye_panel("17 segments (AHA)", segments, scale, digits, orientation)},
          .title = fmt::format("{}, mean at {}", label, heartbeat::title(state)),
          .footnote =
              with_stars((analysis::quantity(quantity).is_strain ? strain : "") + segment_note(),
                         orientation, parts),
          .colour_bar = drawing::ColourBar{label, scale}};
}

drawing::Figure contractility_figure(const Table& segments,
                                     const drawing::Orientation& orientation) {
  const auto numbers = segments.whole_numbers("segment");
  const auto panel = [&](const char* column, const std::string& label, drawing::ColourScale scale) {
    std::vector<double> values(mesh::aha_count, std::nan(""));
    const auto found = segments.numbers(column);
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      values.at(numbers[i] - 1) = found[i];
      scale.max = std::max(scale.max, std::ceil(10.0 * found[i]) / 10.0);
    }
    if (scale.middle > 0.0)
      scale.min = 2.0 * scale.middle - scale.max;
    drawing::Panel of = bulls_eye_panel(label, values, scale, 2, orientation);
    of.colour_bar = drawing::ColourBar{label, scale};
    return of;
  };
  return {.panels = {panel("factor", "factor", {drawing::diverging(), 0.0, 2.0, 1.0, 0.0}),
                     panel("standard_error_of_logarithm", "standard error of ln(factor)",
                           {drawing::sequential(), 0.0, 0.1})},
          .title = "contractility, fitted from strain",
          .footnote = with_stars(segment_note(), orientation)};
}

drawing::Figure rotation_figure(const Table& rotation, const drawing::Orientation& orientation) {
  const auto slice = rotation.numbers("slice");
  const auto series = [&](const char* label, const char* column, bool dashed) {
    return drawing::Series{.label = label,
                           .x = slice,
                           .y = rotation.numbers(column),
                           .colour = drawing::category(0),
                           .dashed = dashed,
                           .marker = drawing::Marker::circle};
  };
  const drawing::LineChart chart{
      .x = {fmt::format("slice, from the {} (1) to the {} (7)", orientation.starred("base", "base"),
                        orientation.starred("apex", "apex"))},
      .y = {"rotation [deg]"},
      .series = {series("end-diastole to end-systole", "end_diastole_to_end_systole_deg", false),
                 series("early to end-diastole", "early_to_end_diastole_deg", true)}};
  return {.panels = {{.content = chart}},
          .columns = 1,
          .panel_width = 420.0,
          .footnote = with_stars("Anticlockwise seen from the apex is positive", orientation,
                                 {"apex", "base"})};
}

drawing::Figure muscle_figure(const Table& curves) {
  const auto muscle = curves.words("muscle");
  const auto published = curves.words("published");
  const auto stretch = curves.numbers("fibre_stretch");
  const auto stress = curves.numbers("cauchy_stress_kPa");
  drawing::LineChart chart{.x = {"fibre stretch"}, .y = {"Cauchy stress [kPa]"}};
  for (std::size_t i = 0; i < muscle.size(); ++i) {
    if (material::is_subject_of_paper(muscle[i]))
      continue;
    if (i == 0 || muscle[i] != muscle[i - 1])
      chart.series.push_back({.label = muscle[i], .dashed = published[i] == "yes"});
    chart.series.back().x.push_back(stretch[i]);
    chart.series.back().y.push_back(stress[i]);
  }
  return {.panels = {{.content = chart}}, .columns = 1, .panel_width = 480.0};
}

drawing::Figure agreement_figure(const Table& table, const std::string& component,
                                 const std::string& scheme,
                                 const drawing::Orientation& orientation) {
  const auto pairs = pairs_of(table, scheme);
  const strain::Agreement a = strain::agreement(pairs);
  drawing::Series scatter{.width = 0.0, .marker = drawing::Marker::circle};
  drawing::Series difference = scatter;
  double low = missing;
  double high = missing;
  for (const strain::Pair& p : pairs) {
    scatter.x.push_back(p.measured);
    scatter.y.push_back(p.model);
    difference.x.push_back(0.5 * (p.measured + p.model));
    difference.y.push_back(p.model - p.measured);
    low = std::fmin(low, std::min(p.measured, p.model));
    high = std::fmax(high, std::max(p.measured, p.model));
  }
  const drawing::Series same{
      .label = "the same", .x = {low, high}, .y = {low, high}, .width = 1.2, .dashed = true};
  return {.panels = {{.title = "model against images",
                      .content = drawing::LineChart{.x = {"strain of the images"},
                                                    .y = {"strain of the model"},
                                                    .series = {scatter, same}}},
                     {.title = "Bland and Altman", .content = bland_altman(difference, a)}},
          .title = fmt::format(
              "{} strain at end-systole, {} {}", component, a.count,
              orientation.starred(scheme == "sector" ? "sectors of slices" : "AHA segments",
                                  {"septum", "apex", "base"})),
          .footnote = with_stars("", orientation)};
}

void write_figures(const fs::path& work, const fs::path& folder) {
  fs::create_directories(folder);
  const FigureFolder figures(work, folder);
  figures.curves();
  figures.heartbeats();
  figures.regions();
  figures.contractility();
  figures.rotation();
  figures.muscle();
  figures.agreement();
}

}  // namespace lv::report
