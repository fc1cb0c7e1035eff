#include "lv/job/beat_result.hpp"

#include "lv/base/parallel.hpp"
#include "lv/heartbeat/run_state.hpp"

#include <fmt/format.h>

namespace lv::job {
namespace {

using heartbeat::Archive;

/// A snapshot that an engine has taken of a wall: with the stress of every element, or the tension
/// at every node.
heartbeat::Snapshot load_whole_snapshot(const Archive& archive, const std::string& name,
                                        const mesh::Mesh& mesh) {
  heartbeat::Snapshot snapshot = heartbeat::load_snapshot(archive, name, mesh.nodes.size());
  const bool fits = snapshot.stress.empty()
                        ? snapshot.tension.size() == mesh.nodes.size()
                        : snapshot.stress.size() == static_cast<std::size_t>(mesh.cell_count());
  if (!fits || snapshot.positions.empty())
    archive.refuse(fmt::format("'{}' is of another wall", name));
  return snapshot;
}

}  // namespace

void write_beat(const heartbeat::Beat& beat, const std::filesystem::path& folder) {
  Archive archive;
  heartbeat::store(beat.curves, archive);
  heartbeat::store(beat.end_diastole, "end_diastole", archive);
  heartbeat::store(beat.end_systole, "end_systole", archive);
  archive.set("facts",
              {beat.filling_was_steady ? 1.0 : 0.0, beat.contraction_was_steady ? 1.0 : 0.0,
               static_cast<double>(beat.steps), static_cast<double>(beat.retries), beat.wall_clock,
               static_cast<double>(parallel::size())});
  archive.write(folder / beat_name);
}

BeatResult read_beat(const std::filesystem::path& folder, const mesh::Mesh& mesh) {
  const Archive archive = Archive::read(folder / beat_name);
  const auto& facts = archive.get_rows("facts", 6, 1, heartbeat::not_negative);
  BeatResult result;
  result.beat.curves = heartbeat::load_curves(archive);
  result.beat.end_diastole = load_whole_snapshot(archive, "end_diastole", mesh);
  result.beat.end_systole = load_whole_snapshot(archive, "end_systole", mesh);
  result.beat.filling_was_steady = facts[0] != 0.0;
  result.beat.contraction_was_steady = facts[1] != 0.0;
  result.beat.steps = archive.whole_number(facts[2]);
  result.beat.retries = archive.whole_number(facts[3]);
  result.beat.wall_clock = facts[4];
  result.ranks = archive.whole_number(facts[5]);
  return result;
}

}  // namespace lv::job
