#include "lv/draw/study_json.hpp"

#include "lv/base/check.hpp"
#include "lv/base/json_file.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

namespace lv::draw {
namespace {

using geometry::Contour;
using geometry::Landmark;
using geometry::Side;
using nlohmann::json;

constexpr const char* what_page = "what the page sent";
constexpr const char* reload = "Reload the page, and draw again what is wrong";

json numbers(const Vec3& x) {
  const auto rounded = [](double v) { return std::round(1e3 * v) / 1e3; };
  return {rounded(x.x()), rounded(x.y()), rounded(x.z())};
}

json all_numbers(const std::vector<Vec3>& points) {
  json all = json::array();
  for (const Vec3& x : points)
    all.push_back(numbers(x));
  return all;
}

json lines_json(const Lines& lines) {
  json all = json::array();
  for (std::size_t t = 0; t < lines.size(); ++t)
    for (const Contour& line : lines[t])
      all.push_back({{"slice", line.slice},
                     {"phase", t + 1},
                     {"side", geometry::name(line.side)},
                     {"points", all_numbers(line.points)},
                     {"how", line.drawn.how},
                     {"by", line.drawn.by},
                     {"when", line.drawn.when}});
  return all;
}

json confidence_json(const std::vector<Confidence>& confidence) {
  json all = json::array();
  for (const Confidence& sure : confidence)
    all.push_back(
        {{"slice", sure.slice}, {"phase", sure.phase}, {"endo", sure.endo}, {"epi", sure.epi}});
  return all;
}

json landmarks_json(const std::vector<Landmark>& landmarks) {
  json all = json::array();
  for (const Landmark& mark : landmarks)
    all.push_back({{"name", mark.name},
                   {"slice", mark.slice},
                   {"at", numbers(mark.at)},
                   {"by", mark.by},
                   {"when", mark.when}});
  return all;
}

json planes_json(const image::Cine& cine) {
  json all = json::array();
  for (const image::CineSlice& slice : cine.slices) {
    const image::Plane& plane = slice.frames.front().plane;
    const auto exact = [](const Vec3& x) { return json{x.x(), x.y(), x.z()}; };
    all.push_back({{"columns", plane.columns},
                   {"rows", plane.rows},
                   {"origin", exact(plane.origin)},
                   {"along_row", exact(plane.along_row)},
                   {"along_column", exact(plane.along_column)},
                   {"spacing", {plane.spacing_i, plane.spacing_j}}});
  }
  return all;
}

/// Beats do not last alike on all slices: times of the middle one.
json times_json(const image::Cine& cine) {
  return cine.slices[cine.slices.size() / 2].times;
}

Vec3 point(const json& x) {
  if (!x.is_array() || x.size() != 3)
    throw InputError(what_page, "a point has not three coordinates", reload);
  const Vec3 p(x[0].get<double>(), x[1].get<double>(), x[2].get<double>());
  if (!p.allFinite())
    throw InputError(what_page, "a coordinate is no number", reload);
  return p;
}

/// A number from 1 to `most`.
int counted(const json& object, const char* name, std::size_t most) {
  const int n = object.at(name).get<int>();
  if (n < 1 || n > static_cast<int>(most))
    throw InputError(what_page, fmt::format("there is no {} {}", name, n), reload);
  return n;
}

/// A word that an observer typed: one line that is short.
std::string word(const json& object, const char* name) {
  constexpr std::size_t longest = 60;
  return printable(object.at(name).get<std::string>()).substr(0, longest);
}

void check_plane(const Vec3& x, int slice, const Study& study) {
  constexpr double farthest = 1.0;  // [mm]
  const image::Plane& plane = study.cine.slices[slice - 1].frames.front().plane;
  const Vec3 pixel = plane.pixel(x);
  if (std::abs(pixel.z()) > farthest || pixel.x() < -plane.columns ||
      pixel.x() > 2 * plane.columns || pixel.y() < -plane.rows || pixel.y() > 2 * plane.rows)
    throw InputError(what_page, fmt::format("a point lies off slice {}", slice), reload);
}

/// So many points of a slice.
std::vector<Vec3> points_of(const json& said, int slice, const Study& study, std::size_t fewest,
                            std::size_t most) {
  if (said.size() < fewest || said.size() > most)
    throw InputError(what_page, fmt::format("a line of slice {} has {} points", slice, said.size()),
                     reload);
  std::vector<Vec3> points;
  for (const json& x : said) {
    points.push_back(point(x));
    check_plane(points.back(), slice, study);
  }
  return points;
}

constexpr std::size_t fewest_of_line = 3;
constexpr std::size_t most_of_line = 2000;

Side side_of(const json& said) {
  const std::string side = said.at("side").get<std::string>();
  if (side != "endo" && side != "epi")
    throw InputError(what_page, "a line is neither endo nor epi", reload);
  return side == "endo" ? Side::endo : Side::epi;
}

Contour line_of(const json& said, const Study& study) {
  Contour line;
  line.slice = counted(said, "slice", study.cine.slices.size());
  line.side = side_of(said);
  const std::string how = said.at("how").get<std::string>();
  if (how != "proposed" && how != "corrected" && how != "drawn")
    throw InputError(what_page, "a line does not say how it was drawn", reload);
  line.drawn = {how, word(said, "by"), word(said, "when")};
  line.points = points_of(said.at("points"), line.slice, study, fewest_of_line, most_of_line);
  return line;
}

Redrawn wish_of(const json& said, const Study& study) {
  constexpr std::size_t most_points = 100;
  const int slice = counted(said, "slice", study.cine.slices.size());
  const auto line = [&](const char* name) {
    return said.at(name).empty()
               ? std::vector<Vec3>()
               : points_of(said.at(name), slice, study, fewest_of_line, most_of_line);
  };
  return {static_cast<std::size_t>(slice - 1),
          {.side = side_of(said),
           .frame = static_cast<std::size_t>(counted(said, "phase", study.phases()) - 1),
           .points = points_of(said.at("points"), slice, study, 1, most_points),
           .endo = line("endo"),
           .epi = line("epi")}};
}

Landmark landmark_of(const json& said, const Study& study) {
  Landmark mark{said.at("name").get<std::string>(),
                counted(said, "slice", study.cine.slices.size()), point(said.at("at")),
                word(said, "by"), word(said, "when")};
  const auto& names = geometry::landmark_names;
  if (std::find(names.begin(), names.end(), mark.name) == names.end())
    throw InputError(what_page, "a landmark has an unknown name", reload);
  check_plane(mark.at, mark.slice, study);
  return mark;
}

Kept kept_of(const json& said, const Study& study) {
  Kept kept;
  kept.revision = said.at("revision").get<int>();
  kept.drawing.lines.resize(study.phases());
  std::set<std::tuple<int, int, Side>> there;
  for (const json& line : said.at("contours")) {
    const int phase = counted(line, "phase", study.phases());
    Contour read = line_of(line, study);
    if (!there.emplace(phase, read.slice, read.side).second)
      throw InputError(what_page, fmt::format("slice {} has a border twice", read.slice), reload);
    kept.drawing.lines[phase - 1].push_back(std::move(read));
  }
  for (std::vector<Contour>& lines : kept.drawing.lines)
    std::sort(lines.begin(), lines.end(), [](const Contour& a, const Contour& b) {
      return std::tuple(a.slice, a.side) < std::tuple(b.slice, b.side);
    });
  for (const json& mark : said.at("landmarks")) {
    Landmark read = landmark_of(mark, study);
    if (geometry::find(kept.drawing.landmarks, read.name) != nullptr)
      throw InputError(what_page, "a landmark is there twice", reload);
    kept.drawing.landmarks.push_back(std::move(read));
  }
  for (const json& sure : said.at("confidence"))
    kept.drawing.confidence.push_back(
        {counted(sure, "slice", study.cine.slices.size()), counted(sure, "phase", study.phases()),
         sure.at("endo").get<double>(), sure.at("epi").get<double>()});
  return kept;
}

template <class Use>
auto from_text(const std::string& text, const Use& use) {
  try {
    return use(json::parse(text));
  } catch (const json::exception&) {
    throw InputError(what_page, "is no drawing", reload);
  }
}

}  // namespace

std::string study_json(const Study& study) {
  const json all{{"name", printable(study.name)},
                 {"folder", printable(study.folder.filename().string())},
                 {"phases", study.phases()},
                 {"times", times_json(study.cine)},
                 {"spacing", study.spacing},
                 {"slices", planes_json(study.cine)},
                 {"doubtful", segment::doubtful},
                 {"contours", lines_json(study.drawing.lines)},
                 {"landmarks", landmarks_json(study.drawing.landmarks)},
                 {"confidence", confidence_json(study.drawing.confidence)},
                 {"proposal", lines_json(study.proposal.lines)},
                 {"doubts", study.proposal.doubts},
                 {"saved", study.saved},
                 {"hindrance", study.hindrance},
                 {"revision", study.revision}};
  return json_text(all, -1);
}

std::string proposal_json(const Proposal& proposal) {
  return json_text(json{{"contours", lines_json(proposal.lines)},
                        {"confidence", confidence_json(proposal.confidence)},
                        {"doubts", proposal.doubts}},
                   -1);
}

Kept read_kept(const std::string& text, const Study& study) {
  return from_text(text, [&](const json& said) { return kept_of(said, study); });
}

Vec3 read_centre(const std::string& text) {
  return from_text(text, [](const json& said) { return point(said.at("centre")); });
}

Redrawn read_wish(const std::string& text, const Study& study) {
  return from_text(text, [&](const json& said) { return wish_of(said, study); });
}

std::string points_json(const std::vector<Vec3>& points) {
  return json_text(json{{"points", all_numbers(points)}}, -1);
}

std::string slice_bytes(const Study& study, std::size_t slice) {
  const auto [low, high] = study.greys;
  std::string bytes;
  for (const image::Picture& frame : study.cine.slices[slice].frames)
    for (const float v : frame.values) {
      const float part = std::isfinite(v) ? (v - low) / (high - low) : 0.0F;
      bytes.push_back(
          static_cast<char>(static_cast<unsigned char>(std::clamp(255.0F * part, 0.0F, 255.0F))));
    }
  return bytes;
}

}  // namespace lv::draw
