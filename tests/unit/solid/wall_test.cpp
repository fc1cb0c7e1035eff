#include "lv/solid/wall.hpp"

#include "lv/base/check.hpp"
#include "lv/mesh/surface.hpp"
#include "lv/solid/boundary.hpp"
#include "lv/solid/endocardial_surface.hpp"

#include "support/block_mesh.hpp"
#include "support/cell_kinds.hpp"
#include "support/random_values.hpp"
#include <Eigen/LU>
#include <catch2/catch.hpp>

#include <cmath>

namespace {

using namespace lv;
using material::Myocardium;
using material::VolumetricPoints;
using mesh::CellKind;
using mesh::Mesh;
using solid::Wall;
using test::kinds;

constexpr std::array volumetric_points{VolumetricPoints::full, VolumetricPoints::mean};

/// Fibres in one direction everywhere, since t grows along x everywhere.
const mesh::FibreRule parallel_fibres{0.4, 0.4, 0.3, 0.3};

Mat3 parallel_frame() {
  return mesh::fibre_frame(parallel_fibres, mesh::wall_axes(Vec3::UnitX()), 0.0);
}

/// A deformation with stretch, shear, rotation and a change of volume (J = 1.08).
Mat3 some_deformation() {
  Mat3 F;
  F << 1.10, 0.05, -0.02, 0.13, 0.98, 0.04, -0.01, 0.16, 1.01;
  return F;
}

/// M from 0 to 1 through the block.
Mesh infarcted(Mesh mesh) {
  for (std::size_t a = 0; a < mesh.nodes.size(); ++a)
    mesh.infarct[a] = std::clamp((mesh.nodes[a].y() - 4.0) / 6.0, 0.0, 1.0);
  return mesh;
}

Myocardium material_of(const material::AnyPassiveLaw& passive, VolumetricPoints points) {
  Myocardium material;
  material.passive = passive;
  material.volumetric_points = points;
  material.stabilisation.beta_s = 150.0;  // more than a tetrahedron's own share
  return material;
}

std::vector<Vec3> elastic_forces(const Wall& wall, std::span<const Vec3> positions,
                                 std::span<const double> tension) {
  std::vector<Vec3> forces(positions.size(), Vec3::Zero());
  wall.add_elastic_forces(positions, tension, forces);
  return forces;
}

/// The penalty at the points of an element: tetrahedra with mean dilatations have none.
material::Volumetric at_points(const Myocardium& material, CellKind kind) {
  if (material.volumetric_points == VolumetricPoints::full)
    return material.volumetric;
  return kind == CellKind::hexahedron ? material.stabilisation : material::Volumetric{0.0};
}

/// Strain energy of a point, in the model frame.
double energy_at(const Myocardium& material, CellKind kind, const solid::PointSample& p) {
  const Mat3 F = p.F * p.fibre_frame;
  const double passive =
      std::visit([&](const auto& law) { return law.energy(F); }, material.passive);
  return material.infarct.passive(p.infarct) * passive + at_points(material, kind).energy(F);
}

/// The volumetric part from one J per cell, that of its mean deformation, or around each node of
/// tetrahedra.
double mean_volumetric_energy(const Mesh& mesh, const Myocardium& material,
                              const std::vector<Mat3>& mean_F, const std::vector<double>& volume) {
  const material::Volumetric& law = material.volumetric;
  double sum = 0.0;
  if (mesh.kind == CellKind::hexahedron) {
    for (int c = 0; c < mesh.cell_count(); ++c)
      sum += volume[c] * law.energy(mean_F[c]);
    return sum;
  }
  std::vector<double> before(mesh.nodes.size(), 0.0);
  std::vector<double> now(mesh.nodes.size(), 0.0);
  for (int c = 0; c < mesh.cell_count(); ++c)
    for (const int a : mesh.cell(c)) {
      before[a] += volume[c] / 4.0;
      now[a] += determinant(mean_F[c]) * volume[c] / 4.0;
    }
  constexpr double own_share = 0.1;
  const material::Volumetric own{std::max(own_share * law.beta_s, material.stabilisation.beta_s)};
  for (std::size_t a = 0; a < now.size(); ++a)
    sum += (1.0 - own_share) * before[a] *
           law.energy(Mat3(std::cbrt(now[a] / before[a]) * Mat3::Identity()));
  for (int c = 0; c < mesh.cell_count(); ++c)
    sum += volume[c] * own.energy(mean_F[c]);
  return sum;
}

/// The whole wall's energy.
double energy(const Mesh& mesh, const Wall& wall, const Myocardium& material,
              std::span<const Vec3> positions) {
  const std::vector<double> no_tension(positions.size(), 0.0);
  double sum = 0.0;
  std::vector<Mat3> mean_F(mesh.cell_count(), Mat3::Zero());
  std::vector<double> cell_volume(mesh.cell_count(), 0.0);
  for (const solid::PointSample& p : wall.sample(positions, no_tension)) {
    sum += p.volume * energy_at(material, mesh.kind, p);
    mean_F[p.cell] += p.volume * p.F;
    cell_volume[p.cell] += p.volume;
  }
  for (int c = 0; c < mesh.cell_count(); ++c)
    mean_F[c] /= cell_volume[c];
  if (material.volumetric_points == VolumetricPoints::mean)
    sum += mean_volumetric_energy(mesh, material, mean_F, cell_volume);
  return sum;
}

/// -sum_q P : dF over the points, the work of the stresses that `sample` reports.
double work_of_stresses(const Wall& wall, std::span<const Vec3> positions,
                        std::span<const double> tension, std::span<const Vec3> displacements) {
  const auto plus = wall.sample(test::displaced(positions, displacements, 0.5), tension);
  const auto minus = wall.sample(test::displaced(positions, displacements, -0.5), tension);
  const auto now = wall.sample(positions, tension);
  double sum = 0.0;
  for (std::size_t q = 0; q < now.size(); ++q) {
    const solid::CellStress& s = now[q].stress;
    const Mat3 cauchy = s.cauchy_passive + s.cauchy_active - s.pressure * Mat3::Identity();
    const Mat3 P = determinant(now[q].F) * cauchy * now[q].F.inverse().transpose();
    sum -= now[q].volume * P.cwiseProduct(plus[q].F - minus[q].F).sum();
  }
  return sum;
}

/// [kPa], of a wall that has the same J everywhere. A tetrahedron's own share is less than its
/// stabilisation here.
double whole_penalty(const Myocardium& material, CellKind kind) {
  const double beta_s = material.volumetric.beta_s;
  if (material.volumetric_points == VolumetricPoints::full)
    return beta_s;
  return material.stabilisation.beta_s + (kind == CellKind::tetrahedron ? 0.9 : 1.0) * beta_s;
}

std::vector<double> uneven_tension(const Mesh& mesh) {
  std::vector<double> tension;
  for (const Vec3& X : mesh.nodes)
    tension.push_back(50.0 + 4.0 * X.y() + X.z() * X.z());
  return tension;
}

}  // namespace

TEST_CASE("a uniform deformation is in equilibrium inside a distorted wall", "[unit][solid]") {
  const Mat3 F = some_deformation();
  const Mat3 F_fibre = F * parallel_frame();
  for (const CellKind kind : kinds) {
    for (const VolumetricPoints points : volumetric_points) {
      INFO("hexahedra " << (kind == kinds[0]) << ", mean dilatation "
                        << (points == volumetric_points[1]));
      Mesh mesh = test::block_mesh(kind);
      mesh.fibres.rule = parallel_fibres;
      mesh.infarct.assign(mesh.nodes.size(), 0.1);
      const Myocardium material = material_of(material::HolzapfelOgden{}, points);
      const Wall wall(mesh, material);
      const auto positions = test::moved(mesh.nodes, F, {1, 2, 3});
      const std::vector<double> tension(positions.size(), 30.0);
      const auto forces = elastic_forces(wall, positions, tension);

      Mat3 P_fibre = 5.9 * material::HolzapfelOgden{}.stress(F_fibre);  // 1 + 49 M
      P_fibre.col(0) += material::active_stress_column(F_fibre, determinant(F), 27.0);
      const material::Volumetric all{whole_penalty(material, kind)};
      const Mat3 P = P_fibre * parallel_frame().transpose() + all.stress(F);
      // -int P grad phi_a dX = -P int phi_a N dA over the boundary: zero at nodes inside
      std::vector<Vec3> minus_area(positions.size(), Vec3::Zero());
      mesh.endo = mesh::boundary(mesh);
      solid::EndocardialSurface(mesh).add_gradient(1.0, mesh.nodes, minus_area);
      for (std::size_t a = 0; a < forces.size(); ++a)
        CHECK((forces[a] - P * minus_area[a]).norm() <
              1e-12 * P.norm());  // rounding of sums over cells of 8 mm^3
    }
  }
}

TEST_CASE("the wall's force is minus the derivative of its energy", "[unit][solid]") {
  test::RandomValues random(5);
  for (const CellKind kind : kinds)
    for (const VolumetricPoints points : volumetric_points)
      for (const material::AnyPassiveLaw& law :
           {material::AnyPassiveLaw(material::Guccione{}),
            material::AnyPassiveLaw(material::NeoHookean{5.0})}) {
        const Mesh mesh = infarcted(test::block_mesh(kind));
        const Myocardium material = material_of(law, points);
        const Wall wall(mesh, material);
        const auto positions = test::displaced(test::moved(mesh.nodes, some_deformation()),
                                               random.vectors(mesh.nodes.size(), 0.1), 1.0);
        const auto forces =
            elastic_forces(wall, positions, std::vector<double>(positions.size(), 0.0));
        for (int i = 0; i < 4; ++i) {
          const auto direction = random.vectors(mesh.nodes.size(), 1.0);
          const auto slope = [&](double h) {
            return (energy(mesh, wall, material, test::displaced(positions, direction, h)) -
                    energy(mesh, wall, material, test::displaced(positions, direction, -h))) /
                   (2.0 * h);
          };
          // fourth order: the step to the fourth power, and rounding over the step
          const double derivative = (4.0 * slope(1e-3) - slope(2e-3)) / 3.0;
          CHECK(test::work(forces, direction) ==
                Approx(-derivative).epsilon(1e-7).margin(1e-8 * test::magnitude(forces)));
        }
      }
}

TEST_CASE("the wall's force does the work of the stresses it reports", "[unit][solid]") {
  test::RandomValues random(6);
  for (const CellKind kind : kinds) {
    const Mesh mesh = infarcted(test::block_mesh(kind));
    const Wall wall(mesh, material_of(material::HolzapfelOgden{}, VolumetricPoints::full));
    const auto tension = uneven_tension(mesh);
    const auto positions = test::displaced(test::moved(mesh.nodes, some_deformation()),
                                           random.vectors(mesh.nodes.size(), 0.1), 1.0);
    const auto forces = elastic_forces(wall, positions, tension);
    for (int i = 0; i < 10; ++i) {
      const auto direction = random.vectors(mesh.nodes.size(), 0.01);
      // F is linear in the positions: rounding alone
      CHECK(test::work(forces, direction) ==
            Approx(work_of_stresses(wall, positions, tension, direction))
                .margin(1e-12 * test::magnitude(forces)));
    }
  }
}

TEST_CASE("the wall exerts no net force and no torque on itself", "[unit][solid]") {
  test::RandomValues random(8);
  for (const CellKind kind : kinds) {
    for (const VolumetricPoints points : volumetric_points) {
      const Mesh mesh = infarcted(test::block_mesh(kind));
      const Wall wall(mesh, material_of(material::HolzapfelOgden{}, points));
      const auto positions = test::displaced(test::moved(mesh.nodes, some_deformation()),
                                             random.vectors(mesh.nodes.size(), 0.2), 1.0);
      const auto forces = elastic_forces(wall, positions, uneven_tension(mesh));
      const double size = test::magnitude(forces);
      CHECK(test::resultant(forces).norm() < 1e-14 * size);
      CHECK(test::torque(positions, forces).norm() < 1e-14 * 20.0 * size);  // arms of 20 mm
    }
  }
}

TEST_CASE("moving or turning the wall as a whole makes no force", "[unit][solid]") {
  for (const CellKind kind : kinds) {
    for (const VolumetricPoints points : volumetric_points) {
      const Mesh mesh = infarcted(test::block_mesh(kind));
      const Wall wall(mesh, material_of(material::HolzapfelOgden{}, points));
      const auto positions =
          test::moved(mesh.nodes, test::RandomValues(9).rotation(), {10, -20, 5});
      const std::vector<double> relaxed(positions.size(), 0.0);
      // stiffness 100 kPa, widths of 2 mm, coordinates rounded to 1e-15 of 20 mm
      for (const Vec3& F : elastic_forces(wall, positions, relaxed))
        CHECK(F.norm() < 1e-10);
    }
  }
}

TEST_CASE("the scar neither contracts nor keeps its softness", "[unit][solid]") {
  Mesh mesh = test::block_mesh(CellKind::hexahedron);
  const auto positions = test::moved(mesh.nodes, some_deformation());
  const std::vector<double> relaxed(positions.size(), 0.0);
  const std::vector<double> active(positions.size(), 60.0);
  Myocardium material;
  material.volumetric.beta_s = 0.0;
  const auto healthy = elastic_forces(Wall(mesh, material), positions, relaxed);
  mesh.infarct.assign(mesh.nodes.size(), 1.0);
  const Wall scar(mesh, material);
  const auto passive = elastic_forces(scar, positions, relaxed);
  const auto activated = elastic_forces(scar, positions, active);
  for (std::size_t a = 0; a < passive.size(); ++a) {
    CHECK((activated[a] - passive[a]).norm() < 1e-12);  // 1 - M is rounding of M
    CHECK((passive[a] - 50.0 * healthy[a]).norm() < 1e-12 * passive[a].norm() + 1e-12);
  }
}

TEST_CASE("nodal volumes add up to the wall's", "[unit][solid]") {
  for (const CellKind kind : kinds) {
    const Mesh mesh = test::block_mesh(kind);
    const Wall wall(mesh, {});
    double sum = 0.0;
    for (const double V : wall.nodal_volumes()) {
      CHECK(V > 0.0);
      sum += V;
    }
    CHECK(sum == Approx(test::volume(mesh)).epsilon(1e-13));
  }
}

TEST_CASE("in a uniform deformation every node has the stretch |F f0| and every point the J",
          "[unit][solid]") {
  const Mat3 F = some_deformation();
  for (const CellKind kind : kinds) {
    Mesh mesh = test::block_mesh(kind);
    mesh.fibres.rule = parallel_fibres;
    const Wall wall(mesh, {});
    const auto positions = test::moved(mesh.nodes, F, {1, 2, 3});
    std::vector<double> stretch(positions.size());
    wall.nodal_stretch(positions, stretch);
    for (const double lambda : stretch)
      CHECK(lambda == Approx((F * parallel_frame().col(0)).norm()).epsilon(1e-13));
    std::vector<Vec3> forces(positions.size(), Vec3::Zero());
    const auto J =
        wall.add_elastic_forces(positions, std::vector<double>(positions.size(), 0.0), forces);
    CHECK(J.min_J == Approx(determinant(F)).epsilon(1e-13));
    CHECK(J.max_J == Approx(determinant(F)).epsilon(1e-13));
  }
}

TEST_CASE("samples cover the wall and know where they are", "[unit][solid]") {
  const Mat3 F = some_deformation();
  for (const CellKind kind : kinds) {
    Mesh mesh = infarcted(test::block_mesh(kind));
    mesh.fibres.rule = parallel_fibres;
    const Wall wall(mesh, {});
    const std::vector<double> tension(mesh.nodes.size(), 40.0);
    double volume = 0.0;
    for (const auto& p : wall.sample(test::moved(mesh.nodes, F, {1, 2, 3}), tension)) {
      volume += p.volume;
      CHECK((p.F - F).norm() < 1e-13);
      CHECK((p.position - (F * p.reference + Vec3(1, 2, 3))).norm() < 1e-12);
      CHECK(p.transmural == Approx((p.reference.x() - 15.0) / 6.0).margin(1e-13));
      CHECK((p.fibre_frame - parallel_frame()).norm() < 1e-13);
      CHECK((p.axes.radial - Vec3::UnitX()).norm() < 1e-13);
      CHECK(p.stress.tension == Approx(40.0 * (1.0 - p.infarct)).epsilon(1e-13));
    }
    CHECK(volume == Approx(test::volume(mesh)).epsilon(1e-13));
  }
}

TEST_CASE("an inverted element is refused by number", "[unit][solid]") {
  Mesh mesh = test::block_mesh(CellKind::tetrahedron);
  std::swap(mesh.cells[4 * 17], mesh.cells[4 * 17 + 1]);
  CHECK_THROWS_AS(Wall(mesh, {}), InputError);
  CHECK_THROWS_WITH(Wall(mesh, {}), Catch::Matchers::Contains("element 17 "));
}
