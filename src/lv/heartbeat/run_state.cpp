#include "lv/heartbeat/run_state.hpp"

#include "lv/base/check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <utility>

namespace lv::heartbeat {
namespace {

std::vector<double> flat(const std::vector<Vec3>& vectors) {
  std::vector<double> numbers;
  numbers.reserve(3 * vectors.size());
  for (const Vec3& v : vectors)
    numbers.insert(numbers.end(), v.data(), v.data() + 3);
  return numbers;
}

std::vector<Vec3> vectors(const std::vector<double>& numbers) {
  std::vector<Vec3> result(numbers.size() / 3);
  for (std::size_t a = 0; a < result.size(); ++a)
    result[a] = Vec3(numbers[3 * a], numbers[3 * a + 1], numbers[3 * a + 2]);
  return result;
}

/// Words as the numbers of their letters, each word ended by a zero, and back.
std::vector<double> as_numbers(const std::vector<std::string>& words) {
  std::vector<double> numbers;
  for (const std::string& word : words) {
    numbers.insert(numbers.end(), word.begin(), word.end());
    numbers.push_back(0.0);
  }
  return numbers;
}

std::vector<std::string> as_words(const std::vector<double>& numbers) {
  std::vector<std::string> words;
  std::string word;
  for (const double letter : numbers) {
    if (letter != 0.0)
      word += static_cast<char>(whole_number(letter));
    else
      words.push_back(std::exchange(word, {}));
  }
  return words;
}

/// Throws RunError when there is no phase of that number.
const std::string& phase_named(const std::vector<std::string>& phases, double number) {
  const auto phase = static_cast<std::size_t>(whole_number(number));
  if (phase >= phases.size())
    throw RunError(fmt::format("the archive has no phase {}", phase),
                   "It was written by another version of the program; delete it to start again");
  return phases[phase];
}

}  // namespace

void store(const Snapshot& s, const std::string& name, Archive& archive) {
  archive.set(name + ".numbers", {s.time, s.pressure, s.volume});
  archive.set(name + ".positions", flat(s.positions));
  archive.set(name + ".tension", s.tension);
  std::vector<double> stress(solid::CellStress::numbers * s.stress.size());
  if (!stress.empty())
    std::memcpy(stress.data(), s.stress.data(), sizeof(double) * stress.size());
  archive.set(name + ".stress", std::move(stress));
}

Snapshot load_snapshot(const Archive& archive, const std::string& name) {
  const auto& n = archive.get_rows(name + ".numbers", 3, 1);
  const auto& numbers = archive.get_rows(name + ".stress", solid::CellStress::numbers);
  std::vector<solid::CellStress> stress(numbers.size() / solid::CellStress::numbers);
  if (!stress.empty())
    std::memcpy(static_cast<void*>(stress.data()), numbers.data(), sizeof(double) * numbers.size());
  return {n[0],
          n[1],
          n[2],
          vectors(archive.get_rows(name + ".positions", 3)),
          archive.get(name + ".tension"),
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
  archive.set("moments.names", as_numbers(names));
  archive.set("moments.phases", as_numbers(phases));
  archive.set("moments.by_criterion", std::move(by_criterion));
}

std::vector<NamedMoment> load_moments(const Archive& archive) {
  const auto names = as_words(archive.get("moments.names"));
  const auto phases = as_words(archive.get("moments.phases"));
  const auto& by_criterion = archive.get_rows("moments.by_criterion", 1, names.size());
  std::vector<NamedMoment> moments;
  for (std::size_t i = 0; i < std::min(names.size(), phases.size()); ++i)
    moments.push_back(
        {names[i], phases[i], by_criterion[i] != 0.0, load_snapshot(archive, names[i])});
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
  archive.set("curves.phases", as_numbers(phases));
}

std::vector<CurveRow> load_curves(const Archive& archive) {
  constexpr std::size_t width = 11;
  const auto& numbers = archive.get_rows("curves", width);
  const auto phases = as_words(archive.get("curves.phases"));
  std::vector<CurveRow> curves(numbers.size() / width);
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const double* n = numbers.data() + width * i;
    curves[i] = {n[0], phase_named(phases, n[1]), n[2], n[3], n[4], n[5], n[6], n[7], n[8], n[9],
                 n[10]};
  }
  return curves;
}

void store(const RunState& run, Archive& archive) {
  archive.set("run", {run.time, static_cast<double>(run.phase), run.phase_start, run.next_frame,
                      run.next_curve, static_cast<double>(run.frames), run.largest_velocity,
                      static_cast<double>(run.halvings), static_cast<double>(run.good_steps),
                      static_cast<double>(run.patience), run.volume_was_falling ? 1.0 : 0.0,
                      static_cast<double>(run.beat.steps), static_cast<double>(run.beat.retries),
                      run.beat.wall_clock});
  archive.set("frame_times", run.frame_times);
  std::vector<double> samples;
  for (const auto& [time, volume] : run.steady.samples())
    samples.insert(samples.end(), {time, volume});
  archive.set("steady", std::move(samples));
  store(run.least, "least", archive);
  store(run.beat.curves, archive);
  store(run.beat.moments, archive);
}

RunState load_run_state(const Archive& archive, const std::vector<Phase>& phases) {
  const auto& n = archive.get_rows("run", 14, 1);
  RunState run;
  run.time = n[0];
  run.phase = static_cast<std::size_t>(whole_number(n[1]));
  if (run.phase >= phases.size())
    throw RunError(fmt::format("the archive has no phase {}", run.phase),
                   "It was written by another version of the program; delete it to start again");
  run.phase_start = n[2];
  run.next_frame = n[3];
  run.next_curve = n[4];
  run.frames = whole_number(n[5]);
  run.largest_velocity = n[6];
  run.halvings = whole_number(n[7]);
  run.good_steps = whole_number(n[8]);
  run.patience = whole_number(n[9]);
  run.volume_was_falling = n[10] != 0.0;
  run.beat.steps = whole_number(n[11]);
  run.beat.retries = whole_number(n[12]);
  run.beat.wall_clock = n[13];
  run.frame_times =
      archive.get_rows("frame_times", 1, static_cast<std::size_t>(std::max(run.frames, 0)));
  run.steady = criterion(phases[run.phase]);
  const auto& samples = archive.get_rows("steady", 2);
  for (std::size_t i = 0; i + 1 < samples.size(); i += 2)
    run.steady.record(samples[i], samples[i + 1]);
  run.least = load_snapshot(archive, "least");
  run.beat.curves = load_curves(archive);
  run.beat.moments = load_moments(archive);
  return run;
}

SteadyVolume criterion(const Phase& phase) {
  return {phase.window, phase.tolerance};
}

}  // namespace lv::heartbeat
