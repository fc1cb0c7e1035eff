#include "lv/job/unloading.hpp"

#include "lv/base/check.hpp"
#include "lv/base/json_file.hpp"
#include "lv/base/parallel.hpp"
#include "lv/base/table.hpp"
#include "lv/base/units.hpp"
#include "lv/mesh/fibres.hpp"
#include "lv/mesh/quality.hpp"
#include "lv/solid/cavity.hpp"
#include "lv/solid/interpolate.hpp"

#include <fmt/format.h>

namespace lv::job {
namespace {

using Json = nlohmann::ordered_json;
using quasi_static::Unloaded;
using units::mmHg;

constexpr const char* summary_name = "unloaded.json";

Table steps_table(const Unloaded& unloaded) {
  Table table({"step", "largest_distance_mm", "rms_distance_mm", "unloaded_volume_ml",
               "loaded_volume_ml", "damping", "accelerated"});
  const auto number = [](double value) { return Table::number(value, 9); };
  int row = 0;
  for (const quasi_static::UnloadStep& s : unloaded.steps)
    table.add_row({std::to_string(++row), number(s.largest), number(s.rms),
                   number(1e-3 * s.unloaded_volume), number(1e-3 * s.volume), number(s.damping),
                   s.accelerated ? "1" : "0"});
  return table;
}

Json summary(const Case& c, const mesh::Mesh& elements, const Unloaded& unloaded) {
  const quasi_static::UnloadStep& last = unloaded.steps.back();
  return {{"pressure_mmHg", c.unloaded.pressure / mmHg},
          {"seen_volume_ml", 1e-3 * solid::Cavity(elements).volume(elements.nodes)},
          {"unloaded_volume_ml", 1e-3 * last.unloaded_volume},
          {"loaded_again_volume_ml", 1e-3 * last.volume},
          {"largest_distance_mm", last.largest},
          {"rms_distance_mm", last.rms},
          {"tolerance_mm", c.unloaded.tolerance},
          {"steps", unloaded.steps.size()}};
}

/// The other mesh of the same wall, moved as this one was.
std::vector<Vec3> carried(const mesh::Mesh& elements, const Unloaded& unloaded,
                          const mesh::Mesh& other) {
  std::vector<Vec3> displacement;
  for (std::size_t a = 0; a < elements.nodes.size(); ++a)
    displacement.push_back(unloaded.nodes[a] - elements.nodes[a]);
  std::vector<Vec3> nodes = solid::interpolate(elements, displacement, other.nodes);
  for (std::size_t a = 0; a < nodes.size(); ++a)
    nodes[a] += other.nodes[a];
  return nodes;
}

void check_elements(const mesh::Mesh& wall) {
  const mesh::Quality q = mesh::quality(wall);
  if (q.scaled_jacobian.min > 0.0)
    return;
  throw RunError(
      fmt::format("Element {} at ({:.1f}, {:.1f}, {:.1f}) mm is turned inside out in the "
                  "wall without load",
                  q.worst_cell, q.worst_place.x(), q.worst_place.y(), q.worst_place.z()),
      "Check unloaded.pressure, or take a smaller quasi_static.edge_length");
}

}  // namespace

void make_unloading(const Case& c, const MeshResult& seen, const mesh::Mesh& elements,
                    const std::filesystem::path& folder) {
  const Unloaded unloaded =
      quasi_static::unload(elements, c.fibres, muscle(c), c.unloaded, c.quasi_static.solver);
  MeshResult result = seen;
  result.mesh = mesh::with_nodes(seen.mesh, c.engine == Engine::quasi_static
                                                ? unloaded.nodes
                                                : carried(elements, unloaded, seen.mesh));
  check_elements(result.mesh);
  if (parallel::is_root()) {
    write_mesh_result(result, folder);
    steps_table(unloaded).write_csv(folder / "unloading.csv");
    write_file(folder / summary_name, summary(c, elements, unloaded).dump(2) + "\n");
  }
  show_mesh(result, c, folder);
}

std::optional<report::UnloadedShape> unloaded_shape(const std::filesystem::path& folder) {
  if (!std::filesystem::exists(folder / summary_name))
    return {};
  return from_json_file(folder / summary_name, [](const Json& json) {
    return report::UnloadedShape{json.at("pressure_mmHg").get<double>() * mmHg,
                                 1e3 * json.at("seen_volume_ml").get<double>(),
                                 1e3 * json.at("unloaded_volume_ml").get<double>(),
                                 1e3 * json.at("loaded_again_volume_ml").get<double>(),
                                 json.at("largest_distance_mm").get<double>(),
                                 json.at("rms_distance_mm").get<double>()};
  });
}

}  // namespace lv::job
