#pragma once

#include "lv/mesh/parameters.hpp"
#include "lv/solid/cardiac_model.hpp"

#include <span>

/// The mechanics benchmark of S. Land et al., Proc. R. Soc. A 471:20150641, 2015.
namespace lv::verify {

/// Problem 1: a beam [0,10] x [0,1] x [0,1] mm held at x = 0, its lower side under a pressure that
/// follows it, fibres along x. The mesh's endocardium is the loaded side, its base the held one.
struct LandBeam {
  double pressure = 0.004;  ///< [kPa]

  /// 40 x 4 x 4 quadratic elements.
  [[nodiscard]] mesh::Mesh mesh() const;
  [[nodiscard]] solid::CardiacModel heart() const;

  /// The node that begins at (10, 0.5, 1) mm.
  [[nodiscard]] int watched_node(const mesh::Mesh& mesh) const;
};

/// The ventricle of problems 2 and 3: between ellipsoids with semi-axes 7 and 17 mm inside, 10 and
/// 20 mm outside, cut 5 mm above their widest section; here the cut is at z = 0.
struct LandEllipsoid {
  static constexpr double base_height = 5.0;  ///< z there = z here + this [mm]

  [[nodiscard]] static mesh::Mesh mesh(const mesh::WallMeshParameters& parameters);

  /// With elements that become smaller towards the apex, to 0.3 of their size, and the endocardium,
  /// to 0.5. The fibres of problem 3 run together at the apex: over the innermost 0.5 mm of the
  /// endocardium the circumferential stretch falls from 1.4 to 1.
  [[nodiscard]] static mesh::Mesh graded_mesh(const mesh::WallMeshParameters& parameters);
};

/// What problems 2 and 3 ask of that ventricle.
struct LandProblem {
  solid::CardiacModel heart;  ///< its tension is S = T f0 (x) f0
  mesh::FibreRule fibres = {};
  double pressure = 0.0;  ///< [kPa]
};

/// Problem 2: isotropic, 10 kPa.
[[nodiscard]] LandProblem land_inflation();

/// Where the ends of the long axis are.
struct LandApex {
  double endo, epi;  ///< z [mm]
};

/// On a mesh of LandEllipsoid whose nodes have moved.
[[nodiscard]] LandApex land_apex(const mesh::Mesh& mesh, std::span<const Vec3> positions);

/// What an axisymmetric solver with torsion found on its finest meshes (no participant's results
/// are published as numbers; their plots agree).
struct LandReference {
  LandApex apex;
  double volume;  ///< of the cavity [mm^3]
};
inline constexpr LandReference land_inflation_reference{{-26.61, -28.28}, 10734.5};
inline constexpr LandReference land_contraction_reference{{-12.35, -15.46}, 1795.9};

/// Problem 3: fibres from 90 to -90 degrees, 15 kPa and an active stress of 60 kPa.
[[nodiscard]] LandProblem land_contraction();

}  // namespace lv::verify
