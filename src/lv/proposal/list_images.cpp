#include "lv/proposal/list_images.hpp"

#include "lv/anatomy/drawn.hpp"
#include "lv/base/check.hpp"
#include "lv/base/files.hpp"
#include "lv/image/dicom_study.hpp"
#include "lv/image/label_contours.hpp"
#include "lv/image/label_meaning.hpp"
#include "lv/image/pixel_grid.hpp"
#include "lv/image/sunnybrook.hpp"
#include "lv/image/volume_file.hpp"
#include "lv/proposal/propose_case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace lv::proposal {
namespace {

namespace fs = std::filesystem;

std::string direction_text(const Vec3& d) {
  return fmt::format("({:.3f}, {:.3f}, {:.3f})", d.x(), d.y(), d.z());
}

/// The range of the values of an image, and how many are none.
std::string describe_values(const image::Volume& v) {
  std::vector<float> values = v.values;
  std::erase_if(values, [](float x) { return std::isnan(x); });
  std::string text;
  if (const std::size_t none = v.values.size() - values.size(); none > 0)
    text =
        fmt::format("  note: {} voxel{} no finite number\n", none, none == 1 ? " holds" : "s hold");
  if (values.empty())
    return text;
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  return text + fmt::format("  values {:g} to {:g}: an image, no labels\n", *least, *most);
}

/// The labels of every frame that has any.
std::string describe_labels(const image::Volume& v) {
  std::string text;
  int without = 0;
  for (int f = 0; f < v.frames; ++f) {
    const auto volumes = image::label_volumes(v, f);
    const bool empty = volumes.size() == 1 && volumes.contains(0);
    without += empty ? 1 : 0;
    if (!empty)
      text += fmt::format("  labels of frame {}: {}\n", f + 1, image::describe(volumes, v.names));
  }
  if (without > 0)
    text += fmt::format("  {} of {} frames hold no label but 0\n", without, v.frames);
  return text;
}

/// See image::unusual_pixels: those of the slices.
std::string unusual_pixels_of(const image::Volume& v) {
  const int axis = image::slice_axis(v);
  return image::unusual_pixels(v.spacing[(axis + 1) % 3], v.spacing[(axis + 2) % 3]);
}

std::string list_volume(const fs::path& file, const ListOptions& options) {
  const image::Volume v = image::read_labels(file);
  std::string text = fmt::format(
      "{}: {} x {} x {} voxels of {:.3f} x {:.3f} x {:.3f} mm, {} frame{}{}\n"
      "  axes (LPS): i {}, j {}, k {}; slices across {}\n",
      v.file, v.size[0], v.size[1], v.size[2], v.spacing.x(), v.spacing.y(), v.spacing.z(),
      v.frames, v.frames == 1 ? "" : "s",
      v.time_step > 0.0 ? fmt::format(" {:.0f} ms apart", 1e3 * v.time_step) : "",
      direction_text(v.directions.col(0)), direction_text(v.directions.col(1)),
      direction_text(v.directions.col(2)), "ijk"[image::slice_axis(v)]);
  for (const std::string& note : v.notes)
    text += fmt::format("  note: {}\n", note);
  if (const std::string note = unusual_pixels_of(v); !note.empty())
    text += fmt::format("  note: {}\n", note);
  if (!image::seems_labels(v)) {
    if (!options.cavity.empty())
      throw InputError(
          v.file,
          "holds values that are no labels (whole numbers from 0 to 255, or few up to 65535)",
          "Leave --cavity out, or give a label map");
    return text + describe_values(v);
  }
  text += describe_labels(v);
  if (options.cavity.empty())
    return text;
  for (const int label : options.cavity) {
    if (label == 0)
      throw InputError(
          "--cavity", "0 is the background of the map",
          fmt::format("Frame 1 has {}", image::describe(image::label_volumes(v), v.names)));
    if (std::find(v.values.begin(), v.values.end(), static_cast<float>(label)) == v.values.end())
      throw InputError(
          "--cavity", fmt::format("no voxel of {} has the label {}", v.file, label),
          fmt::format("Frame 1 has {}", image::describe(image::label_volumes(v), v.names)));
  }
  return text + anatomy::describe_volume_curve(image::volume_curve(v, options.cavity)) + "\n";
}

std::string list_skipped(const image::DicomStudy& study) {
  constexpr std::size_t most = 20;
  std::string text;
  for (std::size_t i = 0; i < std::min(most, study.skipped.size()); ++i)
    text +=
        fmt::format("skipped {}: {}\n", study.skipped[i].place.string(), study.skipped[i].reason);
  if (study.skipped.size() > most)
    text += fmt::format("skipped {} files more\n", study.skipped.size() - most);
  return text;
}

/// The NIfTI files among those of a folder, as many public studies are kept.
std::string list_volume_among(const image::DicomStudy& study, const ListOptions& options) {
  std::string text;
  for (const LeftOut& item : study.skipped) {
    if (!image::is_volume_name(item.place) || !unreadable(item.place).empty())
      continue;
    try {
      text += list_volume(item.place, options);
    } catch (const InputError& error) {
      text += fmt::format("{}\n", error.what());
    }
  }
  return text;
}

std::string list_study(const image::DicomStudy& study, const ListOptions& options) {
  std::string text = image::describe(study);
  image::require_images(study, options.where.string());
  text += list_skipped(study);
  if (options.contours.empty())
    return text;
  const image::DicomStack stack =
      image::choose_stack(study, options.series, options.where.string(), "--series");
  const image::DrawnPhases drawn = image::read_sunnybrook(
      options.contours, stack, image::PixelOrigin::corner, image::DrawnBy::manual);
  text += fmt::format("contours of {}\n{}\n", options.contours.string(),
                      anatomy::describe_phases(drawn.phases));
  for (const std::string& note : drawn.notes)
    text += fmt::format("  note: {}\n", note);
  return text;
}

/// What ends every list.
std::string for_a_case(const ListOptions& options, const Proposal& proposal) {
  if (proposal.lines.empty())
    return "";
  return fmt::format("\nFor a case file (`ventricle new --from {}` writes it):\n\n{}",
                     options.where.string(), case_file::case_lines(proposal.lines));
}

std::string list_dicom(const ListOptions& options) {
  const image::DicomStudy study = image::read_dicom_study(std::array{options.where});
  if (study.stacks.empty())
    if (std::string text = list_volume_among(study, options); !text.empty())
      return text;
  const std::string list = list_study(study, options);  // first, with the messages of its own
  return list + for_a_case(options, propose(study, options.where.string(), options.contours,
                                            options.contours.string()));
}

}  // namespace

std::string list_images(const ListOptions& options) {
  const SourceKind kind = kind_of(options.where);
  if (kind == SourceKind::dicom)
    return list_dicom(options);
  const Proposal proposal = propose(options.where, options.where.string());
  const std::string text =
      kind == SourceKind::volume ? list_volume(options.where, options) : proposal.what + "\n";
  return text + for_a_case(options, proposal);
}

}  // namespace lv::proposal
