#include "lv/heartbeat/run_state.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace lv::heartbeat {
namespace {

/// A number of an archive that counts things from zero of which there are so many.
std::size_t index_of(const Archive& archive, double number, std::size_t count) {
  return static_cast<std::size_t>(
      archive.whole_number(number, {0.0, static_cast<double>(count) - 1.0}));
}

/// How many rows an array may have: none, or one for each of the nodes where their number is known.
std::optional<std::size_t> none_or(const Archive& archive, const std::string& name,
                                   std::optional<std::size_t> nodes) {
  return archive.get(name).empty() ? 0 : nodes;
}

}  // namespace

void store(const Snapshot& s, const std::string& name, Archive& archive) {
  archive.set(name + ".numbers", {s.time, s.pressure, s.volume});
  archive.set(name + ".positions", flat(s.positions));
  archive.set(name + ".tension", s.tension);
  std::vector<double> stress;
  stress.reserve(solid::CellStress::numbers * s.stress.size());
  for (solid::CellStress cell : s.stress)
    stress.insert(stress.end(), cell.as_numbers().begin(), cell.as_numbers().end());
  archive.set(name + ".stress", std::move(stress));
}

Snapshot load_snapshot(const Archive& archive, const std::string& name,
                       std::optional<std::size_t> nodes) {
  const auto& n = archive.get_rows(name + ".numbers", 3, 1);
  const std::string positions = name + ".positions";
  const std::string tension = name + ".tension";
  const auto& numbers = archive.get_rows(name + ".stress", solid::CellStress::numbers);
  std::vector<solid::CellStress> stress(numbers.size() / solid::CellStress::numbers);
  auto next = numbers.begin();
  for (solid::CellStress& cell : stress) {
    std::copy_n(next, solid::CellStress::numbers, cell.as_numbers().begin());
    next += solid::CellStress::numbers;
  }
  return {n[0],
          n[1],
          n[2],
          vectors(archive.get_rows(positions, 3, none_or(archive, positions, nodes))),
          archive.get_rows(tension, 1, none_or(archive, tension, nodes)),
          std::move(stress)};
}

void store(const std::vector<NamedMoment>& moments, Archive& archive) {
  std::vector<std::string> names, phases;
  std::vector<double> by_criterion;
  for (const NamedMoment& m : moments) {
    names.push_back(m.name);
    phases.push_back(m.phase);
    by_criterion.push_back(m.by_criterion ? 1.0 : 0.0);
    store(m.wall, m.name, archive);
  }
  archive.set_words("moments.names", names);
  archive.set_words("moments.phases", phases);
  archive.set("moments.by_criterion", std::move(by_criterion));
}

std::vector<NamedMoment> load_moments(const Archive& archive, std::optional<std::size_t> nodes) {
  const auto names = archive.get_words("moments.names");
  const auto phases = archive.get_words("moments.phases");
  const auto by_criterion = archive.get_whole("moments.by_criterion", names.size(), {0.0, 1.0});
  if (phases.size() != names.size())
    archive.refuse("it has more moments than phases, or fewer");
  std::vector<NamedMoment> moments;
  for (std::size_t i = 0; i < names.size(); ++i)
    moments.push_back(
        {names[i], phases[i], by_criterion[i] == 1, load_snapshot(archive, names[i], nodes)});
  return moments;
}

void store(const std::vector<CurveRow>& curves, Archive& archive) {
  std::vector<std::string> phases;  // in their order, each once
  std::vector<double> numbers;
  for (const CurveRow& r : curves) {
    if (phases.empty() || phases.back() != r.phase)
      phases.push_back(r.phase);
    for (const double value :
         {r.time, static_cast<double>(phases.size() - 1), r.pressure, r.volume, r.calcium,
          r.mean_tension, r.kinetic_energy, r.largest_velocity, r.min_J, r.max_J, r.step})
      numbers.push_back(value);
  }
  archive.set("curves", std::move(numbers));
  archive.set_words("curves.phases", phases);
}

std::vector<CurveRow> load_curves(const Archive& archive) {
  constexpr std::size_t width = 11;
  const auto& numbers = archive.get_rows("curves", width, {}, {.missing = true});
  const auto phases = archive.get_words("curves.phases");
  std::vector<CurveRow> curves(numbers.size() / width);
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const double* n = numbers.data() + width * i;
    curves[i] = {n[0], phases[index_of(archive, n[1], phases.size())],
                 n[2], n[3],
                 n[4], n[5],
                 n[6], n[7],
                 n[8], n[9],
                 n[10]};
  }
  return curves;
}

void store(const RunState& run, Archive& archive) {
  archive.set("run", {run.time, static_cast<double>(run.phase), run.phase_start, run.next_frame,
                      run.next_curve, static_cast<double>(run.frames), run.largest_velocity,
                      static_cast<double>(run.halvings), static_cast<double>(run.good_steps),
                      static_cast<double>(run.patience), static_cast<double>(run.flips),
                      run.volume_was_falling ? 1.0 : 0.0, static_cast<double>(run.beat.steps),
                      static_cast<double>(run.beat.retries), run.beat.wall_clock});
  archive.set("frame_times", run.frame_times);
  std::vector<double> samples;
  for (const auto& [time, volume] : run.steady.samples())
    samples.insert(samples.end(), {time, volume});
  archive.set("steady", std::move(samples));
  store(run.least, "least", archive);
  store(run.beat.curves, archive);
  store(run.beat.moments, archive);
}

RunState load_run_state(const Archive& archive, const std::vector<Phase>& phases,
                        std::optional<std::size_t> nodes) {
  const auto& n = archive.get_rows("run", 15, 1, not_negative);
  const auto whole = [&](double number) { return archive.whole_number(number, not_negative); };
  RunState run;
  run.time = n[0];
  run.phase = index_of(archive, n[1], phases.size());
  run.phase_start = n[2];
  run.next_frame = n[3];
  run.next_curve = n[4];
  run.frames = whole(n[5]);
  run.largest_velocity = n[6];
  run.halvings = archive.whole_number(n[7], {0.0, most_halvings});
  run.good_steps = whole(n[8]);
  run.patience = whole(n[9]);
  run.flips = whole(n[10]);
  run.volume_was_falling = archive.whole_number(n[11], {0.0, 1.0}) == 1;
  run.beat.steps = whole(n[12]);
  run.beat.retries = whole(n[13]);
  run.beat.wall_clock = n[14];
  run.frame_times = archive.get_rows("frame_times", 1, static_cast<std::size_t>(run.frames));
  run.steady = criterion(phases[run.phase]);
  const auto& samples = archive.get_rows("steady", 2);
  for (std::size_t i = 0; i + 1 < samples.size(); i += 2)
    run.steady.record(samples[i], samples[i + 1]);
  run.least = load_snapshot(archive, "least", nodes);
  run.beat.curves = load_curves(archive);
  run.beat.moments = load_moments(archive, nodes);
  for (std::size_t p = 0; p < run.phase; ++p)
    if (run.beat.find(phases[p].marks) == nullptr)
      archive.refuse(
          fmt::format("it holds a {} without {}", phases[run.phase].name, phases[p].marks));
  return run;
}

SteadyVolume criterion(const Phase& phase) {
  return {phase.window, phase.tolerance};
}

}  // namespace lv::heartbeat
