#include "lv/image/dicom_segmentation.hpp"

#include "lv/base/check.hpp"
#include "lv/base/memory.hpp"
#include "lv/base/trial.hpp"
#include "lv/image/dicom_file.hpp"
#include "lv/image/dicom_values.hpp"
#include "lv/image/place.hpp"
#include "lv/image/segments.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace lv::image {
namespace {

namespace fs = std::filesystem;
using gdcm::Tag;

constexpr const char* segmentation_remedy =
    "Export it again as an uncompressed DICOM segmentation, or as NIfTI or NRRD";

[[noreturn]] void fail_segmentation(const fs::path& file, const std::string& what) {
  throw InputError(file.string(), what, segmentation_remedy);
}

/// One frame: a segment on a plane.
struct SegmentFrame {
  int segment = 0;  ///< its number
  int time = 0;     ///< temporal position; 0 if not stated
  Plane plane;
  double thickness = 0.0;  ///< [mm]
  int slice = 0;           ///< in the stack, from 0
};

/// How the pixels are stored.
struct Storage {
  bool binary = true;       ///< one bit a pixel, the least significant first, frame after frame
  double half = 0.5;        ///< from which a fractional pixel counts
  std::string_view pixels;  ///< of all frames
  std::size_t in_frame = 0;

  [[nodiscard]] bool holds(std::size_t frame, std::size_t pixel) const {
    const std::size_t at = frame * in_frame + pixel;
    if (!binary)
      return static_cast<unsigned char>(pixels[at]) >= half;
    return ((static_cast<unsigned char>(pixels[at / 8]) >> (at % 8)) & 1U) != 0;
  }
};

Storage storage_of(const fs::path& file, const DicomValues& values, std::size_t frames,
                   const Plane& plane) {
  Storage storage;
  const std::string type = values.text(Tag(0x0062, 0x0001));
  storage.binary = type == "BINARY";
  const int bits = values.binary<std::uint16_t>(Tag(0x0028, 0x0100)).value_or(0);
  if ((type != "BINARY" || bits != 1) && (type != "FRACTIONAL" || bits != 8))
    fail_segmentation(
        file, fmt::format("has the SegmentationType \"{}\" with {} bits a pixel", type, bits));
  storage.half = 0.5 * values.binary<std::uint16_t>(Tag(0x0062, 0x000e)).value_or(255);
  storage.in_frame = static_cast<std::size_t>(plane.rows) * static_cast<std::size_t>(plane.columns);
  storage.pixels = values.bytes(Tag(0x7fe0, 0x0010));
  const std::size_t stored = storage.in_frame * frames;
  if (storage.pixels.size() < (storage.binary ? (stored + 7) / 8 : stored))
    fail_segmentation(file, fmt::format("has {} bytes of pixels, too few for {} frames, or packs "
                                        "them",
                                        storage.pixels.size(), frames));
  return storage;
}

/// Names by number.
std::map<int, std::string> segment_names(const fs::path& file, const DicomValues& values) {
  std::map<int, std::string> names;
  if (const auto items = values.sequence(Tag(0x0062, 0x0002)); items != nullptr)
    for (std::size_t i = 1; i <= items->GetNumberOfItems(); ++i) {
      const DicomValues segment(items->GetItem(i).GetNestedDataSet());
      const auto number = segment.binary<std::uint16_t>(Tag(0x0062, 0x0004));
      if (!number || !names.emplace(*number, segment.text(Tag(0x0062, 0x0005))).second)
        fail_segmentation(file, "has segments without a number of their own");
    }
  if (names.empty())
    fail_segmentation(file, "has no segments");
  return names;
}

SegmentFrame read_frame_of_segment(const fs::path& file, FrameGroups groups, const Plane& size,
                                   std::size_t number) {
  SegmentFrame frame;
  frame.plane = size;
  const auto which = groups.group(Tag(0x0062, 0x000a));
  frame.segment = which ? which->binary<std::uint16_t>(Tag(0x0062, 0x000b)).value_or(0) : 0;
  const Tag measures(0x0028, 0x9110);
  const std::string wrong = lay_plane(groups.numbers(Tag(0x0020, 0x9113), Tag(0x0020, 0x0032)),
                                      groups.numbers(Tag(0x0020, 0x9116), Tag(0x0020, 0x0037)),
                                      groups.numbers(measures, Tag(0x0028, 0x0030)), frame.plane);
  if (!wrong.empty())
    fail_segmentation(file, fmt::format("frame {}: {}", number, wrong));
  for (const Tag& tag : {Tag(0x0018, 0x0088), Tag(0x0018, 0x0050)})
    if (const auto said = groups.numbers(measures, tag); frame.thickness == 0.0 && !said.empty())
      frame.thickness = std::abs(said.front());
  if (const auto content = groups.group(Tag(0x0020, 0x9111)))
    frame.time =
        static_cast<int>(content->binary<std::uint32_t>(Tag(0x0020, 0x9128)).value_or(0) % 100000U);
  return frame;
}

std::vector<SegmentFrame> frames_of(const fs::path& file, const DicomValues& values) {
  const auto per_frame = values.sequence(Tag(0x5200, 0x9230));
  if (per_frame == nullptr || per_frame->GetNumberOfItems() == 0)
    fail_segmentation(file, "does not say what its frames show (PerFrameFunctionalGroups)");
  const auto shared = values.sequence(Tag(0x5200, 0x9229));
  std::optional<DicomValues> of_all;
  if (shared != nullptr && shared->GetNumberOfItems() > 0)
    of_all.emplace(shared->GetItem(1).GetNestedDataSet());
  Plane size;
  size.rows = values.binary<std::uint16_t>(Tag(0x0028, 0x0010)).value_or(0);
  size.columns = values.binary<std::uint16_t>(Tag(0x0028, 0x0011)).value_or(0);
  std::vector<SegmentFrame> frames;
  for (std::size_t f = 1; f <= per_frame->GetNumberOfItems(); ++f)
    frames.push_back(read_frame_of_segment(
        file, {DicomValues(per_frame->GetItem(f).GetNestedDataSet()), of_all}, size, f));
  return frames;
}

/// The heights of the slices along the normal of the first frame, in order. Throws unless all
/// frames lie above each other.
std::vector<double> heights_of(const fs::path& file, const std::vector<SegmentFrame>& frames) {
  constexpr double same = 0.1;         // [mm]
  constexpr double same_size = 1e-3;   // relative
  constexpr double same_angle = 1e-3;  // sine
  const Plane& first = frames.front().plane;
  std::vector<double> heights;
  for (const SegmentFrame& frame : frames) {
    const Vec3 at = first.pixel(frame.plane.origin);
    if ((frame.plane.along_row - first.along_row).norm() > same_angle ||
        (frame.plane.along_column - first.along_column).norm() > same_angle ||
        std::abs(frame.plane.spacing_i - first.spacing_i) > same_size * first.spacing_i ||
        std::abs(frame.plane.spacing_j - first.spacing_j) > same_size * first.spacing_j ||
        std::hypot(at.x() * first.spacing_i, at.y() * first.spacing_j) > same)
      fail_segmentation(file, "has frames that do not lie straight above each other");
    heights.push_back(at.z());
  }
  std::sort(heights.begin(), heights.end());
  heights.erase(
      std::unique(heights.begin(), heights.end(), [](double a, double b) { return b - a < same; }),
      heights.end());
  return heights;
}

/// Lays the stack, whose slices are the smallest step apart, and gives each frame its slice.
void lay_stack(const fs::path& file, std::vector<SegmentFrame>& frames, Volume& volume) {
  constexpr double uneven = 0.02;  // of a step
  constexpr double most_slices = 10000;
  const std::vector<double> heights = heights_of(file, frames);
  double step = heights.size() > 1 ? heights[1] - heights[0] : frames.front().thickness;
  for (std::size_t h = 1; h < heights.size(); ++h)
    step = std::min(step, heights[h] - heights[h - 1]);
  const double slices = heights.size() > 1 ? (heights.back() - heights.front()) / step : 0.0;
  if (!(step > 0.0) || slices > most_slices)
    fail_segmentation(file, "does not say how thick its slices are");
  const Plane& first = frames.front().plane;
  for (SegmentFrame& frame : frames) {
    const double at = (first.pixel(frame.plane.origin).z() - heights.front()) / step;
    frame.slice = static_cast<int>(std::lround(at));
    if (std::abs(at - frame.slice) > std::max(uneven * at, 0.05))
      fail_segmentation(file, fmt::format("has slices at uneven distances: one lies {:.3f} steps "
                                          "of {:g} mm above the first",
                                          at, step));
  }
  Affine map;
  map << first.spacing_i * first.along_row, first.spacing_j * first.along_column,
      step * first.normal(), first.origin + heights.front() * first.normal();
  volume.size = {first.columns, first.rows, static_cast<int>(std::lround(slices)) + 1};
  lay(map, "ImageOrientationPatient", "mm", volume);
}

/// The frames that show one slice at one time, by segment in order of numbers.
using Shown = std::map<std::pair<int, int>, std::map<int, std::size_t>>;

Shown shown_by_frames(const fs::path& file, const std::vector<SegmentFrame>& frames,
                      const std::map<int, std::string>& names, const std::set<int>& times) {
  Shown shown;
  for (std::size_t f = 0; f < frames.size(); ++f) {
    const auto segment = names.find(frames[f].segment);
    if (segment == names.end())
      fail_segmentation(file, fmt::format("frame {} shows the segment {}, which is not there",
                                          f + 1, frames[f].segment));
    const auto index = static_cast<int>(std::distance(names.begin(), segment));
    const auto time = static_cast<int>(std::distance(times.begin(), times.find(frames[f].time)));
    if (!shown[{time, frames[f].slice}].emplace(index, f).second)
      fail_segmentation(
          file, fmt::format("shows the segment \"{}\" twice on one slice, and does not say at "
                            "which times (TemporalPositionIndex)",
                            segment->second));
  }
  return shown;
}

void fill_slice(const Storage& storage, const std::map<int, std::size_t>& frames, std::size_t first,
                SegmentLabels& label, Volume& volume) {
  std::vector<int> here;
  for (std::size_t p = 0; p < storage.in_frame; ++p) {
    here.clear();
    for (const auto& [segment, frame] : frames)
      if (storage.holds(frame, p))
        here.push_back(segment);
    volume.values[first + p] = static_cast<float>(label(here));
  }
}

Volume segmentation_in(const fs::path& file, const DicomValues& values) {
  Volume volume;
  volume.file = file.string();
  const auto names = segment_names(file, values);
  std::vector<SegmentFrame> frames = frames_of(file, values);
  const Storage storage = storage_of(file, values, frames.size(), frames.front().plane);
  lay_stack(file, frames, volume);
  std::set<int> times;
  for (const SegmentFrame& frame : frames)
    times.insert(frame.time);
  volume.frames = static_cast<int>(times.size());
  const Shown shown = shown_by_frames(file, frames, names, times);
  const double count = static_cast<double>(volume.voxels()) * volume.frames;
  require_memory(volume.file, 2.0 * sizeof(float) * count);
  volume.values.assign(static_cast<std::size_t>(count), 0.0F);
  std::vector<std::string> in_order;
  for (const auto& [number, name] : names)
    in_order.push_back(name);
  SegmentLabels label(in_order);
  for (const auto& [place, on_slice] : shown)
    fill_slice(storage, on_slice,
               volume.voxels() * static_cast<std::size_t>(place.first) +
                   storage.in_frame * static_cast<std::size_t>(place.second),
               label, volume);
  volume.names = label.names();
  if (std::string note = label.note(volume.file); !note.empty())
    volume.notes.push_back(std::move(note));
  if (!storage.binary)
    volume.notes.push_back(fmt::format(
        "{}: its segments are fractional; a pixel counts from half of the largest value on",
        volume.file));
  return volume;
}

Volume read_file_of_segments(const fs::path& file) {
  Volume volume;
  with_data_set(file, segmentation_remedy,
                [&](const DicomValues& values) { volume = segmentation_in(file, values); });
  return volume;
}

}  // namespace

bool holds_dicom_segmentation(const fs::path& file) {
  return dicom_modality(file) == "SEG";
}

Volume read_dicom_segmentation(const fs::path& file) {
  silence_gdcm();
  check_survives(file.string(), [&] { static_cast<void>(read_file_of_segments(file)); });
  return read_file_of_segments(file);
}

}  // namespace lv::image
