#include "lv/image/cvi42.hpp"

#include "lv/base/check.hpp"
#include "lv/base/lines.hpp"
#include "lv/base/printable.hpp"

#include <fmt/format.h>
#include <pugixml.hpp>

#include <array>
#include <cmath>
#include <fstream>
#include <string_view>

namespace lv::image {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail_cvi42(const fs::path& file, const std::string& what) {
  throw InputError(file.string(), what,
                   "Export the workspace again as XML (.cvi42wsx); a packed one must be unpacked");
}

/// The next element of a document, children first; none at its end.
pugi::xml_node next_of(pugi::xml_node node) {
  if (node.first_child())
    return node.first_child();
  while (node && !node.next_sibling())
    node = node.parent();
  return node.next_sibling();
}

std::string_view key_of(const pugi::xml_node& node) {
  return node.attribute("Hash:key").value();
}

/// The entry of a table with a key; none if there is none.
pugi::xml_node entry(const pugi::xml_node& table, std::string_view key) {
  for (const pugi::xml_node& child : table.children("Hash:item"))
    if (key_of(child) == key)
      return child;
  return {};
}

/// What is a border or another closed line, by cvi42's name.
bool is_closed_line(std::string_view name) {
  for (const char* other : {"Musc", "Ref", "flow"})
    if (name.find(other) != std::string_view::npos)
      return false;
  return name.ends_with("Contour") && !name.ends_with("OpenContour");
}

double coordinate(const fs::path& file, const pugi::xml_node& point, const char* name) {
  const auto value = number_of<double>(trimmed(point.child(name).text().get()));
  if (!value || !std::isfinite(*value))
    fail_cvi42(file, fmt::format("has a point whose {} is no number", name));
  return *value;
}

ForeignLoop loop_of_contour(const fs::path& file, const pugi::xml_node& contour,
                            const std::string& uid) {
  ForeignLoop loop{printable(key_of(contour)), uid, 0, {}};
  const auto factor = number_of<double>(trimmed(entry(contour, "SubpixelResolution").text().get()));
  if (!factor || !(*factor >= 1.0 && *factor <= 1e4))
    fail_cvi42(file,
               fmt::format("does not state the SubpixelResolution of a contour \"{}\"", loop.name));
  for (const pugi::xml_node& point : entry(contour, "Points").children("List:item"))
    loop.points.emplace_back(coordinate(file, point, "Point:x") / *factor,
                             coordinate(file, point, "Point:y") / *factor, 0.0);
  return loop;
}

/// The contours of one image.
void add_contours(const fs::path& file, const pugi::xml_node& image, ForeignContours& drawn,
                  int& others) {
  for (const pugi::xml_node& contour : entry(image, "Contours").children("Hash:item")) {
    if (!is_closed_line(key_of(contour))) {
      ++others;
      continue;
    }
    ForeignLoop loop = loop_of_contour(file, contour, printable(key_of(image)));
    if (!loop.points.empty())
      drawn.loops.push_back(std::move(loop));
  }
}

}  // namespace

bool holds_cvi42(const fs::path& file) {
  std::array<char, 4096> bytes{};
  std::ifstream stream(file, std::ios::binary);
  stream.read(bytes.data(), bytes.size());
  const std::string_view begin(bytes.data(), static_cast<std::size_t>(stream.gcount()));
  return begin.find("circlecvi.com/cvi42") != std::string_view::npos &&
         begin.find('<') != std::string_view::npos;
}

ForeignContours read_cvi42(const fs::path& file) {
  pugi::xml_document document;
  if (const auto parsed = document.load_file(file.c_str()); !parsed)
    fail_cvi42(file, fmt::format("cannot be read as XML: {} at byte {}", parsed.description(),
                                 parsed.offset));
  ForeignContours drawn{file.string(),          "a workspace of cvi42", true, {},
                        "saendocardialContour", "saepicardialContour",  {}};
  int others = 0;
  for (pugi::xml_node node = document.first_child(); node; node = next_of(node))
    if (key_of(node) == "ImageStates")
      for (const pugi::xml_node& image : node.children("Hash:item"))
        add_contours(file, image, drawn, others);
  if (drawn.loops.empty())
    fail_cvi42(file, "holds no closed contours (ImageStates, Contours)");
  drawn.notes.push_back(
      fmt::format("{}: pixel (0, 0) is taken for the outer corner of the first pixel: if it is the "
                  "centre, all lies half a pixel aside, with the same size",
                  file.string()));
  if (others > 0)
    drawn.notes.push_back(
        fmt::format("{}: {} open lines, papillary muscles and other marks are not used",
                    file.string(), others));
  return drawn;
}

}  // namespace lv::image
