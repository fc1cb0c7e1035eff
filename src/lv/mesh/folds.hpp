#pragma once

#include "lv/mesh/mesh.hpp"

#include <array>
#include <span>
#include <vector>

namespace lv::mesh {

/// How far a wall is folded against a smooth one of the same mesh. All are found by pairs of faces
/// of one surface, endocardium or epicardium, with centres c, normals n out of the cavity and the
/// mean thickness t of the smooth wall.
struct Folds {
  /// How much a surface turns inwards over a piece of it, where the smooth one does not: the
  /// largest min(-b, b_smooth - b) with b = (n_j - n_i).(c_j - c_i)/|c_j - c_i|, the angle by which
  /// the surface turns between i and j, positive where it is convex, over pairs that lie 1.5 to 3 t
  /// apart in the smooth wall [rad].
  double dent = 0.0;
  Vec3 dent_place = Vec3::Zero();  ///< in the smooth wall [mm]
  /// Smallest |c_j - c_i| by that in the smooth wall, over pairs that lie more than 4 t apart
  /// there: zero where a surface touches itself [-].
  double approach = 1.0;
  Vec3 approach_place = Vec3::Zero();  ///< in the smooth wall [mm]
  /// Largest principal stretch of a cell from the wall to the smooth one [-].
  double stretch = 1.0;
};

/// When a wall counts as folded. The figures of smooth and of folded walls: docs/method.md.
struct FoldLimits {
  double dent = 0.5;      ///< most [rad]
  double approach = 0.2;  ///< least
  double stretch = 4.0;   ///< most
};

[[nodiscard]] bool is_folded(const Folds& folds, const FoldLimits& limits = {});

/// Looks for folds of a wall that is smooth as it is given, moved.
class FoldFinder {
 public:
  /// The mesh must outlive it.
  explicit FoldFinder(const Mesh& smooth);

  /// Of the same mesh with other places of its nodes [mm].
  [[nodiscard]] Folds operator()(std::span<const Vec3> nodes) const;

 private:
  struct Side {
    const Surface* surface;
    double sign;  ///< of the normals, to point out of the cavity
    std::vector<Vec3> centre, normal;
  };
  [[nodiscard]] Side side(std::span<const Vec3> nodes, const Surface& surface, double sign) const;
  void compare(const Side& smooth, const Side& now, Folds& folds) const;

  const Mesh& smooth_;
  double thickness_;  ///< mean, of the smooth wall [mm]
  std::array<Side, 2> sides_;
};

}  // namespace lv::mesh
