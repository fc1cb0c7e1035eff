#include "lv/anatomy/mesh_result.hpp"

#include "lv/heartbeat/archive.hpp"

namespace lv::anatomy {
namespace {

using heartbeat::Archive;

std::vector<double> as_numbers(const std::vector<int>& whole) {
  return {whole.begin(), whole.end()};
}

void store(const mesh::Surface& surface, const std::string& name, Archive& archive) {
  archive.set(name + ".nodes_per_face", {static_cast<double>(surface.nodes_per_face)});
  archive.set(name, as_numbers(surface.nodes));
}

void store(const mesh::GivenFibres& fibres, Archive& archive) {
  archive.set("fibres.at_nodes", {fibres.at == mesh::GivenFibres::At::nodes ? 1.0 : 0.0});
  archive.set("fibres.f0", heartbeat::flat(fibres.f0));
  archive.set("fibres.s0", heartbeat::flat(fibres.s0));
}

mesh::GivenFibres load_fibres(const Archive& archive, const mesh::Mesh& m) {
  using At = mesh::GivenFibres::At;
  const At at = archive.whole_number(archive.number("fibres.at_nodes"), {0.0, 1.0}) == 0
                    ? At::cells
                    : At::nodes;
  const std::size_t count =
      at == At::nodes ? m.nodes.size() : static_cast<std::size_t>(m.cell_count());
  constexpr heartbeat::Range unit{-1.0 - 1e-6, 1.0 + 1e-6};
  const auto load = [&](const char* name) {
    return archive.get(name).empty() ? std::vector<Vec3>{}
                                     : heartbeat::vectors(archive.get_rows(name, 3, count, unit));
  };
  return {at, load("fibres.f0"), load("fibres.s0")};
}

/// Nodes of cells or faces, `each` of one, of those that a wall has.
std::vector<int> load_nodes(const Archive& archive, const std::string& name, std::size_t each,
                            std::size_t nodes) {
  static_cast<void>(archive.get_rows(name, each));
  return archive.get_whole(name, {}, {0.0, static_cast<double>(nodes) - 1.0});
}

mesh::Surface load_surface(const Archive& archive, const std::string& name, std::size_t nodes) {
  const int each = archive.whole_number(archive.number(name + ".nodes_per_face"), {3.0, 4.0});
  return {each, load_nodes(archive, name, static_cast<std::size_t>(each), nodes)};
}

}  // namespace

void write_mesh_result(const MeshResult& result, const std::filesystem::path& folder) {
  const mesh::Mesh& m = result.mesh;
  Archive archive;
  archive.set("kind", {m.kind == mesh::CellKind::hexahedron ? 0.0 : 1.0});
  archive.set("order", {static_cast<double>(m.order)});
  archive.set("nodes", heartbeat::flat(m.nodes));
  archive.set("cells", as_numbers(m.cells));
  archive.set("transmural", m.transmural);
  archive.set("infarct", m.infarct);
  archive.set("infarcted", result.infarcted);
  store(m.fibres.given, archive);
  store(m.endo, "endo", archive);
  store(m.epi, "epi", archive);
  store(m.base, "base", archive);
  archive.set("slice", as_numbers(result.regions.slice));
  archive.set("sector", as_numbers(result.regions.sector));
  archive.set("aha", as_numbers(result.regions.aha));
  archive.write(folder / "mesh.bin");
  if (result.slice_moves)
    result.slice_moves->write_csv(folder / "slice_moves.csv");
}

MeshResult read_mesh_result(const std::filesystem::path& folder, const mesh::FibreRule& rule) {
  const Archive archive = Archive::read(folder / "mesh.bin");
  MeshResult result;
  mesh::Mesh& m = result.mesh;
  m.kind = archive.whole_number(archive.number("kind"), {0.0, 1.0}) == 0
               ? mesh::CellKind::hexahedron
               : mesh::CellKind::tetrahedron;
  m.order = archive.whole_number(archive.number("order"), {1.0, 2.0});
  m.nodes = heartbeat::vectors(archive.get_rows("nodes", 3));
  const std::size_t nodes = m.nodes.size();
  const std::size_t of_element = m.order == 1 ? 1 : 8;  // its parts, see mesh.hpp
  m.cells = load_nodes(archive, "cells",
                       static_cast<std::size_t>(mesh::nodes_per_cell(m.kind)) * of_element, nodes);
  constexpr heartbeat::Range part{-1e-6, 1.0 + 1e-6};
  m.transmural = archive.get_rows("transmural", 1, nodes, part);
  m.infarct = archive.get_rows("infarct", 1, nodes, part);
  m.endo = load_surface(archive, "endo", nodes);
  m.epi = load_surface(archive, "epi", nodes);
  m.base = load_surface(archive, "base", nodes);
  const auto cells = static_cast<std::size_t>(m.cell_count());
  result.infarcted = archive.get_rows("infarcted", 1, cells, part);
  m.fibres = {rule, load_fibres(archive, m)};
  result.regions = {archive.get_whole("slice", cells, {1.0, mesh::slice_count}),
                    archive.get_whole("sector", cells, {1.0, mesh::sectors_of_slice(1)}),
                    archive.get_whole("aha", cells, {1.0, mesh::aha_count})};
  m.segment = result.regions.aha;
  return result;
}

}  // namespace lv::anatomy
