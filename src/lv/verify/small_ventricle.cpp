#include "lv/verify/small_ventricle.hpp"

#include "lv/mesh/wall_mesh.hpp"

namespace lv::verify {

mesh::Mesh ideal_mesh(double edge_length, const geometry::Ellipsoid& ellipsoid) {
  return mesh::wall_mesh(
      [&](double u, double theta, double t) { return ellipsoid.point(u, theta, t); },
      {edge_length, 0});
}

immersed::ModelParameters in_default_box(const mesh::Mesh& mesh, const std::array<int, 3>& cells) {
  Vec3 lower = mesh.nodes.front();
  Vec3 upper = lower;
  for (const Vec3& x : mesh.nodes) {
    lower = lower.cwiseMin(x);
    upper = upper.cwiseMax(x);
  }
  const Vec3 size(150.0, 150.0, 200.0);
  immersed::ModelParameters p;
  p.grid.cells = cells;
  p.grid.spacing = size.cwiseQuotient(Vec3(cells[0], cells[1], cells[2]));
  p.grid.lower = 0.5 * (lower + upper) - 0.5 * size;
  return p;
}

heartbeat::BeatSetup default_beat(const mesh::Mesh& mesh, const std::array<int, 3>& cells,
                                  double time_step) {
  constexpr double never = 1e9;
  heartbeat::BeatSetup setup{mesh, {}, {}, {}, in_default_box(mesh, cells), {}, {}, {}};
  setup.control.longest = time_step;
  setup.output.frame_interval = never;
  setup.output.checkpoint_interval = never;
  return setup;
}

}  // namespace lv::verify
