#pragma once

#include "lv/geometry/contours.hpp"

#include <string>
#include <vector>

namespace lv::image {

/// Mends walls that are open or too thin on part of a slice, as where the outflow tract cuts the
/// basal muscle or an observer's two borders touch. Along rays from the middle of the endocardium,
/// the wall counts as missing where the epicardium lies less than `least` [mm] outside the
/// endocardium, and beside such rays up to where it has half its median thickness, for an open wall
/// tapers. Missing over up to 120 degrees in all, its thickness is interpolated from where it is
/// there; over more, the epicardial loop is left out. Each is noted, by slice.
void close_walls(geometry::Contours& contours, double least, std::vector<std::string>& notes);

}  // namespace lv::image
