#pragma once

#include "lv/mesh/fibres.hpp"
#include "lv/mesh/parameters.hpp"
#include "lv/solid/wall.hpp"

/// The mechanics benchmark of S. Land et al., Proc. R. Soc. A 471:20150641, 2015.
namespace lv::verify {

/// Problem 1: a beam [0,10] x [0,1] x [0,1] mm held at x = 0, its lower side under a pressure that
/// follows it, fibres along x. The mesh's endocardium is the loaded side, its base the held one.
struct LandBeam {
  double pressure = 0.004;  ///< [kPa]

  /// 40 x 4 x 4 quadratic elements.
  [[nodiscard]] mesh::Mesh mesh() const;
  [[nodiscard]] mesh::FibreRule fibres() const { return {0.0, 0.0, 0.0, 0.0}; }
  [[nodiscard]] solid::WallMaterial material() const;

  /// The node that begins at (10, 0.5, 1) mm.
  [[nodiscard]] int watched_node(const mesh::Mesh& mesh) const;
};

/// The ventricle of problems 2 and 3: between ellipsoids with semi-axes 7 and 17 mm inside, 10 and
/// 20 mm outside, cut 5 mm above their widest section; here the cut is at z = 0.
struct LandEllipsoid {
  static constexpr double base_height = 5.0;  ///< z there = z here + this [mm]

  [[nodiscard]] static mesh::Mesh mesh(const mesh::WallMeshParameters& parameters);
};

/// What problems 2 and 3 ask of that ventricle.
struct LandProblem {
  solid::WallMaterial material;
  mesh::FibreRule fibres;
  double pressure = 0.0;  ///< [kPa]
  double tension = 0.0;   ///< S = T f0 (x) f0 [kPa]
};

/// Problem 2: isotropic, 10 kPa.
[[nodiscard]] LandProblem land_inflation();

/// Problem 3: fibres from 90 to -90 degrees, 15 kPa and an active stress of 60 kPa.
[[nodiscard]] LandProblem land_contraction();

}  // namespace lv::verify
