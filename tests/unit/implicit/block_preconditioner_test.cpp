#include "lv/implicit/block_preconditioner.hpp"

#include "lv/implicit/equations.hpp"
#include "lv/verify/small_ventricle.hpp"

#include <catch2/catch.hpp>

namespace {

using namespace lv;

/// Iterations of GMRES for the first correction of a ventricle with quadratic elements this large
/// [mm] and muscle this many times as stiff.
int iterations(double edge, double stiffness) {
  const mesh::Mesh mesh = verify::ideal_mesh({.edge_length = 0.5 * edge, .order = 2});
  solid::CardiacModel heart{.base = {.stiffness = implicit::rigid_base}};
  heart.myocardium.passive = material::HolzapfelOgden{}.scaled(stiffness);
  heart.myocardium.active = material::PrescribedTension{0.0};
  const implicit::Equations equations(mesh, heart);
  implicit::SparseMatrix K(equations.pattern(), {.method = implicit::LinearMethod::iterative},
                           equations.undeformed());
  equations.tangent(equations.rest(), {0.1, 0.0}, K);
  K.solve(equations.residual(equations.rest(), {0.1, 0.0})).value();
  return K.iterations();
}

}  // namespace

TEST_CASE("iterations hardly grow when elements become smaller", "[unit][implicit]") {
  const int coarse = iterations(16.0, 1.0);
  CHECK(coarse < 60);
  CHECK(iterations(11.0, 1.0) < 1.5 * coarse);
}

TEST_CASE("the pressures' block knows how stiff the muscle is", "[unit][implicit]") {
  // a mass that were not weighted by 1/mu would be a thousand times too large
  CHECK(iterations(16.0, 1000.0) < 1.5 * iterations(16.0, 1.0));
}
