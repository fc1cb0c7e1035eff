#pragma once

#include "lv/mesh/mesh.hpp"

#include <span>
#include <vector>

namespace lv::solid {

/// The cavity's opening at the base, within the endocardium's edge, as a lid that the base carries.
/// The centre of the lid follows the nodes X_b of the base,
///
///   c(x) = sum_b w_b x_b,   w_b = A_b (1/A + (C - B).M^-1 (X_b - B))
///
/// with their shares A_b of the base's area A, its centre B, M = sum_b A_b (X_b - B)(X_b - B)^T in
/// the basal plane, and the centre C of the undeformed opening: of all w with sum w = 1 and
/// sum w_b X_b = C the least in sum w_b^2/A_b. So where the base moves as a rigid or evenly
/// stretched body, c moves as the opening's centre does.
///
/// A flat lid that moves by dc, turned about its centre or not, sweeps a.dc with the opening's area
/// vector a = int n da over the endocardium = -sum_a g_a, g_a = dV/dx_a of EndocardialSurface. So
/// the cavity under it gains what the endocardium sweeps against the lid,
///
///   dV = sum_a g_a.dx_a + a.dc = sum_a g_a.(dx_a - dc)                              [mm^3]
///
/// which is nothing in a translation.
class Opening {
 public:
  /// Of a mesh without a base or without an edge of the endocardium the lid stays.
  explicit Opening(const mesh::Mesh& mesh);

  /// C [mm].
  [[nodiscard]] const Vec3& centre() const { return centre_; }

  /// sum_b w_b v_b of what all nodes of the mesh have.
  [[nodiscard]] Vec3 carried(std::span<const Vec3> at_nodes) const;

 private:
  struct Weight {
    int node;
    double w;
  };

  Vec3 centre_ = Vec3::Zero();
  std::vector<Weight> weights_;
};

}  // namespace lv::solid
