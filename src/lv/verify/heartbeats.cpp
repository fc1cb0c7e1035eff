#include "lv/base/parallel.hpp"
#include "lv/base/units.hpp"
#include "lv/heartbeat/cycle.hpp"
#include "lv/heartbeat/immersed_cycle.hpp"
#include "lv/verify/problems.hpp"
#include "lv/verify/small_ventricle.hpp"

#include <fmt/format.h>

#include <algorithm>
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

namespace {

/// The immersed engine's case of a cycle of the other engine, on a grid half as fine as the
/// paper's. The mesh must outlive it.
heartbeat::BeatSetup immersed_cycle(const heartbeat::CycleSetup& setup, const mesh::Mesh& mesh) {
  heartbeat::BeatSetup immersed = default_beat(mesh, {48, 48, 64}, 2e-4);
  immersed.heart = setup.model.heart;
  immersed.heart.myocardium.stabilisation = material::Myocardium::stabilisation_of_heartbeats;
  immersed.protocol.calcium = setup.calcium;
  immersed.protocol.cycle = setup.cycle;
  return immersed;
}

/// Of the immersed engine in a closed loop, which starts in the other engine's limit cycle and says
/// whether it stays there. Its blood does not flow twice alike, so that its states come to no limit
/// of their own, though its volumes do.
constexpr int beats_from_the_limit = 5;

/// The circuit's states where the beats of a run have ended.
circulation::Start end_of_beats(const std::filesystem::path& folder) {
  const auto archive = heartbeat::Archive::read(folder / heartbeat::end_of_beats);
  return circulation::start_of(heartbeat::load_begin(archive).circuit);
}

/// The last beats of both engines, their base on the same springs, blood and muscle with inertia or
/// without: the bounds of the paper for its pair of engines, 3% in volume (section 3.1), and as
/// much in pressure. Returns the immersed engine's beats.
circulation::Cycle compare_engines(heartbeat::CycleSetup setup, Findings& found) {
  setup.model.heart.base = {};
  const heartbeat::Beat implicit = run(setup, found, "implicit");
  if (setup.cycle.tolerance > 0.0) {
    found.add_error("change of the implicit limit cycle", implicit.cycle->change,
                    setup.cycle.tolerance);
    setup.circuit.start = end_of_beats(folder_of(found, "implicit"));
    setup.cycle = {.beats = beats_from_the_limit, .tolerance = 0.0};
  }
  const mesh::Mesh linear = ideal_mesh({.edge_length = 2.8});
  const heartbeat::Beat immersed = heartbeat::run_immersed_cycle(
      immersed_cycle(setup, linear), setup.circuit, folder_of(found, "immersed"), {});

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
  return *immersed.cycle;
}

}  // namespace

/// One heartbeat of the same ventricle by both engines.
void cycle_engines(Findings& found) {
  const mesh::Mesh mesh = default_mesh();
  heartbeat::CycleSetup setup = human_cycle(mesh, circulation::Kind::windkessel);
  setup.cycle.beats = 1;
  compare_engines(setup, found);
}

/// The limit cycle of a closed loop, and beats of the immersed engine that begin in it with as much
/// blood: the limit's change is well below the bound of the comparison.
void cycle_engines_limit(Findings& found) {
  const mesh::Mesh mesh = default_mesh();
  heartbeat::CycleSetup setup = human_cycle(mesh, circulation::Kind::closed_loop);
  setup.circuit.start = {};
  setup.circuit.closed_loop.blood = 1400.0 * ml;
  setup.cycle.beats = 10;
  setup.cycle.tolerance = 3e-3;
  setup.cycle.step = 4e-3;
  const circulation::Cycle immersed = compare_engines(setup, found);
  const circulation::BeatMeasures& last = immersed.beats.back();
  const circulation::BeatMeasures& before = immersed.beats[immersed.beats.size() - 2];
  constexpr double of_blood = 0.02;
  found.add_within("EDV, the last immersed beat and the one before it",
                   last.end_diastolic_volume / ml, before.end_diastolic_volume / ml, of_blood,
                   "ml");
  found.add_within("ESV, the last immersed beat and the one before it",
                   last.end_systolic_volume / ml, before.end_systolic_volume / ml, of_blood, "ml");
  found.add_error("change of the total volume, immersed", immersed.blood_lost, 1e-10);
}

namespace {

/// Two of them, with a front through the wall.
heartbeat::BeatSetup quick_immersed(const mesh::Mesh& mesh) {
  heartbeat::BeatSetup setup = quick_heartbeat(mesh);
  setup.protocol.cycle = {.beats = 2, .tolerance = 1e-6};  // with a leap between them
  for (const double t : mesh.transmural)
    setup.activation_times.push_back(0.01 * t);
  return setup;
}

/// A closed loop whose other chambers beat as fast.
circulation::CircuitParameters quick_loop() {
  circulation::CircuitParameters circuit;
  circuit.kind = circulation::Kind::closed_loop;
  circuit.period = 0.4;
  circuit.left_ventricle.t_C = 0.05;
  circulation::ClosedLoopParameters& loop = circuit.closed_loop;
  for (circulation::ElastanceParameters* atrium : {&loop.left_atrium, &loop.right_atrium}) {
    atrium->T_C = atrium->T_R = 0.08;
    atrium->t_C = 0.36;
  }
  loop.right_ventricle.T_C = 0.12;
  loop.right_ventricle.T_R = 0.2;
  loop.right_ventricle.t_C = 0.05;
  return circuit;
}

/// Volume and pressure at all steps that are kept.
std::vector<double> loops(const heartbeat::Beat& beat) {
  std::vector<double> all;
  for (const circulation::Sample& s : beat.cycle->samples)
    all.insert(all.end(), {s.signals.volume / ml, s.signals.pressure / mmHg});
  return all;
}

}  // namespace

/// One rank leaves its beats for two to compare with. Sums over ranks are rounded in another order,
/// and two thousand steps with valves amplify that: a millionth of a heart's volumes and pressures.
void cycle_ranks(Findings& found) {
  const mesh::Mesh mesh = ideal_mesh({.edge_length = 9.0});
  const circulation::CircuitParameters circuit = quick_loop();
  const std::string name = fmt::format("on_{}_ranks", parallel::size());
  const heartbeat::Beat beat = heartbeat::run_immersed_cycle(quick_immersed(mesh), circuit,
                                                             folder_of(found, name.c_str()), {});
  const std::vector<double> mine = loops(beat);
  const std::filesystem::path file = found.scratch() / "loops_on_one_rank";
  if (parallel::size() == 1) {
    heartbeat::Archive archive;
    archive.set("loops", mine);
    archive.write(file);
    found.add("beats after a leap, 1 rank", beat.cycle->leaps, 1.0, 0.0);
    return;
  }
  const std::vector<double> one = heartbeat::Archive::read(file).get_rows("loops", 2);
  double largest = one.size() == mine.size() ? 0.0 : std::nan("");
  for (std::size_t i = 0; i < std::min(one.size(), mine.size()); ++i)
    largest = std::max(largest, std::abs(one[i] - mine[i]));
  found.add_error(
      fmt::format("volumes (ml) and pressures (mmHg), {} ranks and 1", parallel::size()), largest,
      1e-4);
}

}  // namespace lv::verify
