#include "lv/base/units.hpp"
#include "lv/quasi_static/unload.hpp"
#include "lv/solid/endocardial_surface.hpp"
#include "lv/verify/problems.hpp"
#include "lv/verify/small_ventricle.hpp"

#include <algorithm>
#include <cmath>

/// The stress-free shape behind a loaded one.
namespace lv::verify {
namespace {

using units::mmHg;

/// The paper's healthy subject.
quasi_static::StaticModel healthy() {
  return solid::CardiacModel{.base = {.stiffness = quasi_static::rigid_base}};
}

double largest_distance(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i)
    largest = std::max(largest, (a[i] - b[i]).norm());
  return largest;
}

}  // namespace

/// The idealised ventricle on a coarse mesh; the mesh's own error cancels. The shape at 8 mmHg,
/// which has twice the volume, is taken for the one that was seen.
void unloading_round_trip(Findings& found) {
  const mesh::Mesh known = ideal_mesh({.edge_length = 5.0, .layers = 2, .order = 2});
  const quasi_static::StaticModel model = healthy();
  const double pressure = 8.0 * mmHg;
  quasi_static::Engine engine(known, model, {});
  engine.go_to({pressure, 0.0}).value();
  mesh::Mesh seen = known;
  seen.nodes = engine.state().positions;
  const quasi_static::Unloaded back =
      quasi_static::unload(seen, model, {.pressure = pressure, .tolerance = 1e-3}, {}).value();
  const solid::EndocardialSurface endocardium(known);
  found.add_error("largest distance, loaded again, from the loaded shape",
                  back.steps.back().largest, 1e-3, "mm");
  found.add_error("largest distance of the unloaded from the known shape",
                  largest_distance(back.nodes, known.nodes), 0.02, "mm");
  found.add_within("unloaded cavity volume", endocardium.volume(back.nodes),
                   endocardium.volume(known.nodes), 1e-3, "mm^3");
  found.add_within("cavity volume, loaded again", back.steps.back().volume, engine.cavity_volume(),
                   1e-4, "mm^3");
}

}  // namespace lv::verify
