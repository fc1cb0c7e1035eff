#include "lv/anatomy/proposals.hpp"

#include "lv/anatomy/long_axis_cine.hpp"
#include "lv/base/check.hpp"
#include "lv/base/ending.hpp"
#include "lv/image/label_meaning.hpp"
#include "lv/image/lookup.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

namespace lv::anatomy {
namespace {

using case_file::CaseLine;
namespace fs = std::filesystem;

/// What the file calls these labels; and before a remark on them.
std::string names_in(const image::Volume& map, const std::vector<int>& labels) {
  std::string text;
  for (const int label : labels)
    if (const auto name = map.names.find(label); name != map.names.end())
      text += fmt::format("{}\"{}\"", text.empty() ? "" : ", ", name->second);
  return text;
}

std::string named(const image::Volume& map, const std::vector<int>& labels) {
  const std::string text = names_in(map, labels);
  return text.empty() ? "" : text + ": ";
}

std::string value_of(const std::vector<int>& labels) {
  return labels.empty() ? case_file::fill_in : case_file::listed(labels);
}

/// Names that may stand for the series of a study, one or several stacks each.
std::vector<std::string> series_names(const image::DicomStudy& study) {
  std::vector<std::string> names;
  std::set<std::string> descriptions;
  for (const image::DicomStack& stack : study.stacks) {
    names.push_back(stack.key);
    if (!stack.description.empty())
      descriptions.insert(stack.description);
  }
  names.insert(names.end(), descriptions.begin(), descriptions.end());
  return names;
}

/// Whether a name in the file says scar or its core.
bool says_scar(const std::string& name) {
  constexpr std::array says{"scar", "infarct", "fibros", "necro", "reflow", "mvo"};
  const std::string small = lower_case(name);
  return std::any_of(says.begin(), says.end(),
                     [&](const char* part) { return small.find(part) != std::string::npos; });
}

constexpr std::size_t least_images = 5;  // of a cine

/// The first word of what kind of image a stack holds: magnitude, phase and the like.
std::string first_word_of_kind(const image::DicomStack& stack) {
  return stack.kind.substr(0, stack.kind.find('\\'));
}

/// Whether a stack's key names it alone: that of the first of a series names the whole series.
bool is_named_alone(const image::DicomStudy& study, const image::DicomStack& stack) {
  return std::count_if(study.stacks.begin(), study.stacks.end(), [&](const auto& other) {
           return image::is_chosen(study, other, stack.key);
         }) == 1;
}

/// Whether a plane runs through the middle of a short-axis stack, across its slices.
bool runs_along(const image::DicomStack& view, const image::DicomStack& short_axis) {
  constexpr double most_cosine = 0.5;  // 60 degrees between the planes
  constexpr double farthest = 30.0;    // from the middle, across the slices [mm]
  const image::Plane& plane = view.slices.front().images.front().plane;
  const auto beside = [&](const image::DicomSlice& slice) {
    return std::abs(plane.pixel(slice.images.front().plane.middle()).z()) > farthest;
  };
  return std::abs(plane.normal().dot(short_axis.normal)) < most_cosine &&
         !beside(short_axis.slices.front()) && !beside(short_axis.slices.back());
}

}  // namespace

LikelyScar likely_scar(const image::Volume& map, const std::vector<int>& muscle) {
  LikelyScar likely;
  for (const int label : muscle)
    if (const auto name = map.names.find(label); name != map.names.end() && says_scar(name->second))
      likely.labels.push_back(label);
  likely.by_name = !likely.labels.empty();
  if (likely.by_name || muscle.size() < 2)
    return likely;
  const std::vector<int> seen = image::propose_meaning(map).muscle;
  for (std::size_t i = 1; i < seen.size(); ++i)
    if (image::is_one_of(seen[i], muscle))
      likely.labels.push_back(seen[i]);
  return likely;
}

std::vector<CaseLine> scar_lines(const image::Volume& map, const std::string& name,
                                 const std::vector<int>& muscle, int frame) {
  const LikelyScar likely = likely_scar(map, muscle);
  if (likely.labels.empty())
    return {};
  const bool active = likely.by_name;
  std::vector<CaseLine> lines{
      {"infarct.source", case_file::quoted("labels"), "", active},
      {"infarct.labels.file", case_file::quoted(name), "", active},
      {"infarct.labels.scar", case_file::listed(likely.labels),
       active ? named(map, likely.labels) + "check it"
              : "may be scar: it lies within the wall. Without these lines it is healthy muscle",
       active}};
  const std::vector<int> frames = image::frames_with(map, likely.labels);
  if (frames.size() > 1)
    lines.push_back({"infarct.labels.frame",
                     std::to_string(image::is_one_of(frame, frames) ? frame : frames.front()),
                     "a person has one scar", active});
  return lines;
}

std::string unsaid_scar(const case_file::Case& c, const image::Volume& map) {
  if (c.scar.source != mesh::InfarctSource::mesh)
    return "";
  const LikelyScar likely = likely_scar(map, c.anatomy.labels.muscle);
  if (likely.labels.empty())
    return "";
  return fmt::format(
      "{} of anatomy.labels.muscle {}, and the case has no infarct: it is taken as healthy muscle. "
      "If it is scar, say so with source = \"labels\" under [infarct], and file = {} and scar = {} "
      "under [infarct.labels]; infarct.source = \"none\" says that none is meant",
      case_file::listed(likely.labels),
      likely.by_name ? "is called scar in the map (" + names_in(map, likely.labels) + ")"
                     : "lies within the other muscle, as a scar does",
      case_file::quoted(c.anatomy.labels.file), case_file::listed(likely.labels));
}

std::vector<CaseLine> label_lines(const image::Volume& map, const case_file::LabelAnatomy& said) {
  const bool unsaid = said.cavity.empty() || said.muscle.empty() || said.right_ventricle.empty();
  const image::LabelMeaning seen = unsaid ? image::propose_meaning(map) : image::LabelMeaning{};
  std::vector<CaseLine> lines;
  if (said.cavity.empty())
    lines.push_back({"anatomy.labels.cavity", value_of(seen.cavity),
                     seen.cavity.empty()
                         ? "which labels mean the left ventricle's blood"
                         : named(map, seen.cavity) +
                               "seems the left ventricle's blood: it lies inside the "
                               "muscle; check it"});
  if (said.muscle.empty())
    lines.push_back({"anatomy.labels.muscle", value_of(seen.muscle),
                     seen.muscle.empty()
                         ? "which labels mean the left ventricle's muscle"
                         : named(map, seen.muscle) + "seems its muscle: it lies round the cavity"});
  if (said.right_ventricle.empty() && !seen.right_ventricle.empty())
    lines.push_back({"anatomy.labels.right_ventricle", value_of(seen.right_ventricle),
                     named(map, seen.right_ventricle) +
                         "seems the right ventricle, which shows where the septum is"});
  if (map.frames > 1 && said.frame == 0) {
    const auto& cavity = said.cavity.empty() ? seen.cavity : said.cavity;
    lines.push_back(choice("anatomy.labels.frame", moments_of(map, cavity)));
  }
  return lines;
}

std::vector<CaseLine> contour_file_lines(const image::ForeignContours& drawn,
                                         const case_file::ContourFileAnatomy& said) {
  std::vector<CaseLine> lines;
  const auto name_line = [&](const char* parameter, const std::string& fixed,
                             const std::string& chosen, const char* part) {
    if (!fixed.empty() || !chosen.empty())
      return;
    std::string value = case_file::fill_in;
    for (const auto& [name, count] : image::structures(drawn))
      if (value == case_file::fill_in && lower_case(name).find(part) != std::string::npos)
        value = case_file::quoted(name);
    lines.push_back({parameter, value,
                     value == case_file::fill_in ? "the name of its contours in the file"
                                                 : "seems so by its name; check it"});
  };
  name_line("anatomy.contour_file.endo", drawn.endo, said.endo, "endo");
  name_line("anatomy.contour_file.epi", drawn.epi, said.epi, "epi");
  if (drawn.in_pixels && said.images.empty())
    lines.push_back(
        {"anatomy.contour_file.images", case_file::fill_in,
         "the folder of the DICOM images they were drawn on: the file has pixels alone"});
  return lines;
}

SunnybrookChoice sunnybrook_choice(const fs::path& contours, const image::DicomStudy& study,
                                   const case_file::SunnybrookAnatomy& said) {
  const bool open = said.series.empty() && study.stacks.size() > 1;
  std::vector<std::vector<std::string>> candidates{said.series};
  if (open) {
    candidates.clear();
    for (const std::string& name : series_names(study))
      candidates.push_back({name});
  }
  SunnybrookChoice choice_made;
  for (const std::vector<std::string>& series : candidates) {
    try {
      choice_made.stack =
          image::choose_stack(study, series, study.where, "anatomy.sunnybrook.series");
      choice_made.read =
          image::read_sunnybrook(contours, choice_made.stack, said.pixel_origin, said.drawn_by);
    } catch (const InputError&) {
      if (!open)
        throw;
      continue;
    }
    if (open)
      choice_made.lines.push_back({"anatomy.sunnybrook.series",
                                   fmt::format("[{}]", case_file::quoted(series.front())),
                                   "its images are those that the contours name"});
    break;
  }
  if (choice_made.read.phases.empty())
    choice_made.lines.push_back({"anatomy.sunnybrook.series", case_file::fill_in,
                                 "the series that the contours were drawn on"});
  if (said.phase == 0)
    choice_made.lines.push_back(
        choice("anatomy.sunnybrook.phase", moments_of(choice_made.read.phases)));
  return choice_made;
}

const image::DicomStack* short_axis_cine(const image::DicomStudy& study) {
  constexpr std::size_t least_slices = 3;
  const image::DicomStack* best = nullptr;
  const auto images = [](const image::DicomStack& s) {
    return s.slices.size() * s.slices.front().images.size();
  };
  for (const image::DicomStack& stack : study.stacks)
    if (stack.slices.size() >= least_slices && stack.slices.front().images.size() >= least_images &&
        (best == nullptr || images(stack) > images(*best)))
      best = &stack;
  return best;
}

CaseLine short_axis_line(const std::string& parameter, const image::DicomStudy& study) {
  const image::DicomStack* cine = short_axis_cine(study);
  if (cine == nullptr)
    return {parameter, case_file::fill_in, "the short-axis cine"};
  return {parameter, case_file::quoted(cine->key), "seems the short-axis cine"};
}

std::vector<const image::DicomStack*> long_axis_cines(const image::DicomStudy& study,
                                                      const image::DicomStack& short_axis) {
  std::vector<const image::DicomStack*> found;
  for (const image::DicomStack& stack : study.stacks)
    if (found.size() < most_long_axes && stack.slices.size() == 1 &&
        stack.slices.front().images.size() >= least_images &&
        first_word_of_kind(stack) == first_word_of_kind(short_axis) &&
        runs_along(stack, short_axis) && is_named_alone(study, stack))
      found.push_back(&stack);
  return found;
}

std::vector<CaseLine> long_axis_lines(const std::string& parameter, const image::DicomStudy& study,
                                      const image::DicomStack& short_axis) {
  std::string keys;
  for (const image::DicomStack* stack : long_axis_cines(study, short_axis))
    keys += (keys.empty() ? "" : ", ") + case_file::quoted(stack->key);
  if (keys.empty())
    return {};
  return {{parameter, fmt::format("[{}]", keys),
           "seem long-axis cines, on which base and tip are looked for"}};
}

}  // namespace lv::anatomy
