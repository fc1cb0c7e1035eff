#pragma once

#include "lv/verify/problem.hpp"

/// The problems themselves. What each proves, its formula, tolerance and measured values:
/// docs/verification.md.
namespace lv::verify {

// material points
void holzapfel_ogden_curves(Findings& found);
void niederer_steady(Findings& found);
void niederer_twitch(Findings& found);
void niederer_release(Findings& found);
void land2017_steady(Findings& found);
void land2017_twitch(Findings& found);
void land2017_ramp(Findings& found);
void tangent_is_derivative(Findings& found);

// circulation, alone and joined to the wall
void circulation_windkessel(Findings& found);
void circulation_closed_loop(Findings& found);
void cycle_default(Findings& found);
void cycle_closed_loop(Findings& found);
void cycle_engines(Findings& found);
void cycle_engines_limit(Findings& found);
void cycle_ranks(Findings& found);

// activation
void eikonal_point(Findings& found);
void eikonal_plane(Findings& found);

// blood alone
void stokes_modes(Findings& found);
void stokes_order(Findings& found);
void convection_order(Findings& found);

// wall meets grid
void delta_moments(Findings& found);
void spread_interpolate_adjoint(Findings& found);
void force_and_torque_conserved(Findings& found);
void thick_sphere_at_rest(Findings& found);

// equilibrium without time, and through it
void thick_sphere_static(Findings& found);
void coupled_sphere(Findings& found);
void generalised_alpha(Findings& found);
void no_locking(Findings& found);
void land2015_problem1(Findings& found);
void land2015_problem2(Findings& found);
void land2015_problem3(Findings& found);
void land2015_problem2_immersed(Findings& found);
void land2015_problem3_immersed(Findings& found);
void arostica_0a(Findings& found);
void arostica_0b(Findings& found);
void arostica_1(Findings& found);
void iterative_solver(Findings& found);
void calibration_twin(Findings& found);
void strain_twin(Findings& found);
void unloading_round_trip(Findings& found);

// the whole engine
void rank_independence(Findings& found);
void restart_is_bitwise(Findings& found);
void grid_convergence(Findings& found);
void time_step(Findings& found);
void idealised_ventricle(Findings& found);
void pressure_volume(Findings& found);
void other_ventricles(Findings& found);

// both engines
void engines_agree(Findings& found);

}  // namespace lv::verify
