#include "lv/image/cvi42.hpp"

#include "lv/base/check.hpp"
#include "lv/base/files.hpp"
#include "lv/base/lines.hpp"
#include "lv/base/printable.hpp"
#include "lv/base/table.hpp"

#include <fmt/format.h>
#include <minizip/unzip.h>
#include <pugixml.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace lv::image {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail_cvi42(const fs::path& file, const std::string& what) {
  throw InputError(file.string(), what, "Export the workspace again as XML (.cvi42wsx)");
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

constexpr std::size_t seen_of_workspace = 4096;  // bytes that tell one

bool begins_workspace(std::string_view begin) {
  begin = begin.substr(0, seen_of_workspace);
  return begin.find("circlecvi.com/cvi42") != std::string_view::npos &&
         begin.find('<') != std::string_view::npos;
}

bool is_zip(std::string_view begin) {
  return begin.starts_with("PK\x03\x04");
}

/// A zip archive, its files one after the other.
class Archive {
 public:
  explicit Archive(const fs::path& file)
      : zip_(unzOpen64(file.c_str()), &unzClose),
        found_(zip_ != nullptr && unzGoToFirstFile(zip_.get()) == UNZ_OK) {}
  [[nodiscard]] bool at_file() const { return found_; }
  void next() { found_ = unzGoToNextFile(zip_.get()) == UNZ_OK; }

  /// The file that is reached, or so much of it; none if it is damaged.
  [[nodiscard]] std::optional<std::string> text(std::size_t most) const {
    if (unzOpenCurrentFile(zip_.get()) != UNZ_OK)
      return std::nullopt;
    std::string all;
    std::string part(std::size_t{1} << 16, '\0');
    int count = 1;
    while (count > 0 && all.size() < most) {
      count = unzReadCurrentFile(zip_.get(), part.data(), static_cast<unsigned>(part.size()));
      all.append(part, 0, static_cast<std::size_t>(std::max(count, 0)));
    }
    const bool is_right = unzCloseCurrentFile(zip_.get()) == UNZ_OK;  // the sum of its bytes
    if (count < 0 || !is_right)
      return std::nullopt;
    return all;
  }

 private:
  std::unique_ptr<void, decltype(&unzClose)> zip_;
  bool found_;
};

/// Goes to the workspace of an archive.
bool find_workspace(Archive& archive) {
  for (; archive.at_file(); archive.next())
    if (const auto begin = archive.text(seen_of_workspace); begin && begins_workspace(*begin))
      return true;
  return false;
}

/// The XML of a file.
std::string workspace_text(const fs::path& file) {
  constexpr std::size_t most = std::size_t{256} << 20;  // workspaces are a hundredth of it
  if (!is_zip(first_bytes(file, seen_of_workspace)))
    return read_file(file);
  Archive archive(file);
  if (!find_workspace(archive))
    fail_cvi42(file, "is a zip archive without a workspace");
  std::optional<std::string> text = archive.text(most);
  if (!text)
    fail_cvi42(file, "is a zip archive whose workspace is damaged");
  if (text->size() >= most)
    fail_cvi42(file, fmt::format("unpacks to more than {} MB", most >> 20));
  return std::move(*text);
}

bool packs_workspace(const fs::path& file) {
  Archive archive(file);
  return find_workspace(archive);
}

}  // namespace

bool holds_cvi42(const fs::path& file) {
  const std::string begin = first_bytes(file, seen_of_workspace);
  return is_zip(begin) ? packs_workspace(file) : begins_workspace(begin);
}

ForeignContours read_cvi42(const fs::path& file) {
  const std::string text = workspace_text(file);
  pugi::xml_document document;
  if (const auto parsed = document.load_buffer(text.data(), text.size()); !parsed)
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
