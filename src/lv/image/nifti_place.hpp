#pragma once

#include "lv/image/nifti_header.hpp"
#include "lv/image/volume.hpp"

namespace lv::image {

/// Lays a volume, whose file and size are known, as its header says [mm]: by the sform, else by the
/// qform, else along L, P and S. The notes say what of the header contradicts itself and what was
/// believed:
///
/// - Axes less than 0.1 degrees off right angles, by rounding, become orthonormal.
/// - The sform's lengths must be the sizes of voxels (pixdim) to 1%. An sform of unit vectors holds
///   directions alone, its sizes are pixdim; a pixdim of ones says nothing beside an sform that
///   has lengths.
/// - Sform and qform, if there are both, must agree to a tenth of a voxel.
///
/// Throws InputError for what else contradicts itself, is sheared, flat, in no unit of length, or
/// of sizes that no scanner has.
void lay_by_header(const NiftiHeader& header, Volume& volume);

}  // namespace lv::image
