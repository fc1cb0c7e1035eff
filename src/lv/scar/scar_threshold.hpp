#pragma once

#include "lv/case_file/case.hpp"
#include "lv/image/picture.hpp"
#include "lv/mesh/mesh.hpp"

#include <optional>
#include <vector>

namespace lv::scar {

/// Places of a wall: the grey values there (NaN outside the image), and the volume or area that
/// each stands for.
struct WallGreys {
  std::vector<double> greys, volumes;
};

/// m + n s, with mean m and standard deviation s, by volume, of the places for which `remote` is
/// not 0. None where the image shows none of them.
[[nodiscard]] std::optional<double> above_remote(const WallGreys& wall,
                                                 const std::vector<char>& remote,
                                                 double deviations);

/// The largest of grey values, of which those outside an image are NaN.
[[nodiscard]] double brightest_of(const std::vector<double>& greys);

/// z + (b - z)/2, with z the grey value of no signal and b the brightest of some places of the
/// wall. Throws InputError as scar_threshold does.
[[nodiscard]] double half_of_brightest(const case_file::Case& c, const image::Cine& image,
                                       const std::vector<double>& greys);

/// The grey value from which on muscle is scar in a late-enhancement image, of which `greys` holds
/// the value at the centre of every element of the wall (NaN outside the image):
///
///   sd     above_remote of the remote segments. What scar each other choice of one segment would
///          make is logged.
///   fwhm   half_of_brightest of the wall
///
/// Throws InputError where the remote segments are not named (with the scar that each would make)
/// or not shown; or where z is not said and the image has an offset: the darkest hundredth of its
/// pixels is brighter than a fifth of b.
[[nodiscard]] double scar_threshold(const case_file::Case& c, const mesh::Mesh& mesh,
                                    const image::Cine& image, const std::vector<double>& greys);

}  // namespace lv::scar
