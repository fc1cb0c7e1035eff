#include "lv/pipeline/beat_result.hpp"

#include "lv/base/parallel.hpp"
#include "lv/heartbeat/cycle.hpp"
#include "lv/heartbeat/run_state.hpp"
#include "lv/mesh/quadratic.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace lv::pipeline {
namespace {

using heartbeat::Archive;

/// The moments of a whole beat as an engine has taken them of a wall: with the stress of every
/// element, or the tension at every node.
std::vector<heartbeat::NamedMoment> load_whole_moments(const Archive& archive,
                                                       const mesh::Mesh& mesh) {
  auto moments = heartbeat::load_moments(archive, mesh.nodes.size());
  for (const auto& [name, phase, by_criterion, wall] : moments) {
    const bool fits = wall.stress.empty()
                          ? wall.tension.size() == mesh.nodes.size()
                          : wall.stress.size() == static_cast<std::size_t>(mesh.cell_count());
    if (!fits || wall.positions.empty())
      archive.refuse(fmt::format("'{}' is of another wall", name));
  }
  for (const char* name : {heartbeat::end_diastole, heartbeat::end_systole})
    if (std::none_of(moments.begin(), moments.end(), [&](const auto& m) { return m.name == name; }))
      archive.refuse(fmt::format("it holds a beat without {}", name));
  return moments;
}

std::vector<double> load_activation_times(const Archive& archive, std::size_t nodes) {
  if (archive.get("activation_times").empty())
    return {};
  return archive.get_rows("activation_times", 1, nodes, heartbeat::not_negative);
}

}  // namespace

void write_beat(const heartbeat::Beat& beat, const std::filesystem::path& folder) {
  Archive archive;
  heartbeat::store(beat.curves, archive);
  heartbeat::store(beat.moments, archive);
  archive.set("facts", {static_cast<double>(beat.steps), static_cast<double>(beat.retries),
                        beat.wall_clock, static_cast<double>(parallel::size())});
  if (beat.cycle) {
    heartbeat::store(*beat.cycle, archive);
    heartbeat::store(beat.energy, archive);
    archive.set("activation_times", beat.activation_times);
  }
  archive.write(folder / beat_name);
}

BeatResult read_beat(const std::filesystem::path& folder, const mesh::Mesh& mesh) {
  const Archive archive = Archive::read(folder / beat_name);
  const auto& facts = archive.get_rows("facts", 4, 1, heartbeat::not_negative);
  BeatResult result;
  result.beat.curves = heartbeat::load_curves(archive);
  result.beat.moments = load_whole_moments(archive, mesh);
  if (archive.has("cycle.facts")) {
    result.beat.cycle = heartbeat::load_cycle(archive);
    result.beat.energy = heartbeat::load_energy(archive);
    if (const std::size_t elements = result.beat.energy.work_density.size();
        elements > 0 && elements * mesh::cells_per_element(mesh.order) !=
                            static_cast<std::size_t>(mesh.cell_count()))
      archive.refuse("'work_density' is of another wall");
    result.beat.activation_times = load_activation_times(archive, mesh.nodes.size());
  }
  result.beat.steps = archive.whole_number(facts[0]);
  result.beat.retries = archive.whole_number(facts[1]);
  result.beat.wall_clock = facts[2];
  result.ranks = archive.whole_number(facts[3]);
  return result;
}

circulation::Cycle read_cycle(const std::filesystem::path& folder) {
  return heartbeat::load_cycle(Archive::read(folder / beat_name));
}

}  // namespace lv::pipeline
