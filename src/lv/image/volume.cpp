#include "lv/image/volume.hpp"

#include "lv/base/check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace lv::image {
namespace {

/// The two axes of a slice.
std::array<int, 2> axes_across(int axis) {
  return axis == 0 ? std::array{1, 2} : axis == 1 ? std::array{0, 2} : std::array{0, 1};
}

void require_frame(const Volume& volume, int frame, const std::string& where) {
  if (frame < 1 || frame > volume.frames)
    throw InputError(where,
                     fmt::format("{} has {} frame{}; there is no frame {}", volume.file,
                                 volume.frames, volume.frames == 1 ? "" : "s", frame),
                     "Frames are counted from 1");
}

}  // namespace

int slice_axis(const Volume& volume) {
  int largest = 2;
  for (const int d : {0, 1})
    if (volume.spacing[d] > volume.spacing[largest])
      largest = d;
  constexpr double thick = 1.2;
  for (const int d : {0, 1, 2})
    if (d != largest && volume.spacing[largest] < thick * volume.spacing[d])
      return 2;
  return largest;
}

std::vector<Picture> slices(const Volume& volume, int axis, int frame) {
  const auto [a, b] = axes_across(axis);
  std::vector<Picture> pictures;
  for (int s = 0; s < volume.size[axis]; ++s) {
    std::array<int, 3> ijk{};
    ijk[axis] = s;
    Picture picture;
    picture.plane = {volume.point(Vec3(ijk[0], ijk[1], ijk[2])),
                     volume.directions.col(a),
                     volume.directions.col(b),
                     volume.spacing[a],
                     volume.spacing[b],
                     volume.size[a],
                     volume.size[b]};
    for (ijk[b] = 0; ijk[b] < volume.size[b]; ++ijk[b])
      for (ijk[a] = 0; ijk[a] < volume.size[a]; ++ijk[a])
        picture.values.push_back(volume.at(ijk[0], ijk[1], ijk[2], frame));
    pictures.push_back(std::move(picture));
  }
  return pictures;
}

Cine cine_of(const Volume& volume) {
  const int axis = slice_axis(volume);
  Cine cine;
  cine.notes = volume.notes;
  for (int s = 0; s < volume.size[axis]; ++s)
    cine.slices.push_back({fmt::format("slice {}", s + 1), {}, {}, 0.0});
  for (int f = 0; f < volume.frames; ++f) {
    std::vector<Picture> pictures = slices(volume, axis, f);
    for (int s = 0; s < volume.size[axis]; ++s) {
      cine.slices[s].frames.push_back(std::move(pictures[s]));
      if (volume.time_step > 0.0)
        cine.slices[s].times.push_back(f * volume.time_step);
    }
  }
  return cine;
}

double spacing_of(const Cine& cine) {
  std::vector<double> heights;
  const Plane& first = cine.slices.front().frames.front().plane;
  for (const CineSlice& slice : cine.slices)
    heights.push_back(first.pixel(slice.frames.front().plane.origin).z());
  std::sort(heights.begin(), heights.end());
  return heights.size() < 2
             ? 0.0
             : (heights.back() - heights.front()) / static_cast<double>(heights.size() - 1);
}

std::size_t nearest_slice(const Cine& cine, const Vec3& x) {
  const auto distance = [&](std::size_t s) {
    return std::abs(cine.slices[s].frames.front().plane.pixel(x).z());
  };
  std::size_t nearest = 0;
  for (std::size_t s = 1; s < cine.slices.size(); ++s)
    if (distance(s) < distance(nearest))
      nearest = s;
  return nearest;
}

Volume frame_of(const Volume& volume, int frame, const std::string& where) {
  require_frame(volume, frame, where);
  Volume one = volume;
  const auto first =
      volume.values.begin() +
      static_cast<std::ptrdiff_t>(volume.voxels() * static_cast<std::size_t>(frame - 1));
  one.values.assign(first, first + static_cast<std::ptrdiff_t>(volume.voxels()));
  one.frames = 1;
  one.time_step = 0.0;
  return one;
}

std::vector<int> frames_with(const Volume& volume, const std::vector<int>& labels) {
  std::vector<int> frames;
  for (int f = 0; f < volume.frames; ++f) {
    const auto* first = volume.values.data() + volume.voxels() * static_cast<std::size_t>(f);
    if (std::any_of(first, first + volume.voxels(), [&](float value) {
          return std::any_of(labels.begin(), labels.end(),
                             [&](int label) { return value == static_cast<float>(label); });
        }))
      frames.push_back(f + 1);
  }
  return frames;
}

std::map<int, double> label_volumes(const Volume& volume, int frame) {
  std::map<int, std::size_t> counts;
  const std::size_t n = volume.voxels();
  for (std::size_t v = 0; v < n; ++v) {
    const float value = volume.values[n * frame + v];
    if (!(std::abs(value) < 1e9F) || value != std::round(value)) {
      const std::size_t i = v % volume.size[0];
      const std::size_t j = v / volume.size[0] % volume.size[1];
      throw InputError(volume.file,
                       fmt::format("voxel ({}, {}, {}) of frame {} has the value {:g}, which is no "
                                   "whole number and so no label",
                                   i, j, v / volume.size[0] / volume.size[1], frame + 1, value),
                       "Save label maps as whole numbers, resampled to the nearest neighbour");
    }
    ++counts[static_cast<int>(value)];
  }
  constexpr std::size_t most = 10000;
  if (counts.size() > most)
    throw InputError(volume.file, fmt::format("has {} different values", counts.size()),
                     "This seems to be an image, not a label map");
  std::map<int, double> volumes;
  for (const auto& [label, count] : counts)
    volumes[label] = static_cast<double>(count) * volume.voxel_volume();
  return volumes;
}

std::string describe(const std::map<int, double>& label_volumes,
                     const std::map<int, std::string>& names) {
  std::string text;
  constexpr int most = 40;
  int listed = 0;
  for (const auto& [label, volume] : label_volumes) {
    if (++listed > most)
      return text + fmt::format(" and {} more", label_volumes.size() - most);
    const auto name = names.find(label);
    text +=
        fmt::format("{}{}{} ({:.2f} ml)", text.empty() ? "" : ", ", label,
                    name == names.end() ? "" : fmt::format(" \"{}\"", name->second), 1e-3 * volume);
  }
  return text;
}

void require_labels(const Volume& volume, int frame, const std::vector<int>& labels,
                    const std::string& where, const std::string& parameter,
                    const std::string& remedy) {
  require_frame(volume, frame + 1, where);
  const auto present = label_volumes(volume, frame);
  for (const int label : labels) {
    if (label == 0)
      throw InputError(where,
                       fmt::format("0 is the background of the map, no label of {}; {} has {}",
                                   parameter, volume.file, describe(present, volume.names)),
                       remedy);
    if (!present.contains(label))
      throw InputError(
          where,
          fmt::format("no voxel of {}{} has the label {} of {}; it has {}", volume.file,
                      volume.frames > 1 ? fmt::format(", frame {},", frame + 1) : "", label,
                      parameter, describe(present, volume.names)),
          remedy);
  }
}

}  // namespace lv::image
