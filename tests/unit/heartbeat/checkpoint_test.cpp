#include "lv/heartbeat/checkpoint.hpp"

#include "lv/base/bounds.hpp"
#include "lv/base/check.hpp"
#include "lv/geometry/ellipsoid.hpp"
#include "lv/mesh/wall_mesh.hpp"

#include "support/archive_bytes.hpp"
#include "support/mutations.hpp"
#include "support/temporary_folder.hpp"
#include <catch2/catch.hpp>

#include <cmath>

namespace {

using namespace lv;
using namespace heartbeat;

mesh::Mesh coarse_ventricle() {
  const auto point = [e = geometry::Ellipsoid{}](double u, double theta, double t) {
    return e.point(u, theta, t);
  };
  return mesh::wall_mesh(point, {.edge_length = 20.0, .layers = 1});
}

immersed::Model model_in(const mesh::Mesh& mesh, const std::array<int, 3>& cells) {
  immersed::ModelParameters p;
  p.grid = fluid::centred_grid(bounds(mesh.nodes).center(), Vec3(150.0, 150.0, 200.0), cells);
  return {mesh, {}, p};
}

/// Steps under a rising load.
void advance(immersed::Model& model, int steps) {
  for (int n = 0; n < steps; ++n)
    static_cast<void>(model.step({0.2 * n, 0.0, 0.3 + 0.1 * n}, 2e-4));
}

std::string checkpoint_bytes(immersed::Model& model) {
  const test::TemporaryFolder folder;
  Archive archive;
  archive.add("kept", archived(model.state(), {}, model.transform()));
  advance(model, 2);
  archive.add("now", archived(model.state(), {}, model.transform()));
  archive.write(folder / "checkpoint.bin");
  return test::bytes_of(folder / "checkpoint.bin");
}

constexpr std::array<int, 3> cells{12, 12, 16};

}  // namespace

TEST_CASE("a model goes on from a checkpoint bit for bit", "[unit][heartbeat]") {
  const test::TemporaryFolder folder;
  const mesh::Mesh mesh = coarse_ventricle();
  immersed::Model model = model_in(mesh, cells);
  model.relax(0.3);
  advance(model, 3);
  test::write_bytes(folder / "checkpoint.bin", checkpoint_bytes(model));
  immersed::Model resumed = model_in(mesh, cells);
  const Checkpoint checkpoint = read_checkpoint(folder / "checkpoint.bin", resumed, phases({}));
  resumed.restore(checkpoint.now.model);
  for (int n = 0; n < 3; ++n) {
    const auto one = model.step({1.0, 0.5, 0.0}, 2e-4);
    const auto other = resumed.step({1.0, 0.5, 0.0}, 2e-4);
    CHECK(one.smoothness == other.smoothness);  // of the last two steps
    CHECK(model.state().positions == resumed.state().positions);
    CHECK(model.state().contraction == resumed.state().contraction);
  }
}

TEST_CASE("a checkpoint of another box or wall is refused", "[unit][heartbeat]") {
  const test::TemporaryFolder folder;
  const mesh::Mesh mesh = coarse_ventricle();
  immersed::Model model = model_in(mesh, cells);
  test::write_bytes(folder / "checkpoint.bin", checkpoint_bytes(model));
  immersed::Model other = model_in(mesh, {14, 12, 16});
  CHECK_THROWS_AS(read_checkpoint(folder / "checkpoint.bin", other, phases({})), RunError);
}

TEST_CASE("a checkpoint with a number that cannot be is refused", "[unit][heartbeat]") {
  const test::TemporaryFolder folder;
  const mesh::Mesh mesh = coarse_ventricle();
  immersed::Model model = model_in(mesh, cells);
  test::write_bytes(folder / "good.bin", checkpoint_bytes(model));
  for (const char* name : {"positions", "node_velocities", "velocity_change", "contraction",
                           "modes.1", "convection.2", "steps"})
    for (const double number : {std::nan(""), HUGE_VAL}) {
      INFO(name << " " << number);
      Archive whole = Archive::read(folder / "good.bin");
      Archive now = whole.take("now");
      std::vector<double> numbers = now.get(name);
      numbers.back() = number;
      now.set(name, numbers);
      whole.add("now", std::move(now));
      whole.write(folder / "bad.bin");
      CHECK_THROWS_AS(read_checkpoint(folder / "bad.bin", model, phases({})), RunError);
    }
}

TEST_CASE("a damaged checkpoint is refused, or a run goes on from it and finds out",
          "[unit][heartbeat][mutations][records]") {
  const mesh::Mesh mesh = coarse_ventricle();
  immersed::Model model = model_in(mesh, cells);
  model.relax(0.3);
  const auto go_on = [&](const std::filesystem::path& file) {
    const Checkpoint checkpoint = read_checkpoint(file, model, phases({}));
    for (const Moment& moment : {checkpoint.now, checkpoint.kept}) {
      model.restore(moment.model);
      for (int n = 0; n < 2; ++n)
        if (!model.step({1.0, 0.5, 0.0}, 2e-4).inside_box)
          break;
    }
  };
  test::try_damaged("checkpoint.bin", checkpoint_bytes(model), go_on, {}, test::repair_checksum);
}
