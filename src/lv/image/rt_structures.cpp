#include "lv/image/rt_structures.hpp"

#include "lv/base/check.hpp"
#include "lv/base/trial.hpp"
#include "lv/image/dicom_file.hpp"
#include "lv/image/dicom_values.hpp"

#include <fmt/format.h>

namespace lv::image {
namespace {

namespace fs = std::filesystem;
using gdcm::Tag;

constexpr const char* structures_remedy =
    "The file seems to be truncated or damaged: export or copy it again";

[[noreturn]] void fail_structures(const fs::path& file, const std::string& what) {
  throw InputError(file.string(), what, structures_remedy);
}

/// The items of a sequence, from 1.
template <class Visit>
void for_each_item(const DicomValues& values, const Tag& tag, const Visit& visit) {
  const auto items = values.sequence(tag);
  if (items == nullptr)
    return;
  for (std::size_t i = 1; i <= items->GetNumberOfItems(); ++i)
    visit(DicomValues(items->GetItem(i).GetNestedDataSet()));
}

/// Names of the regions of interest by number.
std::map<int, std::string> region_names(const DicomValues& set) {
  std::map<int, std::string> names;
  for_each_item(set, Tag(0x3006, 0x0020), [&](const DicomValues& region) {
    if (const auto number = region.whole(Tag(0x3006, 0x0022)))
      names[*number] = region.text(Tag(0x3006, 0x0026));
  });
  return names;
}

ForeignLoop loop_of(const fs::path& file, const std::string& name, const DicomValues& contour) {
  constexpr double farthest = 1e6;  // from the scanner's centre [mm]
  ForeignLoop loop{name, "", 0, {}};
  const std::vector<double> data = contour.numbers(Tag(0x3006, 0x0050));
  if (data.empty() || data.size() % 3 != 0)
    fail_structures(file, fmt::format("a contour of \"{}\" has {} numbers, not three for each "
                                      "point",
                                      name, data.size()));
  for (std::size_t i = 0; i < data.size(); i += 3) {
    loop.points.emplace_back(data[i], data[i + 1], data[i + 2]);
    if (loop.points.back().cwiseAbs().maxCoeff() > farthest)
      fail_structures(file, fmt::format("a point of \"{}\" lies at {:g} mm", name,
                                        loop.points.back().cwiseAbs().maxCoeff()));
  }
  for_each_item(contour, Tag(0x3006, 0x0016), [&](const DicomValues& image) {
    loop.image_uid = image.text(Tag(0x0008, 0x1155));
  });
  return loop;
}

/// "11 OPEN_PLANAR, 2 POINT"
std::string in_words(const std::map<std::string, int>& counts) {
  std::vector<std::string> each;
  for (const auto& [kind, count] : counts)
    each.push_back(fmt::format("{} {}", count, kind.empty() ? "of no kind" : kind));
  return fmt::format("{}", fmt::join(each, ", "));
}

ForeignContours structures_in(const fs::path& file, const DicomValues& set) {
  ForeignContours drawn{file.string(), "DICOM contours (RTSTRUCT)", false, {}, "", "", {}};
  const auto names = region_names(set);
  int others = 0;
  std::map<std::string, std::map<std::string, int>> kinds;  // of what is not read, by structure
  for_each_item(set, Tag(0x3006, 0x0039), [&](const DicomValues& region) {
    const auto number = region.whole(Tag(0x3006, 0x0084));
    const auto name = number ? names.find(*number) : names.end();
    if (name == names.end())
      fail_structures(file, "has contours of a region of interest that it does not name");
    for_each_item(region, Tag(0x3006, 0x0040), [&](const DicomValues& contour) {
      const std::string kind = contour.text(Tag(0x3006, 0x0042));
      if (kind == "CLOSED_PLANAR") {
        drawn.loops.push_back(loop_of(file, name->second, contour));
      } else {
        ++others;
        ++kinds[name->second][kind];
      }
    });
  });
  for (const ForeignLoop& loop : drawn.loops)
    kinds.erase(loop.name);
  for (const auto& [name, counts] : kinds)
    drawn.not_read[name] = in_words(counts);
  if (others > 0)
    drawn.notes.push_back(
        fmt::format("{}: {} points and open lines are not used", file.string(), others));
  return drawn;
}

ForeignContours read_set(const fs::path& file) {
  ForeignContours drawn;
  with_data_set(file, structures_remedy,
                [&](const DicomValues& set) { drawn = structures_in(file, set); });
  return drawn;
}

}  // namespace

bool holds_rt_structures(const fs::path& file) {
  return dicom_modality(file) == "RTSTRUCT";
}

ForeignContours read_rt_structures(const fs::path& file) {
  silence_gdcm();
  check_survives(file.string(), [&] { static_cast<void>(read_set(file)); });
  return read_set(file);
}

}  // namespace lv::image
