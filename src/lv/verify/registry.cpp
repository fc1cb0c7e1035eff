#include "lv/base/check.hpp"
#include "lv/base/nearest.hpp"
#include "lv/verify/problems.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace lv::verify {

std::span<const Problem> problems() {
  using enum Length;
  static const std::vector<Problem> all{
      {"holzapfel_ogden_curves",
       "the passive law gives the published shear and tension curves",
       brief,
       {1},
       holzapfel_ogden_curves},
      {"niederer_steady",
       "the steady active tension over calcium and stretch",
       brief,
       {1},
       niederer_steady},
      {"niederer_twitch",
       "isometric twitches, and second order in the time step",
       brief,
       {1},
       niederer_twitch},
      {"niederer_release",
       "tension while shortening, and after a sudden change of length",
       brief,
       {1},
       niederer_release},
      {"tangent_is_derivative",
       "every law's tangent is the derivative of its stress",
       brief,
       {1},
       tangent_is_derivative},
      {"stokes_modes",
       "the transforms solve the discrete Stokes equations to rounding",
       brief,
       {1, 2, 3},
       stokes_modes},
      {"stokes_order",
       "unsteady Stokes flow converges with order 2 in space and time",
       brief,
       {1},
       stokes_order},
      {"convection_order",
       "Navier-Stokes flow converges with order 2 in space and time",
       brief,
       {1},
       convection_order},
      {"delta_moments",
       "the regularised delta functions have the moments they are made for",
       brief,
       {1},
       delta_moments},
      {"spread_interpolate_adjoint",
       "wall and blood exchange power without loss",
       brief,
       {1, 2},
       spread_interpolate_adjoint},
      {"force_and_torque_conserved",
       "spreading keeps the wall's force and torque",
       brief,
       {1, 2},
       force_and_torque_conserved},
      {"thick_sphere_at_rest",
       "blood trapped in a stretched shell: exact pressure, no flow",
       brief,
       {1},
       thick_sphere_at_rest},
      {"thick_sphere_static",
       "an inflated shell of incompressible rubber, exact solution (quasi-static engine)",
       brief,
       {1, 2},
       thick_sphere_static},
      {"no_locking",
       "incompressible elements of every kind are not too stiff on coarse meshes",
       brief,
       {2},
       no_locking},
      {"land2015_problem1",
       "a bending beam: Land et al. 2015, problem 1 (quasi-static engine)",
       brief,
       {2},
       land2015_problem1},
      {"land2015_problem2",
       "inflation of a ventricle: Land et al. 2015, problem 2 (quasi-static engine)",
       brief,
       {2},
       land2015_problem2},
      {"land2015_problem3",
       "inflation and contraction: Land et al. 2015, problem 3 (quasi-static engine)",
       nightly,
       {2},
       land2015_problem3},
      {"calibration_twin",
       "calibration finds the parameters that made its volumes",
       brief,
       {1},
       calibration_twin},
      {"strain_twin",
       "a fit to regional strains finds the parameters that made them",
       brief,
       {1},
       strain_twin},
      {"unloading_round_trip",
       "a stress-free ventricle that was loaded is found again from its loaded shape",
       brief,
       {1},
       unloading_round_trip},
      {"rank_independence",
       "1, 2 and 3 ranks give the same beat to rounding",
       brief,
       {1, 2, 3},
       rank_independence},
      {"restart_is_bitwise",
       "a killed and resumed run equals an undisturbed one bit for bit",
       brief,
       {1, 2},
       restart_is_bitwise},
      {"grid_convergence",
       "volumes and displacements change little with the mesh width",
       nightly,
       {1},
       grid_convergence},
      {"time_step", "volumes do not depend on the time step", nightly, {1}, time_step},
      {"idealised_ventricle",
       "the default ventricle's volumes, against an independent solver",
       nightly,
       {1},
       idealised_ventricle},
      {"pressure_volume",
       "the default ventricle's passive pressure-volume curve, against an independent solver",
       nightly,
       {1},
       pressure_volume},
      {"other_ventricles",
       "volumes of other shapes and stiffnesses, against an independent solver",
       nightly,
       {1},
       other_ventricles},
  };
  return all;
}

const Problem& problem(const std::string& name) {
  const auto all = problems();
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const Problem& p) { return p.name == name; });
  if (found != all.end())
    return *found;
  std::vector<std::string> names;
  for (const Problem& p : all)
    names.push_back(p.name);
  const std::string nearest = nearest_name(name, names);
  throw InputError("verify " + name, "is not a problem",
                   (nearest.empty() ? "" : fmt::format("Did you mean {}? ", nearest)) +
                       "All of them: ventricle verify --list");
}

}  // namespace lv::verify
