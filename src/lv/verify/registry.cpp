#include "lv/base/check.hpp"
#include "lv/base/nearest.hpp"
#include "lv/verify/problems.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace lv::verify {

namespace {

using Ranks = std::vector<int>;
using Solve = void (*)(Findings&);

Problem brief(const char* name, Solve solve, const char* proves, const Ranks& ranks = {1}) {
  return {name, proves, Length::brief, ranks, solve};
}

Problem nightly(const char* name, Solve solve, const char* proves, const Ranks& ranks = {1}) {
  return {name, proves, Length::nightly, ranks, solve};
}

Problem with_constants(Problem problem) {
  problem.has_constants = true;
  return problem;
}

}  // namespace

// NOLINTNEXTLINE(readability-function-size): a table
std::span<const Problem> problems() {
  static const std::vector<Problem> all{
      brief("holzapfel_ogden_curves", holzapfel_ogden_curves,
            "the passive law gives the published shear and tension curves"),
      brief("niederer_steady", niederer_steady,
            "the steady active tension over calcium and stretch"),
      brief("niederer_twitch", niederer_twitch,
            "isometric twitches, and second order in the time step"),
      brief("niederer_release", niederer_release,
            "tension while shortening, and after a sudden change of length"),
      brief("land2017_steady", land2017_steady,
            "the steady tension of human muscle over calcium and stretch"),
      brief("land2017_twitch", land2017_twitch,
            "twitches of human muscle for two calcium transients, and second order in time"),
      brief("land2017_ramp", land2017_ramp,
            "human muscle while it shortens and lengthens, and after a sudden change of length"),
      brief("tangent_is_derivative", tangent_is_derivative,
            "every law's tangent is the derivative of its stress"),
      brief("circulation_windkessel", circulation_windkessel,
            "the limit cycle of a ventricle on a windkessel, and second order in time"),
      brief("circulation_closed_loop", circulation_closed_loop,
            "the limit cycle of a closed circulation, whose total volume stays"),
      brief("eikonal_point", eikonal_point,
            "a front from a point in an orthotropic block, exact times, first order"),
      brief("eikonal_plane", eikonal_plane,
            "a front from a side of an orthotropic block, exact times, first order"),
      brief("stokes_modes", stokes_modes,
            "the transforms solve the discrete Stokes equations to rounding", {1, 2, 3}),
      brief("stokes_order", stokes_order,
            "unsteady Stokes flow converges with order 2 in space and time"),
      brief("convection_order", convection_order,
            "Navier-Stokes flow converges with order 2 in space and time"),
      brief("delta_moments", delta_moments,
            "the regularised delta functions have the moments they are made for"),
      brief("spread_interpolate_adjoint", spread_interpolate_adjoint,
            "wall and blood exchange power without loss", {1, 2}),
      brief("force_and_torque_conserved", force_and_torque_conserved,
            "spreading keeps the wall's force and torque", {1, 2}),
      brief("thick_sphere_at_rest", thick_sphere_at_rest,
            "blood trapped in a stretched shell: exact pressure, no flow"),
      brief("thick_sphere_static", thick_sphere_static,
            "an inflated shell of incompressible rubber, exact solution (quasi-static engine)",
            {1, 2}),
      brief("coupled_sphere", coupled_sphere,
            "a sphere of rubber empties through a resistance, its pressure the multiplier of its "
            "volume"),
      brief("generalised_alpha", generalised_alpha,
            "a sphere of rubber that swings, exact solution, and second order in time"),
      brief("cycle_default", cycle_default,
            "a heartbeat of the default ventricle with human muscle on a windkessel, against an "
            "independent solver"),
      brief("cycle_closed_loop", cycle_closed_loop,
            "a heartbeat of the default ventricle in a closed circulation, whose blood stays"),
      brief("no_locking", no_locking,
            "incompressible elements of every kind are not too stiff on coarse meshes"),
      brief("land2015_problem1", land2015_problem1,
            "a bending beam: Land et al. 2015, problem 1 (quasi-static engine)"),
      brief("land2015_problem2", land2015_problem2,
            "inflation of a ventricle: Land et al. 2015, problem 2 (quasi-static engine)"),
      brief("land2015_problem3", land2015_problem3,
            "inflation and contraction: Land et al. 2015, problem 3 (quasi-static engine)"),
      brief("iterative_solver", iterative_solver,
            "the iterative linear solver finds the same ventricle, as easily on fine meshes as on "
            "coarse",
            {2}),
      brief("calibration_twin", calibration_twin,
            "calibration finds the parameters that made its volumes"),
      brief("strain_twin", strain_twin,
            "a fit to regional strains finds the parameters that made them"),
      brief("unloading_round_trip", unloading_round_trip,
            "a stress-free ventricle that was loaded is found again from its loaded shape"),
      brief("rank_independence", rank_independence,
            "1, 2 and 3 ranks give the same beat to rounding", {1, 2, 3}),
      brief("restart_is_bitwise", restart_is_bitwise,
            "a killed and resumed run equals an undisturbed one bit for bit", {1, 2}),
      nightly("grid_convergence", grid_convergence,
              "volumes and displacements change little with the mesh width"),
      nightly("time_step", time_step, "volumes do not depend on the time step"),
      nightly("idealised_ventricle", idealised_ventricle,
              "the default ventricle's volumes, against an independent solver"),
      nightly(
          "pressure_volume", pressure_volume,
          "the default ventricle's passive pressure-volume curve, against an independent solver"),
      nightly("other_ventricles", other_ventricles,
              "volumes of other shapes and stiffnesses, against an independent solver"),
      nightly("land2015_problem2_immersed", land2015_problem2_immersed,
              "inflation of a ventricle: Land et al. 2015, problem 2 (immersed engine)", {2}),
      nightly("land2015_problem3_immersed", land2015_problem3_immersed,
              "inflation and contraction: Land et al. 2015, problem 3 (immersed engine)", {2}),
      nightly("cycle_ranks", cycle_ranks,
              "immersed heartbeats in a closed loop on 1, 2 and 3 ranks are the same to rounding",
              {1, 2, 3}),
      nightly("cycle_engines", cycle_engines,
              "a heartbeat of the same ventricle in a circulation by both engines"),
      nightly("cycle_engines_limit", cycle_engines_limit,
              "the limit cycle of the same ventricle in a closed loop by both engines"),
      with_constants(nightly("arostica_0a", arostica_0a,
                             "a ventricle that contracts: Arostica et al. 2025, step 0, case A")),
      with_constants(nightly("arostica_0b", arostica_0b,
                             "a ventricle under pressure: Arostica et al. 2025, step 0, case B")),
      with_constants(nightly("arostica_1", arostica_1,
                             "a beat with inertia and supports: Arostica et al. 2025, step 1")),
      nightly("engines_agree", engines_agree,
              "both engines move the default ventricle alike, at the paper's resolution", {2}),
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
