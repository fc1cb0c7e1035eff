#include "lv/draw/study_json.hpp"

#include "lv/base/check.hpp"
#include "lv/base/json_file.hpp"
#include "lv/draw/enhancement_json.hpp"
#include "lv/draw/said.hpp"

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

/// Beats do not last alike on all slices: times of the middle one.
json times_json(const image::Cine& cine) {
  return cine.slices[cine.slices.size() / 2].times;
}

json long_axis_json(const Study& study) {
  json all = json::array();
  for (const LongAxisImage& view : study.long_axis) {
    all.push_back(plane_json(view.cine));
    all.back()["phases"] = view.cine.frames.size();
  }
  return all;
}

Redrawn wish_of(const json& said, const Study& study) {
  constexpr std::size_t most_points = 100;
  const int slice = said_number(said, "slice", study.cine.slices.size());
  const auto line = [&](const char* name) {
    return said.at(name).empty()
               ? std::vector<Vec3>()
               : said_points(said.at(name), slice, study, fewest_of_line, most_of_line);
  };
  return {static_cast<std::size_t>(slice - 1),
          {.side = said_side(said),
           .frame = static_cast<std::size_t>(said_number(said, "phase", study.phases()) - 1),
           .points = said_points(said.at("points"), slice, study, 1, most_points),
           .endo = line("endo"),
           .epi = line("epi")}};
}

Landmark landmark_of(const json& said, const Study& study) {
  Landmark mark{said.at("name").get<std::string>(), said_number(said, "slice", study.pictures()),
                said_point(said.at("at")), said_word(said, "by"), said_word(said, "when")};
  const auto& names = geometry::landmark_names;
  if (std::find(names.begin(), names.end(), mark.name) == names.end())
    throw InputError(what_page, "a landmark has an unknown name", reload);
  check_on_slice(mark.at, mark.slice, study);
  return mark;
}

Kept kept_of(const json& said, const Study& study) {
  Kept kept;
  kept.revision = said.at("revision").get<int>();
  kept.drawing.lines.resize(study.phases());
  std::set<std::tuple<int, int, Side>> there;
  for (const json& line : said.at("contours")) {
    const int phase = said_number(line, "phase", study.phases());
    Contour read = said_line(line, study);
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
    kept.drawing.confidence.push_back({said_number(sure, "slice", study.cine.slices.size()),
                                       said_number(sure, "phase", study.phases()),
                                       sure.at("endo").get<double>(),
                                       sure.at("epi").get<double>()});
  if (said.contains("scar"))
    kept.scar = said_scar(said.at("scar"), study);
  return kept;
}

}  // namespace

std::string study_json(const Study& study) {
  const json all{{"name", printable(study.name)},
                 {"folder", printable(study.folder.filename().string())},
                 {"phases", study.phases()},
                 {"times", times_json(study.cine)},
                 {"spacing", study.spacing},
                 {"slices", planes_json(study.cine)},
                 {"long_axis", long_axis_json(study)},
                 {"doubtful", segment::doubtful},
                 {"contours", lines_json(study.drawing.lines)},
                 {"landmarks", landmarks_json(study.drawing.landmarks)},
                 {"landmark_phase", study.proposal.landmark_frame + 1},
                 {"confidence", confidence_json(study.drawing.confidence)},
                 {"proposal", lines_json(study.proposal.lines)},
                 {"doubts", study.proposal.doubts},
                 {"faults", faults_of(study.drawing.lines)},
                 {"scar", enhancement_json(study)},
                 {"saved", study.saved},
                 {"hindrance", study.hindrance},
                 {"revision", study.revision}};
  return json_text(all, -1);
}

std::string proposal_json(const Proposal& proposal) {
  return json_text(json{{"contours", lines_json(proposal.lines)},
                        {"landmarks", landmarks_json(proposal.landmarks)},
                        {"landmark_phase", proposal.landmark_frame + 1},
                        {"confidence", confidence_json(proposal.confidence)},
                        {"doubts", proposal.doubts}},
                   -1);
}

Kept read_kept(const std::string& text, const Study& study) {
  return from_text(text, [&](const json& said) { return kept_of(said, study); });
}

Vec3 read_centre(const std::string& text) {
  return from_text(text, [](const json& said) { return said_point(said.at("centre")); });
}

Redrawn read_wish(const std::string& text, const Study& study) {
  return from_text(text, [&](const json& said) { return wish_of(said, study); });
}

std::string points_json(const std::vector<Vec3>& points) {
  return json_text(json{{"points", all_numbers(points)}}, -1);
}

std::string picture_bytes(const Study& study, int number) {
  const int of_long_axis = number - static_cast<int>(study.cine.slices.size()) - 1;
  return grey_bytes(study.picture(number),
                    of_long_axis < 0 ? study.greys : study.long_axis.at(of_long_axis).greys);
}

}  // namespace lv::draw
