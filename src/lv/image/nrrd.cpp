#include "lv/image/nrrd.hpp"

#include "lv/base/check.hpp"
#include "lv/base/files.hpp"
#include "lv/base/lines.hpp"
#include "lv/base/memory.hpp"
#include "lv/base/printable.hpp"
#include "lv/base/trial.hpp"
#include "lv/image/place.hpp"
#include "lv/image/segments.hpp"

#include <NrrdIO.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <memory>
#include <optional>

namespace lv::image {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const std::string& file, const std::string& what,
                       const std::string& remedy) {
  throw InputError(file, what, remedy);
}

/// A file as the library of the format has read it.
using Loaded = std::unique_ptr<Nrrd, Nrrd* (*)(Nrrd*)>;

constexpr const char* state_space =
    "Set \"space: left-posterior-superior\" or \"space: right-anterior-superior\" in its header, "
    "whichever is true: else the heart may be mirrored";

/// Throws InputError for a header with directions of which no line before says in what space they
/// are: the library of the format takes them for damaged.
void check_space_is_stated(const fs::path& file) {
  constexpr std::size_t enough = 65536;  // a header ends with its first empty line
  const std::string text = first_bytes(file, enough);
  const auto lines = fields_of(text, '\n');
  const auto end = std::find_if(lines.begin(), lines.end(),
                                [](std::string_view line) { return trimmed(line).empty(); });
  const auto find = [&](std::initializer_list<std::string_view> keys) {
    return std::find_if(lines.begin(), end, [&](std::string_view line) {
      return std::any_of(keys.begin(), keys.end(), [&](std::string_view key) {
        return line.starts_with(key) && trimmed(line.substr(key.size())).starts_with(':');
      });
    });
  };
  const auto space = find({"space", "space dimension"});
  const auto placed = find({"space directions", "space origin"});
  if (placed == end || space < placed)
    return;
  if (space == end)
    fail(file.string(), "does not state the space of its directions", state_space);
  fail(file.string(),
       fmt::format("states its space in line {}, behind line {}, which needs it",
                   space - lines.begin() + 1, placed - lines.begin() + 1),
       fmt::format("Put \"{}\" before it", printable(trimmed(*space))));
}

Loaded load(const fs::path& file) {
  Loaded nrrd(nrrdNew(), nrrdNuke);
  if (nrrdLoad(nrrd.get(), file.c_str(), nullptr) == 0)
    return nrrd;
  check_space_is_stated(file);
  const std::unique_ptr<char, void (*)(void*)> said(biffGetDone(NRRD), std::free);
  std::string last = said ? said.get() : "";
  last = std::string(trimmed(last));
  last = last.substr(last.rfind('\n') + 1);
  fail(file.string(), fmt::format("cannot be read as NRRD: {}", printable(last)),
       "The file seems to be truncated, damaged or packed by bzip2; of a .nhdr, the voxels must "
       "lie beside it: save or copy it again");
}

/// What the axes of the array are.
struct Axes {
  std::vector<unsigned> space;
  std::optional<unsigned> others;  ///< frames, or the layers of segments
};

bool is_number(const double* v, unsigned n) {
  return std::all_of(v, v + n, [](double x) { return std::isfinite(x); });
}

/// Whether steps along an axis lead through space, not through time.
bool leads_through_space(const Nrrd& nrrd, unsigned axis) {
  const double* d = nrrd.axis[axis].spaceDirection;
  return nrrd.spaceDim >= 3 && is_number(d, nrrd.spaceDim) &&
         (d[0] != 0.0 || d[1] != 0.0 || d[2] != 0.0);
}

Axes axes_of(const Nrrd& nrrd, const std::string& file) {
  Axes axes;
  int more = 0;
  for (unsigned a = 0; a < nrrd.dim; ++a) {
    const int kind = nrrd.axis[a].kind;
    if (leads_through_space(nrrd, a)) {
      axes.space.push_back(a);
    } else if (nrrd.axis[a].size == 1) {
      continue;
    } else if (kind > nrrdKindList && kind != nrrdKindStub && kind != nrrdKindScalar) {
      fail(file, fmt::format("has {} values per voxel, as colours or vectors", nrrd.axis[a].size),
           "Give an image of grey values or labels");
    } else {
      ++more;
      axes.others = a;
    }
  }
  if (axes.space.size() != 3)
    fail(file,
         fmt::format("has {} axes with a direction in space where three are needed",
                     axes.space.size()),
         "Save it as a volume with \"space directions\"");
  if (more > 1)
    fail(file, fmt::format("has {} axes more than those of space", more),
         "Save an image of three or four");
  return axes;
}

/// Signs that turn the file's space to LPS.
Vec3 to_lps(const Nrrd& nrrd, const std::string& file) {
  switch (nrrd.space) {
    case nrrdSpaceRightAnteriorSuperior:
    case nrrdSpaceRightAnteriorSuperiorTime:
      return {-1.0, -1.0, 1.0};
    case nrrdSpaceLeftAnteriorSuperior:
    case nrrdSpaceLeftAnteriorSuperiorTime:
      return {1.0, -1.0, 1.0};
    case nrrdSpaceLeftPosteriorSuperior:
    case nrrdSpaceLeftPosteriorSuperiorTime:
      return {1.0, 1.0, 1.0};
    default:
      fail(file,
           nrrd.space == nrrdSpaceUnknown ? "does not state the space of its directions"
                                          : "states a space that is not the patient's",
           state_space);
  }
}

std::string text_of(const char* text) {
  return text == nullptr ? "" : printable(trimmed(text));
}

struct Unit {
  std::string name;
  double mm;
};

/// The file's unit of length; millimetres if it states none, as most do.
Unit unit_of(const Nrrd& nrrd, const std::string& file) {
  const std::string said = text_of(nrrd.spaceUnits[0]);
  for (const unsigned d : {1U, 2U})
    if (text_of(nrrd.spaceUnits[d]) != said)
      fail(file, "has several units of length (space units)", "Save it in mm");
  if (said.empty())
    return {"mm, as the file names no unit", 1.0};
  for (const auto& [name, mm] :
       {std::pair("mm", 1.0), {"cm", 10.0}, {"m", 1e3}, {"um", 1e-3}, {"\xc2\xb5m", 1e-3}})
    if (said == name)
      return {said, mm};
  fail(file, fmt::format("has the unknown unit of length \"{}\" (space units)", said),
       "mm, cm, m and um are read");
}

void lay_volume(const Nrrd& nrrd, const Axes& axes, Volume& volume) {
  const Vec3 signs = to_lps(nrrd, volume.file);
  const Unit unit = unit_of(nrrd, volume.file);
  Affine map;
  for (int d = 0; d < 3; ++d)
    map.col(d) = unit.mm * signs.cwiseProduct(Vec3(nrrd.axis[axes.space[d]].spaceDirection));
  if (!is_number(nrrd.spaceOrigin, 3))
    fail(volume.file, "does not state where its first voxel lies (space origin)",
         "Save it again from the program that made it");
  map.col(3) = unit.mm * signs.cwiseProduct(Vec3(nrrd.spaceOrigin));
  lay(map, "space directions", unit.name, volume);
}

/// The time between frames, where spacing and unit are stated.
void set_time_step(const Nrrd& nrrd, unsigned axis, Volume& volume) {
  constexpr double longest_cycle = 5.0;  // [s]
  const NrrdAxisInfo& time = nrrd.axis[axis];
  const bool in_space = nrrd.spaceDim == 4 && is_number(time.spaceDirection, 4);
  const double step = in_space ? std::abs(time.spaceDirection[3]) : time.spacing;
  const std::string unit = text_of(in_space ? nrrd.spaceUnits[3] : time.units);
  const double seconds = unit == "s" || unit == "sec"     ? 1.0
                         : unit == "ms" || unit == "msec" ? 1e-3
                                                          : 0.0;
  if (std::isfinite(step) && step > 0.0 && seconds > 0.0 &&
      step * seconds * volume.frames <= longest_cycle)
    volume.time_step = step * seconds;
  else
    volume.notes.push_back(fmt::format(
        "{} does not state the time between its {} frames, with its unit, or one that is no "
        "heart's: times are taken as not known",
        volume.file, volume.frames));
}

template <class Stored>
float value_of(const void* data, std::size_t at) {
  Stored stored;
  std::memcpy(&stored, static_cast<const char*>(data) + at * sizeof(Stored), sizeof(Stored));
  const auto value = static_cast<float>(stored);
  return std::isfinite(value) ? value : std::numeric_limits<float>::quiet_NaN();
}

using ValueOf = float (*)(const void*, std::size_t);

ValueOf reader_of(const Nrrd& nrrd, const std::string& file) {
  switch (nrrd.type) {
    case nrrdTypeChar:
      return value_of<signed char>;
    case nrrdTypeUChar:
      return value_of<unsigned char>;
    case nrrdTypeShort:
      return value_of<short>;
    case nrrdTypeUShort:
      return value_of<unsigned short>;
    case nrrdTypeInt:
      return value_of<int>;
    case nrrdTypeUInt:
      return value_of<unsigned>;
    case nrrdTypeLLong:
      return value_of<long long>;
    case nrrdTypeULLong:
      return value_of<unsigned long long>;
    case nrrdTypeFloat:
      return value_of<float>;
    case nrrdTypeDouble:
      return value_of<double>;
    default:
      fail(file, "holds blocks of bytes", "Give an image of grey values or labels");
  }
}

/// The values in the volume's order; what lies along the other axis as frames.
void copy_values(const Nrrd& nrrd, const Axes& axes, Volume& volume) {
  const ValueOf value = reader_of(nrrd, volume.file);
  std::vector<std::size_t> stride(nrrd.dim, 1);
  for (unsigned a = 1; a < nrrd.dim; ++a)
    stride[a] = stride[a - 1] * nrrd.axis[a - 1].size;
  volume.values.reserve(volume.voxels() * static_cast<std::size_t>(volume.frames));
  for (int f = 0; f < volume.frames; ++f)
    for (int k = 0; k < volume.size[2]; ++k)
      for (int j = 0; j < volume.size[1]; ++j)
        for (int i = 0; i < volume.size[0]; ++i) {
          const std::size_t at =
              stride[axes.space[0]] * static_cast<std::size_t>(i) +
              stride[axes.space[1]] * static_cast<std::size_t>(j) +
              stride[axes.space[2]] * static_cast<std::size_t>(k) +
              (axes.others ? stride[*axes.others] * static_cast<std::size_t>(f) : std::size_t{0});
          volume.values.push_back(value(nrrd.data, at));
        }
}

/// A segment of 3D Slicer.
struct Segment {
  std::string name;
  int label = 0, layer = 0;
};

std::optional<std::string> said_of(const Nrrd& nrrd, std::size_t segment, const char* what) {
  const std::unique_ptr<char, void (*)(void*)> said(
      nrrdKeyValueGet(&nrrd, fmt::format("Segment{}_{}", segment, what).c_str()), std::free);
  return said ? std::optional(text_of(said.get())) : std::nullopt;
}

std::vector<Segment> segments_of(const Nrrd& nrrd, const std::string& file) {
  std::vector<Segment> segments;
  for (std::size_t s = 0; said_of(nrrd, s, "ID") || said_of(nrrd, s, "Name"); ++s) {
    const auto name = said_of(nrrd, s, "Name");
    Segment segment{name ? *name : *said_of(nrrd, s, "ID"), 0, 0};
    const auto label = number_of<int>(said_of(nrrd, s, "LabelValue").value_or(""));
    const auto layer = number_of<int>(said_of(nrrd, s, "Layer").value_or("0"));
    if (!label || !layer)
      fail(file,
           fmt::format("does not state by a whole number which label and layer its segment \"{}\" "
                       "has (Segment{}_LabelValue, _Layer)",
                       segment.name, s),
           "Save it with a 3D Slicer of version 4.11 or later");
    segment.label = *label;
    segment.layer = *layer;
    segments.push_back(segment);
  }
  return segments;
}

void check_layers(const std::vector<Segment>& segments, const Volume& volume) {
  for (const Segment& s : segments)
    if (s.layer < 0 || s.layer >= volume.frames)
      fail(volume.file,
           fmt::format("has {} layer{}, but its segment \"{}\" lies in layer {}, counted from 0",
                       volume.frames, volume.frames == 1 ? "" : "s", s.name, s.layer),
           "The file seems to be damaged: save it again");
}

/// Whether every label stands for one segment, in a single layer: labels stay as they are.
bool labels_tell(const std::vector<Segment>& segments, int layers) {
  std::map<int, int> of_label;
  for (const Segment& s : segments)
    ++of_label[s.label];
  return layers == 1 && !of_label.contains(0) &&
         std::all_of(of_label.begin(), of_label.end(), [](const auto& n) { return n.second == 1; });
}

/// Makes one map of labels of several layers.
void join_layers(const std::vector<Segment>& segments, Volume& volume) {
  std::vector<std::string> names;
  for (const Segment& s : segments)
    names.push_back(s.name);
  SegmentLabels label(names);
  const std::size_t n = volume.voxels();
  std::vector<float> joined(n);
  std::vector<int> here;
  for (std::size_t v = 0; v < n; ++v) {
    here.clear();
    for (std::size_t s = 0; s < segments.size(); ++s)
      if (volume.values[n * static_cast<std::size_t>(segments[s].layer) + v] ==
          static_cast<float>(segments[s].label))
        here.push_back(static_cast<int>(s));
    joined[v] = static_cast<float>(label(here));
  }
  volume.values = std::move(joined);
  volume.frames = 1;
  volume.names = label.names();
  if (std::string note = label.note(volume.file); !note.empty())
    volume.notes.push_back(std::move(note));
}

void name_labels(const std::vector<Segment>& segments, Volume& volume) {
  check_layers(segments, volume);
  if (!labels_tell(segments, volume.frames))
    return join_layers(segments, volume);
  for (const Segment& s : segments)
    volume.names[s.label] = s.name;
}

}  // namespace

Volume read_nrrd(const fs::path& file) {
  require_readable(file, "Check the name of the file");
  check_survives(file.string(), [&] { static_cast<void>(load(file)); });
  const Loaded nrrd = load(file);
  Volume volume;
  volume.file = file.string();
  const Axes axes = axes_of(*nrrd, volume.file);
  for (int d = 0; d < 3; ++d)
    volume.size[d] = static_cast<int>(nrrd->axis[axes.space[d]].size);
  volume.frames = axes.others ? static_cast<int>(nrrd->axis[*axes.others].size) : 1;
  lay_volume(*nrrd, axes, volume);
  require_memory(volume.file, 2.0 * sizeof(float) * static_cast<double>(volume.voxels()) *
                                  static_cast<double>(volume.frames));
  copy_values(*nrrd, axes, volume);
  if (const auto segments = segments_of(*nrrd, volume.file); !segments.empty())
    name_labels(segments, volume);
  else if (axes.others)
    set_time_step(*nrrd, *axes.others, volume);
  return volume;
}

}  // namespace lv::image
