#include "lv/image/nifti_place.hpp"

#include "lv/base/check.hpp"

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace lv::image {
namespace {

using Affine = Eigen::Matrix<double, 3, 4>;

constexpr double right_angle_error = 0.1;  // [degrees]
constexpr double same_length = 1e-2;       // relative
constexpr double unit_error = 1e-3;        // of the length of a unit vector
constexpr double same_place = 0.1;         // of a voxel, between sform and qform
constexpr double farthest_origin = 1e6;    // of an image from the scanner's centre [mm]
constexpr double to_degrees = 180.0 / std::numbers::pi;

[[noreturn]] void fail(const Volume& volume, const std::string& what, const std::string& remedy) {
  throw InputError(volume.file, what, remedy);
}

std::string three(const Vec3& v) {
  return fmt::format("({:.4g}, {:.4g}, {:.4g})", v.x(), v.y(), v.z());
}

struct Unit {
  const char* name;
  double mm;
};

/// The unit of length (the NIfTI standard's xyzt_units, bits 0 to 2).
Unit length_unit(const NiftiHeader& header, const Volume& volume) {
  switch (header.units & 7) {
    case 0:
      return {"mm, as the file names no unit", 1.0};
    case 1:
      return {"m", 1e3};
    case 2:
      return {"mm", 1.0};
    case 3:
      return {"um", 1e-3};
    default:
      fail(volume, fmt::format("its unit of length has the unknown code {}", header.units & 7),
           "Set xyzt_units to mm, and sizes and place in mm");
  }
}

/// RAS to LPS.
Mat3 to_lps() {
  return Vec3(-1.0, -1.0, 1.0).asDiagonal();
}

void set_axes(const Affine& map, Volume& volume) {
  volume.origin = map.col(3);
  for (int d = 0; d < 3; ++d) {
    volume.spacing[d] = map.col(d).norm();
    volume.directions.col(d) = map.col(d).normalized();
  }
}

/// Refuses axes that are not at right angles; makes those that nearly are orthonormal.
void straighten(Volume& volume) {
  for (int d = 0; d < 3; ++d) {
    if (!(volume.spacing[d] > 0.0))
      fail(volume, fmt::format("its axis {} has the length 0", "ijk"[d]),
           "Correct the sform, or pixdim, in the header");
    const int e = (d + 1) % 3;
    const double cosine = volume.directions.col(d).dot(volume.directions.col(e));
    const double angle = std::acos(std::clamp(cosine, -1.0, 1.0)) * to_degrees;
    if (!(std::abs(angle - 90.0) < right_angle_error))
      fail(volume,
           fmt::format(
               "its sform is sheared: its axes are not at right angles, {} and {} are {:.2f} "
               "degrees apart",
               "ijk"[d], "ijk"[e], angle),
           "Resample the image to a rectangular grid");
  }
  const Eigen::JacobiSVD<Mat3> svd(volume.directions, Eigen::ComputeFullU | Eigen::ComputeFullV);
  volume.directions = svd.matrixU() * svd.matrixV().transpose();
}

/// Decides between the lengths of the sform and the sizes of voxels, both in the file's unit.
/// Returns what each column must be multiplied by.
Vec3 mend_lengths(const Affine& sform, const Vec3& sizes, Volume& volume) {
  const Vec3 lengths = sform.leftCols<3>().colwise().norm();
  if (((lengths - sizes).array().abs() <= same_length * lengths.array()).all())
    return Vec3::Ones();
  const std::string what =
      fmt::format("the lengths of its sform {} are not its voxel sizes (pixdim) {}", three(lengths),
                  three(sizes));
  const auto ones = [](const Vec3& v) { return ((v.array() - 1.0).abs() < unit_error).all(); };
  if (ones(lengths) && sizes.minCoeff() > 0.0) {
    volume.notes.push_back(volume.file + ": " + what +
                           ": the sform seems to hold directions alone, and the sizes are taken");
    return sizes;
  }
  if (ones(sizes) || sizes.isZero()) {
    volume.notes.push_back(volume.file + ": " + what +
                           ": the sizes seem not to be set, and the lengths are taken");
    return Vec3::Ones();
  }
  fail(volume, what, "Correct whichever is wrong in the header: volumes depend on it");
}

/// The map of the qform from voxels to RAS (the NIfTI standard's method 2), in the file's unit.
Affine qform(const NiftiHeader& header, const Vec3& sizes, const Volume& volume) {
  constexpr double rounding = 1e-3;
  Vec3 v = header.quaternion;
  if (!(v.norm() < 1.0 + rounding))
    fail(volume, fmt::format("its qform's quaternion {} is no rotation", three(v)),
         "Correct the qform, or set its code to 0");
  if (v.norm() > 1.0)
    v.normalize();
  const double a = std::sqrt(std::max(0.0, 1.0 - v.squaredNorm()));
  Affine map;
  map.leftCols<3>() = Eigen::Quaterniond(a, v.x(), v.y(), v.z()).normalized().toRotationMatrix();
  const double handed = header.pixdim[0] < 0.0 ? -1.0 : 1.0;
  map.leftCols<3>() *= Vec3(sizes.x(), sizes.y(), handed * sizes.z()).asDiagonal();
  map.col(3) = header.offset;
  return map;
}

/// Refuses a map that puts a corner of a volume elsewhere.
void check_agrees(const Volume& volume, const Affine& other) {
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 ijk((corner & 1) != 0 ? volume.size[0] - 1 : 0,
                   (corner & 2) != 0 ? volume.size[1] - 1 : 0,
                   (corner & 4) != 0 ? volume.size[2] - 1 : 0);
    const double apart = (volume.point(ijk) - other * ijk.homogeneous()).norm();
    if (!(apart < std::max(same_place * volume.spacing.minCoeff(), 1e-2)))
      fail(volume,
           fmt::format("its sform and its qform put a corner of the image {:.1f} mm apart", apart),
           "Correct the header so that both agree, or set the code of the wrong one to 0");
  }
}

/// Refuses numbers that are none before anything is computed from them.
void check_finite(const NiftiHeader& header, const Volume& volume) {
  const auto check = [&](const char* of, const auto& numbers) {
    for (const double number : numbers)
      if (!std::isfinite(number))
        fail(volume, fmt::format("cannot be read as NIfTI: its header has {:g} in {}", number, of),
             "The file seems to be damaged: save or copy it again");
  };
  check("pixdim", std::vector<double>(header.pixdim.begin(), header.pixdim.begin() + 4));
  if (header.qform_code > 0) {
    check("the qform", header.quaternion);
    check("the qform", header.offset);
  }
  if (header.sform_code > 0)
    check("the sform", header.rows.reshaped());
}

/// Refuses voxels that are no part of a person, before anything is resampled to their size.
void check_sizes(const Volume& volume, const Unit& unit) {
  if (volume.spacing.minCoeff() < smallest_pixel || volume.spacing.maxCoeff() > largest_pixel)
    fail(volume,
         fmt::format("its voxels measure {:g} x {:g} x {:g} mm (unit of the file: {})",
                     volume.spacing.x(), volume.spacing.y(), volume.spacing.z(), unit.name),
         "Correct the unit (xyzt_units) or the sizes in the header");
  if (volume.origin.cwiseAbs().maxCoeff() > farthest_origin)
    fail(volume, fmt::format("its first voxel lies at {} mm", three(volume.origin)),
         "Correct the place in the header");
}

/// Of an affine map that says nothing.
void note_nothing_said(Volume& volume) {
  if (volume.spacing.isOnes() && volume.origin.isZero() && volume.directions.isApprox(to_lps()))
    volume.notes.push_back(
        fmt::format("{} says that its voxels measure 1 x 1 x 1 mm and begin at the origin, as "
                    "files of programs "
                    "do that have lost both: check its volumes",
                    volume.file));
}

}  // namespace

void lay_by_header(const NiftiHeader& header, Volume& volume) {
  check_finite(header, volume);
  const Unit unit = length_unit(header, volume);
  const Vec3 sizes = Vec3(header.pixdim[1], header.pixdim[2], header.pixdim[3]).cwiseAbs();
  const bool has_sform = header.sform_code > 0 && !header.rows.leftCols<3>().isZero();
  const auto in_space = [&](const Affine& map) -> Affine { return unit.mm * to_lps() * map; };
  if (has_sform) {
    Affine map = header.rows;
    map.leftCols<3>() *= mend_lengths(map, sizes, volume).asDiagonal();
    set_axes(in_space(map), volume);
  } else if (header.qform_code > 0) {
    set_axes(in_space(qform(header, sizes, volume)), volume);
  } else {
    volume.spacing = (sizes.array() > 0.0).select(unit.mm * sizes, 1.0);
    volume.notes.push_back(
        fmt::format("{} does not say how it lies in space (neither sform nor qform): its axes are "
                    "taken to point "
                    "to the left, the back and the head; if it is mirrored, so are the regions",
                    volume.file));
  }
  straighten(volume);
  check_sizes(volume, unit);
  if (has_sform && header.qform_code > 0)
    check_agrees(volume, in_space(qform(header, sizes, volume)));
  note_nothing_said(volume);
}

}  // namespace lv::image
