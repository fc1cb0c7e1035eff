#include "lv/heartbeat/checkpoint.hpp"

#include "lv/base/check.hpp"
#include "lv/base/parallel.hpp"

#include <fmt/format.h>

namespace lv::heartbeat {
namespace {

constexpr const char* steps_name = "steps";  ///< the last two
constexpr const char* calcium_name = "calcium";
constexpr const char* slack_name = "slack";

std::string modes_name(int c) {
  return fmt::format("modes.{}", c);
}
std::string convection_name(int c) {
  return fmt::format("convection.{}", c);
}

/// What all ranks hold together.
std::size_t of_all_ranks(std::size_t mine) {
  return static_cast<std::size_t>(parallel::sum(static_cast<double>(mine)));
}

std::size_t points(const fluid::Component& u) {
  return static_cast<std::size_t>(u.nx()) * u.ny() * u.nz();
}

Moment load_moment(const Archive& archive, immersed::Model& model,
                   const std::vector<Phase>& phases) {
  immersed::ModelState state = load_model_state(archive, model);
  const std::size_t nodes = state.positions.size();
  return {std::move(state), load_run_state(archive, phases, nodes)};
}

}  // namespace

immersed::ModelState load_model_state(const Archive& archive, immersed::Model& model) {
  immersed::ModelState state = model.state();
  const std::size_t nodes = state.positions.size();
  const auto at_nodes = [&](const char* name) { return vectors(archive.get_rows(name, 3, nodes)); };
  state.positions = at_nodes("positions");
  state.node_velocities = at_nodes("node_velocities");
  state.velocity_change = at_nodes("velocity_change");
  state.contraction = archive.get_rows("contraction", 1, state.contraction.size());
  const auto& steps = archive.get_rows(steps_name, 2, 1, not_negative);
  state.dt = steps[0];
  state.dt_before = steps[1];
  state.calcium = archive.get_rows(calcium_name, 1, {}, not_negative);
  if (state.calcium.size() != 1 && state.calcium.size() != nodes)
    archive.refuse("it has calcium for another number of nodes");
  state.slack = archive.whole_number(archive.number(slack_name), {0.0, 1.0}) == 1;
  if (!model.inside_box(state.positions))
    throw RunError("the archive has a wall that is not inside the box",
                   "Delete it to start this stage again");
  for (int c = 0; c < 3; ++c) {
    auto& modes = state.velocity_modes[c];
    auto& convection = state.convection.component[c];
    model.transform().scatter(archive.get_rows(modes_name(c), 1, of_all_ranks(modes.size())), c,
                              state.velocity_modes);
    fluid::scatter(archive.get_rows(convection_name(c), 1, of_all_ranks(points(convection))),
                   convection);
  }
  return state;
}

Archive archived(const immersed::ModelState& state, const fluid::BoxTransform& transform) {
  Archive archive;
  archive.set("positions", flat(state.positions));
  archive.set("node_velocities", flat(state.node_velocities));
  archive.set("velocity_change", flat(state.velocity_change));
  archive.set("contraction", state.contraction);
  archive.set(steps_name, {state.dt, state.dt_before});
  archive.set(calcium_name, state.calcium);
  archive.set(slack_name, {state.slack ? 1.0 : 0.0});
  for (int c = 0; c < 3; ++c) {
    archive.set(modes_name(c), transform.gather(state.velocity_modes, c));
    archive.set(convection_name(c), fluid::gather(state.convection.component[c]));
  }
  return archive;
}

Archive archived(const immersed::ModelState& state, const RunState& run,
                 const fluid::BoxTransform& transform) {
  Archive archive = archived(state, transform);
  store(run, archive);
  return archive;
}

Checkpoint read_checkpoint(const std::filesystem::path& file, immersed::Model& model,
                           const std::vector<Phase>& phases) {
  Archive archive = Archive::read(file);
  Moment now = load_moment(archive.take("now"), model, phases);
  return {std::move(now), load_moment(archive.take("kept"), model, phases)};
}

}  // namespace lv::heartbeat
