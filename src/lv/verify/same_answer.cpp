#include "lv/base/log.hpp"
#include "lv/base/parallel.hpp"
#include "lv/verify/problems.hpp"
#include "lv/verify/small_ventricle.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstring>

namespace lv::verify {
namespace {

using heartbeat::flat;

constexpr double edge = 6.0;                     ///< of the small ventricle's elements [mm]
constexpr std::array<int, 3> cells{26, 26, 34};  ///< of its box

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = a.size() == b.size() ? 0.0 : std::nan("");
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
    largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

/// Steps around a cavity whose volume stays, by the pressure that each of them takes; the last
/// one's [kPa].
double hold_volume(immersed::Model& model, double pressure) {
  const auto of_step = [&](const immersed::StepVolume& v) {
    return v.guess - (v.volume - model.cavity_volume()) / v.per_pressure;
  };
  constexpr int steps = 40;
  constexpr int same_response = 10;
  for (int n = 0; n < steps; ++n)
    pressure = model.step({pressure, 1.0, 1.0}, 2e-4, of_step, n % same_response == 0).pressure;
  return pressure;
}

/// The first steps of a contraction under a rising pressure, then around a closed valve.
heartbeat::Archive contract() {
  const mesh::Mesh mesh = ideal_mesh({.edge_length = edge});
  immersed::Model model(mesh, {}, in_default_box(mesh, cells));
  model.relax(0.3);
  constexpr int steps = 80;
  for (int n = 0; n < steps; ++n) {
    const double ramp = heartbeat::smooth_step(static_cast<double>(n) / steps);
    static_cast<void>(model.step({2.0 * ramp, ramp, 0.3 + 0.7 * ramp}, 2e-4));
  }
  heartbeat::Archive result;
  result.set("pressure", {hold_volume(model, 2.0)});
  result.set("positions", flat(model.positions()));
  const auto tension = model.contraction().tension();
  result.set("tension", {tension.begin(), tension.end()});
  result.set("volume", {model.cavity_volume()});
  result.set("reference", flat(mesh.nodes));
  return result;
}

}  // namespace

/// One rank leaves its result for the others to compare with.
void rank_independence(Findings& found) {
  const std::filesystem::path file = found.scratch() / "on_one_rank";
  const heartbeat::Archive mine = contract();
  if (parallel::size() == 1) {
    mine.write(file);
    found.add("largest displacement after 24 ms, 1 rank",
              largest_difference(mine.get("positions"), mine.get("reference")), 5.0, 4.9, "mm");
    return;
  }
  const heartbeat::Archive one = heartbeat::Archive::read(file);
  const std::string ranks = fmt::format(", {} ranks and 1", parallel::size());
  const auto difference = [&](const std::string& name) {
    return largest_difference(mine.get(name), one.get(name));
  };
  // sums over ranks are rounded in another order; 120 steps amplify 1e-15 of 100 mm, 100 kPa and
  // 1e5 mm^3 by some hundreds at most. A pressure that holds 1e5 mm^3, of which a step changes
  // some 0.5 mm^3/kPa, has their rounding, 1e-10 mm^3, over that
  found.add_error("positions" + ranks, difference("positions"), 1e-10, "mm");
  found.add_error("tension" + ranks, difference("tension"), 1e-9, "kPa");
  found.add_error("cavity volume" + ranks, difference("volume") / one.number("volume"), 1e-12);
  found.add_error("pressure that holds a volume" + ranks, difference("pressure"), 1e-8, "kPa");
}

namespace {

/// A beat of 100 ms that never settles, with steps that are too long at first: some fail.
heartbeat::BeatSetup short_beat(const mesh::Mesh& mesh) {
  heartbeat::BeatSetup setup = default_beat(mesh, {32, 32, 42}, 6e-4);
  setup.protocol.filling_ramp = 0.02;
  setup.protocol.filling_longest = 0.05;
  setup.protocol.filling_window = 0.01;
  setup.protocol.contraction_ramp = 0.02;
  setup.protocol.contraction_longest = 0.05;
  setup.protocol.contraction_window = 0.01;
  setup.output.frame_interval = 0.01;
  return setup;
}

struct Killed {};

/// Runs in `folder`, is killed at every frame once, and run again.
heartbeat::Beat run_through_kills(const heartbeat::BeatSetup& setup,
                                  const std::filesystem::path& folder) {
  double survived = 0.0;
  heartbeat::Observers observers;
  observers.frame = [&](const heartbeat::Frame& frame) {
    if (frame.run.time <= survived)
      return;
    survived = frame.run.time;
    throw Killed{};
  };
  for (;;) {
    try {
      return heartbeat::run_immersed_beat(setup, folder, observers);
    } catch (const Killed&) {
    }
  }
}

/// All numbers of a beat.
std::vector<double> numbers(const heartbeat::Beat& beat) {
  heartbeat::Archive archive;
  heartbeat::store(beat.curves, archive);
  std::vector<double> all = archive.get("curves");
  for (const heartbeat::NamedMoment& moment : beat.moments) {
    const heartbeat::Snapshot& s = moment.wall;
    all.insert(all.end(), {s.time, s.pressure, s.volume});
    for (const auto& part : {flat(s.positions), s.tension})
      all.insert(all.end(), part.begin(), part.end());
  }
  all.insert(all.end(), {static_cast<double>(beat.steps), static_cast<double>(beat.retries)});
  return all;
}

/// How many of the numbers differ in any bit.
std::size_t count_differences(const std::vector<double>& a, const std::vector<double>& b) {
  std::size_t count = a.size() > b.size() ? a.size() - b.size() : b.size() - a.size();
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
    count += std::memcmp(&a[i], &b[i], sizeof(double)) != 0 ? 1 : 0;
  return count;
}

}  // namespace

/// Checkpoints are written every ten steps; the process dies at frames between two of them, before
/// and after steps that are taken back.
void restart_is_bitwise(Findings& found) {
  log::silence();
  const mesh::Mesh mesh = ideal_mesh({.edge_length = 4.5});
  heartbeat::BeatSetup setup = short_beat(mesh);
  const std::filesystem::path folder =
      found.scratch() / fmt::format("restarted_on_{}", parallel::size());
  if (parallel::is_root())
    std::filesystem::create_directories(folder);
  parallel::barrier();
  heartbeat::Observers frames;
  frames.frame = [](const heartbeat::Frame&) {};
  const heartbeat::Beat undisturbed = heartbeat::run_immersed_beat(setup, found.scratch(), frames);

  setup.output.checkpoint_interval = 0.0;
  const heartbeat::Beat resumed = run_through_kills(setup, folder);

  const std::string ranks =
      fmt::format(", {} rank{}", parallel::size(), parallel::size() == 1 ? "" : "s");
  found.add("numbers of the beat that differ" + ranks,
            static_cast<double>(count_differences(numbers(undisturbed), numbers(resumed))), 0.0,
            0.0);
  found.add_error("1 / steps that were taken back" + ranks, 1.0 / undisturbed.retries, 1.0);
}

}  // namespace lv::verify
