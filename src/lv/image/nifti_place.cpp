#include "lv/image/nifti_place.hpp"

#include "lv/base/check.hpp"
#include "lv/image/place.hpp"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace lv::image {
namespace {

constexpr double same_length = 1e-2;  // relative
constexpr double unit_error = 1e-3;   // of the length of a unit vector
constexpr double same_place = 0.1;    // of a voxel, between sform and qform

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

/// Sizes have no sign: some programs mean a mirrored axis by one, which the standard leaves to the
/// sform and the qform.
void note_negative_sizes(const NiftiHeader& header, Volume& volume) {
  const Vec3 sizes(header.pixdim[1], header.pixdim[2], header.pixdim[3]);
  if (sizes.minCoeff() < 0.0)
    volume.notes.push_back(
        fmt::format("{}: of its voxel sizes (pixdim) {} some are negative: they are taken without "
                    "the sign, which mirrors nothing; check the orientation",
                    volume.file, three(sizes)));
}

/// Whether an axis of several voxels has no size.
bool lacks_size(const Vec3& sizes, const Volume& volume) {
  for (int d = 0; d < 3; ++d)
    if (volume.size[d] > 1 && sizes[d] == 0.0)
      return true;
  return false;
}

/// Of an affine map that says nothing.
void note_nothing_said(Volume& volume) {
  if (volume.spacing.isOnes() && volume.origin.isZero() && volume.directions.isApprox(to_lps()))
    volume.notes.push_back(
        fmt::format("{} says that its voxels measure 1 x 1 x 1 mm and begin at the origin, as "
                    "files of programs do that have lost both: check its volumes",
                    volume.file));
}

}  // namespace

void lay_by_header(const NiftiHeader& header, Volume& volume) {
  check_finite(header, volume);
  const Unit unit = length_unit(header, volume);
  const Vec3 sizes = Vec3(header.pixdim[1], header.pixdim[2], header.pixdim[3]).cwiseAbs();
  note_negative_sizes(header, volume);
  const bool has_sform = header.sform_code > 0 && !header.rows.leftCols<3>().isZero();
  const auto in_space = [&](const Affine& map) -> Affine { return unit.mm * to_lps() * map; };
  if (has_sform) {
    Affine map = header.rows;
    map.leftCols<3>() *= mend_lengths(map, sizes, volume).asDiagonal();
    lay(in_space(map), "sform", unit.name, volume);
  } else if (header.qform_code > 0) {
    lay(in_space(qform(header, sizes, volume)), "qform", unit.name, volume);
  } else if (lacks_size(sizes, volume)) {
    fail(volume,
         fmt::format("does not say how large its voxels are: pixdim is {}, and there is neither "
                     "sform nor qform",
                     three(sizes)),
         "Save it again with the sizes and the place of its voxels, or correct the header");
  } else {
    Affine map = Affine::Identity();
    map.diagonal() = (sizes.array() > 0.0).select(unit.mm * sizes, 1.0);
    lay(map, "pixdim", unit.name, volume);
    volume.notes.push_back(fmt::format(
        "{} does not say how it lies in space (neither sform nor qform): its axes are taken to "
        "point to the left, the back and the head; if it is mirrored, so are the regions",
        volume.file));
  }
  if (has_sform && header.qform_code > 0)
    check_agrees(volume, in_space(qform(header, sizes, volume)));
  note_nothing_said(volume);
}

}  // namespace lv::image
