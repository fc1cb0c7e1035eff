#include "lv/base/units.hpp"
#include "lv/implicit/unload.hpp"
#include "lv/mesh/distance.hpp"
#include "lv/solid/endocardial_surface.hpp"
#include "lv/verify/problems.hpp"
#include "lv/verify/small_ventricle.hpp"

/// The stress-free shape behind a loaded one.
namespace lv::verify {
namespace {

using units::mmHg;

/// The paper's healthy_model subject.
implicit::StaticModel healthy_model() {
  return solid::CardiacModel{.base = {.stiffness = implicit::rigid_base}};
}

}  // namespace

/// The idealised ventricle on a coarse mesh; the mesh's own error cancels. The shape at 8 mmHg,
/// which has twice the volume, is taken for the one that was seen.
void unloading_round_trip(Findings& found) {
  const mesh::Mesh known = ideal_mesh({.edge_length = 5.0, .layers = 2, .order = 2});
  const implicit::StaticModel model = healthy_model();
  const double pressure = 8.0 * mmHg;
  implicit::Engine engine(known, model, {});
  engine.go_to({pressure, 0.0}).value();
  mesh::Mesh seen = known;
  seen.nodes = engine.state().positions;
  const implicit::Unloaded back =
      implicit::unload(seen, model, {.pressure = pressure, .tolerance = 1e-3}, {}).value();
  const solid::EndocardialSurface endocardium(known);
  found.add_error("largest distance, loaded again, from the loaded shape",
                  back.steps.back().largest, 1e-3, "mm");
  found.add_error("largest distance of the unloaded from the known shape",
                  mesh::largest_distance(back.nodes, known.nodes), 0.02, "mm");
  found.add_within("unloaded cavity volume", endocardium.volume(back.nodes),
                   endocardium.volume(known.nodes), 1e-3, "mm^3");
  found.add_within("cavity volume, loaded again", back.steps.back().volume, engine.cavity_volume(),
                   1e-4, "mm^3");
}

}  // namespace lv::verify
