#include "lv/base/units.hpp"
#include "lv/calibrate/fit.hpp"
#include "lv/material/calcium.hpp"
#include "lv/solid/cavity.hpp"
#include "lv/verify/problems.hpp"
#include "lv/verify/small_ventricle.hpp"

/// Measurements made by the model itself, from which its parameters must come back.
namespace lv::verify {
namespace {

using calibrate::Parameters;
using units::mmHg;

quasi_static::Muscle muscle(const Parameters& p) {
  solid::WallMaterial wall;
  wall.passive = material::HolzapfelOgden{}.scaled(p.scale).with_anisotropy_scaled(p.C_a);
  material::NiedererHunterSmith active;
  active.T_scale = p.T_scale;
  const material::Calcium calcium;
  return {wall,
          quasi_static::Contractility(active, calcium.Ca_0, calcium.Ca_max),
          {solid::BasalSupport::Kind::sliding, quasi_static::rigid_base}};
}

}  // namespace

/// The idealised ventricle on a coarse mesh; the mesh's own error cancels.
void calibration_twin(Findings& found) {
  const mesh::Mesh mesh = ideal_mesh({.edge_length = 6.0, .layers = 2, .order = 2});
  calibrate::Ventricle ventricle(mesh, {}, muscle, {});
  const calibrate::Model model = [&](const Parameters& p, const quasi_static::Loads& loads) {
    return ventricle.volume(p, loads);
  };
  const Parameters truth{.C_a = 1.4, .T_scale = 3.6};
  calibrate::Plan plan;
  plan.passive = calibrate::Passive::C_a;
  plan.active = true;
  plan.ed_pressure = 8.0 * mmHg;
  plan.es_pressure = 150.0 * mmHg;
  plan.edv.volume = model(truth, {plan.ed_pressure, 0.0});
  plan.esv.volume = model(truth, {plan.es_pressure, 1.0});
  plan.unloaded_volume = solid::Cavity(mesh).volume(mesh.nodes);
  plan.stiffness = {0.05, 50.0};
  plan.T_scale = {0.1, 20.0};
  const calibrate::Fit fit = calibrate::fit(model, {.C_a = 0.7, .T_scale = 2.5}, plan);
  found.add_within("C_a", fit.parameters.C_a, truth.C_a, 0.005);
  found.add_within("T_scale", fit.parameters.T_scale, truth.T_scale, 0.005);
  found.add_within("end-diastolic volume", fit.edv, plan.edv.volume, 1e-4, "mm^3");
  found.add_within("end-systolic volume", fit.esv, plan.esv.volume, 1e-4, "mm^3");
}

}  // namespace lv::verify
