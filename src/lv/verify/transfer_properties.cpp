#include "lv/base/parallel.hpp"
#include "lv/immersed/coupling.hpp"
#include "lv/verify/problems.hpp"
#include "lv/verify/sphere_mesh.hpp"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <random>

namespace lv::verify {
namespace {

using fluid::FaceField;
using immersed::AxisWeights;
using immersed::CouplingKind;
using immersed::Kernel;

/// Largest deviations of a one-dimensional kernel's moments over many positions between grid
/// points.
struct Moments {
  double zeroth = 0.0;    ///< sum w = 1
  double even_odd = 0.0;  ///< sum over even points = sum over odd points = 1/2
  double first = 0.0;     ///< sum (x_i - s) w = 0
  double squares = 0.0;   ///< sum w^2 = 3/8
};

template <class KernelFunction>
Moments moments(const KernelFunction& kernel) {
  Moments worst;
  for (int n = 0; n < 1000; ++n) {
    const double s = 7.0 + n / 1000.0;
    const AxisWeights w = kernel(s);
    std::array<double, 2> parity{};
    double first = 0.0;
    double squares = 0.0;
    for (int i = 0; i < 4; ++i) {
      parity[(w.first + i) % 2] += w.weight[i];
      first += (w.first + i - s) * w.weight[i];
      squares += w.weight[i] * w.weight[i];
    }
    worst.zeroth = std::max(worst.zeroth, std::abs(parity[0] + parity[1] - 1.0));
    worst.even_odd = std::max(worst.even_odd, std::abs(parity[0] - parity[1]));
    worst.first = std::max(worst.first, std::abs(first));
    worst.squares = std::max(worst.squares, std::abs(squares - 0.375));
  }
  return worst;
}

/// A stretched shell in a box of unequal spacings, random loads at its nodes and a random flow; the
/// same on any number of ranks.
struct Scene {
  Scene()
      : grid{{22, 25, 27}, Vec3(-24.0, -26.0, -25.0), Vec3(2.2, 2.0, 1.9)},
        slab(fluid::slab_of(grid, parallel::rank(), parallel::size())),
        mesh(spherical_shell(9.0, 13.0, 8, 3)) {
    std::mt19937 generator(1);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    const auto random = [&] {
      const double x = uniform(generator);
      const double y = uniform(generator);
      return Vec3(x, y, uniform(generator));
    };
    for (const Vec3& X : mesh.nodes) {
      positions.emplace_back(X.cwiseProduct(Vec3(1.15, 0.9, 1.05)) + 0.1 * random());
      forces.push_back(random());
    }
  }

  void fill_randomly(FaceField& velocity) const {
    std::mt19937 generator(2);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    for (int c = 0; c < 3; ++c) {
      std::vector<double> values(parallel::is_root() ? static_cast<std::size_t>(grid.points(c, 0)) *
                                                           grid.points(c, 1) * grid.points(c, 2)
                                                     : 0);
      for (double& value : values)
        value = uniform(generator);
      fluid::scatter(values, velocity.component[c]);
    }
    fluid::fill_ghosts(velocity, slab);
  }

  fluid::Grid grid;
  fluid::Slab slab;
  mesh::Mesh mesh;
  std::vector<Vec3> positions, forces;
};

/// Calls visit(component, position, value) for every point of this rank.
template <class Visit>
void for_points(const Scene& scene, const FaceField& field, const Visit& visit) {
  for (int c = 0; c < 3; ++c) {
    const fluid::Component& u = field.component[c];
    for (int k = 0; k < u.nz(); ++k)
      for (int j = 0; j < u.ny(); ++j)
        for (int i = 0; i < u.nx(); ++i)
          visit(c, scene.grid.face(c, i, j, k + scene.slab.planes.begin), std::array{i, j, k});
  }
}

struct Variant {
  CouplingKind kind;
  Kernel kernel;
  const char* name;
};
constexpr std::array<Variant, 4> variants{
    {{CouplingKind::nodal, Kernel::peskin4, "nodal, 4-point"},
     {CouplingKind::nodal, Kernel::composite_bspline, "nodal, B-spline"},
     {CouplingKind::quadrature, Kernel::peskin4, "quadrature, 4-point"},
     {CouplingKind::quadrature, Kernel::composite_bspline, "quadrature, B-spline"}}};

std::unique_ptr<immersed::Coupling> make(const Variant& variant, const Scene& scene) {
  return immersed::make_coupling({variant.kind, variant.kernel, 2.0}, scene.mesh, scene.grid,
                                 scene.slab);
}

std::string on_ranks(const char* name) {
  return fmt::format("{}, {} rank{}", name, parallel::size(), parallel::size() == 1 ? "" : "s");
}

}  // namespace

void delta_moments(Findings& found) {
  constexpr double rounding = 1e-14;
  const Moments peskin = moments(immersed::peskin4);
  found.add_error("4-point: sum of weights", peskin.zeroth, rounding);
  found.add_error("4-point: even minus odd points", peskin.even_odd, rounding);
  found.add_error("4-point: first moment", peskin.first, rounding);
  found.add_error("4-point: sum of squares minus 3/8", peskin.squares, rounding);
  const Moments cubic = moments(immersed::cubic_bspline);
  found.add_error("cubic B-spline: sum of weights", cubic.zeroth, rounding);
  found.add_error("cubic B-spline: first moment", cubic.first, rounding);
  const Moments quadratic = moments(immersed::quadratic_bspline);
  found.add_error("quadratic B-spline: sum of weights", quadratic.zeroth, rounding);
  found.add_error("quadratic B-spline: first moment", quadratic.first, rounding);
}

void spread_interpolate_adjoint(Findings& found) {
  const Scene scene;
  FaceField velocity(scene.grid, scene.slab);
  scene.fill_randomly(velocity);
  for (const Variant& variant : variants) {
    const auto coupling = make(variant, scene);
    FaceField force(scene.grid, scene.slab);
    coupling->spread(scene.positions, scene.forces, force);
    double on_grid = 0.0;
    for_points(scene, force, [&](int c, const Vec3& /*x*/, const std::array<int, 3>& i) {
      on_grid +=
          force.component[c].at(i[0], i[1], i[2]) * velocity.component[c].at(i[0], i[1], i[2]);
    });
    on_grid = parallel::sum(on_grid) * scene.grid.cell_volume();

    std::vector<Vec3> velocities(scene.positions.size());
    coupling->interpolate(velocity, scene.positions, velocities);
    double at_nodes = 0.0;
    double scale = 0.0;
    for (std::size_t a = 0; a < velocities.size(); ++a) {
      at_nodes += scene.forces[a].dot(velocities[a]);
      scale += scene.forces[a].norm() * velocities[a].norm();
    }
    found.add_error(on_ranks(variant.name), std::abs(on_grid - at_nodes) / scale, 1e-12);
  }
}

void force_and_torque_conserved(Findings& found) {
  const Scene scene;
  Vec3 wall_force = Vec3::Zero();
  Vec3 wall_torque = Vec3::Zero();
  double force_scale = 0.0;
  double torque_scale = 0.0;
  for (std::size_t a = 0; a < scene.positions.size(); ++a) {
    const Vec3& F = scene.forces[a];
    wall_force += F;
    wall_torque += scene.positions[a].cross(F);
    force_scale += F.norm();
    torque_scale += scene.positions[a].norm() * F.norm();
  }
  for (const Variant& variant : variants) {
    FaceField force(scene.grid, scene.slab);
    make(variant, scene)->spread(scene.positions, scene.forces, force);
    std::array<double, 6> sums{};
    Eigen::Map<Vec3> blood_force(sums.data());
    Eigen::Map<Vec3> blood_torque(sums.data() + 3);
    for_points(scene, force, [&](int c, const Vec3& x, const std::array<int, 3>& i) {
      const Vec3 f = force.component[c].at(i[0], i[1], i[2]) * Vec3::Unit(c);
      blood_force += f * scene.grid.cell_volume();
      blood_torque += x.cross(f) * scene.grid.cell_volume();
    });
    parallel::sum(sums);
    // to rounding; the mass matrix of the quadrature coupling is solved to 1e-12
    found.add_error("force, " + on_ranks(variant.name),
                    (blood_force - wall_force).norm() / force_scale, 1e-12);
    // to rounding at the nodes. Gauss points carry the torque of x_a M_ab F_b with M integrated by
    // another rule than the nodes' own, which differ by the curvature of the elements
    const double tolerance = variant.kind == CouplingKind::nodal ? 1e-12 : 1e-3;
    found.add_error("torque, " + on_ranks(variant.name),
                    (blood_torque - wall_torque).norm() / torque_scale, tolerance);
  }
}

}  // namespace lv::verify
