#include "lv/image/dicom_study.hpp"

#include "lv/base/check.hpp"
#include "lv/base/ending.hpp"
#include "lv/base/formats.hpp"
#include "lv/base/time_left.hpp"
#include "lv/image/pixel_grid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <numbers>
#include <set>
#include <system_error>
#include <tuple>
#include <utility>

namespace lv::image {
namespace {

namespace fs = std::filesystem;

constexpr double same_plane = 0.1;    // [mm]
constexpr double parallel = 0.99985;  // cosine of one degree
constexpr double degrees = 180.0 / std::numbers::pi;

/// Whether two images lie on planes of one direction, rows and spacing.
bool alike(const Plane& a, const Plane& b) {
  return a.normal().dot(b.normal()) > parallel && a.along_row.dot(b.along_row) > parallel;
}

/// What orders the images of one slice.
enum class Order { trigger_time, temporal_position, instance };

/// Whether all images have a value, and not all the same.
template <class Value>
bool tells_apart(const std::vector<DicomImage>& images, const Value& value) {
  std::set<double> seen;
  for (const DicomImage& image : images) {
    const auto v = value(image);
    if (!v)
      return false;
    seen.insert(static_cast<double>(*v));
  }
  return seen.size() > 1 || images.size() == 1;
}

/// The first that every image has and that tells any apart; the last if none does.
Order order_of(const std::vector<DicomImage>& images) {
  if (tells_apart(images, [](const DicomImage& i) { return i.trigger_time; }))
    return Order::trigger_time;
  if (tells_apart(images, [](const DicomImage& i) { return i.temporal_position; }))
    return Order::temporal_position;
  return Order::instance;
}

/// Whether two images are of one time, by what orders them.
bool same_time(const DicomImage& a, const DicomImage& b, Order order) {
  constexpr double shortest = 2e-3;  // that a scanner takes for an image [s]
  switch (order) {
    case Order::trigger_time:
      return std::abs(*a.trigger_time - *b.trigger_time) < shortest;
    case Order::temporal_position:
      return *a.temporal_position == *b.temporal_position;
    default:
      return !a.instance || !b.instance || *a.instance == *b.instance;
  }
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

bool is_named(const DicomStack& stack, const std::string& name) {
  const std::string series = stack.key.substr(0, stack.key.find('#'));
  return name == stack.key || name == series || name == stack.series_uid ||
         (!stack.description.empty() && lower_case(name) == lower_case(stack.description));
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

/// A file, and the frame if it may have several.
std::string name_of(const DicomImage& image) {
  return image.frame == 0 ? image.file.string()
                          : fmt::format("{} frame {}", image.file.string(), image.frame + 1);
}

std::string time_text(const DicomImage& image, Order order) {
  switch (order) {
    case Order::trigger_time:
      return fmt::format(" at {:.0f} ms", 1e3 * *image.trigger_time);
    case Order::temporal_position:
      return fmt::format(" at the temporal position {}", *image.temporal_position);
    default:
      return "";
  }
}

/// Why the images of a slice cannot be used together.
struct Clash {
  std::string what;
  bool untimed = false;  ///< for want of what orders them, not as there are too many
};

/// Why a value of the images does not order them: "no TriggerTime" and the like.
template <class Value>
std::string lack(const std::vector<DicomImage>& images, const char* name, const Value& value) {
  const auto with = std::count_if(images.begin(), images.end(),
                                  [&](const DicomImage& i) { return value(i).has_value(); });
  if (with == 0)
    return fmt::format("no {}", name);
  return with < static_cast<std::ptrdiff_t>(images.size())
             ? fmt::format("{} in {} of {} alone", name, with, images.size())
             : fmt::format("the same {}", name);
}

/// What the images of a slice lack that would order them in time.
std::string lacks_of(const std::vector<DicomImage>& images) {
  return fmt::format(
      "{}, {} and {}",
      lack(images, "TriggerTime", [](const DicomImage& i) { return i.trigger_time; }),
      lack(images, "TemporalPositionIdentifier",
           [](const DicomImage& i) { return i.temporal_position; }),
      lack(images, "InstanceNumber", [](const DicomImage& i) { return i.instance; }));
}

/// Why two images that follow each other in a slice cannot both be of it.
std::optional<Clash> clash(const DicomImage& a, const DicomImage& b, const DicomSlice& slice,
                           Order order) {
  if ((a.plane.origin - b.plane.origin).norm() > same_plane || !same_grid(a.plane, b.plane))
    return Clash{
        fmt::format("has images of different places or sizes: {} and {}", name_of(a), name_of(b))};
  if (a.series_uid != b.series_uid)
    return Clash{fmt::format("is there more than once: {} (series \"{}\") and {} (series \"{}\")",
                             name_of(a), a.description, name_of(b), b.description)};
  if (!same_time(a, b, order))
    return std::nullopt;
  if (order == Order::instance)
    return Clash{fmt::format("has {} images whose phases cannot be told apart, {} and {} among "
                             "them: they have {}",
                             slice.images.size(), name_of(a), name_of(b), lacks_of(slice.images)),
                 true};
  return Clash{fmt::format("is there more than once{}: {} and {}", time_text(a, order), name_of(a),
                           name_of(b))};
}

/// Why the images of a slice are not those of one heart's cycle, if they cannot be.
std::optional<Clash> clash_in(const DicomSlice& slice) {
  const Order order = order_of(slice.images);
  const DicomImage& first = slice.images.front();
  for (std::size_t i = 1; i < slice.images.size(); ++i)
    if (auto found = clash(slice.images[i - 1], slice.images[i], slice, order)) {
      found->what = fmt::format("{} {}", place_text(slice), found->what);
      return found;
    }
  const auto announced = static_cast<std::size_t>(std::max(first.phases_announced, 0));
  if (announced > 1 && slice.images.size() > announced && slice.images.size() % announced == 0)
    return Clash{fmt::format(
        "{} has {} images where the headers announce {} phases, so it seems to be there more than "
        "once: {} and {} follow each other",
        place_text(slice), slice.images.size(), announced, name_of(first),
        name_of(slice.images[1]))};
  return std::nullopt;
}

std::string remedy_of(const Clash& clash, const DicomSlice& slice, const std::string& parameter) {
  if (clash.untimed)
    return "Export the images with their times or InstanceNumbers, or give one image of each slice "
           "in a folder of their own";
  const bool is_one_series = std::all_of(
      slice.images.begin(), slice.images.end(),
      [&](const DicomImage& i) { return i.series_uid == slice.images.front().series_uid; });
  return is_one_series
             ? "They are of one series: leave out the files of the acquisition that is not "
               "meant"
             : fmt::format(
                   "Choose one of the acquisitions with {}, or give the files of "
                   "one in a folder of their own",
                   parameter);
}

/// How many patients the images of a stack name: by their identifiers, or by their names where
/// these are more.
std::size_t patients_of(const DicomStack& stack) {
  std::set<std::string> ids;
  std::set<std::string> names;
  for (const DicomSlice& slice : stack.slices)
    for (const DicomImage& image : slice.images) {
      ids.insert(image.patient_id);
      names.insert(image.patient_name);
    }
  ids.erase("");
  names.erase("");
  return std::max(ids.size(), names.size());
}

/// The plane of the pixels that most slices have.
const Plane& usual_plane(const DicomStack& stack) {
  const auto count_alike = [&](const DicomSlice& slice) {
    return std::count_if(stack.slices.begin(), stack.slices.end(), [&](const DicomSlice& other) {
      return same_grid(slice.images.front().plane, other.images.front().plane);
    });
  };
  return std::max_element(stack.slices.begin(), stack.slices.end(),
                          [&](const DicomSlice& a, const DicomSlice& b) {
                            return count_alike(a) < count_alike(b);
                          })
      ->images.front()
      .plane;
}

/// Slices whose pixels are not those of the others, and pixels of no usual size.
void note_pixels(const DicomStack& stack, std::vector<std::string>& notes) {
  const Plane& usual = usual_plane(stack);
  for (const DicomSlice& slice : stack.slices)
    if (const Plane& plane = slice.images.front().plane; !same_grid(plane, usual))
      notes.push_back(fmt::format("{} has {} where others have {}", place_text(slice),
                                  grid_text(plane), grid_text(usual)));
  if (std::string note = unusual_pixels(usual.spacing_i, usual.spacing_j); !note.empty())
    notes.push_back(std::move(note));
}

[[noreturn]] void fail_choice(const DicomStudy& study, const std::string& where,
                              const std::string& what, const std::string& parameter) {
  throw InputError(
      where, what,
      fmt::format("Name the series to use with {}. There are:{}", parameter, choices(study)));
}

/// Tells copies of an image from others that bear its SOPInstanceUID too.
class Copies {
 public:
  /// An image seen before that has the same UID, place, time and pixels; null if there is none.
  const DicomImage* of(const DicomImage& image) {
    if (image.instance_uid.empty())
      return nullptr;
    if (int& uses = uses_[{image.instance_uid, image.frame}]; ++uses > 1)
      ++reused_;
    const Vec3& x = image.plane.origin;
    std::vector<DicomImage>& alike =
        seen_[{image.instance_uid, image.frame, image.kind, image.trigger_time,
               image.temporal_position, x.x(), x.y(), x.z()}];
    for (const DicomImage& other : alike)
      if (same_pixels(other, image)) {
        --reused_;
        return &other;
      }
    alike.push_back(image);
    return nullptr;
  }

  /// How many images have the UID of one before them, and are not its copies.
  [[nodiscard]] int reused() const { return reused_; }

 private:
  bool same_pixels(const DicomImage& a, const DicomImage& b) {
    try {
      return pixels_[0].read(a).values == pixels_[1].read(b).values;
    } catch (const InputError&) {  // unreadable: whoever uses it says so
      return false;
    }
  }

  using Shown = std::tuple<std::string, int, std::string, std::optional<double>, std::optional<int>,
                           double, double, double>;
  std::map<Shown, std::vector<DicomImage>> seen_;
  std::map<std::pair<std::string, int>, int> uses_;
  std::array<DicomPixels, 2> pixels_;
  int reused_ = 0;
};

/// Sorts images that are read one after the other into stacks.
class Collector {
 public:
  explicit Collector(std::string where) { study_.where = std::move(where); }

  void read(const fs::path& place) {
    std::error_code failed;
    if (!fs::is_directory(place, failed)) {
      require_readable(place, "Name a folder with DICOM files, or the files");
      read_file(place);
      return;
    }
    FolderFiles folder = files_in(place, true);
    for (const LeftOut& unreadable_file : folder.left_out)
      study_.lost.push_back({unreadable_file, std::nullopt});
    std::move(folder.left_out.begin(), folder.left_out.end(), std::back_inserter(study_.skipped));
    Progress progress("reading DICOM files", folder.files.size());
    for (const fs::path& file : folder.files) {
      read_file(file);
      progress.add();
    }
  }

  [[nodiscard]] DicomStudy study() {
    for (auto& [key, images] : groups_)
      add_stacks(images);
    std::stable_sort(study_.stacks.begin(), study_.stacks.end(),
                     [&](const DicomStack& a, const DicomStack& b) {
                       return std::pair(numbers_.at(a.series_uid).value_or(0), a.series_uid) <
                              std::pair(numbers_.at(b.series_uid).value_or(0), b.series_uid);
                     });
    name_stacks(study_.stacks, numbers_);
    if (copies_.reused() > 0)
      study_.notes.push_back(fmt::format(
          "SOPInstanceUIDs are used more than once, by {} images that bear the UID of another: "
          "images are told apart by place, time and pixels",
          copies_.reused()));
    return std::move(study_);
  }

 private:
  void read_file(const fs::path& file) {
    if (!read_.insert(file).second)
      return;
    DicomFile read = read_dicom_headers(file);
    if (!read.reason.empty())
      study_.skipped.push_back({file, read.reason});
    if (read.lost)
      study_.lost.push_back({study_.skipped.back(), read.instance});
    for (DicomImage& image : read.images) {
      if (const DicomImage* same = copies_.of(image)) {
        study_.skipped.push_back({file, fmt::format("the same image as {}", same->file.string())});
        continue;
      }
      auto& number = numbers_[image.series_uid];
      if (!number)
        number = image.series_number;
      groups_[{image.series_uid, image.kind}].push_back(std::move(image));
    }
  }

  void add_stacks(std::vector<DicomImage>& images) {
    std::stable_sort(images.begin(), images.end(), [](const DicomImage& a, const DicomImage& b) {
      return a.instance.value_or(0) < b.instance.value_or(0);
    });
    for (auto& group : by_orientation(images)) {
      const DicomImage first = group.front();
      const Vec3 normal = first.plane.normal();
      study_.stacks.push_back({"", first.series_uid, first.description, first.kind, normal,
                               slices_of(std::move(group), normal)});
    }
  }

  DicomStudy study_;
  std::set<fs::path> read_;
  Copies copies_;
  std::map<std::pair<std::string, std::string>, std::vector<DicomImage>> groups_;
  std::map<std::string, std::optional<int>> numbers_;
};

}  // namespace

DicomStudy read_dicom_study(std::span<const fs::path> where) {
  Collector found(where.empty() ? "no files" : where.front().string());
  for (const fs::path& place : where)
    found.read(place);
  return found.study();
}

std::string describe(const DicomStudy& study) {
  std::string text;
  for (const std::string& note : study.notes)
    text += fmt::format("note: {}\n", note);
  for (const DicomStack& stack : study.stacks) {
    const auto [least, most] = images_per_slice(stack);
    const auto [rr_least, rr_most] = cycle_lengths(stack);
    const DicomImage& first = stack.slices.front().images.front();
    text += fmt::format("series \"{}\": \"{}\"{}\n", stack.key, stack.description,
                        stack.kind.empty() ? "" : fmt::format(", {}", stack.kind));
    text += fmt::format("  {} slice{}, {} image{} each, {}, {}", stack.slices.size(),
                        stack.slices.size() == 1 ? "" : "s", most_and_least(least, most),
                        most == 1 ? "" : "s", grid_text(usual_plane(stack)), steps_text(stack));
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
  if (study.stacks.empty())
    throw InputError(
        where,
        fmt::format("holds no DICOM image with a place in space{}",
                    study.skipped.empty()
                        ? ", nor any other file"
                        : fmt::format("; {}", fmt::join(summary(study.skipped), "; "))),
        fmt::format("Images are read from {}", formats::images));
}

bool is_chosen(const DicomStudy& study, const DicomStack& stack, const std::string& name) {
  // a stack's own key is more exact than the name of its series
  const bool exact = std::any_of(study.stacks.begin(), study.stacks.end(),
                                 [&](const DicomStack& s) { return s.key == name; });
  return exact && name.find('#') != std::string::npos ? name == stack.key : is_named(stack, name);
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
    if (!series.empty() && std::none_of(series.begin(), series.end(), [&](const std::string& name) {
          return is_chosen(study, stack, name);
        }))
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
    if (const auto wrong = clash_in(slice))
      throw InputError(where, wrong->what, remedy_of(*wrong, slice, parameter));
  joined.notes = study.notes;
  joined.lost = study.lost;
  for (std::string& sentence : summary(study.skipped))
    joined.notes.push_back(std::move(sentence));
  return joined;
}

std::vector<std::string> remarks(const DicomStack& stack) {
  std::vector<std::string> notes = stack.notes;
  const auto unusable = std::find_if(stack.slices.begin(), stack.slices.end(),
                                     [](const DicomSlice& s) { return clash_in(s).has_value(); });
  if (unusable != stack.slices.end())
    notes.push_back("cannot be used as it is: " + clash_in(*unusable)->what);
  if (const std::size_t patients = patients_of(stack); patients > 1)
    notes.push_back(
        fmt::format("its images are files of {} patients, by PatientID and PatientName: if these "
                    "are not of one person, give those of each in a folder of their own",
                    patients));
  const auto [least, most] = images_per_slice(stack);
  if (least != most)
    for (const DicomSlice& slice : stack.slices)
      if (slice.images.size() < most)
        notes.push_back(fmt::format("{} has {} images where others have {}", place_text(slice),
                                    slice.images.size(), most));
  note_pixels(stack, notes);
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
  return read_pixels(choose_stack(study, series, study.where, parameter));
}

}  // namespace lv::image
