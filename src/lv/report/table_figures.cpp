#include "lv/report/table_figures.hpp"

#include "lv/heartbeat/beat.hpp"
#include "lv/report/work_folder.hpp"
#include "lv/strain/agreement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace lv::report {
namespace {

namespace fs = std::filesystem;

constexpr double missing = std::numeric_limits<double>::quiet_NaN();

std::string spaced(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

std::string with_unit(const std::string& name, const std::string& unit) {
  return unit == "1" || unit.empty() ? spaced(name) : fmt::format("{} [{}]", spaced(name), unit);
}

bool is_strain(const std::string& quantity) {
  return quantity.ends_with("_strain");
}

// ---- curves ----

/// The phases as curves.csv has them.
std::vector<Phase> phases_of(const Table& curves) {
  const auto time = curves.numbers("time_s");
  const auto name = curves.words("phase");
  std::vector<Phase> phases;
  for (std::size_t i = 0; i < name.size(); ++i) {
    if (phases.empty() || phases.back().label != name[i])
      phases.push_back({name[i], i == 0 ? time[i] : time[i - 1], time[i]});
    phases.back().end = time[i];
  }
  return phases;
}

// ---- bull's-eyes ----

/// A quantity at a state in the regions of one scheme.
struct RegionalMeans {
  std::vector<double> values;
  std::string unit;
};

RegionalMeans means(const Table& regions, const std::string& quantity, const std::string& state,
                    const std::string& scheme) {
  const auto states = regions.words("state");
  const auto schemes = regions.words("scheme");
  const auto quantities = regions.words("quantity");
  const auto units = regions.words("unit");
  const auto mean = regions.numbers("mean");
  RegionalMeans found;
  for (std::size_t i = 0; i < mean.size(); ++i)
    if (states[i] == state && schemes[i] == scheme && quantities[i] == quantity) {
      found.values.push_back(mean[i]);
      found.unit = units[i];
    }
  return found;
}

/// From the least to the greatest value, rounded outwards to a step that ticks can name.
ColourScale scale_of(std::vector<double> values, const std::string& quantity) {
  std::erase_if(values, [](double v) { return !std::isfinite(v); });
  if (values.empty())
    return {sequential(), 0.0, 1.0};
  const auto [least, greatest] = std::minmax_element(values.begin(), values.end());
  double low = *least;
  double high = std::max(*greatest, low + 1e-6);
  const bool is_signed = is_strain(quantity) || quantity == "J";
  if (is_signed) {
    const double middle = quantity == "J" ? 1.0 : 0.0;
    const double most = std::max(std::abs(low - middle), std::abs(high - middle));
    low = middle - most;
    high = middle + most;
  }
  const double step = std::pow(10.0, std::floor(std::log10(high - low))) / 2.0;
  return {is_signed ? diverging() : sequential(), step * std::floor(low / step),
          step * std::ceil(high / step)};
}

/// As many as give three digits of the scale's end.
int decimals(const ColourScale& scale) {
  const double most = std::max(std::abs(scale.min), std::abs(scale.max));
  return std::clamp(2 - static_cast<int>(std::floor(std::log10(std::max(most, 1e-6)))), 0, 3);
}

Panel bulls_eye_panel(const std::string& title, const std::vector<double>& values,
                      const ColourScale& scale, int digits) {
  BullsEye plot{.values = values, .scale = scale, .decimals = digits};
  if (values.size() != 17)
    plot.sectors = seven_slices();
  return {.title = title, .content = plot};
}

/// The value of every AHA segment at end-systole.
Panel segment_panel(const Table& regions, const std::string& quantity, int digits) {
  const RegionalMeans found = means(regions, quantity, heartbeat::end_systole, "aha17");
  return bulls_eye_panel(with_unit(quantity, found.unit), found.values,
                         scale_of(found.values, quantity), digits);
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

Series level(const std::string& label, double y, double from, double to, bool dashed) {
  return {.label = label, .x = {from, to}, .y = {y, y}, .width = 1.2, .dashed = dashed};
}

LineChart bland_altman(const Series& points, const strain::Agreement& a) {
  const auto [low, high] = std::minmax_element(points.x.begin(), points.x.end());
  return {.x = {"mean of model and images"},
          .y = {"model - images"},
          .series = {points,
                     level(fmt::format("bias {:+.3f}", a.bias), a.bias, *low, *high, false),
                     level(fmt::format("95% limits {:+.3f}, {:+.3f}", a.lower, a.upper), a.lower,
                           *low, *high, true),
                     {.x = {*low, *high},
                      .y = {a.upper, a.upper},
                      .colour = category(2),
                      .width = 1.2,
                      .dashed = true}}};
}

// ---- files ----

/// Writes the figures of what is there.
class FigureFolder {
 public:
  FigureFolder(fs::path work, fs::path folder)
      : work_(std::move(work)), folder_(std::move(folder)) {}

  void curves() const {
    const auto table = table_of(work_, "beat", "curves.csv");
    if (!table)
      return;
    write(curves_figure(*table), "curves");
    write(calcium_figure(*table), "calcium");
  }

  void regions() const {
    const auto table = table_of(work_, "results", "regions.csv");
    if (!table)
      return;
    const auto states = table->words("state");
    const std::set<std::string> moments(states.begin(), states.end());
    for (const char* quantity :
         {"active_tension", "fibre_stress", "fibre_stress_passive", "fibre_strain",
          "circumferential_strain", "radial_strain", "longitudinal_strain", "J"})
      for (const std::string& moment : moments)
        if (!means(*table, quantity, moment, "aha17").values.empty())
          write(bulls_eyes_figure(*table, quantity, moment),
                fmt::format("bulls_eyes_{}_{}", quantity, moment));
  }

  void rotation() const {
    if (const auto table = table_of(work_, "results", "rotation.csv"))
      write(rotation_figure(*table), "rotation");
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
          write(agreement_figure(*table, component, scheme),
                fmt::format("strain_agreement_{}_{}", component, scheme));
    }
  }

 private:
  void write(const Figure& figure, const std::string& name) const {
    report::write(figure, folder_ / (name + ".svg"));
  }

  fs::path work_, folder_;
};

}  // namespace

Figure curves_figure(const Table& curves) {
  const auto time = curves.numbers("time_s");
  const auto pressure = curves.numbers("pressure_mmHg");
  const auto volume = curves.numbers("cavity_volume_ml");
  const LineChart against_time{
      .x = {"time [s]"},
      .y = {"pressure [mmHg], tension [kPa]"},
      .second_y = {"volume [ml]"},
      .series = {{.label = "pressure", .x = time, .y = pressure},
                 {.label = "mean active tension",
                  .x = time,
                  .y = curves.numbers("mean_active_tension_kPa")},
                 {.label = "cavity volume", .x = time, .y = volume, .on_second_axis = true}},
      .phases = phases_of(curves)};
  const LineChart loop{.x = {"cavity volume [ml]"},
                       .y = {"pressure [mmHg]"},
                       .series = {{.x = volume, .y = pressure}}};
  return {.panels = {{.title = "against time", .content = against_time},
                     {.title = "pressure and volume", .content = loop}}};
}

Figure calcium_figure(const Table& curves) {
  const LineChart chart{
      .x = {"time [s]"},
      .y = {"calcium [uM]"},
      .series = {{.x = curves.numbers("time_s"), .y = curves.numbers("calcium_uM")}},
      .phases = phases_of(curves)};
  return {.panels = {{.content = chart}}, .columns = 1};
}

Figure segments_figure(const Table& regions) {
  return {.panels = {segment_panel(regions, "fibre_strain", 3),
                     segment_panel(regions, "fibre_stress", 1),
                     segment_panel(regions, "active_tension", 1),
                     segment_panel(regions, "radial_strain", 2)},
          .title = "end-systole, 17 segments",
          .footnote = "Green-Lagrange strain from end-diastole"};
}

Figure bulls_eyes_figure(const Table& regions, const std::string& quantity,
                         const std::string& state) {
  const RegionalMeans slices = means(regions, quantity, state, "sector");
  const RegionalMeans segments = means(regions, quantity, state, "aha17");
  std::vector<double> all = slices.values;
  all.insert(all.end(), segments.values.begin(), segments.values.end());
  const ColourScale scale = scale_of(all, quantity);
  const int digits = decimals(scale);
  const std::string label = with_unit(quantity, segments.unit);
  const std::string strain =
      fmt::format("Green-Lagrange strain from {}", state == heartbeat::end_diastole
                                                       ? "early diastole"
                                                       : heartbeat::title(heartbeat::end_diastole));
  return {.panels = {bulls_eye_panel("seven slices", slices.values, scale, digits),
                     bulls_eye_panel("17 segments (AHA)", segments.values, scale, digits)},
          .title = fmt::format("{}, mean at {}", label, heartbeat::title(state)),
          .footnote = is_strain(quantity) ? strain : "",
          .colour_bar = ColourBar{label, scale}};
}

Figure rotation_figure(const Table& rotation) {
  const auto slice = rotation.numbers("slice");
  const auto series = [&](const char* label, const char* column, bool dashed) {
    return Series{.label = label,
                  .x = slice,
                  .y = rotation.numbers(column),
                  .colour = category(0),
                  .dashed = dashed,
                  .marker = Marker::circle};
  };
  const LineChart chart{
      .x = {"slice, from the base (1) to the apex (7)"},
      .y = {"rotation [deg]"},
      .series = {series("end-diastole to end-systole", "end_diastole_to_end_systole_deg", false),
                 series("early to end-diastole", "early_to_end_diastole_deg", true)}};
  return {.panels = {{.content = chart}},
          .columns = 1,
          .panel_width = 420.0,
          .footnote = "Anticlockwise seen from the apex is positive"};
}

Figure muscle_figure(const Table& curves) {
  const auto muscle = curves.words("muscle");
  const auto published = curves.words("published");
  const auto stretch = curves.numbers("fibre_stretch");
  const auto stress = curves.numbers("cauchy_stress_kPa");
  LineChart chart{.x = {"fibre stretch"}, .y = {"Cauchy stress [kPa]"}};
  for (std::size_t i = 0; i < muscle.size(); ++i) {
    if (i == 0 || muscle[i] != muscle[i - 1])
      chart.series.push_back({.label = muscle[i], .dashed = published[i] == "yes"});
    chart.series.back().x.push_back(stretch[i]);
    chart.series.back().y.push_back(stress[i]);
  }
  return {.panels = {{.content = chart}}, .columns = 1, .panel_width = 480.0};
}

Figure agreement_figure(const Table& table, const std::string& component,
                        const std::string& scheme) {
  const auto pairs = pairs_of(table, scheme);
  const strain::Agreement a = strain::agreement(pairs);
  Series scatter{.width = 0.0, .marker = Marker::circle};
  Series difference = scatter;
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
  const Series same{
      .label = "the same", .x = {low, high}, .y = {low, high}, .width = 1.2, .dashed = true};
  return {.panels = {{.title = "model against images",
                      .content = LineChart{.x = {"strain of the images"},
                                           .y = {"strain of the model"},
                                           .series = {scatter, same}}},
                     {.title = "Bland and Altman", .content = bland_altman(difference, a)}},
          .title = fmt::format("{} strain at end-systole, {} {}", component, a.count,
                               scheme == "sector" ? "sectors of slices" : "AHA segments")};
}

void write_figures(const fs::path& work, const fs::path& folder) {
  fs::create_directories(folder);
  const FigureFolder figures(work, folder);
  figures.curves();
  figures.regions();
  figures.rotation();
  figures.muscle();
  figures.agreement();
}

}  // namespace lv::report
