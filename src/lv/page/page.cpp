#include "lv/page/page.hpp"

#include "lv/analysis/quantities.hpp"
#include "lv/base/check.hpp"
#include "lv/base/json_file.hpp"
#include "lv/base/table.hpp"
#include "lv/base/units.hpp"
#include "lv/drawing/bulls_eye.hpp"
#include "lv/heartbeat/beat.hpp"
#include "lv/page/bundle.hpp"
#include "lv/page/flow_series.hpp"
#include "lv/page/modes.hpp"
#include "lv/page/opening.hpp"
#include "lv/page/packing.hpp"
#include "lv/page/page_pictures.hpp"
#include "lv/page/place.hpp"
#include "lv/page/views.hpp"
#include "lv/page/wall_series.hpp"
#include "lv/report/cycle_tables.hpp"
#include "lv/report/stage_facts.hpp"
#include "lv/report/work_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace lv::page {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// how exactly the page repeats the fields on disk
constexpr double position_tolerance = 0.1;   // [mm]
constexpr double quantity_tolerance = 0.01;  // of the range of a quantity
constexpr double velocity_step = 0.5;        // [mm/s]
constexpr double pressure_step = 0.002;      // [kPa]

/// A number rounded to seven digits.
double rounded(double value) {
  return std::stod(fmt::format("{:.7g}", value));
}

Json rounded(const std::vector<double>& values) {
  Json list = Json::array();
  for (const double value : values)
    list.push_back(rounded(value));
  return list;
}

/// Text that is safe inside a script element.
std::string element(const std::string& id, const char* type, std::string text) {
  for (std::size_t at = text.find('<'); at != std::string::npos; at = text.find('<', at))
    text.replace(at, 1, "\\u003c");  // stands inside strings of JSON alone
  return fmt::format("<script type=\"{}\" id=\"{}\">{}</script>\n", type, id, text);
}

/// Elements of the page: for the summary, for the first picture of the wall, and for the rest.
struct Data {
  std::string summary, wall, more;
};

/// Collects a case's arrays as elements of the page; in the JSON they are named by their ids.
class PagedArrays {
 public:
  explicit PagedArrays(int number) : prefix_(fmt::format("case{}", number)) {}

  template <class Number>
  std::string add(const std::vector<Number>& values) {
    std::string id = fmt::format("{}-{}", prefix_, count_++);
    (is_first ? data.wall : data.more) += element(id, "text/plain", packed(values));
    return id;
  }

  Data data;
  bool is_first = true;  ///< whether the first picture of the wall needs what is added

 private:
  std::string prefix_;
  int count_ = 0;
};

std::int16_t steps(double value, double step) {
  return static_cast<std::int16_t>(std::lround(std::clamp(value / step, -32767.0, 32767.0)));
}

Json modes_json(const Modes& m, PagedArrays& arrays) {
  Json json{{"offset", m.offset}, {"step", m.step}, {"largest_error", rounded(m.largest_error)}};
  json["courses"] = Json::array();
  json["shapes"] = Json::array();
  for (const auto& course : m.courses)
    json["courses"].push_back(rounded(course));
  for (const auto& shape : m.shapes)
    json["shapes"].push_back(arrays.add(shape));
  return json;
}

struct Range {
  double min = std::numeric_limits<double>::infinity();
  double max = -min;
};

Range range_of(const NodalSeries& series) {
  Range range;
  for (const auto& frame : series)
    for (const float value : frame)
      if (std::isfinite(value))
        range = {std::min<double>(range.min, value), std::max<double>(range.max, value)};
  return range;
}

std::vector<std::int16_t> flattened(const std::vector<Vec3>& vectors, double step) {
  std::vector<std::int16_t> numbers;
  for (int d = 0; d < 3; ++d)  // by component: neighbours then differ little
    for (const Vec3& v : vectors)
      numbers.push_back(steps(v[d], step));
  return numbers;
}

std::vector<std::int16_t> narrow(const std::vector<int>& values) {
  return {values.begin(), values.end()};
}

/// Displacements by component too.
NodalSeries by_component(const NodalSeries& displacement) {
  NodalSeries sorted;
  for (const auto& frame : displacement) {
    auto& to = sorted.emplace_back();
    for (std::size_t d = 0; d < 3; ++d)
      for (std::size_t i = d; i < frame.size(); i += 3)
        to.push_back(frame[i]);
  }
  return sorted;
}

Json reach_json(const Reach& reach) {
  return {{"radius", rounded(reach.radius)},
          {"bottom", rounded(reach.bottom)},
          {"top", rounded(reach.top)}};
}

Json wall_json(const WallSeries& wall, PagedArrays& arrays) {
  constexpr double node_step = 0.01;       // [mm]
  constexpr double direction_step = 0.01;  // of unit vectors
  constexpr double infarct_step = 1e-4;
  Json json{{"nodes_per_cell", mesh::nodes_per_cell(wall.kind)},
            {"nodes", wall.undeformed.size()},
            {"times", rounded(wall.times)},
            {"reach", reach_json(wall.reach)}};
  json["cells"] = arrays.add(std::vector<std::int32_t>(wall.cells.begin(), wall.cells.end()));
  json["skin"] = arrays.add(wall.skin.nodes);
  json["skin_cells"] = arrays.add(wall.skin.cells);
  json["undeformed"] = {{"step", node_step},
                        {"values", arrays.add(flattened(wall.undeformed, node_step))}};
  if (std::any_of(wall.infarct.begin(), wall.infarct.end(), [](float M) { return M > 0.0F; })) {
    std::vector<std::int16_t> M;
    for (const float value : wall.infarct)
      M.push_back(steps(value, infarct_step));
    json["infarct"] = {{"step", infarct_step}, {"values", arrays.add(M)}};
  }
  for (const auto& [name, regions] :
       {std::pair{"slice", &wall.slice}, {"sector", &wall.sector}, {"aha17", &wall.aha17}})
    if (!regions->empty())
      json[name] = arrays.add(narrow(*regions));
  json["displacement"] =
      modes_json(modes(by_component(wall.displacement), position_tolerance), arrays);
  json["quantities"] = Json::object();
  for (const auto& [name, series] : wall.quantities) {
    const Range range = range_of(series);
    if (series.size() != wall.times.size() || !(range.max > range.min))
      continue;
    arrays.is_first = name == opening_quantity;
    json["quantities"][name] =
        modes_json(modes(series, quantity_tolerance * (range.max - range.min)), arrays);
    json["quantities"][name]["min"] = rounded(range.min);
    json["quantities"][name]["max"] = rounded(range.max);
  }
  arrays.is_first = false;
  if (!wall.f0.empty())
    json["f0"] = {{"step", direction_step},
                  {"values", arrays.add(flattened(wall.f0, direction_step))}};
  return json;
}

/// One array per time and component.
Json frames_json(const std::vector<std::vector<float>>& frames, std::size_t components, double step,
                 PagedArrays& arrays) {
  Json json = Json::array();
  for (const auto& frame : frames) {
    std::vector<std::int16_t> numbers;
    for (std::size_t d = 0; d < components; ++d)
      for (std::size_t i = d; i < frame.size(); i += components)
        numbers.push_back(steps(frame[i], step));
    json.push_back(arrays.add(numbers));
  }
  return json;
}

Json flow_json(const FlowSeries& flow, const LongAxis& plane, PagedArrays& arrays) {
  return {
      {"plane_deg", rounded(plane.angle / units::degree)},
      {"cells", flow.cells},
      {"lower", flow.lower},
      {"spacing", flow.spacing},
      {"times", rounded(flow.times)},
      {"velocity",
       {{"step", velocity_step}, {"frames", frames_json(flow.velocity, 3, velocity_step, arrays)}}},
      {"pressure",
       {{"step", pressure_step},
        {"frames", frames_json(flow.pressure, 1, pressure_step, arrays)}}}};
}

/// The rectangle in a long-axis plane that the wall ever touches, with room for the jet at the
/// base.
std::array<std::array<double, 2>, 2> surroundings(const WallSeries& wall, const LongAxis& plane) {
  constexpr double margin = 6.0;  // [mm]
  constexpr double above = 35.0;  // [mm]
  std::array<double, 2> lower{1e9, 1e9};
  std::array<double, 2> upper{-1e9, -1e9};
  for (std::size_t frame = 0; frame < wall.times.size(); ++frame)
    for (const Vec3& x : wall.positions(frame)) {
      const std::array<double, 2> at{plane.along(x.x(), x.y()), x.z()};
      for (const std::size_t i : {0U, 1U}) {
        lower.at(i) = std::min(lower.at(i), at.at(i));
        upper.at(i) = std::max(upper.at(i), at.at(i));
      }
    }
  return {{{lower[0] - margin, lower[1] - margin}, {upper[0] + margin, upper[1] + above}}};
}

/// A file of a stage, and its name on the page.
struct PageFile {
  const char* stage;
  const char* file;
  const char* name;
};

constexpr std::array<PageFile, 23> page_files{{
    {"results", "summary.json", "summary.json"},
    {"results", "regions.csv", "regions.csv"},
    {"results", "segments_over_time.csv", "segments_over_time.csv"},
    {"results", "rotation.csv", "rotation.csv"},
    {"results", "infarct.csv", "infarct.csv"},
    {"results", "stress_stretch.csv", "stress_stretch.csv"},
    {"results", "strain_comparison_circumferential.csv", "strain_comparison_circumferential.csv"},
    {"results", "strain_comparison_radial.csv", "strain_comparison_radial.csv"},
    {"results", "strain_agreement.json", "strain_agreement.json"},
    {"results", "outline_distances.csv", "outline_distances.csv"},
    {"beat", "curves.csv", "curves.csv"},
    {"beat", "moments.csv", "moments.csv"},
    {"beat", "cycle.csv", "cycle.csv"},
    {"beat", "beats.csv", "beats.csv"},
    {"beat", "confirmation.json", "confirmation.json"},
    {"calibrate", "calibration.json", "calibration.json"},
    {"calibrate", "heartbeats.json", "heartbeats.json"},
    {"mesh", "quality.csv", "quality.csv"},
    {"anatomy", "quality.csv", "anatomy_quality.csv"},
    {"anatomy", "fit.csv", "fit.csv"},
    {"anatomy", "frame.json", "frame.json"},
    {"strain", "slices.csv", "strain_slices.csv"},
    {"strain", "rotation.csv", "strain_rotation.csv"},
}};

/// A file's text. Throws RunError for JSON that is none: the page could not be drawn.
std::string text_of(const fs::path& file) {
  std::string text = read_file(file);
  if (file.extension() == ".json" && !Json::accept(text))
    throw RunError(fmt::format("{} is damaged: it is no JSON", file.string()),
                   "Remove the stage's folder and run the case again");
  return text;
}

/// The tables and the summary, as they are on disk.
Json files_json(const fs::path& work) {
  Json json = Json::object();
  for (const auto& [stage, file, name] : page_files)
    if (const fs::path path = report::file_of(work, stage, file); !path.empty())
      json[name] = text_of(path);
  return json;
}

/// What the mesh was made with: where the septum is, and the engine.
void add_mesh_facts(Json& json, const report::MeshFacts& mesh, const fs::path& work) {
  json["septum_deg"] = mesh.septum_angle / units::degree;
  // equilibria have shares of loads where heartbeats have times
  if (!report::beat_facts(work).value_or(report::BeatFacts{}).has_valves)
    json["engine"] = mesh.is_immersed ? "immersed" : "quasi_static";
}

/// What the page says of a case's state.
std::vector<std::string> state_of(const PageCase& shown) {
  std::vector<std::string> state = shown.state;
  if (!report::file_of(shown.work, "beat", "wall.pvd").empty() &&
      report::file_of(shown.work, "beat", "moments.csv").empty())
    state.emplace_back(
        "03_beat has no moments.csv: strains are from early diastole at all times, and no moment "
        "has a name.");
  for (std::string& sentence : report::missing_facts(shown.work))
    state.push_back(std::move(sentence));
  return state;
}

/// Frames of the beat; without any, the undeformed mesh.
std::vector<TimedFrame> wall_frames(const fs::path& work) {
  std::vector<TimedFrame> frames = frames_of(report::file_of(work, "beat", "wall.pvd"));
  const fs::path undeformed = report::file_of(work, "mesh", "mesh.vtu");
  if (frames.empty() && !undeformed.empty())
    frames.push_back({0.0, undeformed});
  return frames;
}

/// A case's wall at all its moments; nothing without frames.
std::optional<WallSeries> wall_of(const fs::path& work) {
  const std::vector<TimedFrame> frames = wall_frames(work);
  if (frames.empty())
    return {};
  return read_wall_series(frames, report::time_of(work, heartbeat::end_diastole)
                                      .value_or(std::numeric_limits<double>::infinity()));
}

using Walls = std::vector<std::optional<WallSeries>>;

/// Where a case's wall stands in time.
Course course_of(const fs::path& work, const std::optional<WallSeries>& wall) {
  return {.times = wall ? wall->times : std::vector<double>{},
          .end_systole = report::time_of(work, heartbeat::end_systole),
          .has_beats = !report::file_of(work, "beat", "cycle.csv").empty()};
}

/// What the page opens with: one scale and one view for all cases, and a frame of each.
struct OpeningPlan {
  std::optional<drawing::ColourScale> scale;
  std::vector<std::optional<std::size_t>> frames;
  std::size_t view = 0;  ///< of `views`
};

/// `walls` of the cases in `works`.
OpeningPlan opening_plan(const std::vector<fs::path>& works, const Walls& walls) {
  std::vector<Course> courses;
  for (std::size_t i = 0; i < works.size(); ++i)
    courses.push_back(course_of(works[i], walls[i]));
  OpeningPlan plan{.scale = opening_scale(works), .frames = opening_frames(courses)};
  std::vector<double> shown(views.size(), 0.0);
  for (std::size_t i = 0; i < works.size(); ++i) {
    if (!walls[i])
      continue;
    const auto mesh = report::mesh_facts(works[i]).value_or(report::MeshFacts{});
    const std::vector<double> one =
        infarct_shown(*walls[i], plan.frames[i].value(), {.septum_angle = mesh.septum_angle});
    std::transform(one.begin(), one.end(), shown.begin(), shown.begin(), std::plus<>());
  }
  plan.view = opening_view(shown);
  return plan;
}

/// Nothing where results or the quantity are missing.
Json opening_json(const WallSeries& wall, const report::MeshFacts& mesh, const OpeningPlan& plan,
                  std::size_t frame) {
  const auto found = wall.quantities.find(opening_quantity);
  if (!plan.scale || found == wall.quantities.end() || found->second.size() != wall.times.size())
    return {};
  const Opening drawn = opening(wall, mesh.order, frame, views.at(plan.view),
                                {.septum_angle = mesh.septum_angle}, *plan.scale);
  return {{"png", base64(drawn.png)}, {"width_mm", rounded(drawn.width_mm)}, {"frame", frame}};
}

/// A page is passed on, and the name of a folder may be that of a patient.
Data case_html(const PageCase& shown, const std::optional<WallSeries>& wall, int number,
               const OpeningPlan& plan) {
  static constexpr std::array<const char*, 2> folders{"the first work folder",
                                                      "the second work folder"};
  PagedArrays arrays(number);
  Json json{{"folder", plan.frames.size() < 2 ? "the work folder" : folders.at(number)},
            {"complete", shown.complete},
            {"state", state_of(shown)},
            {"files", files_json(shown.work)}};
  if (const std::string name = report::case_name(shown.work); !name.empty())
    json["name"] = name;
  const auto known_mesh = report::mesh_facts(shown.work);
  if (known_mesh)
    add_mesh_facts(json, *known_mesh, shown.work);
  const auto blood = frames_of(report::file_of(shown.work, "beat", "blood.pvd"));
  json["has_blood"] = !blood.empty();
  if (wall) {
    json["wall"] = wall_json(*wall, arrays);
    const auto mesh = known_mesh.value_or(report::MeshFacts{});
    json["wall"]["order"] = mesh.order;
    if (Json first = opening_json(*wall, mesh, plan, plan.frames[number].value()); !first.is_null())
      json["wall"]["opening"] = std::move(first);
    const LongAxis plane{mesh.septum_angle};  // the four-chamber view's
    const auto [lower, upper] = surroundings(*wall, plane);
    // the wall's frames are the blood's borders; the undeformed mesh is none
    if (!blood.empty() && !report::file_of(shown.work, "beat", "wall.pvd").empty())
      json["flow"] = flow_json(read_flow_series(blood, plane, lower, upper), plane, arrays);
  }
  if (const std::string pictures = pictures_json(shown.work); !pictures.empty()) {
    json["pictures"] = fmt::format("case{}-pictures", number);
    arrays.data.more += element(json["pictures"], "application/json", pictures);
  }
  arrays.data.summary =
      element(fmt::format("case{}", number), "application/json", json_text(std::move(json), -1));
  return arrays.data;
}

Json quantity_json(const analysis::Quantity& q) {
  return {{"name", q.name},     {"title", q.title}, {"unit", q.unit}, {"signed", q.is_signed},
          {"middle", q.middle}, {"floor", q.floor}, {"help", q.help}};
}

/// The quantities that the page shows, in its words.
Json quantities_json() {
  Json list = Json::array();
  for (const analysis::Quantity& q : analysis::quantities())
    if (q.is_shown)
      list.push_back(quantity_json(q));
  return list;
}

/// The moments that beats may come to, in its words.
Json moments_json() {
  Json list = Json::array();
  for (const heartbeat::MomentWords& w : heartbeat::moment_words)
    list.push_back(
        {{"name", w.moment}, {"title", w.title}, {"mark", w.mark}, {"volume", w.volume}});
  return list;
}

/// The views of the wall.
Json views_json() {
  Json list = Json::array();
  for (const NamedView& view : views) {
    Json json{{"name", view.name}, {"azimuth", view.azimuth}, {"elevation", view.elevation}};
    if (view.opened == Opened::nothing)
      json["cut"] = {{"kind", "none"}};
    else if (view.opened == Opened::short_axis)
      json["cut"] = {{"kind", "short"}};
    else
      json["cut"] = {{"kind", "long"}, {"angle", view.plane}};
    list.push_back(std::move(json));
  }
  return list;
}

/// What the arteries of the 17 segments are called, feed, and where their names stand [deg].
Json territories_json() {
  Json list = Json::array();
  for (const drawing::Territory& t : drawing::coronary_territories())
    list.push_back(
        {{"name", t.name}, {"segments", t.sectors}, {"angle", rounded(t.angle / units::degree)}});
  return list;
}

/// What beats.csv holds, in its words.
Json beat_measures_json() {
  Json list = Json::array();
  for (const report::BeatMeasure& m : report::beat_measures())
    list.push_back({{"name", m.column},
                    {"title", m.words},
                    {"unit", m.unit.empty() ? "1" : m.unit},
                    {"help", m.meaning}});
  return list;
}

}  // namespace

std::string unlike_moments(const std::vector<PageCase>& cases) {
  std::size_t beats = 0, heartbeats = 0;
  for (const PageCase& shown : cases) {
    beats += report::file_of(shown.work, "beat", "moments.csv").empty() ? 0 : 1;
    heartbeats += report::file_of(shown.work, "beat", "cycle.csv").empty() ? 0 : 1;
  }
  if (beats < 2 || heartbeats == 0 || heartbeats == beats)
    return "";
  return "The moments are not defined alike: one case has heartbeats, whose end-diastole and "
         "end-systole are where the mitral and the aortic valve close, and the other the paper's "
         "protocol, whose are steady states under given pressures. Differences of volumes, "
         "strains and stresses between them are those of the protocols too.";
}

std::string page(const std::vector<PageCase>& cases, const std::string& version) {
  const std::string title = "<title>ventricle</title>";
  std::string html(page_bundle());
  const auto put = [&](std::string_view mark, const std::string& data) {
    const std::size_t at = html.find(mark);
    LV_CHECK(at != std::string::npos);
    html.replace(at, mark.size(), data);
  };
  std::vector<fs::path> works;
  Walls walls;
  for (const PageCase& shown : cases) {
    works.push_back(shown.work);
    walls.push_back(wall_of(shown.work));
  }
  const OpeningPlan plan = opening_plan(works, walls);
  Data data{element("about", "application/json",
                    Json{{"version", version},
                         {"cases", cases.size()},
                         {"unlike_moments", unlike_moments(cases)},
                         {"quantities", quantities_json()},
                         {"moments", moments_json()},
                         {"territories", territories_json()},
                         {"views", views_json()},
                         {"opening_view", plan.view},
                         {"infarct", quantity_json(analysis::infarct_extent())},
                         {"beat_measures", beat_measures_json()}}
                        .dump()),
            "", ""};
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const Data one = case_html(cases[i], walls[i], static_cast<int>(i), plan);
    walls[i].reset();
    data.summary += one.summary;
    data.wall += one.wall;
    data.more += one.more;
  }
  put(title, title + ("\n" + runs_element(works)));
  put("<!-- more data -->", data.more);
  put("<!-- wall data -->", data.wall);
  put("<!-- data -->", data.summary);
  return html;
}

}  // namespace lv::page
