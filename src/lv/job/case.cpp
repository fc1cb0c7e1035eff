#include "lv/job/case.hpp"

namespace lv::job {
namespace {

/// Springs that yield by micrometres under the pressures of a ventricle [kPa/mm].
constexpr double quasi_static_base = 1e6;

}  // namespace

std::filesystem::path beside(const Case& c, const std::string& name) {
  return c.file.parent_path() / name;
}

std::string place_of(const Case& c, const std::string& parameter) {
  const auto set_at = c.origin.find(parameter);
  return set_at == c.origin.end() ? c.file.string() : set_at->second;
}

solid::WallMaterial wall_material(const Case& c) {
  solid::WallMaterial material;
  switch (c.passive.law) {
    case PassiveLaw::holzapfel_ogden:
      material.passive = c.passive.holzapfel_ogden.with_anisotropy_scaled(c.passive.C_a);
      break;
    case PassiveLaw::guccione:
      material.passive = c.passive.guccione;
      break;
    case PassiveLaw::neo_hookean:
      material.passive = c.passive.neo_hookean;
      break;
  }
  material.volumetric = c.volumetric;
  material.volumetric_points = c.volumetric_points;
  material.infarct = c.infarct;
  material.active_form = c.active_form;
  return material;
}

mesh::WallMeshParameters mesh_parameters(const Case& c) {
  if (c.engine == Engine::immersed || c.quasi_static.order == 1)
    return c.mesh;
  return {.edge_length = 0.5 * c.quasi_static.edge_length,
          .layers = 2 * c.quasi_static.layers,
          .order = 2};
}

heartbeat::Protocol protocol(const Case& c) {
  heartbeat::Protocol p = c.protocol;
  if (c.active_form != material::ActiveForm::niederer)
    p.tension = c.prescribed_tension;
  return p;
}

solid::BasalSupport basal_support(const Case& c) {
  if (c.engine == Engine::immersed)
    return c.base;
  return {c.base.kind, quasi_static_base};
}

quasi_static::Muscle muscle(const Case& c) {
  const auto contractility = c.active_form == material::ActiveForm::niederer
                                 ? quasi_static::Contractility(c.active, c.protocol.calcium.Ca_0,
                                                               c.protocol.calcium.Ca_max)
                                 : quasi_static::Contractility(c.prescribed_tension);
  return {wall_material(c),
          contractility,
          {c.base.kind, quasi_static_base},
          c.quasi_static.stabilisation};
}

immersed::ModelParameters model_parameters(const Case& c, const mesh::Mesh& mesh) {
  Vec3 lower = mesh.nodes.front();
  Vec3 upper = lower;
  for (const Vec3& x : mesh.nodes) {
    lower = lower.cwiseMin(x);
    upper = upper.cwiseMax(x);
  }
  immersed::ModelParameters p;
  const Vec3 size(c.box.size[0], c.box.size[1], c.box.size[2]);
  p.grid.cells = c.box.cells;
  p.grid.spacing = size.cwiseQuotient(Vec3(c.box.cells[0], c.box.cells[1], c.box.cells[2]));
  p.grid.lower = 0.5 * (lower + upper) - 0.5 * size;
  p.blood = c.blood;
  p.coupling = c.coupling;
  p.base = c.base;
  return p;
}

}  // namespace lv::job
