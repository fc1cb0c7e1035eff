#pragma once

#include "lv/segment/heart.hpp"

namespace lv::segment {

/// Both borders in one frame of one slice.
struct FrameBorders {
  Radii endo, epi;         ///< round the slice's centre [mm]
  double wall_part = 0.0;  ///< part of the circumference along which muscle is seen
  /// How sure a border is: the part of the circumference along which muscle is seen and the border
  /// drawn lies within 2 mm of where the image shows it.
  double endo_agrees = 0.0, epi_agrees = 0.0;
};

struct SliceBorders {
  Pixel centre = Pixel::Zero();
  double contrast = 0.0;  ///< of blood and muscle, (blood - muscle)/muscle
  std::vector<FrameBorders> frames;
};

/// Draws endocardium and epicardium on all frames of all slices.
///
/// Grey levels are learnt from the study: blood as the median of the inner half of the cavity of a
/// slice, muscle as the most frequent grey value 2 to 10 mm outside the blood of all slices, then
/// of each slice, then along each ray where the wall was found, since coils make one side brighter.
///
/// In polar pictures round the heart's centre four closed paths of least cost follow each other:
/// the blood's edge; the middle of the wall, along which a band of 4 mm is most like muscle; from
/// there outwards the epicardium, where what is like muscle ends at an edge, close to the median of
/// neighbouring frames; inwards the endocardium, where `fall` of the way from blood to muscle is
/// reached. Trabeculae, greyer than blood, lie inside for fall = 0.85, as observers draw them; the
/// middle of an edge is at 0.5.
///
/// The endocardium is then a sum of three harmonics that papillary muscles hardly push inwards, and
/// its convex hull. Where no muscle is seen behind it, as in the outflow tract, it takes the shape
/// of the next slice towards the middle of the heart.
[[nodiscard]] std::vector<SliceBorders> draw_borders(const image::Cine& cine, const Heart& heart,
                                                     double fall);

}  // namespace lv::segment
