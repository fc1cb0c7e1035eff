#pragma once

#include "lv/base/table.hpp"
#include "lv/image/picture.hpp"
#include "lv/scar/wall_outlines.hpp"

#include <vector>

namespace lv::scar {

/// Whether a slice shows where the wall lies in it.
enum class Evidence {
  clear,
  weak,      ///< moves farther than 3 mm, or half of the largest, from the best fit as well
  at_limit,  ///< the best lies at the largest move that is accepted
  no_wall    ///< the wall does not reach into its slab, or no plane of it cuts a closed outline
};

[[nodiscard]] const char* name(Evidence evidence);

/// How a slice is moved in its plane.
struct SliceMove {
  Vec3 move = Vec3::Zero();  ///< image space [mm]; zero unless the evidence is clear
  double doubt = 0.0;        ///< see image::Registration [mm]
  Evidence evidence = Evidence::no_wall;
};

/// How each slice of a stack (first frames) must be moved in its plane to lie on a wall, by at most
/// `largest` [mm]: the wall's sides, in image space, cut its slab into cavity, wall and
/// surroundings; see image::register_slice. A slab reaches half way to the neighbouring slices.
[[nodiscard]] std::vector<SliceMove> register_slices(const image::Cine& stack,
                                                     const Triangles& endo, const Triangles& epi,
                                                     double largest);

/// How each slice of a stack of label maps (first frames) must be moved in its plane [mm] so that
/// the middle of its pixels with these labels falls on the middle of the wall's section there,
///
///   x_c = (A_epi x_epi - A_endo x_endo) / (A_epi - A_endo),
///
/// of the areas that the wall's sides, in image space, enclose in its plane. Zero where they are
/// not closed, as at an oblique base, of which a plane cuts one side alone, and where a slice shows
/// none of the labels.
[[nodiscard]] std::vector<Vec3> moves_of_labels(const image::Cine& stack,
                                                const std::vector<int>& labels,
                                                const Triangles& endo, const Triangles& epi);

/// Logs what became of each slice of a late-enhancement image; those that stay where they are
/// although the wall reaches into them, in a warning.
void report_moves(const image::Cine& image, const std::vector<SliceMove>& moves);

/// A row per slice.
[[nodiscard]] Table table_of(const image::Cine& image, const std::vector<SliceMove>& moves);

}  // namespace lv::scar
