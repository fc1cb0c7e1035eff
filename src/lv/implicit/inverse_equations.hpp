#pragma once

#include "lv/implicit/constitution.hpp"
#include "lv/implicit/equations.hpp"

#include <optional>
#include <vector>

namespace lv::implicit {

/// A wall without load, and the pressures of its elements in the shape that was seen.
struct Reference {
  std::vector<Vec3> nodes;        ///< X [mm]
  std::vector<double> pressures;  ///< [kPa]
};

/// The inverse problem of elastostatics (S. Govindjee, P. Mihalic, Comput. Methods Appl. Mech. Eng.
/// 136:47, 1996): the equilibrium of Equations, with the seen shape x* fixed and the reference
/// nodes X unknown,
///
///   R_a(x*; X, p) = 0  [mN],  R_m(x*; X, p) = 0  [mm^3],
///
/// of muscle at rest in its steady state. The cavity's pressure pushes on the seen endocardium, so
/// its force does not depend on X. With H = sum_b dX_b (x) grad phi_b, the gradients over the wall
/// without load,
///
///   dF = -F H,  d(grad phi_a) = -H^T grad phi_a,  d(dV) = tr(H) dV,
///
/// and where fibres follow the rule in hexahedra, with the frame Q of columns f0, s0, n0 whose
/// radial direction is along grad t,  dQ = -dQ/dr (1 - r r^T) H^T r.  The tangent is not symmetric.
///
/// Without their derivative: directions that the mesh brings, those of tetrahedra, and the areas
/// and normals of supports.
class InverseEquations {
 public:
  /// The mesh of the seen shape, quadratic or of linear hexahedra; it must outlive the equations.
  InverseEquations(const mesh::Mesh& seen, const StaticModel& model);

  /// The seen shape itself, without pressures.
  [[nodiscard]] Reference seen() const;
  InverseEquations(const InverseEquations&) = delete;
  InverseEquations& operator=(const InverseEquations&) = delete;

  [[nodiscard]] int size() const { return 3 * node_count() + elements_.pressure_count; }
  [[nodiscard]] int node_count() const { return static_cast<int>(seen_.nodes.size()); }
  [[nodiscard]] const Pattern& pattern() const { return pattern_; }

  /// Near the axis at the apex the directions of the rule turn abruptly with X: from now on they
  /// are those of this wall there, until they are held anew.
  void hold_frames(const Reference& reference);

  /// Whether any are held, on any rank. Collective.
  [[nodiscard]] bool holds_frames() const;

  /// R under a pressure in the cavity [kPa], complete on every rank; empty where an element of X
  /// is turned inside out. Collective.
  [[nodiscard]] std::vector<double> residual(const Reference& reference, double pressure) const;

  /// Sets a matrix to dR/d(X, p). Of a wall that has a residual.
  void tangent(const Reference& reference, SparseMatrix& K) const;

 private:
  struct Place {
    std::size_t element;  ///< among this rank's
    int point;            ///< of it
    std::size_t number;   ///< among all of this rank's
  };
  struct Geometry {
    Eigen::Matrix3Xd gradient;  ///< d phi_a/dX
    double dV;                  ///< [mm^3]
    double M, t;                ///< infarct, depth
    Vec3 radial;
    Mat3 frame;
  };
  /// Of the seen shape over a wall without load, in the fibre frame.
  struct Strained {
    Eigen::Matrix3Xd G;  ///< d phi_a/dX
    Mat3 F;
    Eigen::VectorXd N;  ///< of the pressures
    double p;           ///< [kPa]
  };
  template <class Visit>
  void for_points(const mesh::Mesh& wall, const Visit& visit) const;
  [[nodiscard]] Strained strained_at(const Place& place, const Geometry& at,
                                     const State& state) const;
  /// Numbers of an element's unknowns.
  [[nodiscard]] const std::vector<int>& group_of(const Place& place) const;
  [[nodiscard]] Constitution law_at(const Place& place) const;
  void add_elements(const mesh::Mesh& wall, const Reference& reference, SparseMatrix& K) const;
  void add_supports(const mesh::Mesh& wall, SparseMatrix& K) const;

  const mesh::Mesh& seen_;
  StaticModel model_;
  std::vector<double> contractility_;  ///< see Equations::contractility
  TensionAt tension_ = [this](std::size_t element, std::size_t point, double stretch) {
    const Tension T = model_.contractility.at(stretch, 0.0);
    return contractility_.empty()
               ? T
               : contractility_[element * static_cast<std::size_t>(shapes_.points()) + point] * T;
  };
  ReferenceWall elements_;  ///< their numbers alone
  solid::ShapeTable shapes_;
  Pattern pattern_;
  std::vector<std::optional<Mat3>> held_;  ///< frames, per point
};

}  // namespace lv::implicit
