#include "lv/image/dicom_study.hpp"

#include "lv/base/check.hpp"
#include "lv/base/time_left.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <tuple>
#include <utility>

namespace lv::image {
namespace {

namespace fs = std::filesystem;

constexpr double same_plane = 0.1;    // [mm]
constexpr double parallel = 0.99985;  // cosine of one degree
constexpr double degrees = 180.0 / std::numbers::pi;

std::vector<fs::path> files_in(std::span<const fs::path> where) {
  std::vector<fs::path> files;
  for (const fs::path& place : where) {
    std::error_code failed;
    if (fs::is_directory(place, failed)) {
      for (const auto& entry : fs::recursive_directory_iterator(
               place, fs::directory_options::skip_permission_denied, failed))
        if (entry.is_regular_file())
          files.push_back(entry.path());
    } else if (fs::is_regular_file(place, failed)) {
      files.push_back(place);
    } else {
      throw InputError(place.string(), "there is no such file or folder",
                       "Name a folder with DICOM files, or the files");
    }
  }
  std::sort(files.begin(), files.end());
  files.erase(std::unique(files.begin(), files.end()), files.end());
  return files;
}

/// Whether two images lie on planes of one direction, rows and spacing.
bool alike(const Plane& a, const Plane& b) {
  return a.normal().dot(b.normal()) > parallel && a.along_row.dot(b.along_row) > parallel;
}

/// "1.37 x 1.37 mm" and the like.
std::string spacing_text(const Plane& p) {
  return std::abs(p.spacing_i - p.spacing_j) < 1e-4 * p.spacing_i
             ? fmt::format("{:.3f} mm", p.spacing_i)
             : fmt::format("{:.3f} x {:.3f} mm", p.spacing_i, p.spacing_j);
}

/// What orders the images of one slice.
enum class Order { trigger_time, temporal_position, instance };

template <class Value>
bool all_distinct(const std::vector<DicomImage>& images, const Value& value) {
  std::set<double> seen;
  for (const DicomImage& image : images) {
    const auto v = value(image);
    if (!v || !seen.insert(static_cast<double>(*v)).second)
      return false;
  }
  return true;
}

/// The first that every image has and that tells them all apart; the last if none does.
Order order_of(const std::vector<DicomImage>& images) {
  if (all_distinct(images, [](const DicomImage& i) { return i.trigger_time; }))
    return Order::trigger_time;
  if (all_distinct(images, [](const DicomImage& i) { return i.temporal_position; }))
    return Order::temporal_position;
  return Order::instance;
}

void sort_by_time(std::vector<DicomImage>& images) {
  const Order order = order_of(images);
  const auto key = [order](const DicomImage& i) {
    const double time = order == Order::trigger_time        ? *i.trigger_time
                        : order == Order::temporal_position ? *i.temporal_position
                                                            : i.instance.value_or(0);
    return std::tuple(time, i.instance.value_or(0), i.series_uid, i.file, i.frame);
  };
  std::sort(images.begin(), images.end(),
            [&](const DicomImage& a, const DicomImage& b) { return key(a) < key(b); });
}

/// Sorts images of one orientation into slices.
std::vector<DicomSlice> slices_of(std::vector<DicomImage> images, const Vec3& normal) {
  std::vector<std::pair<double, DicomImage>> placed;
  for (DicomImage& image : images)
    placed.emplace_back(image.plane.origin.dot(normal), std::move(image));
  std::stable_sort(placed.begin(), placed.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<DicomSlice> slices;
  for (auto& [position, image] : placed) {
    if (slices.empty() || position - slices.back().position > same_plane)
      slices.push_back({position, {}});
    slices.back().images.push_back(std::move(image));
  }
  for (DicomSlice& slice : slices)
    sort_by_time(slice.images);
  return slices;
}

/// Splits the images of one series and kind by orientation, in order of their first instances.
std::vector<std::vector<DicomImage>> by_orientation(const std::vector<DicomImage>& images) {
  std::vector<std::vector<DicomImage>> groups;
  for (const DicomImage& image : images) {
    const auto found = std::find_if(groups.begin(), groups.end(), [&](const auto& group) {
      return alike(group.front().plane, image.plane);
    });
    if (found == groups.end())
      groups.push_back({image});
    else
      found->push_back(image);
  }
  return groups;
}

/// The keys of all stacks: see DicomStack::key.
void name_stacks(std::vector<DicomStack>& stacks,
                 const std::map<std::string, std::optional<int>>& numbers) {
  std::map<int, int> uses;
  for (const auto& [uid, number] : numbers)
    if (number)
      ++uses[*number];
  std::map<std::string, int> count;
  for (DicomStack& stack : stacks) {
    const auto number = numbers.at(stack.series_uid);
    const bool usable = number && uses[*number] == 1;
    const std::string series = usable ? std::to_string(*number) : stack.series_uid;
    const int k = ++count[stack.series_uid];
    stack.key = k == 1 ? series : fmt::format("{}#{}", series, k);
  }
}

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

bool is_named(const DicomStack& stack, const std::string& name) {
  const std::string series = stack.key.substr(0, stack.key.find('#'));
  return name == stack.key || name == series || name == stack.series_uid ||
         (!stack.description.empty() && lower(name) == lower(stack.description));
}

std::string most_and_least(std::size_t least, std::size_t most) {
  return least == most ? std::to_string(least) : fmt::format("{} to {}", least, most);
}

std::pair<std::size_t, std::size_t> images_per_slice(const DicomStack& stack) {
  std::size_t least = stack.slices.front().images.size();
  std::size_t most = least;
  for (const DicomSlice& slice : stack.slices) {
    least = std::min(least, slice.images.size());
    most = std::max(most, slice.images.size());
  }
  return {least, most};
}

/// Shortest and longest RR that the images name; zeros if none does.
std::pair<double, double> cycle_lengths(const DicomStack& stack) {
  double least = 0.0;
  double most = 0.0;
  for (const DicomSlice& slice : stack.slices)
    for (const DicomImage& image : slice.images)
      if (image.rr > 0.0) {
        least = least == 0.0 ? image.rr : std::min(least, image.rr);
        most = std::max(most, image.rr);
      }
  return {least, most};
}

std::string rr_text(double least, double most) {
  if (most == 0.0)
    return "RR not given";
  if (most - least < 5e-4)
    return fmt::format("RR {:.0f} ms", 1e3 * most);
  return fmt::format("RR {:.0f} to {:.0f} ms", 1e3 * least, 1e3 * most);
}

/// The steps between neighbouring slices, shortest and longest; zeros for one slice.
std::pair<double, double> steps_of(const DicomStack& stack) {
  double least = 0.0;
  double most = 0.0;
  for (std::size_t k = 1; k < stack.slices.size(); ++k) {
    const double step = stack.slices[k].position - stack.slices[k - 1].position;
    least = k == 1 ? step : std::min(least, step);
    most = std::max(most, step);
  }
  return {least, most};
}

std::string steps_text(const DicomStack& stack) {
  const auto [least, most] = steps_of(stack);
  if (most == 0.0)
    return "one slice";
  return most - least < same_plane ? fmt::format("slices {:.2f} mm apart", most)
                                   : fmt::format("slices {:.2f} to {:.2f} mm apart", least, most);
}

std::string orientation_text(const Vec3& n) {
  const char* along = "LPH";
  const char* against = "RAF";
  int largest = 0;
  for (int d = 1; d < 3; ++d)
    if (std::abs(n[d]) > std::abs(n[largest]))
      largest = d;
  const double angle = std::acos(std::min(1.0, std::abs(n[largest]))) * degrees;
  const char* axis = n[largest] > 0.0 ? along : against;
  return fmt::format("normal ({:.3f}, {:.3f}, {:.3f}), {:.0f} degrees from {}", n.x(), n.y(), n.z(),
                     angle, axis[largest]);
}

std::string place_text(const DicomSlice& slice) {
  return fmt::format("the slice at {:.1f} mm along the normal", slice.position);
}

/// No two images of a slice may be of one time or lie beside each other.
void check_slice(const DicomSlice& slice, const std::string& where, const std::string& parameter) {
  const Order order = order_of(slice.images);
  for (std::size_t i = 1; i < slice.images.size(); ++i) {
    const DicomImage& a = slice.images[i - 1];
    const DicomImage& b = slice.images[i];
    if ((a.plane.origin - b.plane.origin).norm() > same_plane ||
        a.plane.columns != b.plane.columns || a.plane.rows != b.plane.rows)
      throw InputError(where,
                       fmt::format("{} has images of different places or sizes: {} and {}",
                                   place_text(slice), a.file.string(), b.file.string()),
                       fmt::format("Choose one of the acquisitions with {}", parameter));
    const bool told_apart =
        order != Order::instance || (a.instance && b.instance && *a.instance != *b.instance);
    if (!told_apart || a.series_uid != b.series_uid)
      throw InputError(
          where,
          fmt::format("{} is there more than once: {} (series \"{}\") and {} (series \"{}\")",
                      place_text(slice), a.file.string(), a.description, b.file.string(),
                      b.description),
          fmt::format("Choose one of the acquisitions with {}", parameter));
  }
}

[[noreturn]] void fail_choice(const DicomStudy& study, const std::string& where,
                              const std::string& what, const std::string& parameter) {
  throw InputError(
      where, what,
      fmt::format("Name the series to use with {}. There are:{}", parameter, choices(study)));
}

}  // namespace

DicomStudy read_dicom_study(std::span<const fs::path> where) {
  DicomStudy study;
  std::map<std::pair<std::string, std::string>, std::vector<DicomImage>> groups;
  std::map<std::string, std::optional<int>> numbers;
  std::map<std::pair<std::string, int>, fs::path> seen;
  const std::vector<fs::path> files = files_in(where);
  Progress progress("reading DICOM files", files.size());
  for (const fs::path& file : files) {
    DicomFile read = read_dicom_headers(file);
    progress.add();
    if (!read.reason.empty())
      study.skipped.push_back(fmt::format("{}: {}", file.string(), read.reason));
    for (DicomImage& image : read.images) {
      if (!image.instance_uid.empty()) {
        const auto [first, fresh] = seen.try_emplace({image.instance_uid, image.frame}, file);
        if (!fresh) {
          study.skipped.push_back(
              fmt::format("{}: the same image as {}", file.string(), first->second.string()));
          continue;
        }
      }
      auto& number = numbers[image.series_uid];
      if (!number)
        number = image.series_number;
      groups[{image.series_uid, image.kind}].push_back(std::move(image));
    }
  }
  for (auto& [key, images] : groups) {
    std::stable_sort(images.begin(), images.end(), [](const DicomImage& a, const DicomImage& b) {
      return a.instance.value_or(0) < b.instance.value_or(0);
    });
    for (auto& group : by_orientation(images)) {
      const DicomImage first = group.front();
      const Vec3 normal = first.plane.normal();
      study.stacks.push_back({"", first.series_uid, first.description, first.kind, normal,
                              slices_of(std::move(group), normal)});
    }
  }
  std::stable_sort(study.stacks.begin(), study.stacks.end(),
                   [&](const DicomStack& a, const DicomStack& b) {
                     return std::pair(numbers.at(a.series_uid).value_or(0), a.series_uid) <
                            std::pair(numbers.at(b.series_uid).value_or(0), b.series_uid);
                   });
  name_stacks(study.stacks, numbers);
  return study;
}

std::string describe(const DicomStudy& study) {
  std::string text;
  for (const DicomStack& stack : study.stacks) {
    const auto [least, most] = images_per_slice(stack);
    const auto [rr_least, rr_most] = cycle_lengths(stack);
    const DicomImage& first = stack.slices.front().images.front();
    text += fmt::format("series \"{}\": \"{}\"{}\n", stack.key, stack.description,
                        stack.kind.empty() ? "" : fmt::format(", {}", stack.kind));
    text += fmt::format("  {} slice{}, {} image{} each, {} x {} pixels of {}, {}",
                        stack.slices.size(), stack.slices.size() == 1 ? "" : "s",
                        most_and_least(least, most), most == 1 ? "" : "s", first.plane.columns,
                        first.plane.rows, spacing_text(first.plane), steps_text(stack));
    text += first.thickness > 0.0 ? fmt::format(" and {:g} mm thick\n", first.thickness) : "\n";
    text += fmt::format("  {}; {}\n", orientation_text(stack.normal), rr_text(rr_least, rr_most));
    for (const std::string& remark : remarks(stack))
      text += fmt::format("  note: {}\n", remark);
  }
  return text;
}

std::string choices(const DicomStudy& study) {
  std::string list;
  for (const DicomStack& stack : study.stacks)
    list += fmt::format("\n  \"{}\" {}", stack.key, stack.description);
  return list;
}

void require_images(const DicomStudy& study, const std::string& where) {
  if (!study.stacks.empty())
    return;
  throw InputError(
      where,
      fmt::format(
          "holds no DICOM image with a place in space{}",
          study.skipped.empty()
              ? ", nor any other file"
              : fmt::format("; {} file{} skipped, the first: {}", study.skipped.size(),
                            study.skipped.size() == 1 ? " was" : "s were", study.skipped.front())),
      "Name the folder with the images of the scanner");
}

DicomStack choose_stack(const DicomStudy& study, std::span<const std::string> series,
                        const std::string& where, const std::string& parameter) {
  require_images(study, where);
  if (series.empty() && study.stacks.size() > 1)
    fail_choice(study, where, fmt::format("holds {} stacks of images", study.stacks.size()),
                parameter);
  DicomStack joined;
  std::vector<DicomImage> images;
  for (const std::string& name : series)
    if (std::none_of(study.stacks.begin(), study.stacks.end(),
                     [&](const DicomStack& s) { return is_named(s, name); }))
      fail_choice(study, where, fmt::format("has no series \"{}\"", name), parameter);
  for (const DicomStack& stack : study.stacks) {
    const auto named = [&](const std::string& name) {
      // a stack's own key is more exact than the name of its series
      const bool exact = std::any_of(study.stacks.begin(), study.stacks.end(),
                                     [&](const DicomStack& s) { return s.key == name; });
      return exact && name.find('#') != std::string::npos ? name == stack.key
                                                          : is_named(stack, name);
    };
    if (!series.empty() && std::none_of(series.begin(), series.end(), named))
      continue;
    if (joined.key.empty())
      joined = {stack.key, stack.series_uid, stack.description, stack.kind, stack.normal, {}};
    else if (std::abs(joined.normal.dot(stack.normal)) < parallel)
      fail_choice(study, where,
                  fmt::format("the series \"{}\" and \"{}\" that were chosen are not parallel",
                              joined.key, stack.key),
                  parameter);
    for (const DicomSlice& slice : stack.slices)
      images.insert(images.end(), slice.images.begin(), slice.images.end());
  }
  joined.slices = slices_of(std::move(images), joined.normal);
  for (const DicomSlice& slice : joined.slices)
    check_slice(slice, where, parameter);
  return joined;
}

std::vector<std::string> remarks(const DicomStack& stack) {
  std::vector<std::string> notes;
  const auto [least, most] = images_per_slice(stack);
  if (least != most)
    for (const DicomSlice& slice : stack.slices)
      if (slice.images.size() < most)
        notes.push_back(fmt::format("{} has {} images where others have {}", place_text(slice),
                                    slice.images.size(), most));
  const int announced = stack.slices.front().images.front().phases_announced;
  if (announced > static_cast<int>(most))
    notes.push_back(
        fmt::format("{} of the {} phases that the headers announce are there", most, announced));
  const auto [shortest, longest] = steps_of(stack);
  if (longest - shortest >= same_plane)
    notes.push_back(fmt::format("the slices are {:.2f} to {:.2f} mm apart", shortest, longest));
  const double thickness = stack.slices.front().images.front().thickness;
  if (thickness > 0.0 && shortest > thickness + same_plane)
    notes.push_back(fmt::format("there is a gap of {:.2f} mm between slices {:g} mm thick",
                                shortest - thickness, thickness));
  const auto [rr_least, rr_most] = cycle_lengths(stack);
  if (rr_most > 1.02 * rr_least)
    notes.push_back(fmt::format("the heart beat differently between images: RR {:.0f} to {:.0f} ms",
                                1e3 * rr_least, 1e3 * rr_most));
  for (const DicomSlice& slice : stack.slices)
    for (const DicomImage& image : slice.images)
      if (!image.damage.empty())
        notes.push_back(fmt::format("{}: {}", image.file.string(), image.damage));
  return notes;
}

Cine read_pixels(const DicomStack& stack) {
  DicomPixels pixels;
  Cine cine;
  for (std::size_t k = 0; k < stack.slices.size(); ++k) {
    const DicomSlice& from = stack.slices[k];
    CineSlice slice;
    slice.name = fmt::format("slice {}", k + 1);
    const bool timed = order_of(from.images) == Order::trigger_time;
    for (const DicomImage& image : from.images) {
      slice.frames.push_back(pixels.read(image));
      if (timed)
        slice.times.push_back(*image.trigger_time);
      slice.rr = std::max(slice.rr, image.rr);
    }
    cine.slices.push_back(std::move(slice));
  }
  cine.notes = remarks(stack);
  return cine;
}

Cine read_dicom_cine(std::span<const fs::path> where, std::span<const std::string> series,
                     const std::string& parameter) {
  const DicomStudy study = read_dicom_study(where);
  const std::string place = where.empty() ? "no files" : where.front().string();
  Cine cine = read_pixels(choose_stack(study, series, place, parameter));
  if (!study.skipped.empty())
    cine.notes.push_back(fmt::format("{} file{} skipped, the first: {}", study.skipped.size(),
                                     study.skipped.size() == 1 ? " was" : "s were",
                                     study.skipped.front()));
  return cine;
}

}  // namespace lv::image
