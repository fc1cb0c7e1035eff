#pragma once

#include "lv/activation/front.hpp"
#include "lv/mesh/regions.hpp"

#include <string>
#include <variant>
#include <vector>

namespace lv::activation {

/// A place that activation starts from, and its words:
///
///   Segment      "mid anterior", "apex", "7": the middle of a segment of the AHA's 17, on the
///                endocardium
///   Point        "12 -4 -30 mm": the node nearest to a point in the coordinates of the mesh
///   Endocardium  "endocardium": all of it at once
struct Segment {
  int number = 1;
};
struct Point {
  Vec3 x = Vec3::Zero();  ///< [mm]
};
struct Endocardium {};
using Site = std::variant<Segment, Point, Endocardium>;

/// Throws std::invalid_argument that says what the words are not.
[[nodiscard]] Site site_of(const std::string& words);

/// The fibre frame [f0 s0 n0] at the centre of every cell.
[[nodiscard]] std::vector<Mat3> cell_frames(const mesh::Mesh& mesh);

/// A wall that activation spreads in.
struct ActivatedWall {
  const mesh::Mesh& mesh;
  const mesh::Regions& regions;
  std::vector<Mat3> metrics;  ///< travel_metric of every cell
  std::string sites_are_at;   ///< where the case names its sites, for messages
};

/// The nodes that activation starts from at a site, at time 0: those of a ball of 2 mm, in which it
/// spreads as in the muscle at its centre. Throws InputError for a point farther than 5 mm from
/// every node, and a segment that has no part of the wall.
[[nodiscard]] std::vector<Start> starts_at(const Site& site, const ActivatedWall& wall);

}  // namespace lv::activation
