#include "lv/scar/infarct.hpp"

#include "lv/base/check.hpp"
#include "lv/base/log.hpp"
#include "lv/base/median.hpp"
#include "lv/case_file/case_lines.hpp"
#include "lv/image/dicom_study.hpp"
#include "lv/image/lookup.hpp"
#include "lv/image/volume_file.hpp"
#include "lv/mesh/cell.hpp"
#include "lv/mesh/infarct.hpp"
#include "lv/mesh/quadratic.hpp"
#include "lv/mesh/surface.hpp"
#include "lv/mesh_io/closed_surface.hpp"
#include "lv/mesh_io/label_volume.hpp"
#include "lv/scar/late_enhancement.hpp"
#include "lv/scar/scar_map.hpp"
#include "lv/scar/scar_threshold.hpp"
#include "lv/scar/slice_moves.hpp"
#include "lv/scar/strain_infarct.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace lv::scar {
namespace {

using case_file::Case;
using mesh::Infarcted;
using mesh::InfarctSource;
using mesh::Mesh;

std::string format_box(const Eigen::AlignedBox3d& box) {
  const Vec3& lower = box.min();
  const Vec3& upper = box.max();
  return fmt::format("from ({:.1f}, {:.1f}, {:.1f}) to ({:.1f}, {:.1f}, {:.1f}) mm", lower.x(),
                     lower.y(), lower.z(), upper.x(), upper.y(), upper.z());
}

/// The box around the wall in image space.
std::string place_of_wall(const anatomy::Shape& shape, const Mesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const Vec3& X : mesh.nodes)
    box.extend(shape.frame.to_image(X));
  return format_box(box);
}

/// What is infarcted of the wall, per element.
struct Infarct {
  Infarcted elements;        ///< whose centre is
  std::vector<double> part;  ///< of its volume
  std::optional<Table> slice_moves;
};

/// Throws unless an element is infarcted; `where` is the infarct's place in words.
void check_found(const Case& c, const anatomy::Shape& shape, const Mesh& mesh,
                 const Infarcted& infarcted, const std::string& where) {
  if (std::find(infarcted.begin(), infarcted.end(), true) == infarcted.end())
    throw InputError(
        case_file::place_of(c, "infarct.source"),
        fmt::format("the infarct ({}) holds the centre of no element of the wall, which reaches {} "
                    "in image space",
                    where, place_of_wall(shape, mesh)),
        "Check the infarct's place, its unit and its size");
}

Infarct within(const Case& c, const anatomy::Shape& shape, const Mesh& mesh,
               const mesh::Region& region, const std::string& where) {
  Infarct infarct{mesh::infarcted_where(mesh, region), {}, {}};
  check_found(c, shape, mesh, infarct.elements, where);
  infarct.part = mesh::infarcted_part(mesh, region);
  return infarct;
}

Infarct described(const Case& c, const anatomy::Shape& shape, const Mesh& mesh) {
  return within(c, shape, mesh, mesh::described_region(mesh, c.scar.described, c.regions),
                "as infarct.described says");
}

Infarct within_surface(const Case& c, const anatomy::Shape& shape, const Mesh& mesh) {
  const std::string file = case_file::beside(c, c.scar.surface).string();
  const mesh_io::ClosedSurface surface = mesh_io::read_closed_surface(file, c.scar.length_unit);
  return within(
      c, shape, mesh,
      [&](const Vec3& X, double) { return surface.contains(shape.frame.to_image(X)); },
      fmt::format("{}: {}", file, format_box(surface.box())));
}

void check_labels(const Case& c, const std::string& file, const std::vector<int>& found) {
  for (const int label : c.scar.scar) {
    if (label == 0)
      throw InputError(case_file::place_of(c, "infarct.labels.scar"),
                       "infarct.labels.scar: 0 is the background of the map, not a tissue",
                       "Name the labels that mean scar");
    if (!std::binary_search(found.begin(), found.end(), label))
      throw InputError(case_file::place_of(c, "infarct.labels.scar"),
                       fmt::format("no voxel of {} has the label {}; it has {}", file, label,
                                   fmt::join(found, ", ")),
                       "Name the labels that mean scar");
  }
}

/// A point of the wall as the shifted images have it.
Vec3 in_images(const Case& c, const anatomy::Shape& shape, const Vec3& X) {
  return shape.frame.to_image(X) - Vec3(c.scar.shift[0], c.scar.shift[1], c.scar.shift[2]);
}

/// A side of the wall as the shifted images have it.
Triangles in_images(const Case& c, const anatomy::Shape& shape, const Mesh& mesh,
                    const mesh::Surface& side) {
  const auto x = [&](int node) { return in_images(c, shape, mesh.nodes[node]); };
  Triangles triangles;
  for (int f = 0; f < side.size(); ++f)
    mesh::for_triangles(side.face(f), [&](int a, int b, int d) {
      triangles.push_back({x(a), x(b), x(d)});
    });
  return triangles;
}

/// Warns where a map shows less than the wall: there is no scar where nothing is shown.
void check_shown(const Mesh& mesh, const std::string& file, const std::function<bool(int)>& shows) {
  constexpr double worth_saying = 0.05;  // of the wall
  if (const double part = unseen_part(mesh, shows); part > worth_saying)
    log::warn("scar: {:.1f}% of the wall lies outside of {}: it is taken as healthy", 100.0 * part,
              file);
}

/// How the slices of a map move until the middle of its muscle lies on that of the wall.
std::vector<Vec3> moves_onto_wall(const Case& c, const anatomy::Shape& shape, const Mesh& mesh,
                                  const image::Volume& volume, std::vector<int> muscle) {
  image::require_labels(volume, 0, c.scar.muscle, case_file::place_of(c, "infarct.labels.muscle"),
                        "infarct.labels.muscle");
  muscle.insert(muscle.end(), c.scar.muscle.begin(), c.scar.muscle.end());
  std::vector<Vec3> moves =
      moves_of_labels(image::cine_of(volume), muscle, in_images(c, shape, mesh, mesh.endo),
                      in_images(c, shape, mesh, mesh.epi));
  for (std::size_t s = 0; s < moves.size(); ++s)
    if (moves[s].norm() > c.anatomy.contours.fit.largest_shift)
      throw InputError(
          case_file::place_of(c, "infarct.labels.in_plane"),
          fmt::format("slice {} of {} would have to move by {:.1f} mm; at most {:g} mm are "
                      "accepted",
                      s + 1, volume.file, moves[s].norm(), c.anatomy.contours.fit.largest_shift),
          "Check that both images share the scanner's coordinates, or set infarct.shift");
  return moves;
}

/// Scar and its dark core.
std::vector<int> infarcted_labels(const Case& c) {
  std::vector<int> labels = c.scar.scar;
  labels.insert(labels.end(), c.scar.no_reflow.begin(), c.scar.no_reflow.end());
  return labels;
}

/// The one frame of a label map that the case means: a person has one scar.
image::Volume scar_map(const Case& c, const std::string& file) {
  image::Volume volume = image::read_volume(file);
  for (const std::string& note : volume.notes)
    log::warn("scar: {}", note);
  if (volume.frames == 1 || c.scar.frame > 0)
    return image::frame_of(volume, std::max(c.scar.frame, 1),
                           case_file::place_of(c, "infarct.labels.frame"));
  std::vector<int> frames = image::frames_with(volume, infarcted_labels(c));
  if (frames.size() > 1)
    throw InputError(case_file::place_of(c, "infarct.labels.file"),
                     fmt::format("{} has {} frames and infarct.labels.frame is not set; there is "
                                 "scar in the frames {}",
                                 volume.file, volume.frames, fmt::join(frames, ", ")),
                     "Choose a frame");
  frames.push_back(1);
  log::info("scar: frame {} of {}", frames.front(), volume.file);
  return image::frame_of(volume, frames.front(), case_file::place_of(c, "infarct.labels.file"));
}

/// Warns where most of a map's scar lies beside the wall.
void check_met(const image::Volume& map, const std::vector<int>& scar, const Mesh& mesh,
               const Infarct& infarct) {
  constexpr double enough = 0.5;  // of the map's scar; some lies above the base, or at the rim
  double drawn = 0.0;
  for (const auto& [label, volume] : image::label_volumes(map))
    if (std::find(scar.begin(), scar.end(), label) != scar.end())
      drawn += volume;
  const double met = mesh::infarct_volumes(mesh, infarct.part).infarct;
  if (met < enough * drawn)
    log::warn(
        "scar: {:.1f} of the {:.1f} ml of scar in {} lie in the wall: check that both share "
        "the scanner's coordinates; infarct.labels.in_plane moves slices onto the wall, "
        "infarct.shift all of it",
        1e-3 * met, 1e-3 * drawn, map.file);
}

/// Whether the scar's map is also that of the wall.
bool is_map_of_wall(const Case& c) {
  return c.anatomy.source == case_file::AnatomySource::labels &&
         case_file::beside(c, c.anatomy.labels.file) == case_file::beside(c, c.scar.labels);
}

/// The labels by which a slice that was drawn is told from one that was not: those of the left
/// ventricle as far as the case names them, else all of the map.
std::vector<int> drawn_labels(const Case& c, const image::Volume& map,
                              const std::vector<int>& scar) {
  std::vector<int> labels = c.scar.muscle;
  if (is_map_of_wall(c))
    for (const std::vector<int>& more : {c.anatomy.labels.cavity, c.anatomy.labels.muscle})
      labels.insert(labels.end(), more.begin(), more.end());
  if (labels.empty())
    for (const auto& [label, volume] : image::label_volumes(map))
      if (label != 0)
        labels.push_back(label);
  labels.insert(labels.end(), scar.begin(), scar.end());
  return labels;
}

/// The slices of a scar's map that were not drawn, between slices that were; none of a map that has
/// scar alone, since it cannot tell them from healthy slices. Warns of both.
std::vector<bool> slices_without_wall(const Case& c, const image::Volume& map,
                                      const std::vector<int>& scar) {
  const std::vector<int> labels = drawn_labels(c, map, scar);
  std::vector<bool> undrawn = image::undrawn_slices(map, labels);
  std::vector<int> numbers;
  for (std::size_t s = 0; s < undrawn.size(); ++s)
    if (undrawn[s])
      numbers.push_back(static_cast<int>(s) + 1);
  if (numbers.empty())
    return undrawn;
  const bool shows_muscle = std::any_of(labels.begin(), labels.end(), [&](int label) {
    return std::find(scar.begin(), scar.end(), label) == scar.end();
  });
  const bool one = numbers.size() == 1;
  log::warn("scar: slice{} {} of {} {} no {} between slices that do: {}", one ? "" : "s",
            fmt::join(numbers, ", "), map.file, one ? "shows" : "show",
            shows_muscle ? "ventricle" : "scar",
            shows_muscle ? "the wall there has the scar of the nearest of them"
                         : "the map has no healthy muscle by which to tell whether it was drawn "
                           "there, and the wall is taken as healthy");
  if (!shows_muscle)
    undrawn.assign(undrawn.size(), false);
  return undrawn;
}

Infarct within_image(const Case& c, const anatomy::Shape& shape, const Mesh& mesh,
                     const std::string& file) {
  const image::Volume volume = scar_map(c, file);
  image::require_labels(volume, 0, c.scar.scar, case_file::place_of(c, "infarct.labels.scar"),
                        "infarct.labels.scar");
  image::require_labels(volume, 0, c.scar.no_reflow,
                        case_file::place_of(c, "infarct.labels.no_reflow"),
                        "infarct.labels.no_reflow");
  check_shown(mesh, file, [&](int cell) {
    return image::shows(volume, in_images(c, shape, mesh::cell_centre(mesh, cell)));
  });
  const std::vector<int> wanted = infarcted_labels(c);
  const std::vector<Vec3> moves =
      c.scar.in_plane ? moves_onto_wall(c, shape, mesh, volume, wanted) : std::vector<Vec3>{};
  const std::vector<bool> undrawn = slices_without_wall(c, volume, wanted);
  Infarct infarct = within(
      c, shape, mesh,
      [&](const Vec3& X, double) {
        const Vec3 x = image::in_drawn_slice(volume, undrawn, in_images(c, shape, X));
        return image::has_label(volume, x, wanted, moves);
      },
      fmt::format("in {}", file));
  check_met(volume, wanted, mesh, infarct);
  return infarct;
}

/// The brightness at the centre of every element; NaN outside the image.
std::vector<double> brightness(const Case& c, const anatomy::Shape& shape, const Mesh& mesh,
                               const image::Cine& lge) {
  std::vector<double> values;
  for (int cell = 0; cell < mesh.cell_count(); ++cell)
    values.push_back(image::sample(lge, in_images(c, shape, mesh::cell_centre(mesh, cell))));
  return values;
}

/// How each slice of a late-enhancement image moves in its plane onto the wall.
std::vector<SliceMove> moves_onto_wall(const Case& c, const anatomy::Shape& shape, const Mesh& mesh,
                                       const image::Cine& image) {
  std::vector<SliceMove> moves =
      register_slices(image, in_images(c, shape, mesh, mesh.endo),
                      in_images(c, shape, mesh, mesh.epi), c.scar.lge.largest_shift);
  if (std::none_of(moves.begin(), moves.end(),
                   [](const SliceMove& m) { return m.evidence == Evidence::clear; }))
    throw InputError(
        case_file::place_of(c, "infarct.lge.in_plane"),
        fmt::format("no slice of {} shows the wall clearly within {:g} mm of its place",
                    c.scar.lge.image, c.scar.lge.largest_shift),
        "Check that both share the scanner's coordinates, or set infarct.shift");
  report_moves(image, moves);
  return moves;
}

void move_slices(image::Cine& image, const std::vector<SliceMove>& moves) {
  for (std::size_t s = 0; s < moves.size(); ++s)
    image.slices[s].frames.front().plane.origin += moves[s].move;
}

/// Warns where most slices of a late-enhancement image, which stay where they are, show the wall
/// clearly elsewhere, or none shows it.
void ask_whether_met(const Case& c, const anatomy::Shape& shape, const Mesh& mesh,
                     const image::Cine& image) {
  constexpr double far = 5.0;  // [mm]; breath-holds differ by less
  const double tried = mesh::LateEnhancement{}.largest_shift;
  const std::vector<SliceMove> moves = register_slices(image, in_images(c, shape, mesh, mesh.endo),
                                                       in_images(c, shape, mesh, mesh.epi), tried);
  std::vector<double> clear;
  int beyond = 0;
  int weak = 0;
  for (const SliceMove& m : moves) {
    if (m.evidence == Evidence::clear)
      clear.push_back(m.move.norm());
    beyond += m.evidence == Evidence::at_limit ? 1 : 0;
    weak += m.evidence == Evidence::weak ? 1 : 0;
  }
  const auto off = static_cast<int>(
      std::count_if(clear.begin(), clear.end(), [](double move) { return move > far; }));
  const int told = static_cast<int>(clear.size()) + beyond;
  if (told + weak == 0 || (2 * (off + beyond) <= told && told > 0))
    return;
  log::warn(
      "late enhancement: {} does not show the wall where it lies: of {} slices that cross it {} "
      "fit it better {:g} to {:g} mm away, {} farther away than that, and {} nowhere clearly. "
      "Check that both share the scanner's coordinates; infarct.lge.in_plane moves slices onto the "
      "wall, infarct.shift all of them",
      c.scar.lge.image, told + weak, off, far, tried, beyond, weak);
}

/// Moves the slices of `stack` onto the wall as an image shows it, if the case asks for it, and
/// tells how.
std::optional<Table> settle(const Case& c, const anatomy::Shape& shape, const Mesh& mesh,
                            const image::Cine& image, image::Cine& stack) {
  if (!c.scar.lge.in_plane) {
    ask_whether_met(c, shape, mesh, image);
    return {};
  }
  const std::vector<SliceMove> moves = moves_onto_wall(c, shape, mesh, image);
  move_slices(stack, moves);
  return table_of(image, moves);
}

/// The part of the wall's volume that is infarcted.
double part_of_wall(const Mesh& mesh, const std::vector<double>& part) {
  const mesh::InfarctVolumes volumes = mesh::infarct_volumes(mesh, part);
  return volumes.infarct / volumes.wall;
}

/// So large a scar is rarely meant: the threshold may be wrong.
void check_extent(const Case& c, const Mesh& mesh, const Infarct& infarct, double threshold) {
  const double part = part_of_wall(mesh, infarct.part);
  if (part > c.scar.lge.largest_part)
    throw InputError(
        case_file::place_of(c, "infarct.lge.threshold"),
        fmt::format("{:.1f}% of the wall is scar (brighter than {:.4g} in {}); more than {:g}% is "
                    "rarely meant",
                    100.0 * part, threshold, c.scar.lge.image, 100.0 * c.scar.lge.largest_part),
        "Check infarct.lge.threshold, zero, remote and deviations; if so large a scar is meant, "
        "raise infarct.lge.largest_part");
}

/// The median brightness of the blood: on the long axis, and on the way to the endocardium up to
/// 0.6 of it, clear of papillary muscles. NaN where the image shows nothing of it.
double brightness_of_blood(const Case& c, const anatomy::Shape& shape, const Mesh& mesh,
                           const image::Cine& lge) {
  std::vector<double> greys;
  for (int f = 0; f < mesh.endo.size(); ++f) {
    const Vec3 x = mesh::face_centre(mesh.nodes, mesh.endo.face(f));
    for (const double part : {0.0, 0.3, 0.6}) {
      const Vec3 inside(part * x.x(), part * x.y(), x.z());
      if (const double grey = image::sample(lge, in_images(c, shape, inside)); !std::isnan(grey))
        greys.push_back(grey);
    }
  }
  return greys.empty() ? std::nan("") : median(std::move(greys));
}

/// Warns where blood is brighter than all of the wall: half of the brightest is then that of its
/// rim at the endocardium, which blood brightens.
void ask_whether_blood_is_bright(const Case& c, const anatomy::Shape& shape, const Mesh& mesh,
                                 const image::Cine& lge, const std::vector<double>& values) {
  if (c.scar.lge.threshold != mesh::ScarThreshold::fwhm)
    return;
  const double brightest = brightest_of(values);
  const double blood = brightness_of_blood(c, shape, mesh, lge);
  if (blood > brightest)
    log::warn(
        "late enhancement: the blood is brighter ({:.4g}, the median within the endocardium) than "
        "anything of the wall (at most {:.4g}), as where there is no scar or the blood was not "
        "dimmed: half of the brightest then marks the rim of the endocardium, which blood "
        "brightens. Look at the scar; threshold = \"sd\" with remote segments, or a scar that is "
        "drawn (infarct.lge.drawn), do not depend on it",
        blood, brightest);
}

Infarct with_dark_core(const Mesh& mesh, Infarct infarct) {
  const Infarcted filled = mesh::with_enclosed(mesh, infarct.elements);
  for (std::size_t e = 0; e < filled.size(); ++e)
    if (filled[e] && !infarct.elements[e])
      infarct.part[e] = 1.0;
  infarct.elements = filled;
  return infarct;
}

/// What an observer drew on the image, or left as it was proposed.
Infarct as_drawn(const Case& c, const anatomy::Shape& shape, const Mesh& mesh) {
  const image::Cine lge = read_late_enhancement(c);
  const std::string file = case_file::beside(c, c.scar.lge.drawn).string();
  image::Cine scar = scar_stack(read_scar_map(file, lge), lge);
  std::optional<Table> slice_moves = settle(c, shape, mesh, lge, scar);
  Infarct infarct = within(
      c, shape, mesh,
      [&](const Vec3& X, double) { return image::sample(scar, in_images(c, shape, X)) > 0.5; },
      fmt::format("drawn in {}", file));
  infarct.slice_moves = std::move(slice_moves);
  return infarct;
}

Infarct by_brightness(const Case& c, const anatomy::Shape& shape, const Mesh& mesh) {
  image::Cine lge = read_late_enhancement(c);
  std::optional<Table> slice_moves = settle(c, shape, mesh, lge, lge);
  const std::vector<double> values = brightness(c, shape, mesh, lge);
  if (std::all_of(values.begin(), values.end(), [](double v) { return std::isnan(v); }))
    throw InputError(case_file::place_of(c, "infarct.lge.image"),
                     fmt::format("{} shows nothing of the wall, which reaches {} in image space",
                                 c.scar.lge.image, place_of_wall(shape, mesh)),
                     "Check that both share the scanner's coordinates");
  check_shown(mesh, c.scar.lge.image, [&](int cell) { return !std::isnan(values[cell]); });
  const double threshold = scar_threshold(c, mesh, lge, values);
  ask_whether_blood_is_bright(c, shape, mesh, lge, values);
  log::info("late enhancement: scar is brighter than {:.4g}", threshold);
  Infarct infarct = within(
      c, shape, mesh,
      [&](const Vec3& X, double) { return image::sample(lge, in_images(c, shape, X)) > threshold; },
      fmt::format("brighter than {:.4g} in {}", threshold, c.scar.lge.image));
  infarct.slice_moves = std::move(slice_moves);
  if (c.scar.lge.fill_no_reflow)
    infarct = with_dark_core(mesh, std::move(infarct));
  check_extent(c, mesh, infarct, threshold);
  return infarct;
}

Infarct within_labels(const Case& c, const anatomy::Shape& shape, const Mesh& mesh) {
  const std::string file = case_file::beside(c, c.scar.labels).string();
  if (image::is_volume_name(file))
    return within_image(c, shape, mesh, file);
  const mesh_io::LabelVolume volume(file, c.scar.array, c.scar.length_unit);
  check_labels(c, file, volume.labels());
  check_shown(mesh, file, [&](int cell) {
    return volume.box().contains(in_images(c, shape, mesh::cell_centre(mesh, cell)));
  });
  const std::vector<int> wanted = infarcted_labels(c);
  return within(
      c, shape, mesh,
      [&](const Vec3& X, double) { return volume.has(in_images(c, shape, X), wanted); },
      fmt::format("in {}: {}", file, format_box(volume.box())));
}

Infarct of_elements(const Case& c, const anatomy::Shape& shape, const Mesh& mesh) {
  check_found(c, shape, mesh, shape.infarcted, fmt::format("the elements of \"{}\"", c.scar.set));
  return {shape.infarcted, {shape.infarcted.begin(), shape.infarcted.end()}, {}};
}

/// Whole parts of the wall; none where all of them shorten.
Infarct by_strain(const Case& c, const Mesh& mesh) {
  const std::vector<StrainVerdict> verdicts = strain_verdicts(c, mesh::divide(mesh, c.regions));
  log::warn("the infarct is {}", describe(c, verdicts));
  Infarct infarct{
      Infarcted(mesh.cell_count(), false), std::vector<double>(mesh.cell_count(), 0.0), {}};
  for (const StrainVerdict& v : verdicts)
    for (const int cell : v.cells) {
      infarct.elements[cell] = infarct.elements[cell] || v.is_infarct;
      infarct.part[cell] = infarct.elements[cell] ? 1.0 : 0.0;
    }
  return infarct;
}

/// Files may mean something else than was thought; who describes an infarct knows its size.
void ask_if_large(const Case& c, const Mesh& mesh, const Infarct& infarct) {
  constexpr double large = 0.5;
  const bool by_threshold =  // see check_extent
      c.scar.source == InfarctSource::lge && c.scar.lge.drawn.empty();
  const bool from_file = c.scar.source != InfarctSource::described && !by_threshold;
  const double part = part_of_wall(mesh, infarct.part);
  if (from_file && part > large)
    log::warn("the infarct is {:.1f}% of the wall: is so large a scar meant?", 100.0 * part);
}

/// A border zone of most of the wall surrounds many small patches, not one scar.
void ask_if_scattered(const Case& c, const Mesh& mesh, const Infarct& infarct,
                      const std::vector<double>& field) {
  constexpr double large = 0.5;  // of the wall
  if (c.scar.source == InfarctSource::described)
    return;
  Mesh bordered = mesh;
  bordered.infarct = field;
  const mesh::InfarctVolumes v = mesh::infarct_volumes(bordered, infarct.part);
  if (v.border > large * v.wall)
    log::warn(
        "the border zone is {:.1f}% of the wall ({:.2f} ml) around {:.2f} ml of infarct: is the "
        "scar scattered, as by noise or blood at the endocardium, or infarct.border ({:g} mm) too "
        "wide?",
        100.0 * v.border / v.wall, 1e-3 * v.border, 1e-3 * v.infarct, c.scar.border);
}

Infarct infarcted(const Case& c, const anatomy::Shape& shape, const Mesh& mesh) {
  switch (c.scar.source) {
    case InfarctSource::described:
      return described(c, shape, mesh);
    case InfarctSource::surface:
      return within_surface(c, shape, mesh);
    case InfarctSource::labels:
      return within_labels(c, shape, mesh);
    case InfarctSource::strain:
      return by_strain(c, mesh);
    case InfarctSource::lge:
      return c.scar.lge.drawn.empty() ? by_brightness(c, shape, mesh) : as_drawn(c, shape, mesh);
    default:
      return of_elements(c, shape, mesh);
  }
}

/// What the source needs of a late-enhancement image. Which segments are remote is asked with the
/// scar of each choice where the image can be read (see scar_threshold).
case_file::Missing missing_of_lge(const Case& c, std::string& found) {
  const mesh::LateEnhancement& lge = c.scar.lge;
  case_file::Missing missing;
  if (lge.image.empty())
    missing.add(
        {"infarct.lge.image", case_file::fill_in,
         "the late-enhancement image: a file (NIfTI, NRRD, MetaImage) or a folder of DICOM files"});
  std::error_code failed;
  if (!lge.image.empty() && lge.series.empty() &&
      std::filesystem::is_directory(case_file::beside(c, lge.image), failed)) {
    const image::DicomStudy study =
        image::read_dicom_study(std::array{case_file::beside(c, lge.image)});
    if (study.stacks.size() > 1) {
      missing.add({"infarct.lge.series", case_file::fill_in, "the late-enhancement images"});
      found = fmt::format("{} holds{}", lge.image, image::choices(study));
    }
  }
  if (!missing.empty() && lge.drawn.empty() && lge.remote.empty() &&
      lge.threshold == mesh::ScarThreshold::sd)
    missing.add({"infarct.lge.remote", case_file::fill_in,
                 "AHA segments (1 to 17) of remote, healthy muscle, such as [4, 5]; not needed "
                 "with threshold = \"fwhm\""});
  return missing;
}

case_file::Missing missing_of_labels(const Case& c) {
  case_file::Missing missing;
  if (c.scar.labels.empty())
    missing.add(
        {"infarct.labels.file", case_file::fill_in, "the labelled volume that holds the infarct"});
  if (c.scar.in_plane && c.scar.muscle.empty())
    missing.add({"infarct.labels.muscle", case_file::fill_in,
                 "the labels of the other muscle: in_plane moves slices by the middle of all "
                 "muscle"});
  return missing;
}

}  // namespace

double unseen_part(const Mesh& mesh, const std::function<bool(int)>& shows) {
  double wall = 0.0;
  double unseen = 0.0;
  const std::vector<double> volumes = mesh::cell_volumes(mesh);
  for (int cell = 0; cell < mesh.cell_count(); ++cell) {
    wall += volumes[cell];
    if (!shows(cell))
      unseen += volumes[cell];
  }
  return unseen / wall;
}

void require_infarct(const Case& c) {
  std::string found;
  case_file::Missing missing;
  if (c.scar.source == InfarctSource::labels)
    missing = missing_of_labels(c);
  if (c.scar.source == InfarctSource::lge)
    missing = missing_of_lge(c, found);
  if (c.scar.source == InfarctSource::strain && c.scar_strain.file.empty())
    missing.add({"infarct.strain.file", case_file::fill_in,
                 "the strains of segments, with the columns slice, segment and strain"});
  if (c.scar.source == InfarctSource::surface && c.scar.surface.empty())
    missing.add(
        {"infarct.surface.file", case_file::fill_in, "the closed surface that holds the infarct"});
  missing.raise(c, case_file::place_of(c, "infarct.source"), found);
}

InfarctExtent infarct_extent(const Case& c, const anatomy::Shape& shape, const Mesh& mesh) {
  if (c.scar.source == InfarctSource::mesh)
    return {mesh.infarct, mesh::part_by_extent(mesh), {}};
  InfarctExtent none{
      std::vector<double>(mesh.nodes.size(), 0.0), std::vector<double>(mesh.cell_count(), 0.0), {}};
  if (c.scar.source == InfarctSource::none)
    return none;
  require_infarct(c);
  Infarct infarct = infarcted(c, shape, mesh);
  if (std::find(infarct.elements.begin(), infarct.elements.end(), true) == infarct.elements.end())
    return none;  // all of the wall shortens
  ask_if_large(c, mesh, infarct);
  std::vector<double> field = mesh::infarct_field(mesh, infarct.elements, c.scar.border);
  ask_if_scattered(c, mesh, infarct, field);
  return {std::move(field), std::move(infarct.part), std::move(infarct.slice_moves)};
}

Table infarct_table(const Case& c, const anatomy::MeshResult& wall) {
  Table table({"segment", "name", "wall_ml", "infarct_ml", "infarct_g", "infarct_percent",
               "transmurality_percent"});
  for (const mesh::SegmentInfarct& s :
       mesh::infarct_by_segment(wall.mesh, wall.infarcted, wall.regions, c.regions))
    table.add_row({std::to_string(s.segment), mesh::aha_name(s.segment),
                   Table::number(1e-3 * s.wall), Table::number(1e-3 * s.infarct),
                   Table::number(1e3 * c.muscle_density * s.infarct),
                   Table::number(s.wall > 0.0 ? 100.0 * s.infarct / s.wall : 0.0),
                   Table::number(100.0 * s.transmurality)});
  return table;
}

std::string describe_infarct(const Case& c, const anatomy::MeshResult& wall) {
  const mesh::InfarctVolumes v = mesh::infarct_volumes(wall.mesh, wall.infarcted);
  if (v.infarct + v.border == 0.0)
    return "";
  const auto part = [&](const char* name, double volume) {
    return fmt::format("{}: {:.2f} ml ({:.1f}% of the wall), {:.1f} g", name, 1e-3 * volume,
                       100.0 * volume / v.wall, 1e3 * c.muscle_density * volume);
  };
  const bool whole =
      c.scar.source == InfarctSource::mesh || c.scar.source == InfarctSource::elements;
  return part("infarct", v.infarct) + "; " + part("border zone", v.border) +
         (whole ? "" : " (by the infarcted parts of elements; zones are of whole elements)");
}

}  // namespace lv::scar
