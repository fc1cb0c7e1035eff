#include "lv/mesh/transmural.hpp"

#include "lv/mesh/distance.hpp"

namespace lv::mesh {

std::vector<double> transmural_by_distance(const Mesh& mesh) {
  const SurfaceDistance to_endo(mesh.nodes, mesh.endo);
  const SurfaceDistance to_epi(mesh.nodes, mesh.epi);
  std::vector<double> t;
  t.reserve(mesh.nodes.size());
  for (const Vec3& X : mesh.nodes) {
    const double d_endo = to_endo(X);
    const double d_epi = to_epi(X);
    t.push_back(d_endo / (d_endo + d_epi));
  }
  // rounding off
  for (const int node : mesh.endo.nodes)
    t[node] = 0.0;
  for (const int node : mesh.epi.nodes)
    t[node] = 1.0;
  return t;
}

}  // namespace lv::mesh
