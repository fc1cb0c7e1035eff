#include "lv/verify/land2015.hpp"

#include "lv/base/check.hpp"
#include "lv/geometry/ellipsoid.hpp"
#include "lv/mesh/refine.hpp"
#include "lv/mesh/surface.hpp"
#include "lv/mesh/wall_mesh.hpp"

#include <cmath>
#include <numbers>

namespace lv::verify {
namespace {

/// The faces of a surface whose nodes all satisfy a condition.
template <class Condition>
mesh::Surface faces_where(const mesh::Mesh& mesh, const Condition& condition) {
  const mesh::Surface all = mesh::boundary(mesh);
  mesh::Surface result;
  for (int f = 0; f < all.size(); ++f) {
    const auto face = all.face(f);
    if (std::all_of(face.begin(), face.end(), [&](int n) { return condition(mesh.nodes[n]); }))
      result.nodes.insert(result.nodes.end(), face.begin(), face.end());
  }
  return result;
}

/// A block of nx x ny x nz linear hexahedra on [0,10] x [0,1] x [0,1] mm.
mesh::Mesh block(int nx, int ny, int nz) {
  mesh::Mesh mesh;
  for (int k = 0; k <= nz; ++k)
    for (int j = 0; j <= ny; ++j)
      for (int i = 0; i <= nx; ++i)
        mesh.nodes.emplace_back(10.0 * i / nx, 1.0 * j / ny, 1.0 * k / nz);
  const auto node = [&](int i, int j, int k) { return (k * (ny + 1) + j) * (nx + 1) + i; };
  for (int k = 0; k < nz; ++k)
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i)
        for (const int l : {k, k + 1})
          mesh.cells.insert(mesh.cells.end(), {node(i, j, l), node(i + 1, j, l),
                                               node(i + 1, j + 1, l), node(i, j + 1, l)});
  for (const Vec3& X : mesh.nodes)
    mesh.transmural.push_back(X.y());  // so that the circumferential direction is x
  mesh.infarct.assign(mesh.nodes.size(), 0.0);
  return mesh;
}

}  // namespace

mesh::Mesh LandBeam::mesh() const {
  mesh::Mesh coarse = block(40, 4, 4);
  coarse.endo = faces_where(coarse, [](const Vec3& X) { return X.z() == 0.0; });
  coarse.base = faces_where(coarse, [](const Vec3& X) { return X.x() == 0.0; });
  coarse.fibres.rule = {0.0, 0.0, 0.0, 0.0};
  return mesh::refine(coarse);
}

solid::CardiacModel LandBeam::heart() const {
  solid::CardiacModel heart;
  heart.myocardium.passive = material::Guccione{.C = 2.0, .b_f = 8.0, .b_t = 2.0, .b_fs = 4.0};
  heart.myocardium.active = material::PrescribedTension{0.0};
  return heart;
}

int LandBeam::watched_node(const mesh::Mesh& mesh) const {
  const Vec3 place(10.0, 0.5, 1.0);
  for (std::size_t a = 0; a < mesh.nodes.size(); ++a)
    if ((mesh.nodes[a] - place).norm() < 1e-9)
      return static_cast<int>(a);
  throw LogicError("the beam has no node at (10, 0.5, 1)");
}

mesh::Mesh LandEllipsoid::mesh(const mesh::WallMeshParameters& parameters) {
  const geometry::Ellipsoid wall{7.0, 17.0, 10.0, 20.0, base_height};
  return mesh::wall_mesh([&](double u, double theta, double t) { return wall.point(u, theta, t); },
                         parameters);
}

mesh::Mesh LandEllipsoid::graded_mesh(const mesh::WallMeshParameters& parameters) {
  mesh::WallMeshParameters graded = parameters;
  graded.apex = 0.3;
  graded.endocardium = 0.5;
  return mesh(graded);
}

LandApex land_apex(const mesh::Mesh& mesh, std::span<const Vec3> positions) {
  const auto on_axis = [&](const mesh::Surface& surface) {
    double z = 0.0;
    for (const int node : mesh::surface_nodes(surface))
      if (std::hypot(mesh.nodes[node].x(), mesh.nodes[node].y()) < 1e-6)
        z = positions[node].z();
    return z + LandEllipsoid::base_height;
  };
  return {on_axis(mesh.endo), on_axis(mesh.epi)};
}

LandProblem land_inflation() {
  LandProblem p;
  p.heart.myocardium.passive = material::Guccione{.C = 10.0, .b_f = 1.0, .b_t = 1.0, .b_fs = 1.0};
  p.heart.myocardium.active = material::PrescribedTension{0.0};
  p.pressure = 10.0;
  return p;
}

LandProblem land_contraction() {
  LandProblem p;
  p.heart.myocardium.passive = material::Guccione{.C = 2.0, .b_f = 8.0, .b_t = 2.0, .b_fs = 4.0};
  p.heart.myocardium.active = material::PrescribedTension{60.0};
  p.heart.myocardium.active_form = material::ActiveForm::second_piola;
  // the benchmark's angle has the opposite sign of the paper's
  p.fibres.helix_endo = -0.5 * std::numbers::pi;
  p.fibres.helix_epi = 0.5 * std::numbers::pi;
  p.pressure = 15.0;
  return p;
}

}  // namespace lv::verify
