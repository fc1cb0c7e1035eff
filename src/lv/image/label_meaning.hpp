#pragma once

#include "lv/image/label_contours.hpp"
#include "lv/image/volume.hpp"

namespace lv::image {

/// Whether all values are whole numbers from 0 to 255, as labels are, or at most 64 different ones
/// from 0 to 65535: labels may be of hundreds (205, 420, 500), and grey images have more values.
[[nodiscard]] bool seems_labels(const Volume& volume);

/// What the labels of a map seem to mean, from what lies beside what on the slices of all frames:
///
/// - the cavity is the largest label of whose border at least half is that of one other label and
///   less than a third is background; of two with a wall of their own the one whose wall is
///   thicker;
/// - the muscle is that other label, with what lies on both and less than half on background, or
///   on background less than twice as much as on the cavity (scar), and what such labels enclose
///   (its core);
/// - the right ventricle is the largest other label that lies on the muscle.
///
/// The first label of the muscle is the one round the cavity; what follows may be scar. A proposal
/// for a user to confirm. Lists are empty where nothing fits.
[[nodiscard]] LabelMeaning propose_meaning(const Volume& volume);

}  // namespace lv::image
