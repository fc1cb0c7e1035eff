#include "lv/draw/enhancement_json.hpp"

#include "lv/base/json_file.hpp"
#include "lv/draw/said.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace lv::draw {
namespace {

using nlohmann::json;
using scar::ScarMap;
using scar::SliceMap;
using scar::Tissue;

constexpr std::array<std::pair<Tissue, const char*>, 3> tissues{
    {{Tissue::muscle, "muscle"}, {Tissue::remote, "remote"}, {Tissue::scar, "scar"}}};

const char* name_of(Tissue tissue) {
  return std::find_if(tissues.begin(), tissues.end(),
                      [tissue](const auto& named) { return named.first == tissue; })
      ->second;
}

json outline_json(const geometry::Polygon& line) {
  const auto rounded = [](double v) { return std::round(1e3 * v) / 1e3; };
  json all = json::array();
  for (const Eigen::Vector2d& x : line)
    all.push_back({rounded(x.x()), rounded(x.y())});
  return all;
}

json walls_json(const Walls& walls) {
  json all = json::array();
  for (const auto& wall : walls)
    all.push_back(wall ? json{{"endo", outline_json(wall->endo)}, {"epi", outline_json(wall->epi)}}
                       : json());
  return all;
}

json map_json(const ScarMap& map, const image::Cine& image) {
  json slices = json::array();
  for (std::size_t s = 0; s < map.slices.size(); ++s) {
    const SliceMap& slice = map.slices[s];
    json told{{"how", slice.drawn.how}, {"by", slice.drawn.by}, {"when", slice.drawn.when}};
    for (const auto& [tissue, name] : tissues)
      told[name] = json::array();
    for (const scar::Run& run : scar::runs_of(slice.pixels, image.slices[s].frames.front().plane))
      told[name_of(run.tissue)].push_back({run.row, run.first, run.last});
    slices.push_back(std::move(told));
  }
  return {{"threshold", map.threshold}, {"phase", map.phase}, {"slices", std::move(slices)}};
}

double finite(const json& number) {
  const double value = number.get<double>();
  if (!std::isfinite(value))
    throw InputError(what_page, "a number is not finite", reload);
  return value;
}

geometry::Polygon said_outline(const json& line) {
  if (line.size() > most_of_line)
    throw InputError(what_page, "an outline has too many points", reload);
  geometry::Polygon points;
  for (const json& x : line)
    points.emplace_back(finite(x.at(0)), finite(x.at(1)));
  return points;
}

/// As many as the image has slices.
const json& per_slice(const json& all, const image::Cine& image) {
  if (!all.is_array() || all.size() != image.slices.size())
    throw InputError(what_page, "it has other enhanced slices than the image", reload);
  return all;
}

Walls said_walls(const json& said, const image::Cine& image) {
  Walls walls;
  for (const json& wall : per_slice(said, image))
    if (wall.is_null())
      walls.emplace_back();
    else
      walls.push_back(
          scar::WallOutlines{said_outline(wall.at("endo")), said_outline(wall.at("epi"))});
  return walls;
}

/// Does something with the number of each pixel of runs.
template <class Use>
void for_pixels(const json& runs, const image::Plane& plane, const Use& use) {
  for (const json& run : runs) {
    const int row = run.at(0).get<int>();
    const int first = run.at(1).get<int>();
    const int last = run.at(2).get<int>();
    if (row < 0 || row >= plane.rows || first < 0 || first > last || last >= plane.columns)
      throw InputError(what_page, "a pixel lies outside the enhanced image", reload);
    for (int i = first; i <= last; ++i)
      use(plane.index(i, row));
  }
}

SliceMap said_slice(const json& said, const image::Plane& plane) {
  SliceMap slice{
      std::vector<Tissue>(static_cast<std::size_t>(plane.rows) * plane.columns, Tissue::outside),
      said_provenance(said)};
  for (const auto& [tissue, name] : tissues)
    for_pixels(said.at(name), plane, [&, tissue = tissue](std::size_t n) {
      if (slice.pixels[n] != Tissue::outside)
        throw InputError(what_page, "a pixel is there twice", reload);
      slice.pixels[n] = tissue;
    });
  return slice;
}

ScarMap said_map(const json& said, const Study& study) {
  const image::Cine& image = study.enhancement->image;
  ScarMap map;
  map.threshold = finite(said.at("threshold"));
  map.phase = said_number(said, "phase", study.phases());
  const json& slices = per_slice(said.at("slices"), image);
  for (std::size_t s = 0; s < slices.size(); ++s)
    map.slices.push_back(said_slice(slices[s], image.slices[s].frames.front().plane));
  return map;
}

ScarRule said_rule(const json& said) {
  const std::string rule = said.at("rule").get<std::string>();
  if (rule == "remote")
    return ScarRule::remote;
  if (rule == "brightest")
    return ScarRule::brightest;
  if (rule == "level")
    return ScarRule::level;
  throw InputError(what_page, "there is no such threshold", reload);
}

const Enhancement& enhancement_of(const Study& study) {
  if (!study.enhancement)
    throw InputError(what_page, "the case has no late enhancement", reload);
  return *study.enhancement;
}

ScarWish scar_wish(const json& said, const Study& study) {
  const image::Cine& image = enhancement_of(study).image;
  ScarWish wish{said_rule(said),
                finite(said.at("deviations")),
                finite(said.at("level")),
                said_walls(said.at("walls"), image),
                {}};
  const json& remote = per_slice(said.at("remote"), image);
  for (std::size_t s = 0; s < remote.size(); ++s) {
    const image::Picture& picture = image.slices[s].frames.front();
    std::vector<char>& pixels = wish.remote.emplace_back(picture.values.size(), char{0});
    for_pixels(remote[s], picture.plane, [&](std::size_t n) { pixels[n] = 1; });
  }
  return wish;
}

}  // namespace

json enhancement_json(const Study& study) {
  if (!study.enhancement)
    return {};
  const Enhancement& e = *study.enhancement;
  const mesh::LateEnhancement& lge = study.settings.scar.lge;
  return {{"slices", planes_json(e.image)},
          {"low", e.greys.low},
          {"high", e.greys.high},
          {"rule", lge.threshold == mesh::ScarThreshold::sd ? "remote" : "brightest"},
          {"deviations", lge.deviations},
          {"walls", walls_json(e.scar.walls)},
          {"proposed", map_json(e.scar.proposed, e.image)},
          {"drawn", map_json(e.scar.drawn, e.image)},
          {"saved", e.saved},
          {"note", e.note}};
}

std::vector<geometry::Contour> read_wall_lines(const std::string& text, const Study& study) {
  return from_text(text, [&](const json& said) {
    std::vector<geometry::Contour> lines;
    for (const json& line : said.at("contours"))
      lines.push_back(said_line(line, study));
    return lines;
  });
}

std::string walls_text(const Walls& walls) {
  return json{{"walls", walls_json(walls)}}.dump();
}

ScarWish read_scar_wish(const std::string& text, const Study& study) {
  return from_text(text, [&](const json& said) { return scar_wish(said, study); });
}

std::string scar_map_text(const ScarMap& map, const image::Cine& image) {
  return map_json(map, image).dump();
}

ScarDrawing said_scar(const json& object, const Study& study) {
  static_cast<void>(enhancement_of(study));
  return {said_walls(object.at("walls"), study.enhancement->image),
          said_map(object.at("proposed"), study), said_map(object.at("drawn"), study)};
}

}  // namespace lv::draw
