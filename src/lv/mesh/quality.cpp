#include "lv/mesh/quality.hpp"

#include "lv/mesh/cell.hpp"
#include "lv/mesh/quadratic.hpp"
#include "lv/mesh/surface.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <set>

namespace lv::mesh {
namespace {

Spread spread(const std::vector<double>& values) {
  if (values.empty())
    return {};
  const auto [min, max] = std::minmax_element(values.begin(), values.end());
  const double sum = std::accumulate(values.begin(), values.end(), 0.0);
  return {*min, sum / static_cast<double>(values.size()), *max};
}

Histogram histogram(const std::vector<double>& values, double lower, double upper, int bins) {
  Histogram h{lower, upper, std::vector<int>(bins, 0)};
  for (const double value : values) {
    const double bin = (value - lower) / (upper - lower) * bins;
    ++h.counts[static_cast<int>(std::clamp(bin, 0.0, bins - 1.0))];
  }
  return h;
}

std::vector<double> edge_lengths(const Mesh& mesh) {
  std::set<std::pair<int, int>> edges;
  for (int c = 0; c < mesh.cell_count(); ++c)
    for (const auto& edge : cell_edges(mesh.kind))
      edges.insert(std::minmax(mesh.cell(c)[edge[0]], mesh.cell(c)[edge[1]]));
  std::vector<double> lengths;
  for (const auto& [a, b] : edges)
    lengths.push_back((mesh.nodes[b] - mesh.nodes[a]).norm());
  return lengths;
}

}  // namespace

Quality quality(const Mesh& mesh) {
  std::vector<double> scaled;
  std::vector<double> aspect;
  Quality q;
  q.cells = mesh.cell_count();
  q.nodes = static_cast<int>(mesh.nodes.size());
  for (int c = 0; c < q.cells; ++c) {
    scaled.push_back(scaled_jacobian(mesh, c));
    aspect.push_back(aspect_ratio(mesh, c));
  }
  for (const double volume : cell_volumes(mesh))
    q.wall_volume += volume;
  q.scaled_jacobian = spread(scaled);
  q.aspect_ratio = spread(aspect);
  q.edge_length = spread(edge_lengths(mesh));
  q.endo_area = area(mesh.nodes, mesh.endo);
  q.epi_area = area(mesh.nodes, mesh.epi);
  q.base_area = area(mesh.nodes, mesh.base);
  q.scaled_jacobians = histogram(scaled, 0.0, 1.0, 10);
  if (q.cells > 0) {
    q.worst_cell =
        static_cast<int>(std::min_element(scaled.begin(), scaled.end()) - scaled.begin());
    q.worst_place = cell_centre(mesh, q.worst_cell);
  }
  return q;
}

std::vector<QualityRow> table(const Quality& q) {
  std::vector<QualityRow> rows{
      {"cells", static_cast<double>(q.cells), ""},
      {"nodes", static_cast<double>(q.nodes), ""},
      {"smallest scaled Jacobian", q.scaled_jacobian.min, ""},
      {"mean scaled Jacobian", q.scaled_jacobian.mean, ""},
      {"mean aspect ratio", q.aspect_ratio.mean, ""},
      {"largest aspect ratio", q.aspect_ratio.max, ""},
      {"smallest edge length", q.edge_length.min, "mm"},
      {"mean edge length", q.edge_length.mean, "mm"},
      {"largest edge length", q.edge_length.max, "mm"},
      {"wall volume", q.wall_volume / 1000.0, "ml"},
      {"endocardium's area", q.endo_area / 100.0, "cm^2"},
      {"epicardium's area", q.epi_area / 100.0, "cm^2"},
      {"base's area", q.base_area / 100.0, "cm^2"},
      {"worst cell", static_cast<double>(q.worst_cell), ""},
      {"x of worst cell", q.worst_place.x(), "mm"},
      {"y of worst cell", q.worst_place.y(), "mm"},
      {"z of worst cell", q.worst_place.z(), "mm"},
  };
  const Histogram& h = q.scaled_jacobians;
  const double width = (h.upper - h.lower) / static_cast<double>(h.counts.size());
  for (std::size_t bin = 0; bin < h.counts.size(); ++bin) {
    const double from = h.lower + width * static_cast<double>(bin);
    rows.push_back({fmt::format("cells with scaled Jacobian {:.1f} to {:.1f}", from, from + width),
                    static_cast<double>(h.counts[bin]), ""});
  }
  return rows;
}

}  // namespace lv::mesh
