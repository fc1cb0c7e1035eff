#pragma once

#include "lv/case_file/case.hpp"
#include "lv/image/picture.hpp"
#include "lv/mesh/mesh.hpp"

#include <vector>

namespace lv::scar {

/// The grey value from which on muscle is scar in a late-enhancement image, of which `greys` holds
/// the value at the centre of every element of the wall (NaN outside the image):
///
///   sd     m + n s, with mean m and standard deviation s of the remote segments, by volume. What
///          scar each other choice of one segment would make is logged.
///   fwhm   z + (b - z) / 2, with z the grey value of no signal and b the brightest of the wall
///
/// Throws InputError where the remote segments are not named (with the scar that each would make)
/// or not shown; or where z is not said and the image has an offset: the darkest hundredth of its
/// pixels is brighter than a fifth of b.
[[nodiscard]] double scar_threshold(const case_file::Case& c, const mesh::Mesh& mesh,
                                    const image::Cine& image, const std::vector<double>& greys);

}  // namespace lv::scar
