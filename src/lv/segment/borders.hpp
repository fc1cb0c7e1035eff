#pragma once

#include "lv/segment/heart.hpp"

#include <optional>
#include <vector>

namespace lv::segment {

/// Both borders in one frame of one slice.
struct FrameBorders {
  Radii endo, epi;         ///< round the slice's centre [mm]
  double wall_part = 0.0;  ///< part of the circumference along which muscle is seen
  /// What is more like muscle than like blood more than 1 mm within the endocardium [mm^2]:
  /// papillary muscles and trabeculae.
  double dark_within = 0.0;
  /// How sure a border is: the part of the circumference along which muscle is seen and the border
  /// drawn lies within 2 mm of where the image alone shows it.
  double endo_agrees = 0.0, epi_agrees = 0.0;
};

/// What lies between the borders [mm^2].
[[nodiscard]] double area_of_wall(const FrameBorders& borders);

struct SliceBorders {
  Pixel centre = Pixel::Zero();
  double contrast = 0.0;    ///< of blood and muscle, (blood - muscle)/muscle
  double fluid_part = 0.0;  ///< part of the circumference with fluid outside (see fluid_within)
  std::vector<FrameBorders> frames;
};

/// The borders of all slices, and the part of the way from blood to muscle at which the endocardium
/// was drawn and at which it would be if no blur made edges wide (the same where it was given).
struct Drawn {
  std::vector<SliceBorders> slices;
  double fall = 0.0;
  double fall_if_sharp = 0.0;
  /// The borders at fall_if_sharp, where that is more and blur was taken for all that makes edges
  /// wide; else empty.
  std::vector<SliceBorders> if_sharp;
};

/// Draws endocardium and epicardium on all frames of all slices.
///
/// What coils receive unequally is evened out (see coil_gradient), and the contrast of blood and
/// muscle made that of usual images (see with_usual_contrast).
///
/// Grey levels are learnt from the study: blood as the median of the inner half of the cavity of a
/// slice, muscle as the most frequent grey value 2 to 10 mm outside the blood of all slices, then
/// of each slice, then along each ray where the wall was found, since coils make one side brighter.
///
/// In polar pictures round the heart's centre four closed paths of least cost follow each other:
/// the blood's edge; the middle of the wall, along which a band of 4 mm is most like muscle; from
/// there outwards the epicardium, where what is like muscle first ends at an edge (what is like
/// muscle behind a dark line is another organ's), close to where neighbouring frames have it and
/// walls as thick as in neighbouring slices end; inwards the endocardium, behind papillary muscles,
/// where `fall` of the way from blood to muscle is reached: 0.5 in the middle of an edge, more
/// outside trabeculae. None: from how wide the study's edges are (see darkness_at_border). Then the
/// epicardium once more, close to where walls end that keep their muscle (see kept_areas).
///
/// The endocardium is then a sum of three harmonics that papillary muscles hardly push inwards, and
/// its convex hull. Where no muscle is seen behind it, as in the outflow tract, it takes the shape
/// of the next slice towards the middle of the heart, and is then cut straight from one end of the
/// muscle to the other.
[[nodiscard]] Drawn draw_borders(const image::Cine& cine, const Heart& heart,
                                 const std::optional<double>& fall);

}  // namespace lv::segment
