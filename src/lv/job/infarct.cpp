#include "lv/job/infarct.hpp"

#include "lv/base/check.hpp"
#include "lv/mesh/closed_surface.hpp"
#include "lv/mesh/infarct.hpp"
#include "lv/mesh/label_volume.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace lv::job {
namespace {

using mesh::Infarcted;
using mesh::InfarctSource;
using mesh::Mesh;

std::string format_box(const Eigen::AlignedBox3d& box) {
  const Vec3 lower = box.min();
  const Vec3 upper = box.max();
  return fmt::format("from ({:.1f}, {:.1f}, {:.1f}) to ({:.1f}, {:.1f}, {:.1f}) mm", lower.x(),
                     lower.y(), lower.z(), upper.x(), upper.y(), upper.z());
}

/// The box around the wall in image space.
std::string place_of_wall(const Shape& shape, const Mesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const Vec3& X : mesh.nodes)
    box.extend(shape.frame.to_image(X));
  return format_box(box);
}

/// A file that must be named.
std::string file_of(const Case& c, const std::string& parameter, const std::string& name) {
  if (name.empty())
    throw InputError(place_of(c, "infarct.source"), fmt::format("{} is not set", parameter),
                     "Name the file that holds the infarct");
  return beside(c, name).string();
}

/// The infarcted elements, of which there must be one; `where` is the infarct's place in words.
Infarcted checked(const Case& c, const Shape& shape, const Mesh& mesh, Infarcted&& infarcted,
                  const std::string& where) {
  if (std::find(infarcted.begin(), infarcted.end(), true) == infarcted.end())
    throw InputError(
        place_of(c, "infarct.source"),
        fmt::format("the infarct ({}) holds the centre of no element of the wall, which reaches {} "
                    "in image space",
                    where, place_of_wall(shape, mesh)),
        "Check the infarct's place, its unit and its size");
  return std::move(infarcted);
}

Infarcted described(const Case& c, const Shape& shape, const Mesh& mesh) {
  return checked(c, shape, mesh, mesh::infarcted_as_described(mesh, c.scar.described, c.regions),
                 "as infarct.described says");
}

Infarcted within_surface(const Case& c, const Shape& shape, const Mesh& mesh) {
  const std::string file = file_of(c, "infarct.surface.file", c.scar.surface);
  const mesh::ClosedSurface surface = mesh::read_closed_surface(file, c.scar.length_unit);
  return checked(
      c, shape, mesh,
      mesh::infarcted_where(
          mesh, [&](const Vec3& X) { return surface.contains(shape.frame.to_image(X)); }),
      fmt::format("{}: {}", file, format_box(surface.box())));
}

void check_labels(const Case& c, const std::string& file, const std::vector<int>& found) {
  for (const int label : c.scar.scar)
    if (!std::binary_search(found.begin(), found.end(), label))
      throw InputError(place_of(c, "infarct.labels.scar"),
                       fmt::format("no voxel of {} has the label {}; it has {}", file, label,
                                   fmt::join(found, ", ")),
                       "Name the labels that mean scar");
}

Infarcted within_labels(const Case& c, const Shape& shape, const Mesh& mesh) {
  const std::string file = file_of(c, "infarct.labels.file", c.scar.labels);
  const mesh::LabelVolume volume(file, c.scar.array, c.scar.length_unit);
  check_labels(c, file, volume.labels());
  return checked(
      c, shape, mesh,
      mesh::infarcted_where(
          mesh, [&](const Vec3& X) { return volume.has(shape.frame.to_image(X), c.scar.scar); }),
      fmt::format("in {}: {}", file, format_box(volume.box())));
}

Infarcted infarcted(const Case& c, const Shape& shape, const Mesh& mesh) {
  if (c.scar.source == InfarctSource::described)
    return described(c, shape, mesh);
  if (c.scar.source == InfarctSource::surface)
    return within_surface(c, shape, mesh);
  if (c.scar.source == InfarctSource::labels)
    return within_labels(c, shape, mesh);
  return checked(c, shape, mesh, Infarcted(shape.infarcted),
                 fmt::format("the elements of \"{}\"", c.scar.set));
}

}  // namespace

std::vector<double> infarct_extent(const Case& c, const Shape& shape, const Mesh& mesh) {
  if (c.scar.source == InfarctSource::mesh)
    return mesh.infarct;
  if (c.scar.source == InfarctSource::none)
    return std::vector<double>(mesh.nodes.size(), 0.0);
  return mesh::infarct_field(mesh, infarcted(c, shape, mesh), c.scar.border);
}

Ingredients infarct_files(const Case& c) {
  Ingredients files;
  const auto add = [&](const std::string& parameter, const std::string& name) {
    if (!name.empty())
      files["contents of " + parameter] = fingerprint_of_file(beside(c, name));
  };
  if (c.scar.source == InfarctSource::surface)
    add("infarct.surface.file", c.scar.surface);
  if (c.scar.source == InfarctSource::labels)
    add("infarct.labels.file", c.scar.labels);
  return files;
}

std::string describe_infarct(const Case& c, const Mesh& mesh) {
  const mesh::InfarctVolumes v = mesh::infarct_volumes(mesh);
  if (v.infarct + v.border == 0.0)
    return "";
  const auto part = [&](const char* name, double volume) {
    return fmt::format("{}: {:.2f} ml ({:.1f}% of the wall), {:.1f} g", name, 1e-3 * volume,
                       100.0 * volume / v.wall, 1e3 * c.blood.density * volume);
  };
  return part("infarct", v.infarct) + "; " + part("border zone", v.border);
}

}  // namespace lv::job
