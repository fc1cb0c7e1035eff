#include "lv/case_file/case.hpp"

#include "lv/base/bounds.hpp"

namespace lv::case_file {
namespace {

solid::BasalSupport quasi_static_support(const Case& c) {
  return {c.base.kind, implicit::rigid_base};
}

/// The tensions of laws with kinetics are what (2.21) says.
void set_active(const Case& c, material::Myocardium& material) {
  switch (c.active_law) {
    case ActiveChoice::niederer:
      material.active = c.active;
      break;
    case ActiveChoice::land2017:
      material.active = c.land2017;
      break;
    case ActiveChoice::second_piola:
      material.active = material::PrescribedTension{c.prescribed_tension};
      material.active_form = material::ActiveForm::second_piola;
      break;
    case ActiveChoice::cauchy:
      material.active = material::PrescribedTension{c.prescribed_tension};
      material.active_form = material::ActiveForm::cauchy;
      break;
  }
}

}  // namespace

std::filesystem::path beside(const Case& c, const std::string& name) {
  return c.file.parent_path() / name;
}

std::string place_of(const Case& c, const std::string& parameter) {
  const auto set_at = c.origin.find(parameter);
  return set_at == c.origin.end() ? c.file.string() : set_at->second;
}

material::Myocardium myocardium(const Case& c) {
  material::Myocardium material;
  switch (c.passive.law) {
    case PassiveChoice::holzapfel_ogden:
      material.passive = c.passive.holzapfel_ogden.with_anisotropy_scaled(c.passive.C_a);
      break;
    case PassiveChoice::guccione:
      material.passive = c.passive.guccione;
      break;
    case PassiveChoice::neo_hookean:
      material.passive = c.passive.neo_hookean;
      break;
  }
  material.volumetric = c.volumetric;
  material.volumetric_points = c.volumetric_points;
  if (is_cycle(c))
    material.stabilisation = c.stabilisation;
  material.infarct = c.infarct;
  material.viscosity = c.viscosity;
  set_active(c, material);
  return material;
}

mesh::WallMeshParameters mesh_parameters(const Case& c) {
  if (c.engine == EngineChoice::immersed || c.quasi_static.order == 1)
    return c.mesh;
  return {.edge_length = 0.5 * c.quasi_static.edge_length,
          .layers = 2 * c.quasi_static.layers,
          .order = 2,
          .apex = c.quasi_static.apex,
          .endocardium = c.quasi_static.endocardium};
}

solid::CardiacModel cardiac_model(const Case& c) {
  return {myocardium(c), c.engine == EngineChoice::immersed ? c.base : quasi_static_support(c),
          c.surroundings, segment_factors(c)};
}

implicit::StaticModel static_model(const Case& c) {
  implicit::StaticModel model({myocardium(c), quasi_static_support(c), c.surroundings,
                               segment_factors(c), c.septal_pressure},
                              c.protocol.calcium, c.quasi_static.stabilisation);
  if (c.bulk_modulus > 0.0)
    model.compressibility.kappa = c.bulk_modulus;
  if (c.protocol.cycle.inertia)
    model.density = c.muscle_density;
  return model;
}

immersed::ModelParameters model_parameters(const Case& c, const mesh::Mesh& mesh) {
  immersed::ModelParameters p;
  p.grid = fluid::centred_grid(bounds(mesh.nodes).center(), Vec3(c.box.size.data()), c.box.cells);
  p.blood = c.blood;
  p.coupling = c.coupling;
  return p;
}

heartbeat::BeatSetup beat_setup(const Case& c, const mesh::Mesh& mesh) {
  return {mesh, cardiac_model(c), model_parameters(c, mesh), c.protocol, c.time, c.output};
}

}  // namespace lv::case_file
