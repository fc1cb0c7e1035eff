#include "lv/verify/small_ventricle.hpp"

#include "lv/base/bounds.hpp"
#include "lv/mesh/wall_mesh.hpp"

namespace lv::verify {

mesh::Mesh ideal_mesh(const mesh::WallMeshParameters& parameters,
                      const geometry::Ellipsoid& ellipsoid) {
  return mesh::wall_mesh(
      [&](double u, double theta, double t) { return ellipsoid.point(u, theta, t); }, parameters);
}

immersed::ModelParameters in_default_box(const mesh::Mesh& mesh, const std::array<int, 3>& cells) {
  immersed::ModelParameters p;
  p.grid = fluid::centred_grid(bounds(mesh.nodes).center(), Vec3(150.0, 150.0, 200.0), cells);
  return p;
}

heartbeat::BeatSetup default_beat(const mesh::Mesh& mesh, const std::array<int, 3>& cells,
                                  double time_step) {
  constexpr double never = 1e9;
  heartbeat::BeatSetup setup{mesh, {}, in_default_box(mesh, cells), {}, {}, {}};
  setup.control.longest = time_step;
  setup.output.frame_interval = never;
  setup.output.checkpoint_interval = never;
  return setup;
}

heartbeat::BeatSetup quick_heartbeat(const mesh::Mesh& mesh) {
  heartbeat::BeatSetup setup = default_beat(mesh, {20, 20, 27}, 4e-4);
  setup.heart.myocardium.active = material::Land2017{};
  setup.protocol.calcium = {.Ca_0 = 0.1,
                            .Ca_max = 0.7,
                            .shape = material::Calcium::CurveShape::double_exponential,
                            .t_1 = 0.02,
                            .t_2 = 0.08};
  setup.protocol.filling_ramp = 0.1;
  setup.protocol.filling_longest = 0.12;
  return setup;
}

}  // namespace lv::verify
