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

/// Leaves out, with a note each, outer contours that are drawn somewhere else than round the inner
/// ones: they do not enclose the middle of the endocardium, or lie off it by more than half of
/// their mean radius. @throws InputError if all are.
void drop_strays(geometry::Contours& contours, std::vector<std::string>& notes);

/// Leaves out the most basal slices, endocardium and epicardium, that muscle surrounds over less
/// than half, with a note; what is thinner than `thinnest` or than a third of the usual thickness
/// of the other slices is no muscle. So do readers of images decide which slice is the first of the
/// ventricle (J. Schulz-Menger et al., J. Cardiovasc. Magn. Reson. 22:19, 2020). A slice that shows
/// no epicardium at all stays, and so do three slices.
void drop_open_base(geometry::Contours& contours, double thinnest, std::vector<std::string>& notes);

}  // namespace lv::image
