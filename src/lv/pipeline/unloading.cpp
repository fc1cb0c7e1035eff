#include "lv/pipeline/unloading.hpp"

#include "lv/base/check.hpp"
#include "lv/base/log.hpp"
#include "lv/base/parallel.hpp"
#include "lv/base/table.hpp"
#include "lv/base/units.hpp"
#include "lv/calibrate/klotz.hpp"
#include "lv/mesh/fibres.hpp"
#include "lv/mesh/quality.hpp"
#include "lv/solid/endocardial_surface.hpp"
#include "lv/solid/interpolate.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <utility>

namespace lv::pipeline {
namespace {

using Json = nlohmann::ordered_json;
using implicit::Unloaded;
using units::mmHg;

using heartbeat::Archive;

constexpr const char* summary_name = "unloaded.json";
constexpr const char* result_name = "unloading.bin";

/// A cavity without load below this share of Klotz's V0 is warned of.
constexpr double least_of_klotz = 0.8;

/// What a search that was stopped has found.
implicit::Equilibria read_record(const std::filesystem::path& file, std::size_t nodes) {
  implicit::Equilibria known;
  if (!std::filesystem::exists(file))
    return known;
  const Archive archive = Archive::read(file);
  for (const double found : archive.get_rows("found", 1, {}, {0.0, 1.0})) {
    const std::string name = equilibrium_name(known.size());
    known.push_back(found == 1.0 ? std::optional(load_state(archive, name, nodes)) : std::nullopt);
  }
  log::info("the search for the wall without load goes on after {} equilibria", known.size());
  return known;
}

void write_record(const implicit::Equilibria& known, const std::filesystem::path& file) {
  Archive archive;
  std::vector<double> found;
  for (std::size_t n = 0; n < known.size(); ++n) {
    found.push_back(known[n] ? 1.0 : 0.0);
    if (known[n])
      store(*known[n], equilibrium_name(n), archive);
  }
  archive.set("found", std::move(found));
  archive.write(file);
}

std::optional<Unloaded> read_start(const std::filesystem::path& file, std::size_t nodes) {
  if (!std::filesystem::exists(file))
    return {};
  return load_unloaded(Archive::read(file), nodes);
}

Table steps_table(const Unloaded& unloaded) {
  Table table({"step", "largest_distance_mm", "rms_distance_mm", "unloaded_volume_ml",
               "loaded_volume_ml", "damping", "accelerated", "smoothing", "dent_deg",
               "nearest_to_itself", "largest_stretch"});
  const auto number = [](double value) { return Table::number(value, 9); };
  int row = 0;
  for (const implicit::UnloadStep& s : unloaded.steps)
    table.add_row(
        {std::to_string(++row), number(s.largest), number(s.rms), number(1e-3 * s.unloaded_volume),
         number(1e-3 * s.volume), number(s.damping), s.accelerated ? "1" : "0", number(s.smoothing),
         number(s.folds.dent / units::degree), number(s.folds.approach), number(s.folds.stretch)});
  return table;
}

double seen_volume(const mesh::Mesh& elements) {
  return solid::EndocardialSurface(elements).volume(elements.nodes);
}

/// What a user has to know of a wall without load that is not what it might be.
std::vector<std::string> warnings_of(const report::UnloadedShape& shape, double tolerance) {
  std::vector<std::string> warnings;
  if (shape.smoothing > 0.0)
    warnings.push_back(
        fmt::format("the wall without load would be folded: instead it is a smooth one, which "
                    "loaded again is off by {:.2f} mm rms, {:.2f} mm at most (smoothing {:g})",
                    shape.rms, shape.largest, shape.smoothing));
  else if (shape.largest > tolerance)
    warnings.push_back(fmt::format(
        "the wall without load was found up to {:.3f} mm: loaded again it is off by so much at "
        "most (rms {:.3f} mm; {:.2f} ml instead of {:.2f} ml), more than unloaded.tolerance and "
        "less than unloaded.near_enough, and the search came no nearer",
        shape.largest, shape.rms, 1e-3 * shape.loaded_volume, 1e-3 * shape.seen_volume));
  if (shape.unloaded_volume < least_of_klotz * shape.klotz_volume)
    warnings.push_back(fmt::format(
        "the wall without load holds {:.1f} ml, less than {:.0f}% of the {:.1f} ml that Klotz et "
        "al. (2006) expect of {:.1f} ml at {:.2f} mmHg: check unloaded.pressure and the stiffness",
        1e-3 * shape.unloaded_volume, 100.0 * least_of_klotz, 1e-3 * shape.klotz_volume,
        1e-3 * shape.seen_volume, shape.pressure / mmHg));
  return warnings;
}

report::UnloadedShape found_shape(const case_file::Case& c, const mesh::Mesh& elements,
                                  const Unloaded& unloaded) {
  const implicit::UnloadStep& last = unloaded.steps.back();
  const double seen = seen_volume(elements);
  report::UnloadedShape shape{c.unloaded.pressure,
                              seen,
                              last.unloaded_volume,
                              last.volume,
                              last.largest,
                              last.rms,
                              calibrate::klotz(seen, c.unloaded.pressure).V0,
                              unloaded.smoothing,
                              last.folds};
  shape.warnings = warnings_of(shape, c.unloaded.tolerance);
  return shape;
}

std::string summary(const report::UnloadedShape& shape, double tolerance, std::size_t steps) {
  const Json json{{"pressure_mmHg", shape.pressure / mmHg},
                  {"seen_volume_ml", 1e-3 * shape.seen_volume},
                  {"unloaded_volume_ml", 1e-3 * shape.unloaded_volume},
                  {"loaded_again_volume_ml", 1e-3 * shape.loaded_volume},
                  {"largest_distance_mm", shape.largest},
                  {"rms_distance_mm", shape.rms},
                  {"tolerance_mm", tolerance},
                  {"klotz_volume_ml", 1e-3 * shape.klotz_volume},
                  {"smoothing", shape.smoothing},
                  {"dent_deg", shape.folds.dent / units::degree},
                  {"nearest_to_itself", shape.folds.approach},
                  {"largest_stretch", shape.folds.stretch},
                  {"steps", steps}};
  return json.dump(2) + "\n";
}

/// The numbers of a wall without load, by their names in an archive.
constexpr std::pair<const char*, double report::UnloadedShape::*> shape_numbers[]{
    {"pressure", &report::UnloadedShape::pressure},
    {"seen_volume", &report::UnloadedShape::seen_volume},
    {"unloaded_volume", &report::UnloadedShape::unloaded_volume},
    {"loaded_volume", &report::UnloadedShape::loaded_volume},
    {"largest", &report::UnloadedShape::largest},
    {"rms", &report::UnloadedShape::rms},
    {"klotz_volume", &report::UnloadedShape::klotz_volume},
    {"smoothing", &report::UnloadedShape::smoothing}};

void check_elements(const mesh::Mesh& wall) {
  const mesh::Quality q = mesh::quality(wall);
  if (q.scaled_jacobian.min > 0.0)
    return;
  throw NoSolution(
      fmt::format("Element {} at ({:.1f}, {:.1f}, {:.1f}) mm is turned inside out in the "
                  "wall without load",
                  q.worst_cell, q.worst_place.x(), q.worst_place.y(), q.worst_place.z()),
      "Check unloaded.pressure, or take a smaller quasi_static.edge_length");
}

}  // namespace

implicit::Unloaded find_unloaded(const case_file::Case& c, const mesh::Mesh& elements,
                                 const std::filesystem::path& folder,
                                 const std::filesystem::path& start, double afterwards) {
  const std::filesystem::path record = folder / search_record;
  const std::optional<Unloaded> near = read_start(start, elements.nodes.size());
  implicit::UnloadTask task{near ? &*near : nullptr, {}, afterwards};
  task.record = {read_record(record, elements.nodes.size()),
                 [&](const implicit::Equilibria& known) {
                   parallel::on_root([&] { write_record(known, record); });
                 }};
  return implicit::unload(elements, case_file::static_model(c), c.unloaded, c.quasi_static.solver,
                          std::move(task))
      .value();
}

void make_unloading(const case_file::Case& c, const anatomy::MeshResult& seen,
                    const mesh::Mesh& elements, const std::filesystem::path& folder,
                    const std::filesystem::path& start, double seconds_of_pictures) {
  const Unloaded unloaded = find_unloaded(c, elements, folder, start, seconds_of_pictures);
  anatomy::MeshResult result = seen;
  result.mesh = mesh::with_nodes(seen.mesh, c.engine == case_file::EngineChoice::quasi_static
                                                ? unloaded.nodes
                                                : carried(elements, unloaded.nodes, seen.mesh));
  check_elements(result.mesh);
  if (parallel::is_root()) {
    anatomy::write_mesh_result(result, folder);
    steps_table(unloaded).write_csv(folder / "unloading.csv");
    const report::UnloadedShape shape = found_shape(c, elements, unloaded);
    for (const std::string& warning : shape.warnings)
      log::warn("{}", warning);
    write_file(folder / summary_name, summary(shape, c.unloaded.tolerance, unloaded.steps.size()));
    write_shape(shape, folder);
    std::filesystem::remove(folder / search_record);
  }
  show_mesh(result, c, folder);
}

std::vector<Vec3> carried(const mesh::Mesh& elements, std::span<const Vec3> unloaded,
                          const mesh::Mesh& other) {
  std::vector<Vec3> displacement;
  for (std::size_t a = 0; a < elements.nodes.size(); ++a)
    displacement.emplace_back(unloaded[a] - elements.nodes[a]);
  std::vector<Vec3> nodes = solid::interpolate(elements, displacement, other.nodes);
  for (std::size_t a = 0; a < nodes.size(); ++a)
    nodes[a] += other.nodes[a];
  return nodes;
}

void write_unloaded(const Unloaded& unloaded, const std::filesystem::path& file) {
  Archive archive;
  store(unloaded, archive);
  archive.write(file);
}

std::string equilibrium_name(std::size_t n) {
  return fmt::format("equilibrium.{}", n);
}

void store(const implicit::State& state, const std::string& name, Archive& archive) {
  archive.set(name + ".positions", heartbeat::flat(state.positions));
  archive.set(name + ".pressures", state.pressures);
}

implicit::State load_state(const Archive& archive, const std::string& name, std::size_t nodes) {
  return {heartbeat::vectors(archive.get_rows(name + ".positions", 3, nodes)),
          archive.get_rows(name + ".pressures", 1)};
}

void store(const Unloaded& unloaded, Archive& archive) {
  archive.set("unloaded.nodes", heartbeat::flat(unloaded.nodes));
  archive.set("unloaded.smoothing", {unloaded.smoothing});
  store(unloaded.loaded, "loaded", archive);
}

Unloaded load_unloaded(const Archive& archive, std::size_t nodes) {
  return {heartbeat::vectors(archive.get_rows("unloaded.nodes", 3, nodes)),
          load_state(archive, "loaded", nodes),
          {},
          archive.get_rows("unloaded.smoothing", 1, 1, heartbeat::not_negative).front()};
}

void write_shape(const report::UnloadedShape& shape, const std::filesystem::path& folder) {
  Archive archive;
  for (const auto& [name, member] : shape_numbers)
    archive.set(name, {shape.*member});
  archive.set("folds", {shape.folds.dent, shape.folds.approach, shape.folds.stretch});
  archive.set_words("warnings", shape.warnings);
  archive.write(folder / result_name);
}

std::optional<report::UnloadedShape> unloaded_shape(const std::filesystem::path& folder) {
  if (!std::filesystem::exists(folder / result_name))
    return {};
  const Archive archive = Archive::read(folder / result_name);
  report::UnloadedShape shape;
  for (const auto& [name, member] : shape_numbers)
    shape.*member = archive.number(name);
  const auto& folds = archive.get_rows("folds", 3, 1);
  shape.folds = {.dent = folds[0], .approach = folds[1], .stretch = folds[2]};
  shape.warnings = archive.get_words("warnings");
  return shape;
}

}  // namespace lv::pipeline
