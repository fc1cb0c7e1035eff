#include "lv/image/short_axis_labels.hpp"

#include "lv/base/units.hpp"
#include "lv/image/lookup.hpp"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace lv::image {
namespace {

constexpr double largest_angle = 15.0 * units::degree;
constexpr double coarsest = 3.0;  // voxel [mm]

enum Tissue : std::uint8_t { rest, blood, wall };

/// The tissue of every voxel of a frame.
class Tissues {
 public:
  Tissues(const Volume& volume, const std::vector<int>& cavity, const std::vector<int>& muscle,
          int frame)
      : size_(volume.size) {
    const auto first = volume.values.begin() + static_cast<std::ptrdiff_t>(volume.voxels()) * frame;
    for (auto value = first; value != first + static_cast<std::ptrdiff_t>(volume.voxels()); ++value)
      tissues_.push_back(is_one_of(*value, cavity)   ? blood
                         : is_one_of(*value, muscle) ? wall
                                                     : rest);
  }

  [[nodiscard]] Tissue at(const Eigen::Array3i& ijk) const {
    for (int d = 0; d < 3; ++d)
      if (ijk[d] < 0 || ijk[d] >= size_[d])
        return rest;
    return tissues_[(static_cast<std::size_t>(ijk[2]) * size_[1] + ijk[1]) * size_[0] + ijk[0]];
  }

  /// Calls visit(ijk, tissue) for every voxel that is not rest.
  template <class Visit>
  void visit_ventricle(const Visit& visit) const {
    for (int k = 0; k < size_[2]; ++k)
      for (int j = 0; j < size_[1]; ++j)
        for (int i = 0; i < size_[0]; ++i)
          if (const Tissue tissue = at({i, j, k}); tissue != rest)
            visit(Eigen::Array3i(i, j, k), tissue);
  }

  /// At a place between voxels: the largest of the three indicator functions.
  [[nodiscard]] Tissue interpolated(const Vec3& ijk) const {
    const Eigen::Array3d low = ijk.array().floor();
    const Eigen::Array3d u = ijk.array() - low;
    std::array<double, 3> share{};
    for (int corner = 0; corner < 8; ++corner) {
      const Eigen::Array3i step(corner & 1, corner >> 1 & 1, corner >> 2);
      double weight = 1.0;
      for (int d = 0; d < 3; ++d)
        weight *= step[d] == 1 ? u[d] : 1.0 - u[d];
      share[at(low.cast<int>() + step)] += weight;
    }
    return static_cast<Tissue>(std::max_element(share.begin(), share.end()) - share.begin());
  }

 private:
  std::array<int, 3> size_;
  std::vector<Tissue> tissues_;
};

/// The middle of the faces between the cavity and what is neither cavity nor muscle.
std::optional<Vec3> middle_of_base(const Volume& volume, const Tissues& tissues) {
  Vec3 sum = Vec3::Zero();
  double area = 0.0;
  tissues.visit_ventricle([&](const Eigen::Array3i& ijk, Tissue tissue) {
    for (int d = 0; tissue == blood && d < 3; ++d)
      for (const int side : {-1, 1}) {
        Eigen::Array3i step = Eigen::Array3i::Zero();
        step[d] = side;
        if (tissues.at(ijk + step) != rest)
          continue;
        const double face = volume.voxel_volume() / volume.spacing[d];
        sum += face * volume.point((ijk.cast<double>() + 0.5 * step.cast<double>()).matrix());
        area += face;
      }
  });
  if (area == 0.0)
    return std::nullopt;
  return sum / area;
}

/// The voxels of the ventricle in space.
std::vector<Vec3> voxels_of_ventricle(const Volume& volume, const Tissues& tissues) {
  std::vector<Vec3> places;
  tissues.visit_ventricle([&](const Eigen::Array3i& ijk, Tissue) {
    places.push_back(volume.point(ijk.cast<double>().matrix()));
  });
  return places;
}

/// The middle of the hundredth part of some places that is farthest from another.
Vec3 tip(std::vector<Vec3> places, const Vec3& from) {
  const std::size_t count = std::max<std::size_t>(1, places.size() / 100);
  std::nth_element(places.begin(), places.begin() + static_cast<std::ptrdiff_t>(count) - 1,
                   places.end(), [&](const Vec3& a, const Vec3& b) {
                     return (a - from).squaredNorm() > (b - from).squaredNorm();
                   });
  Vec3 sum = Vec3::Zero();
  for (std::size_t n = 0; n < count; ++n)
    sum += places[n];
  return sum / static_cast<double>(count);
}

/// An empty stack of slices downwards from the middle of the base that holds all these places.
Volume empty_stack(const Volume& volume, const std::vector<Vec3>& places, const Vec3& base,
                   const Vec3& towards_apex) {
  Volume stack;
  stack.file = volume.file;
  const double pixel = volume.spacing.minCoeff();
  const double apart = 2.0 * volume.spacing.maxCoeff();
  stack.spacing = Vec3(pixel, pixel, apart);
  const Vec3 across = towards_apex.unitOrthogonal();
  stack.directions << across, towards_apex.cross(across), towards_apex;
  Eigen::AlignedBox3d box;
  for (const Vec3& x : places)
    box.extend(Vec3(stack.directions.transpose() * (x - base)));
  constexpr double margin = 3.0;  // pixels
  const Vec3 low(box.min().x() - margin * pixel, box.min().y() - margin * pixel, 0.5 * apart);
  const Vec3 high(box.max().x() + margin * pixel, box.max().y() + margin * pixel,
                  box.max().z() + apart);
  stack.origin = base + stack.directions * low;
  for (int d = 0; d < 3; ++d)
    stack.size[d] = 1 + static_cast<int>((high[d] - low[d]) / stack.spacing[d]);
  return stack;
}

}  // namespace

std::optional<Volume> on_short_axis(const Volume& volume, const std::vector<int>& cavity,
                                    const std::vector<int>& muscle, int frame) {
  if (volume.spacing.maxCoeff() > coarsest)
    return std::nullopt;
  const Tissues tissues(volume, cavity, muscle, frame);
  const auto base = middle_of_base(volume, tissues);
  if (!base)
    return std::nullopt;
  const std::vector<Vec3> places = voxels_of_ventricle(volume, tissues);
  const Vec3 axis = (tip(places, *base) - *base).normalized();
  const double cosine = std::abs(axis.dot(volume.directions.col(slice_axis(volume))));
  const double angle = std::acos(std::min(1.0, cosine));
  if (angle <= largest_angle)
    return std::nullopt;
  Volume stack = empty_stack(volume, places, *base, axis);
  const std::array<float, 3> label{0.0F, static_cast<float>(cavity.front()),
                                   static_cast<float>(muscle.front())};
  for (int k = 0; k < stack.size[2]; ++k)
    for (int j = 0; j < stack.size[1]; ++j)
      for (int i = 0; i < stack.size[0]; ++i)
        stack.values.push_back(
            label[tissues.interpolated(volume.index(stack.point(Vec3(i, j, k))))]);
  stack.notes = volume.notes;
  stack.notes.push_back(fmt::format(
      "the slices of the label map lie {:.0f} degrees askew to the long axis, which runs from "
      "({:.1f}, {:.1f}, {:.1f}) mm in the middle of the base along ({:.3f}, {:.3f}, {:.3f}): the "
      "labels were resampled to {} slices across it, {:.2g} mm apart, numbered from the base",
      angle / units::degree, base->x(), base->y(), base->z(), axis.x(), axis.y(), axis.z(),
      stack.size[2], stack.spacing.z()));
  return stack;
}

}  // namespace lv::image
