#include "lv/mesh/refine.hpp"

#include "lv/mesh/fibres.hpp"

#include <algorithm>
#include <map>

namespace lv::mesh {
namespace {

/// Every value eight times.
template <class Value>
std::vector<Value> eightfold(const std::vector<Value>& cells) {
  std::vector<Value> fine;
  for (const Value& value : cells)
    fine.insert(fine.end(), 8, value);
  return fine;
}

/// Makes the nodes in the middle of old nodes, each once.
class Refiner {
 public:
  explicit Refiner(const Mesh& coarse) : coarse_(coarse) {
    fine_.kind = coarse.kind;
    fine_.order = 2;
    fine_.nodes = coarse.nodes;
    fine_.transmural = coarse.transmural;
    fine_.infarct = coarse.infarct;
    fine_.fibres = coarse.fibres;
    if (coarse.fibres.given.at == GivenFibres::At::cells) {
      fine_.fibres.given.f0 = eightfold(coarse.fibres.given.f0);
      fine_.fibres.given.s0 = eightfold(coarse.fibres.given.s0);
    }
  }

  Refinement refine() {
    for (int c = 0; c < coarse_.cell_count(); ++c) {
      if (coarse_.kind == CellKind::hexahedron)
        refine_hexahedron(coarse_.cell(c));
      else
        refine_tetrahedron(coarse_.cell(c));
    }
    fine_.endo = refine(coarse_.endo);
    fine_.epi = refine(coarse_.epi);
    fine_.base = refine(coarse_.base);
    Refinement result{std::move(fine_), {}};
    for (std::size_t a = 0; a < coarse_.nodes.size(); ++a)
      result.middle_of.push_back({static_cast<int>(a)});
    result.middle_of.resize(result.mesh.nodes.size());
    for (const auto& [of, node] : middles_)
      result.middle_of[node] = of;
    return result;
  }

 private:
  /// The node at the mean of old nodes: an edge's two, a quadrilateral's four, a hexahedron's
  /// eight.
  int middle(std::vector<int> of) {
    std::sort(of.begin(), of.end());
    const auto [entry, added] =
        middles_.emplace(std::move(of), static_cast<int>(fine_.nodes.size()));
    if (added)
      add_mean(entry->first);
    return entry->second;
  }

  void add_mean(const std::vector<int>& of) {
    Vec3 X = Vec3::Zero();
    double t = 0.0;
    double M = 0.0;
    for (const int node : of) {
      X += coarse_.nodes[node];
      t += coarse_.transmural[node];
      M += coarse_.infarct[node];
    }
    const auto n = static_cast<double>(of.size());
    fine_.nodes.emplace_back(X / n);
    fine_.transmural.push_back(t / n);
    fine_.infarct.push_back(M / n);
    if (coarse_.fibres.given.at == GivenFibres::At::nodes) {
      add_mean_direction(of, coarse_.fibres.given.f0, fine_.fibres.given.f0);
      add_mean_direction(of, coarse_.fibres.given.s0, fine_.fibres.given.s0);
    }
  }

  static void add_mean_direction(const std::vector<int>& of, const std::vector<Vec3>& coarse,
                                 std::vector<Vec3>& fine) {
    if (coarse.empty())
      return;
    std::vector<Vec3> directions;
    for (const int node : of)
      directions.push_back(coarse[node]);
    fine.push_back(mean_direction(directions, std::vector<double>(of.size(), 1.0)));
  }

  /// The cell's nodes form a 3 x 3 x 3 lattice; the node at lattice point (i, j, k) is the mean of
  /// the corners that share its odd (middle) coordinates.
  void refine_hexahedron(std::span<const int> cell) {
    std::array<int, 27> lattice{};
    for (int p = 0; p < 27; ++p)
      lattice[p] = lattice_node(cell, {p % 3, p / 3 % 3, p / 9});
    for (int k = 0; k < 2; ++k)
      for (int j = 0; j < 2; ++j)
        for (int i = 0; i < 2; ++i)
          for (const auto& corner : corners)
            fine_.cells.push_back(
                lattice[(k + corner[2]) * 9 + (j + corner[1]) * 3 + i + corner[0]]);
  }

  int lattice_node(std::span<const int> cell, const std::array<int, 3>& at) {
    std::vector<int> of;
    for (int a = 0; a < 8; ++a) {
      bool shares = true;
      for (int d = 0; d < 3; ++d)
        shares = shares && (at[d] == 1 || at[d] == 2 * corners[a][d]);
      if (shares)
        of.push_back(cell[a]);
    }
    return of.size() == 1 ? of.front() : middle(of);
  }

  void refine_tetrahedron(std::span<const int> v) {
    const int ab = middle({v[0], v[1]});
    const int ac = middle({v[0], v[2]});
    const int ad = middle({v[0], v[3]});
    const int bc = middle({v[1], v[2]});
    const int bd = middle({v[1], v[3]});
    const int cd = middle({v[2], v[3]});
    add_cells({{v[0], ab, ac, ad}, {ab, v[1], bc, bd}, {ac, bc, v[2], cd}, {ad, bd, cd, v[3]}});
    const auto length = [&](int p, int q) { return (fine_.nodes[p] - fine_.nodes[q]).norm(); };
    // The ring goes round each diagonal anticlockwise, seen from its second end.
    if (length(ab, cd) <= std::min(length(ac, bd), length(ad, bc)))
      cut_octahedron(ab, cd, {ac, ad, bd, bc});
    else if (length(ac, bd) <= length(ad, bc))
      cut_octahedron(ac, bd, {ab, bc, cd, ad});
    else
      cut_octahedron(ad, bc, {ab, ac, cd, bd});
  }

  void cut_octahedron(int from, int to, const std::array<int, 4>& ring) {
    for (int i = 0; i < 4; ++i)
      add_cells({{from, ring[i], ring[(i + 1) % 4], to}});
  }

  void add_cells(const std::vector<std::array<int, 4>>& cells) {
    for (const auto& cell : cells)
      fine_.cells.insert(fine_.cells.end(), cell.begin(), cell.end());
  }

  Surface refine(const Surface& surface) {
    Surface fine;
    fine.nodes_per_face = surface.nodes_per_face;
    for (int f = 0; f < surface.size(); ++f)
      refine_face(surface.face(f), fine.nodes);
    return fine;
  }

  void refine_face(std::span<const int> face, std::vector<int>& fine) {
    const std::size_t n = face.size();
    std::vector<int> middles;
    for (std::size_t i = 0; i < n; ++i)
      middles.push_back(middle({face[i], face[(i + 1) % n]}));
    if (n == 3) {
      fine.insert(fine.end(), middles.begin(), middles.end());
      for (std::size_t i = 0; i < n; ++i)
        fine.insert(fine.end(), {face[i], middles[i], middles[(i + 2) % n]});
      return;
    }
    const int centre = middle({face.begin(), face.end()});
    for (std::size_t i = 0; i < n; ++i)
      fine.insert(fine.end(), {face[i], middles[i], centre, middles[(i + 3) % n]});
  }

  /// The hexahedron's corners on the unit cube.
  static constexpr std::array<std::array<int, 3>, 8> corners{
      {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}};

  const Mesh& coarse_;
  Mesh fine_;
  std::map<std::vector<int>, int> middles_;
};

}  // namespace

Mesh refine(const Mesh& mesh) {
  return refinement(mesh).mesh;
}

Refinement refinement(const Mesh& mesh) {
  return Refiner(mesh).refine();
}

std::vector<bool> refine_flags(const std::vector<bool>& cells) {
  return eightfold(cells);
}

std::vector<double> refine_numbers(const std::vector<double>& cells) {
  return eightfold(cells);
}

}  // namespace lv::mesh
