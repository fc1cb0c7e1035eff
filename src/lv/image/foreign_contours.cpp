#include "lv/image/foreign_contours.hpp"

#include "lv/base/check.hpp"
#include "lv/base/files.hpp"
#include "lv/base/formats.hpp"
#include "lv/geometry/contour_measures.hpp"
#include "lv/image/cvi42.hpp"
#include "lv/image/rt_structures.hpp"
#include "lv/image/segment_mat.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

namespace lv::image {
namespace {

namespace fs = std::filesystem;
using geometry::Side;

struct ContourFormat {
  bool (*holds)(const fs::path&);
  ForeignContours (*read)(const fs::path&);
};

constexpr std::array<ContourFormat, 3> contour_formats{{{holds_segment_mat, read_segment_mat},
                                                        {holds_rt_structures, read_rt_structures},
                                                        {holds_cvi42, read_cvi42}}};

/// An image of a stack: slice and phase, from 1.
struct OnImage {
  const DicomImage* image = nullptr;
  int slice = 0, phase = 0;
};

std::map<std::string, OnImage> images_by_uid(const DicomStack& stack) {
  std::map<std::string, OnImage> places;
  for (std::size_t s = 0; s < stack.slices.size(); ++s)
    for (std::size_t p = 0; p < stack.slices[s].images.size(); ++p) {
      const DicomImage& image = stack.slices[s].images[p];
      places[image.instance_uid] = {&image, static_cast<int>(s) + 1, static_cast<int>(p) + 1};
    }
  return places;
}

/// A loop with its place among slices and times.
struct Placed {
  geometry::Contour contour;
  int phase = 1;
};

/// Points in pixels: (0, 0) is the outer corner of the first pixel.
std::vector<Vec3> in_space(const std::vector<Vec3>& pixels, const Plane& plane,
                           const std::string& file) {
  std::vector<Vec3> points;
  for (const Vec3& x : pixels) {
    if (!(x.x() >= -1.0 && x.y() >= -1.0 && x.x() <= plane.columns + 1.0 &&
          x.y() <= plane.rows + 1.0))
      throw InputError(
          file,
          fmt::format("a point ({:g}, {:g}) of a contour lies outside its image of {} x {} pixels",
                      x.x(), x.y(), plane.columns, plane.rows),
          "Give the images that the contours were drawn on");
    points.push_back(plane.point(x.x() - 0.5, x.y() - 0.5));
  }
  return points;
}

/// Throws InputError for a loop in space that does not lie on the image that it names.
void check_on_plane(const ForeignContours& drawn, const ForeignLoop& loop, const Plane& plane) {
  constexpr double farthest = 1.0;  // [mm]; coordinates are written to a hundredth or better
  double most = 0.0;
  for (const Vec3& x : loop.points)
    most = std::max(most, std::abs(plane.pixel(x).z()));
  if (most > farthest)
    throw InputError(
        drawn.file,
        fmt::format("a contour of \"{}\" lies {:.1f} mm off the plane of the image that it names "
                    "(SOPInstanceUID {})",
                    loop.name, most, loop.image_uid),
        "Contours or images were moved, or are of another study: give those that belong together, "
        "or leave anatomy.contour_file.images out, if the file has one time alone");
}

Placed on_image(const ForeignContours& drawn, const ForeignLoop& loop, Side side,
                const std::map<std::string, OnImage>& images) {
  const auto found = images.find(loop.image_uid);
  if (loop.image_uid.empty() || found == images.end())
    throw InputError(
        drawn.file,
        loop.image_uid.empty()
            ? fmt::format("a contour of \"{}\" does not say on which image it was drawn", loop.name)
            : fmt::format("a contour of \"{}\" was drawn on the image with the SOPInstanceUID {}, "
                          "which is not among the images",
                          loop.name, loop.image_uid),
        loop.image_uid.empty()
            ? "Leave anatomy.contour_file.images out, if the file has one time alone"
            : "Name the folder, and the series, of the images that the contours were drawn on");
  const auto& [image, slice, phase] = found->second;
  if (!drawn.in_pixels)
    check_on_plane(drawn, loop, image->plane);
  return {{slice,
           side,
           drawn.in_pixels ? in_space(loop.points, image->plane, drawn.file) : loop.points,
           drawn.file,
           {}},
          phase};
}

Vec3 centre_of(const std::vector<Vec3>& points) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& x : points)
    sum += x;
  return sum / static_cast<double>(points.size());
}

/// The unit normal of a loop; zero of one without an area.
Vec3 normal_of(const std::vector<Vec3>& points) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t p = 0; p < points.size(); ++p)
    sum += (points[p] - points[0]).cross(points[(p + 1) % points.size()] - points[0]);
  return sum.norm() > 0.0 ? Vec3(sum.normalized()) : Vec3(Vec3::Zero());
}

/// Numbers slices by the heights of their planes along the normal of the first loop that has one.
void number_slices(std::vector<Placed>& placed) {
  constexpr double same_plane = 0.5;  // [mm]
  Vec3 normal = Vec3::Zero();
  for (const Placed& p : placed)
    if (normal.isZero())
      normal = normal_of(p.contour.points);
  std::vector<std::pair<double, Placed*>> heights;
  for (Placed& p : placed)
    heights.emplace_back(normal.dot(centre_of(p.contour.points)), &p);
  std::sort(heights.begin(), heights.end(),
            [](const auto& a, const auto& b) { return a.first < b.first; });
  int slice = 0;
  for (std::size_t h = 0; h < heights.size(); ++h) {
    if (h == 0 || heights[h].first - heights[h - 1].first > same_plane)
      ++slice;
    heights[h].second->contour.slice = slice;
  }
}

std::vector<Placed> placed_loops(const ForeignContours& drawn, const std::string& endo,
                                 const std::string& epi, const DicomStack* images) {
  const auto by_uid = images != nullptr ? images_by_uid(*images) : std::map<std::string, OnImage>();
  if (images == nullptr && drawn.in_pixels)
    throw InputError(drawn.file, "has its contours in pixels of images that are not named",
                     "Set anatomy.contour_file.images to the folder of the DICOM images");
  std::vector<Placed> placed;
  for (const ForeignLoop& loop : drawn.loops) {
    if ((loop.name != endo && loop.name != epi) || loop.points.empty())
      continue;
    const Side side = loop.name == endo ? Side::endo : Side::epi;
    if (images != nullptr)
      placed.push_back(on_image(drawn, loop, side, by_uid));
    else
      placed.push_back({{0, side, loop.points, drawn.file, {}}, std::max(loop.phase, 1)});
  }
  if (images == nullptr)
    number_slices(placed);
  return placed;
}

void require_structure(const ForeignContours& drawn, const std::string& name,
                       const std::string& parameter) {
  const auto all = structures(drawn);
  if (all.contains(name))
    return;
  if (const auto other = drawn.not_read.find(name); other != drawn.not_read.end())
    throw InputError(drawn.file,
                     fmt::format("has \"{}\", but as {}: no closed contours, which alone are read",
                                 name, other->second),
                     "Export it as closed contours (CLOSED_PLANAR)");
  throw InputError(drawn.file, fmt::format("has no contours called \"{}\"", name),
                   fmt::format("Name one of these in {}:\n{}", parameter, describe(drawn)));
}

/// Throws InputError where the structures seem to be exchanged: wherever both are drawn on a slice
/// the one that is named as endocardium encloses more.
void check_sides(const ForeignContours& drawn, const std::string& endo, const std::string& epi,
                 const std::vector<geometry::Contour>& loops) {
  int both = 0;
  int larger = 0;
  for (const geometry::Contour& inner : loops) {
    const geometry::Contour* outer = geometry::find(loops, inner.slice, Side::epi);
    if (inner.side != Side::endo || outer == nullptr)
      continue;
    ++both;
    larger += geometry::enclosed_area(inner) > geometry::enclosed_area(*outer) ? 1 : 0;
  }
  if (both > 0 && larger == both)
    throw InputError(drawn.file,
                     fmt::format("on all {} slices with both, \"{}\" (endocardium) encloses more "
                                 "than \"{}\" (epicardium)",
                                 both, endo, epi),
                     "Exchange anatomy.contour_file.endo and anatomy.contour_file.epi");
}

}  // namespace

bool holds_contours(const fs::path& file) {
  return std::any_of(contour_formats.begin(), contour_formats.end(),
                     [&](const ContourFormat& format) { return format.holds(file); });
}

ForeignContours read_contours(const fs::path& file) {
  require_readable(file, "Check the name of the file of contours");
  for (const ContourFormat& format : contour_formats)
    if (format.holds(file))
      return format.read(file);
  throw InputError(file.string(), "is no file of contours of a known kind",
                   fmt::format("Contours are read from {}", formats::contours));
}

std::map<std::string, int> structures(const ForeignContours& drawn) {
  std::map<std::string, int> all;
  for (const ForeignLoop& loop : drawn.loops)
    ++all[loop.name];
  return all;
}

std::string describe(const ForeignContours& drawn) {
  std::string text;
  for (const auto& [name, count] : structures(drawn)) {
    std::set<int> phases;
    for (const ForeignLoop& loop : drawn.loops)
      if (loop.name == name && loop.phase > 0)
        phases.insert(loop.phase);
    text += fmt::format("  \"{}\": {} contour{}{}\n", name, count, count == 1 ? "" : "s",
                        phases.empty() ? "" : fmt::format(" at {} times", phases.size()));
  }
  for (const auto& [name, what] : drawn.not_read)
    text += fmt::format("  \"{}\": {}, no closed contours: not read\n", name, what);
  return text.empty() ? "  no contours\n" : text;
}

DrawnPhases arranged(const ForeignContours& drawn, const std::string& endo, const std::string& epi,
                     const DicomStack* images) {
  if (endo == epi)
    throw InputError(drawn.file, fmt::format("endocardium and epicardium are both \"{}\"", endo),
                     "Name two structures in anatomy.contour_file.endo and "
                     "anatomy.contour_file.epi: the wall lies between them");
  require_structure(drawn, endo, "anatomy.contour_file.endo");
  require_structure(drawn, epi, "anatomy.contour_file.epi");
  DrawnPhases arranged;
  arranged.notes = drawn.notes;
  for (Placed& p : placed_loops(drawn, endo, epi, images)) {
    std::vector<geometry::Contour>& loops = arranged.phases[p.phase].short_axis;
    if (geometry::find(loops, p.contour.slice, p.contour.side) != nullptr)
      throw InputError(drawn.file,
                       fmt::format("draws the {}cardium of slice {}{} twice",
                                   geometry::name(p.contour.side), p.contour.slice,
                                   images != nullptr ? fmt::format(" at phase {}", p.phase) : ""),
                       images != nullptr
                           ? "Keep one of the contours"
                           : "If they are of several times, name the images they were drawn on "
                             "(anatomy.contour_file.images), which say when; else keep one");
    geometry::drop_repeats(p.contour);
    loops.push_back(std::move(p.contour));
  }
  for (const auto& [phase, contours] : arranged.phases)
    check_sides(drawn, endo, epi, contours.short_axis);
  for (auto& [phase, contours] : arranged.phases)
    std::stable_sort(contours.short_axis.begin(), contours.short_axis.end(),
                     [](const auto& a, const auto& b) { return a.slice < b.slice; });
  return arranged;
}

}  // namespace lv::image
