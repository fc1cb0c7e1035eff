#include "lv/pipeline/cost.hpp"

#include "lv/base/check.hpp"
#include "lv/base/log.hpp"
#include "lv/heartbeat/protocol.hpp"
#include "lv/mesh/quadratic.hpp"
#include "lv/pipeline/calibration.hpp"

#include <fmt/format.h>

#include <ctime>

namespace lv::pipeline {
namespace {

using case_file::Case;

/// Of the quasi-static engine, in times of a first load step: a beat, an unloading by the inverse
/// problem, and a fit of one parameter with the walls of its trials. Rough (docs/progress.md).
constexpr double steps_of_beat = 45.0;
constexpr double steps_of_unloading = 4.0;
constexpr double steps_of_fit = 45.0;
constexpr double steps_of_walls_of_fit = 10.0;
constexpr double steps_of_heartbeat = 13.0;   // of its tangents, which longer time steps share
constexpr double steps_of_time_step = 0.067;  // and of each of its time steps besides
constexpr double beats_of_fit = 30.0;         // with sensitivities
constexpr int many_unknowns = 100'000;        // whose load step takes longer than some seconds

/// Processor time of this thread, as other programs at work take none of it.
double processor_seconds() {
  std::timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

template <class Work>
double seconds(const Work& work) {
  const double start = processor_seconds();
  work();
  return processor_seconds() - start;
}

/// How long one engine takes, or why it cannot.
struct Estimate {
  std::string details, words;
  double step = 0.0;  ///< [s]
};

std::string beat_of_immersed(const Case& c, double step) {
  const auto takes = [&](double simulated) {
    return log::duration(simulated / c.time.longest * step);
  };
  const std::vector<heartbeat::Phase> phases = heartbeat::phases(c.protocol);
  if (case_file::is_cycle(c))
    return fmt::format("about {} to fill and {} a beat, of which {} at most",
                       takes(phases.front().usual), takes(c.circulation.period),
                       c.protocol.cycle.beats);
  double simulated = 0.0;
  for (const heartbeat::Phase& phase : phases)
    simulated += phase.usual;
  return fmt::format("about {}", takes(simulated));
}

Estimate of_immersed(const Case& c, const mesh::Mesh& mesh) {
  log::info("trying steps of the immersed engine ...");
  const immersed::ModelParameters p = case_file::model_parameters(c, mesh);
  immersed::Model model(mesh, case_file::cardiac_model(c), p);
  model.relax(c.protocol.calcium.Ca_0);
  constexpr int steps = 3;
  const double step =
      seconds([&] {
        for (int i = 0; i < steps; ++i)
          static_cast<void>(model.step({.calcium = c.protocol.calcium.Ca_0}, c.time.longest));
      }) /
      steps;
  return {
      fmt::format("  grid: {} x {} x {}, mesh width {:.3f} mm; {:.3g} s a step\n", p.grid.cells[0],
                  p.grid.cells[1], p.grid.cells[2], p.grid.spacing.minCoeff(), step),
      beat_of_immersed(c, step), step};
}

/// Of the quasi-static engine [s].
double heartbeat_of(const Case& c, double load_step) {
  const double time_steps = c.circulation.period / c.protocol.cycle.step;
  return load_step * (steps_of_heartbeat + time_steps * steps_of_time_step);
}

std::string beat_in_words(const Case& c, double load_step) {
  if (!case_file::is_cycle(c))
    return fmt::format("about {}", log::duration(steps_of_beat * load_step));
  return fmt::format("about {} a beat, of which {} at most",
                     log::duration(heartbeat_of(c, load_step)), c.protocol.cycle.beats);
}

Estimate of_quasi_static(const Case& c, const mesh::Mesh& mesh) {
  log::info("trying a load step of the quasi-static engine ...");
  implicit::SolverParameters solver = c.quasi_static.solver;
  const double share = solver.first_step;
  solver.first_step = 1.0;
  implicit::Engine engine(mesh, case_file::static_model(c), solver);
  if (engine.equations().size() > many_unknowns)
    log::info(
        "a load step of {} unknowns is solved to tell what the case costs; it may take minutes",
        engine.equations().size());
  const double step = seconds([&] { engine.go_to({share * c.protocol.ed_pressure, 0.0}).value(); });
  return {fmt::format("  quasi-static: {} finite elements of order {}, {} unknowns; {:.3g} s a "
                      "load step\n",
                      mesh::elements(mesh).size(), mesh.order, engine.equations().size(), step),
          beat_in_words(c, step), step};
}

/// For the engine that the case does not name, what it would say if it did.
template <class Trial>
Estimate tried(const Trial& trial) {
  try {
    return trial();
  } catch (const InputError& failure) {
    return {"", fmt::format("cannot run it ({})", failure.what()), 0.0};
  } catch (const NoSolution& failure) {
    return {"", fmt::format("cannot run it ({})", failure.what()), 0.0};
  }
}

/// What comes before the beat, on the quasi-static engine.
std::string preparation(const Case& c, double step) {
  const case_file::Calibration& k = c.calibration;
  const int fitted = (k.passive == calibrate::FittedPassive::none ? 0 : 1) +
                     (k.passive == calibrate::FittedPassive::scale_and_exponent ||
                              k.passive == calibrate::FittedPassive::klotz
                          ? 1
                          : 0) +
                     (k.active ? 1 : 0);
  const bool is_loaded = case_file::is_loaded(c);
  const double unloading = is_loaded ? steps_of_unloading * step : 0.0;
  const double walls = is_loaded ? steps_of_walls_of_fit * step : 0.0;
  const double beats = k.cycle ? beats_of_fit * heartbeat_of(c, step) : 0.0;
  const double fit = fitted * (steps_of_fit * step + walls) + beats;
  if (unloading + fit == 0.0)
    return "";
  return fmt::format(", {}{}{} before it about {}", unloading > 0.0 ? "unloading" : "",
                     unloading > 0.0 && fit > 0.0 ? " and " : "", fit > 0.0 ? "calibration" : "",
                     log::duration(unloading + fit));
}

Case with_engine(Case c, case_file::EngineChoice engine) {
  c.engine = engine;
  return c;
}

}  // namespace

Cost cost_of(const Case& c, const anatomy::Shape& shape, const anatomy::MeshResult& mesh) {
  const auto mesh_of = [&](case_file::EngineChoice engine) {
    if (c.engine == engine)
      return mesh;
    const Case other = with_engine(c, engine);
    anatomy::MeshResult made = make_mesh(other, shape);
    check_room(other, made.mesh);
    return made;
  };
  const auto immersed = [&] {
    return of_immersed(with_engine(c, case_file::EngineChoice::immersed),
                       mesh_of(case_file::EngineChoice::immersed).mesh);
  };
  const auto quasi_static = [&] {
    return of_quasi_static(with_engine(c, case_file::EngineChoice::quasi_static),
                           mesh_of(case_file::EngineChoice::quasi_static).mesh);
  };
  const bool is_immersed = c.engine == case_file::EngineChoice::immersed;
  const Estimate dynamic = is_immersed ? immersed() : tried(immersed);
  const Estimate slow = is_immersed ? tried(quasi_static) : quasi_static();
  return {dynamic.details + slow.details,
          fmt::format("immersed {}, quasi_static {}{}", dynamic.words, slow.words,
                      preparation(c, slow.step))};
}

}  // namespace lv::pipeline
