#include "lv/image/sunnybrook.hpp"

#include "lv/base/check.hpp"
#include "lv/base/ending.hpp"
#include "lv/base/files.hpp"
#include "lv/base/lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <regex>
#include <string_view>

namespace lv::image {
namespace {

namespace fs = std::filesystem;
using geometry::Contour;
using geometry::Side;

/// What the name of a contour file says.
struct ContourName {
  int instance = 0;
  std::string border;  ///< i, o, p1, p2
  DrawnBy drawn_by = DrawnBy::manual;
};

std::optional<ContourName> parse_name(const std::string& name) {
  static const std::regex form(R"(IM-\d{1,8}-(\d{1,8})-(i|o|p1|p2)contour-(manual|auto)\.txt)",
                               std::regex::icase);
  std::smatch match;
  if (!std::regex_match(name, match, form))
    return std::nullopt;
  return ContourName{std::stoi(match[1]), lower_case(match[2]),
                     lower_case(match[3]) == "manual" ? DrawnBy::manual : DrawnBy::automatic};
}

/// An image of the stack: its slice and phase, both from 1.
struct Place {
  const DicomImage* image;
  int slice, phase;
};

std::multimap<int, Place> images_by_instance(const DicomStack& stack) {
  std::multimap<int, Place> places;
  for (std::size_t s = 0; s < stack.slices.size(); ++s)
    for (std::size_t p = 0; p < stack.slices[s].images.size(); ++p)
      if (const DicomImage& image = stack.slices[s].images[p]; image.instance)
        places.emplace(*image.instance,
                       Place{&image, static_cast<int>(s) + 1, static_cast<int>(p) + 1});
  return places;
}

/// Images that are there but left out, in words to end a sentence: those of an InstanceNumber if
/// there are such, else all of them; empty if there are none.
std::string lost_text(const DicomStack& stack, std::optional<int> instance) {
  std::vector<LeftOut> exact;
  std::vector<LeftOut> all;
  for (const LostImage& image : stack.lost) {
    all.push_back(image.file);
    if (instance && image.instance == instance)
      exact.push_back(image.file);
  }
  const std::vector<std::string> sentences = summary(exact.empty() ? all : exact);
  return sentences.empty() ? "" : fmt::format("; {}", fmt::join(sentences, "; "));
}

Place place_of(const std::multimap<int, Place>& places, int instance, const DicomStack& stack,
               const fs::path& file) {
  const auto [first, last] = places.equal_range(instance);
  if (first == last)
    throw InputError(file.string(),
                     fmt::format("no image of the DICOM series has the InstanceNumber {}{}",
                                 instance, lost_text(stack, instance)),
                     stack.lost.empty() ? "Give the DICOM files that the contours were drawn on"
                                        : "Export the files that are left out again, or give those "
                                          "that the contours were drawn on");
  if (std::next(first) != last)
    throw InputError(file.string(),
                     fmt::format("the InstanceNumber {} is that of {} and of {}", instance,
                                 first->second.image->file.string(),
                                 std::next(first)->second.image->file.string()),
                     "Choose the one series that the contours were drawn on");
  return first->second;
}

/// Two numbers, separated by blanks or a comma.
std::optional<Eigen::Vector2d> parse_point(std::string_view line) {
  constexpr std::string_view separators = " \t,";
  Eigen::Vector2d x;
  for (const int d : {0, 1}) {
    line.remove_prefix(std::min(line.find_first_not_of(separators), line.size()));
    const std::string_view word = line.substr(0, line.find_first_of(separators));
    const auto value = number_of<double>(word);
    if (!value || !std::isfinite(*value))
      return std::nullopt;
    x[d] = *value;
    line.remove_prefix(word.size());
  }
  return line.find_first_not_of(separators) == std::string_view::npos ? std::optional(x)
                                                                      : std::nullopt;
}

Contour read_contour(const fs::path& file, const Place& place, Side side, PixelOrigin origin) {
  LineReader lines(file);
  if (!lines.is_open())
    throw InputError(file.string(), "the contour file cannot be opened: " + unreadable(file),
                     "Check that it can be read");
  const Plane& plane = place.image->plane;
  const double shift = origin == PixelOrigin::corner ? 0.5 : 0.0;
  Contour contour{place.slice, side, {}, file.string(), {}};
  while (lines.next()) {
    const auto x = parse_point(lines.text());
    if (!x)
      throw InputError(lines.where(), "is no point \"x y\"",
                       "Give one point a line: two numbers, in pixels");
    if (x->x() < -1.0 || x->y() < -1.0 || x->x() > plane.columns + 1.0 || x->y() > plane.rows + 1.0)
      throw InputError(
          lines.where(),
          fmt::format("the point ({:g}, {:g}) lies outside the image of {} x {} pixels", x->x(),
                      x->y(), plane.columns, plane.rows),
          "Coordinates are in pixels of the DICOM image");
    contour.points.push_back(plane.point(x->x() - shift, x->y() - shift));
    contour.lines.push_back(lines.number());
  }
  if (contour.points.empty())
    throw InputError(file.string(), "the contour file holds no points",
                     "Remove it or draw it again");
  geometry::drop_repeats(contour);
  return contour;
}

/// One border of one image is drawn once.
void check_first(const std::vector<Contour>& loops, const Place& place, Side side,
                 const fs::path& file) {
  if (const Contour* other = geometry::find(loops, place.slice, side))
    throw InputError(file.string(),
                     fmt::format("draws the same border of the same image as {}", other->file),
                     "Keep one of them in the folder and its subfolders");
}

/// Phases are numbers of images in order of time: where a slice lacks one, those of its contours
/// would be of other times than the other slices'. `drawn` holds a contour file of each slice.
void check_phases(const DicomStack& stack, const std::map<int, fs::path>& drawn) {
  const auto images = [&](const auto& entry) {
    return stack.slices[static_cast<std::size_t>(entry.first) - 1].images.size();
  };
  const auto fewest =
      std::min_element(drawn.begin(), drawn.end(),
                       [&](const auto& a, const auto& b) { return images(a) < images(b); });
  const auto most = std::max_element(drawn.begin(), drawn.end(), [&](const auto& a, const auto& b) {
    return images(a) < images(b);
  });
  if (fewest != drawn.end() && images(*fewest) < images(*most))
    throw InputError(fewest->second.string(),
                     fmt::format("its slice {} has {} image{} where slice {} has {}: the phases of "
                                 "the contours cannot be told by order of time{}",
                                 fewest->first, images(*fewest), images(*fewest) == 1 ? "" : "s",
                                 most->first, images(*most), lost_text(stack, std::nullopt)),
                     "Give the missing images, or leave out the contours of this slice");
}

}  // namespace

bool has_sunnybrook_names(const fs::path& folder) {
  const FolderFiles files = files_in(folder, true);
  return std::any_of(files.files.begin(), files.files.end(), [](const fs::path& file) {
    return parse_name(file.filename().string()).has_value();
  });
}

DrawnPhases read_sunnybrook(const fs::path& folder, const DicomStack& stack, PixelOrigin origin,
                            DrawnBy drawn_by) {
  const FolderFiles files = files_in(folder, true);
  const auto places = images_by_instance(stack);
  DrawnPhases drawn;
  drawn.notes = summary(files.left_out);
  std::map<int, fs::path> drawn_on;
  int others = 0;
  int papillary = 0;
  int unknown = 0;
  for (const fs::path& file : files.files) {
    const auto name = parse_name(file.filename().string());
    unknown += name ? 0 : 1;
    if (!name)
      continue;
    if (name->drawn_by != drawn_by) {
      ++others;
    } else if (name->border != "i" && name->border != "o") {
      ++papillary;
    } else {
      const Place place = place_of(places, name->instance, stack, file);
      drawn_on.emplace(place.slice, file);
      const Side side = name->border == "i" ? Side::endo : Side::epi;
      std::vector<Contour>& loops = drawn.phases[place.phase].short_axis;
      check_first(loops, place, side, file);
      loops.push_back(read_contour(file, place, side, origin));
    }
  }
  if (drawn.phases.empty())
    throw InputError(folder.string(),
                     fmt::format("holds no contours drawn {}",
                                 drawn_by == DrawnBy::manual ? "by hand" : "automatically"),
                     "Contour files are called IM-0001-0059-icontour-manual.txt and so on");
  check_phases(stack, drawn_on);
  for (auto& [phase, contours] : drawn.phases)
    std::stable_sort(contours.short_axis.begin(), contours.short_axis.end(),
                     [](const Contour& a, const Contour& b) { return a.slice < b.slice; });
  if (papillary > 0)
    drawn.notes.push_back(fmt::format(
        "{} contours of papillary muscles are not used: the muscles belong to the cavity",
        papillary));
  if (others > 0)
    drawn.notes.push_back(fmt::format("{} contours of the other observer are not used", others));
  if (unknown > 0)
    drawn.notes.push_back(
        fmt::format("{} other files in {} are not used", unknown, folder.string()));
  return drawn;
}

}  // namespace lv::image
