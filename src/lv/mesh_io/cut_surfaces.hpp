#pragma once

#include "lv/geometry/contours.hpp"
#include "lv/mesh_io/triangles.hpp"

#include <string>
#include <vector>

namespace lv::mesh_io {

/// The wall between two surfaces as contours.
struct CutSurfaces {
  geometry::Contours contours;  ///< slices from the base to the apex, and the tips of both surfaces
  std::vector<std::string> notes;
  std::string warning;  ///< of a cavity of which more than a twentieth is left out; else empty
};

/// Cuts endocardium and epicardium across the long axis into closed loops, about 4 mm apart, at
/// least 12.
///
/// - The base. Each surface is open at its base by one rim, or closed there by one flat lid (the
///   plane of the largest area, a twentieth of the surface or more, on one side of the rest), which
///   is taken off. The most basal loop lies at the lowest point of both rims, so that what is cut is
///   whole all round: what lies above it is not used. The notes say how much, and what part of the
///   cavity it is: of the volume between the endocardium and the fan from its rim to the rim's
///   middle.
/// - The long axis runs from the endocardium's point farthest from the middle of its rim to that
///   middle; the tips are the lowest points of both surfaces along it.
///
/// Throws InputError for a surface with several openings, a hole, or several parts at one height,
/// if the epicardium ends above the endocardium, and where more than a third of the cavity would be
/// left out.
[[nodiscard]] CutSurfaces cut_across(const Triangles& endo, const Triangles& epi);

}  // namespace lv::mesh_io
