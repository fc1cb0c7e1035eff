#pragma once

#include "lv/implicit/time_engine.hpp"
#include "lv/material/smooth_holzapfel_ogden.hpp"

#include <filesystem>
#include <span>
#include <string>
#include <vector>

/// The elastodynamic benchmark of R. Arostica et al., Comput. Methods Appl. Mech. Engrg.
/// 435:117485, 2025, one ventricle ("step 0, case A and B" and "step 1").
namespace lv::verify {

/// A ventricle between truncated ellipsoids of revolution: semi-axes across and along in mm, and
/// the cosine of the angle at the base's edge, whose angle is linear through the wall. Its long
/// axis, x in the benchmark, is z here; y and z there are x and y here.
struct ArosticaWall {
  double endo_radius = 25.0, endo_length = 90.0, endo_cosine = 5.0 / 17.0;
  double epi_radius = 35.0, epi_length = 97.0, epi_cosine = 5.0 / 20.0;

  [[nodiscard]] Vec3 point(double u, double theta, double t) const;

  /// z of the base's edge at depth t [mm].
  [[nodiscard]] double base_height(double t) const;

  /// The direction across the wall that the benchmark's fibres are turned about, at a place of this
  /// transmural coordinate: normal to the ellipsoid of revolution whose semi-axes are those at
  /// depth t, scaled to the place. On the base it differs from the gradient of the coordinate, by
  /// 17 degrees, since the base is sloped.
  [[nodiscard]] Vec3 normal(const Vec3& place, double t) const;

  /// How the normals n of flat triangles with their corners on the epicardium scatter about its
  /// own normal N at a place of it, the mean of (n - N)(n - N)^T over their places and turns [-]:
  ///
  ///   S = h^2/24 W^2 + c h^2 (k_m - k_c)^2 (1 - N (x) N),   W = k_m e_m (x) e_m + k_c e_c (x) e_c
  ///
  /// with edges of h [mm] and the curvatures along the meridian and around [1/mm]. The first part
  /// is how N turns within a triangle, the second that the planes through three points of a surface
  /// which is not a sphere are tilted, as in Schwarz's lantern. Both to the second order of h.
  [[nodiscard]] Mat3 facet_scatter(const Vec3& place, double edge, double c) const;

  /// c of equilateral triangles that are turned at random.
  static constexpr double equilateral_tilt = 1.0 / 96.0;
  /// c of the 3474 triangles of the epicardium in a mesh that gmsh 4.8 made of the toolkit's
  /// description with 5 mm, by least squares; with 7, 6 and 4 mm it is 1/85, 1/64 and 1/55.
  static constexpr double gmsh_tilt = 1.0 / 65.0;

  /// The edge of the triangles at a place of the epicardium in the benchmark's meshes
  /// (ellipsoid_mesh of its toolkit): half of that at the base at the apex, even along the meridian
  /// between [mm].
  [[nodiscard]] double facet_edge(const Vec3& place, double at_base) const;

  /// Quadratic hexahedra with edges of about this length [mm] and so many through the wall, with
  /// the harmonic transmural coordinate of the benchmark's fibres.
  [[nodiscard]] mesh::Mesh mesh(double edge_length, int layers) const;
};

/// Active stress and cavity pressure of J. Bestel, F. Clement and M. Sorine, MICCAI 2001:
///
///   tau' = -|a| tau + sigma_0 max(a, 0),   a = a_max f + a_min (1 - f),  f = S(t - t_sys) S(t_dias - t)
///   p' = -|b| p + sigma_mid max(b, 0) + sigma_pre max(g, 0),   b = a_pre + alpha_pre g + alpha_mid
///
/// with S(x) = (1 + tanh(x/gamma))/2, a_pre as a but with t_sys_pre and t_dias_pre, and
/// g = S(t_dias_pre - t).
struct ArosticaDrive {
  double sigma_0 = 150.0;                       ///< [kPa]
  double a_max = 5.0, a_min = -30.0;            ///< [1/s]
  double t_sys = 0.16, t_dias = 0.484;          ///< [s]
  double gamma = 0.005;                         ///< [s]
  double sigma_pre = 7.0, sigma_mid = 16.0;     ///< [kPa]
  double alpha_pre = 5.0, alpha_mid = 1.0;      ///< [1/s]
  double t_sys_pre = 0.17, t_dias_pre = 0.484;  ///< [s]

  struct Values {
    double tension = 0.0, pressure = 0.0;  ///< [kPa]
  };
  /// At equal steps from 0 on, by the classical Runge-Kutta method.
  [[nodiscard]] std::vector<Values> histories(double step, double end) const;
};

/// All constants of the benchmark, and how finely it is solved.
struct ArosticaConstants {
  material::SmoothHolzapfelOgden muscle;
  double kappa = 1000.0;                    ///< bulk modulus [kPa]
  double share_at_points = 0.1;             ///< of kappa, see model_of
  double eta = 0.1;                         ///< viscosity [kPa s]
  double rho = 1e-6;                        ///< density [kg/mm^3]
  double k_epi = 100.0, c_epi = 0.005;      ///< along the normals [kPa/mm, kPa s/mm]
  double facet_edge = 5.0;                  ///< of the triangles at the base, whose normals these
                                            ///< are, see facet_scatter; 0: none, a smooth wall [mm]
  double k_base = 0.1, c_base = 0.005;      ///< along all directions
  double helix_endo = -1.0471975511965976;  ///< in the paper's sign [rad]
  double helix_epi = 1.0471975511965976;
  ArosticaDrive drive;
  double edge_length = 16.0;  ///< of the elements [mm]
  double layers = 2;          ///< elements through the wall
  double time_step = 5e-3;    ///< [s]
  double end = 1.0;           ///< [s]
  double spectral_radius = implicit::TimeEngine::default_spectral_radius;
  std::string teams;  ///< folder with the teams' histories; empty: there is none at hand

  /// Reads a table of two columns, `constant` and `value` with its unit. Throws InputError.
  static ArosticaConstants read(const std::filesystem::path& file);
};

/// Which of the two loads act.
struct ArosticaLoads {
  bool tension = true, pressure = true;
};

/// Displacements in the benchmark's axes [mm].
struct ArosticaSample {
  double time = 0.0;  ///< [s]
  Vec3 p0 = Vec3::Zero(), p1 = Vec3::Zero();
};

/// Every 0.01 s from 0 on.
[[nodiscard]] std::vector<ArosticaSample> run_arostica(const ArosticaConstants& constants,
                                                       const ArosticaLoads& loads);

/// The mean of the ten teams' displacements every 0.02 s.
[[nodiscard]] std::span<const ArosticaSample> teams_0a();
[[nodiscard]] std::span<const ArosticaSample> teams_0b();
[[nodiscard]] std::span<const ArosticaSample> teams_1();

}  // namespace lv::verify
