#include "lv/base/log.hpp"
#include "lv/heartbeat/immersed_beat.hpp"
#include "lv/verify/land2015.hpp"
#include "lv/verify/problems.hpp"

#include <fmt/format.h>

#include <cmath>

/// Problems 2 and 3 of Land et al. (2015) with the immersed engine: the same equilibria, at the end
/// of a motion through blood.
namespace lv::verify {
namespace {

using heartbeat::Protocol;
using heartbeat::Snapshot;

constexpr double ramp = 0.1;  ///< of the loads [s]
constexpr double never = 1e9;

/// Pressure alone: a filling.
Protocol inflation(const LandProblem& problem) {
  Protocol p;
  p.ed_pressure = problem.pressure;
  p.filling_ramp = ramp;
  p.filling_drag = 100.0;
  p.filling_window = 0.02;
  p.filling_tolerance = 5e-4;
  p.contraction_longest = 1e-4;  // filling is all that is asked for
  return p;
}

/// Pressure and tension together: a contraction that begins without load.
Protocol contraction(const LandProblem& problem) {
  Protocol p;
  p.ed_pressure = 0.0;
  p.filling_longest = 1e-4;
  p.es_pressure = problem.pressure;
  p.contraction_ramp = ramp;
  p.contraction_drag = 100.0;
  p.contraction_window = 0.02;
  p.contraction_tolerance = 5e-4;
  return p;
}

/// A box of 40 x 40 x 48 mm around the ventricle, elements smaller than its cells, and springs that
/// hold the base in every direction.
heartbeat::BeatSetup setup(const LandProblem& problem, const Protocol& protocol,
                           const mesh::Mesh& mesh, double mesh_width) {
  const Vec3 box(40.0, 40.0, 48.0);
  const auto cells = [&](int d) { return static_cast<int>(std::lround(box[d] / mesh_width)); };
  immersed::ModelParameters model;
  model.grid = fluid::centred_grid({0.0, 0.0, -13.0}, box, {cells(0), cells(1), cells(2)});
  heartbeat::BeatSetup s{mesh, problem.heart, model, protocol, {}, {}};
  s.heart.base = {solid::BasalSupport::Kind::fixed, 1000.0};
  s.control.longest = 4e-5 * mesh_width;
  s.output.frame_interval = never;
  s.output.checkpoint_interval = never;
  return s;
}

void compare(const LandProblem& problem, const Protocol& protocol, const std::string& moment,
             const LandReference& reference, Findings& found) {
  for (const double h : {1.0, 0.7}) {
    mesh::Mesh mesh = LandEllipsoid::mesh({.edge_length = 0.9 * h});
    mesh.fibres.rule = problem.fibres;
    log::info("{} elements, mesh width {} mm", mesh.cell_count(), h);
    const auto beat = heartbeat::run_immersed_beat(setup(problem, protocol, mesh, h),
                                                   found.scratch() / fmt::format("{}", h), {});
    const Snapshot& end = beat.at(moment);
    const LandApex apex = land_apex(mesh, end.positions);
    const std::string which = fmt::format(", mesh width {} mm", h);
    // of first order in the mesh width where blood and muscle meet
    found.add("z of the endocardial apex" + which, apex.endo, reference.apex.endo, 0.5 * h, "mm");
    found.add("z of the epicardial apex" + which, apex.epi, reference.apex.epi, 0.5 * h, "mm");
    found.add_within("cavity volume" + which, end.volume, reference.volume, 0.03 * h, "mm^3");
  }
}

}  // namespace

void land2015_problem2_immersed(Findings& found) {
  const LandProblem problem = land_inflation();
  compare(problem, inflation(problem), heartbeat::end_diastole, land_inflation_reference, found);
}

void land2015_problem3_immersed(Findings& found) {
  const LandProblem problem = land_contraction();
  compare(problem, contraction(problem), heartbeat::end_systole, land_contraction_reference, found);
}

}  // namespace lv::verify
