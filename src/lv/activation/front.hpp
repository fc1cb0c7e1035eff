#pragma once

#include "lv/mesh/mesh.hpp"

#include <span>
#include <vector>

/// When each part of the wall is activated.
namespace lv::activation {

/// How fast activation spreads [mm/s].
struct Speeds {
  double v_f = 670.0, v_s = 300.0, v_n = 170.0;  ///< along f0, s0 and n0
  double endocardium = 2500.0;  ///< along the endocardial surface; 0: no faster than in the muscle
};

/// A node that activation starts from, and when [s].
struct Start {
  int node = 0;
  double time = 0.0;
};

/// The metric in which the length of a way is the time that it takes, of muscle with the fibre
/// frame [f0 s0 n0]:
///
///   |d|^2 = d.M^-1 d,  M = v_f^2 f0 (x) f0 + v_s^2 s0 (x) s0 + v_n^2 n0 (x) n0      [s^2/mm^2]
[[nodiscard]] Mat3 travel_metric(const Mat3& frame, const Speeds& speeds);

/// Starts at the nodes within `radius` [mm] of a point, after the time of the straight way from it,
/// in the metric of the muscle there.
[[nodiscard]] std::vector<Start> starts_around(const mesh::Mesh& mesh, const Vec3& point,
                                               double radius, const Mat3& metric);

/// The first arrival T of a front at every node [s]: the solution of the eikonal equation
///
///   grad T . M grad T = 1 in the wall,  |grad T| = 1/v on the endocardium along the surface
///
/// by linear elements: T at a node is the least of T(y) + |x - y| over the points y of the faces
/// across the cells around it, between whose nodes T is linear (Hopf and Lax; F. Bornemann & C.
/// Rasch, Comput. Visual. Sci. 9:57, 2006). First order in the size of the cells, whatever their
/// angles. Nodes are visited in the order of their times, again where a later one finds a shorter
/// way (label correcting). `metrics`: travel_metric of every cell. Throws InputError where no
/// front arrives.
[[nodiscard]] std::vector<double> arrival_times(const mesh::Mesh& mesh,
                                                std::span<const Mat3> metrics, const Speeds& speeds,
                                                std::span<const Start> starts);

}  // namespace lv::activation
