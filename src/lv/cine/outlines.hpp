#pragma once

#include "lv/cine/cine.hpp"
#include "lv/cine/strain.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace lv::cine {

/// An image of the cine and what was drawn on it.
struct DrawnImage {
  std::string slice;  ///< number of a short-axis slice, or "long axis 1" and so on
  int phase = 0;      ///< number of the image in order of time, from 1
  const image::Picture* picture = nullptr;
  bool closed = true;  ///< loops of a short axis; curves of a long axis are open
  const geometry::Contour* endo = nullptr;  ///< null if it was not drawn
  const geometry::Contour* epi = nullptr;
};

/// The images of a moment: of every short-axis slice with an endocardial loop, then of the
/// long-axis views in the case's order. `phase` and `diastole` are numbers of short-axis images,
/// from 1; a view with another number of images shows its nearest one, both being evenly spread
/// over the cycle. The study must outlive what is returned.
[[nodiscard]] std::vector<DrawnImage> images_at(const CineStudy& study, int phase, int diastole);

/// Whether the wall lies where its images show a heart: at end-diastole more than half of the
/// endocardial loops have their middle within the wall's length and radius. An ellipsoid does not,
/// which is in no images, nor a mesh in a space of its own.
[[nodiscard]] bool lies_in_images(const ModelledBeat& model, const CineStudy& study);

/// Lays the model's sections with the planes of the cine over its images at end-diastole and
/// end-systole (phases from 1): outlines.csv, outline_distances.csv, outlines_ed.png,
/// outlines_es.png and pictures/ in `folder`. Returns how far they lie from the contours, in words.
/// Of a model without a frame there are no sections, letters and distances.
/// Throws RunError naming a file that cannot be written.
[[nodiscard]] std::string write_outlines(const ModelledBeat& model, const CineStudy& study,
                                         int diastole, int systole,
                                         const std::filesystem::path& folder);

}  // namespace lv::cine
