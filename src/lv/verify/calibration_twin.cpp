#include "lv/analysis/regional.hpp"
#include "lv/base/parallel.hpp"
#include "lv/base/units.hpp"
#include "lv/calibrate/fit.hpp"
#include "lv/mesh/quadratic.hpp"
#include "lv/verify/problems.hpp"
#include "lv/verify/small_ventricle.hpp"

/// Measurements made by the model itself, from which its parameters must come back.
namespace lv::verify {
namespace {

using calibrate::FitParameters;
using units::mmHg;

implicit::StaticModel static_model(const FitParameters& p) {
  solid::CardiacModel heart{.base = {.stiffness = implicit::rigid_base}};
  heart.myocardium.passive =
      material::HolzapfelOgden{}.scaled(p.scale).with_anisotropy_scaled(p.C_a);
  heart.myocardium.active = material::NiedererHunterSmith{.T_scale = p.T_scale};
  return heart;
}

/// The idealised ventricle on a coarse mesh; the mesh's own error cancels.
mesh::Mesh coarse_ventricle() {
  return ideal_mesh({.edge_length = 6.0, .layers = 2, .order = 2});
}

constexpr FitParameters truth{.C_a = 1.4, .T_scale = 3.6};

/// C_a and T_scale at the paper's healthy pressures; the measurements are left out.
calibrate::Plan both_parameters() {
  calibrate::Plan plan;
  plan.passive = calibrate::FittedPassive::C_a;
  plan.active = true;
  plan.ed_pressure = 8.0 * mmHg;
  plan.es_pressure = 150.0 * mmHg;
  plan.stiffness = {0.05, 50.0};
  plan.T_scale = {0.1, 20.0};
  return plan;
}

/// Mean circumferential strains of the segments of the three middle slices.
std::vector<double> segment_strains(const mesh::Mesh& mesh, const mesh::Regions& regions,
                                    const std::vector<Vec3>& ed, const std::vector<Vec3>& es) {
  const solid::Wall wall(mesh, {});
  const std::vector<double> volumes = mesh::cell_volumes(mesh);
  const auto then = analysis::shape_fields(wall, volumes, ed);
  const auto now = analysis::shape_fields(wall, volumes, es);
  std::vector<double> E_cc;
  for (std::size_t c = 0; c < now.size(); ++c)
    E_cc.push_back(analysis::strain(now[c], then[c]).circumferential);
  std::vector<double> means;
  for (const analysis::Region& region : analysis::region_list(regions, now))
    if (region.scheme == "sector" && region.name[0] >= '3' && region.name[0] <= '5')
      means.push_back(analysis::statistics(E_cc, now, region.cells).mean);
  means.resize(18);
  parallel::broadcast(means);
  return means;
}

}  // namespace

void calibration_twin(Findings& found) {
  const mesh::Mesh mesh = coarse_ventricle();
  calibrate::Ventricle ventricle(mesh, static_model, {});
  const calibrate::Model model{
      [&](const FitParameters& p, const solid::Loads& loads) { return ventricle.volume(p, loads); },
      [&](const FitParameters& p) { return ventricle.unloaded_volume(p); },
      {}};
  calibrate::Plan plan = both_parameters();
  plan.edv.volume = model.volume(truth, {plan.ed_pressure, 0.0}).value();
  plan.esv.volume = model.volume(truth, {plan.es_pressure, 1.0}).value();
  const calibrate::Fit fit = calibrate::fit(model, {.C_a = 0.7, .T_scale = 2.5}, plan);
  found.add_within("C_a", fit.parameters.C_a, truth.C_a, 0.005);
  found.add_within("T_scale", fit.parameters.T_scale, truth.T_scale, 0.005);
  found.add_within("end-diastolic volume", fit.edv, plan.edv.volume, 1e-4, "mm^3");
  found.add_within("end-systolic volume", fit.esv, plan.esv.volume, 1e-4, "mm^3");
}

/// Volumes 5% off, of which nothing is believed, lead the brackets astray; the strains must bring
/// the parameters back.
void strain_twin(Findings& found) {
  const mesh::Mesh mesh = coarse_ventricle();
  const mesh::Regions regions = mesh::divide(mesh, {});
  calibrate::Ventricle ventricle(mesh, static_model, {});
  using solid::Loads;
  const calibrate::Model model{
      [&](const FitParameters& p, const Loads& loads) { return ventricle.volume(p, loads); },
      [&](const FitParameters& p) { return ventricle.unloaded_volume(p); },
      [&](const FitParameters& p, const Loads& ed,
          const Loads& es) -> Outcome<std::vector<double>> {
        const auto end_diastole = ventricle.positions(p, ed).value();
        const auto end_systole = ventricle.positions(p, es).value();
        return segment_strains(mesh, regions, end_diastole, end_systole);
      }};
  calibrate::Plan plan = both_parameters();
  const Loads ed{plan.ed_pressure, 0.0};
  const Loads es{plan.es_pressure, 1.0};
  plan.edv.volume = 0.95 * model.volume(truth, ed).value();
  plan.esv.volume = 1.05 * model.volume(truth, es).value();
  const std::vector<double> strains = model.strains(truth, ed, es).value();
  for (const double strain : strains)
    plan.strains.push_back({"", strain});
  plan.errors = {.volume = 10.0, .strain = 1e-3};
  const calibrate::Fit fit = calibrate::fit(model, {.C_a = 1.0, .T_scale = 3.0}, plan);
  found.add_within("C_a", fit.parameters.C_a, truth.C_a, 0.01);
  found.add_within("T_scale", fit.parameters.T_scale, truth.T_scale, 0.01);
  found.add_error("rms misfit of 18 segments' strains", fit.regional_fit->strain.rms, 5e-4);
}

}  // namespace lv::verify
