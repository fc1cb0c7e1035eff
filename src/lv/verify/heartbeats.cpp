#include "lv/base/parallel.hpp"
#include "lv/base/units.hpp"
#include "lv/heartbeat/cycle.hpp"
#include "lv/heartbeat/immersed_cycle.hpp"
#include "lv/verify/problems.hpp"
#include "lv/verify/small_ventricle.hpp"

#include <cmath>

/// Whole heartbeats of a wall joined to a circulation.
namespace lv::verify {
namespace {

using units::ml;
using units::mmHg;

/// Newton's last correction is below 1e-6 mm, over 8000 mm^2 of endocardium 0.008 mm^3 of 7e4, of
/// which a tenth is wrong where the tangent is kept.
constexpr double by_newton = 1e-8;

/// Quadratic elements of 14 mm, graded as those of a case.
mesh::Mesh default_mesh() {
  return ideal_mesh({.edge_length = 7.0, .order = 2, .apex = 0.3, .endocardium = 0.5});
}

/// Human muscle and calcium in the default ventricle's shape.
heartbeat::CycleSetup human_cycle(const mesh::Mesh& mesh, circulation::Kind kind) {
  solid::CardiacModel heart{.base = {.stiffness = implicit::rigid_base}};
  heart.myocardium.active = material::Land2017{};
  const material::Calcium calcium{.mode = material::Calcium::Mode::transient,
                                  .Ca_0 = 0.1,
                                  .Ca_max = 0.7,
                                  .shape = material::Calcium::CurveShape::double_exponential};
  heartbeat::CycleSetup setup{.mesh = mesh,
                              .model = {heart, calcium},
                              .solver = {},
                              .calcium = calcium,
                              .circuit = {},
                              .cycle = {}};
  setup.circuit.kind = kind;
  setup.circuit.start.p_ar_sys = 80.0 * mmHg;
  setup.cycle.tolerance = 0.0;  // all beats
  return setup;
}

std::filesystem::path folder_of(const Findings& found, const char* name) {
  std::filesystem::path folder = found.scratch() / name;
  if (parallel::is_root())
    std::filesystem::create_directories(folder);
  parallel::barrier();
  return folder;
}

heartbeat::Beat run(const heartbeat::CycleSetup& setup, const Findings& found, const char* name) {
  return heartbeat::run_cycle(setup, folder_of(found, name), {});
}

}  // namespace

/// The default ventricle with human muscle on a windkessel, against an independent solver
/// (axisymmetric with torsion, a coarse mesh, steps of 4 ms), whose times are printed as multiples
/// of its step: a valve may differ by one of those. Its pressures are printed to three digits, and
/// elements of 7 mm change volumes and pressures here by 0.1% at most: 1%.
void cycle_default(Findings& found) {
  const mesh::Mesh mesh = default_mesh();
  heartbeat::CycleSetup setup = human_cycle(mesh, circulation::Kind::windkessel);
  setup.cycle.beats = 1;
  const heartbeat::Beat beat = run(setup, found, "windkessel");
  const circulation::BeatMeasures& m = beat.cycle->beats.back();
  constexpr double fraction = 0.01;
  constexpr double moment = 4e-3;  // [s]
  found.add_within("EDV", m.end_diastolic_volume / ml, 144.7, fraction, "ml");
  found.add_within("ESV", m.end_systolic_volume / ml, 69.6, fraction, "ml");
  found.add_within("peak pressure", m.peak_pressure / mmHg, 142.0, fraction, "mmHg");
  found.add("aortic valve opens", m.aortic_opens, 0.04, moment, "s");
  found.add("aortic valve closes", m.aortic_closes, 0.216, moment, "s");
  found.add("mitral valve opens", m.mitral_opens, 0.42, moment, "s");
  found.add_error("volume of the wall's cavity against the circuit's", beat.cycle->volume_gap,
                  by_newton);
  found.add_error("work of pressure and muscle against what is stored", beat.energy.error(), 0.01);
}

/// A closed loop keeps its blood, whatever the wall does with it.
void cycle_closed_loop(Findings& found) {
  const mesh::Mesh mesh = default_mesh();
  heartbeat::CycleSetup setup = human_cycle(mesh, circulation::Kind::closed_loop);
  setup.circuit.start = {};
  setup.cycle.beats = 1;
  setup.cycle.step = 4e-3;
  const heartbeat::Beat beat = run(setup, found, "closed_loop");
  const circulation::BeatMeasures& m = beat.cycle->beats.back();
  found.add_error("change of the total volume", beat.cycle->blood_lost, 1e-10);
  found.add_error("volume of the wall's cavity against the circuit's", beat.cycle->volume_gap,
                  by_newton);
  found.add_error("work of pressure and muscle against what is stored", beat.energy.error(), 0.01);
  // contraction follows calcium, which rises at 0.1 s, by some hundredths of a second
  found.add("aortic valve opens", m.aortic_opens, 0.15, 0.05, "s");
}

/// One heartbeat of the same ventricle by both engines, its base on the same springs, its blood and
/// muscle with inertia or without: the bounds of the paper for its pair of engines, 3% in volume
/// (section 3.1), and as much in pressure. The immersed grid is half as fine as the paper's.
void cycle_engines(Findings& found) {
  const mesh::Mesh quadratic = default_mesh();
  heartbeat::CycleSetup setup = human_cycle(quadratic, circulation::Kind::windkessel);
  setup.model.heart.base = {};
  setup.cycle.beats = 1;
  const heartbeat::Beat implicit = run(setup, found, "implicit");

  const mesh::Mesh linear = ideal_mesh({.edge_length = 2.8});
  heartbeat::BeatSetup immersed_setup = default_beat(linear, {48, 48, 64}, 2e-4);
  immersed_setup.heart = setup.model.heart;
  immersed_setup.protocol.calcium = setup.calcium;
  immersed_setup.protocol.cycle = setup.cycle;
  const heartbeat::Beat immersed = heartbeat::run_immersed_cycle(immersed_setup, setup.circuit,
                                                                 folder_of(found, "immersed"), {});

  const circulation::BeatMeasures& a = immersed.cycle->beats.back();
  const circulation::BeatMeasures& b = implicit.cycle->beats.back();
  constexpr double fraction = 0.03;
  found.add_within("EDV, immersed and implicit", a.end_diastolic_volume / ml,
                   b.end_diastolic_volume / ml, fraction, "ml");
  found.add_within("ESV, immersed and implicit", a.end_systolic_volume / ml,
                   b.end_systolic_volume / ml, fraction, "ml");
  found.add_within("peak pressure, immersed and implicit", a.peak_pressure / mmHg,
                   b.peak_pressure / mmHg, fraction, "mmHg");
  found.add_within("systolic pressure of the aorta", a.aortic_systolic / mmHg,
                   b.aortic_systolic / mmHg, fraction, "mmHg");
  // of the fan at the base, which its springs of 300 kPa/mm let go by tenths of a millimetre
  found.add_error("volume of the immersed cavity against the circuit's", immersed.cycle->volume_gap,
                  0.01);
}

}  // namespace lv::verify
