#include "lv/base/check.hpp"
#include "lv/base/units.hpp"
#include "lv/circulation/implicit_step.hpp"
#include "lv/implicit/time_engine.hpp"
#include "lv/mesh/refine.hpp"
#include "lv/mesh/split.hpp"
#include "lv/verify/half_sphere.hpp"
#include "lv/verify/land2015.hpp"
#include "lv/verify/problems.hpp"
#include "lv/verify/small_ventricle.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

/// Problems of the quasi-static engine with known answers.
namespace lv::verify {
namespace {

using implicit::Engine;
using solid::CardiacModel;

/// A wall of one passive law, on a base that slides.
CardiacModel without_tension(const material::AnyPassiveLaw& law) {
  CardiacModel heart{.base = {.stiffness = implicit::rigid_base}};
  heart.myocardium.passive = law;
  heart.myocardium.active = material::PrescribedTension{0.0};
  return heart;
}

CardiacModel fixed_at_base(CardiacModel heart) {
  heart.base = {solid::BasalSupport::Kind::fixed, implicit::rigid_base};
  return heart;
}

}  // namespace

void thick_sphere_static(Findings& found) {
  const HalfSphere sphere;
  const double exact = 2.0 / 3.0 * std::numbers::pi * std::pow(sphere.a, 3);
  const auto volume_error = [&](double edge_length, int order) {
    const mesh::Mesh mesh = sphere.mesh(edge_length, order);
    Engine engine(mesh, without_tension(material::NeoHookean{sphere.mu}), {});
    engine.go_to({sphere.pressure(), 0.0}).value();
    return std::abs(engine.cavity_volume() / exact - 1.0);
  };
  found.add_error("cavity volume, relative error, quadratic elements of 3 mm", volume_error(1.5, 2),
                  1e-3);
  found.add_error("cavity volume, relative error, linear elements of 1.25 mm",
                  volume_error(1.25, 1), 0.02);
}

/// Rubber that was blown up and empties through a resistance R against zero pressure, V' = -p(V)/R.
/// Reference values: the exact p(V), integrated by an explicit method of fourth order.
void coupled_sphere(Findings& found) {
  constexpr double R = 2e-4;   // of half a sphere [kPa s/mm^3]
  constexpr double dt = 5e-3;  // [s]
  const HalfSphere sphere{.A = 15.0, .B = 22.0, .a = 18.0, .mu = 10.0};
  const mesh::Mesh mesh = sphere.mesh(2.0, 2);
  implicit::TimeEngine engine(mesh, without_tension(material::NeoHookean{sphere.mu}), {});
  circulation::History<1> history{{engine.fill(sphere.pressure(), 0.0).value()}};
  struct Row {
    double time, volume, pressure;  // of the whole sphere
  };
  constexpr std::array<Row, 6> rows{{{0.0, 24429.02, 3.37565},
                                     {0.1, 21332.98, 2.79773},
                                     {0.2, 18860.75, 2.14002},
                                     {0.3, 17049.17, 1.49381},
                                     {0.5, 15089.34, 0.56687},
                                     {1.0, 14178.26, 0.02638}}};
  int step = 0;
  for (const Row& row : rows) {
    for (; step * dt < row.time - 0.5 * dt; ++step) {
      const auto difference = circulation::backward_difference(history, dt);
      const auto volume = [&](double p) {
        return implicit::GivenVolume{difference.known[0] - difference.weight * p / R,
                                     -difference.weight / R};
      };
      const auto report = engine.advance({.dt = dt}, volume);
      LV_CHECK(report.converged);
      history.push({engine.cavity_volume()}, dt);
    }
    found.add_within(fmt::format("volume at {} s", row.time), 2.0 * engine.cavity_volume(),
                     row.volume, 2e-3, "mm^3");
    found.add_within(fmt::format("pressure at {} s", row.time), engine.pressure(), row.pressure,
                     5e-3, "kPa");
  }
}

void land2015_problem1(Findings& found) {
  const LandBeam beam;
  const mesh::Mesh mesh = beam.mesh();
  Engine engine(mesh, fixed_at_base(beam.heart()), {});
  engine.go_to({beam.pressure, 0.0}).value();
  found.add_within(fmt::format("z of (10, 0.5, 1), {} quadratic elements", mesh.cell_count() / 8),
                   engine.state().positions[beam.watched_node(mesh)].z(), 4.167, 0.005, "mm");
}

namespace {

Engine inflated(const mesh::Mesh& mesh, const LandProblem& problem) {
  Engine engine(mesh, fixed_at_base(problem.heart), {});
  engine.go_to({problem.pressure, 1.0}).value();
  return engine;
}

/// Apex and cavity on two meshes against their reference, each within `fraction` of it.
void compare(const LandProblem& problem, const LandReference& reference, double fraction,
             mesh::Mesh (*make_mesh)(const mesh::WallMeshParameters&), Findings& found) {
  for (const double edge : {2.0, 1.5}) {
    mesh::Mesh mesh = make_mesh({.edge_length = 0.5 * edge, .order = 2});
    mesh.fibres.rule = problem.fibres;
    const Engine engine = inflated(mesh, problem);
    const LandApex here = land_apex(mesh, engine.state().positions);
    const std::string which = fmt::format(", {} quadratic elements", mesh.cell_count() / 8);
    found.add_within("z of the endocardial apex" + which, here.endo, reference.apex.endo, fraction,
                     "mm");
    found.add_within("z of the epicardial apex" + which, here.epi, reference.apex.epi, fraction,
                     "mm");
    found.add_within("cavity volume" + which, engine.cavity_volume(), reference.volume, fraction,
                     "mm^3");
  }
}

}  // namespace

void land2015_problem2(Findings& found) {
  compare(land_inflation(), land_inflation_reference, 0.002, LandEllipsoid::mesh, found);
}

void land2015_problem3(Findings& found) {
  compare(land_contraction(), land_contraction_reference, 0.01, LandEllipsoid::graded_mesh, found);
}

/// Elements that lock are too stiff by tens of per cent on meshes as coarse as these.
void no_locking(Findings& found) {
  const LandProblem problem = land_inflation();
  const auto volume = [&](const mesh::Mesh& mesh) {
    return inflated(mesh, problem).cavity_volume();
  };
  found.add_within("cavity volume, linear hexahedra of 1.5 mm",
                   volume(LandEllipsoid::mesh({.edge_length = 1.5})),
                   land_inflation_reference.volume, 0.05, "mm^3");
  found.add_within("cavity volume, quadratic hexahedra of 3 mm",
                   volume(LandEllipsoid::mesh({.edge_length = 1.5, .order = 2})),
                   land_inflation_reference.volume, 0.02, "mm^3");
  found.add_within(
      "cavity volume, quadratic tetrahedra of 3 mm",
      volume(mesh::refine(mesh::split_into_tetrahedra(LandEllipsoid::mesh({.edge_length = 3.0})))),
      land_inflation_reference.volume, 0.05, "mm^3");
}

namespace {

/// The default ventricle at 8 mmHg, and how its linear equations were solved.
struct Filled {
  double volume = 0.0;      ///< [mm^3]
  double iterations = 0.0;  ///< per linear solve

  Filled(const mesh::Mesh& mesh, implicit::LinearMethod method) {
    implicit::SolverParameters parameters;
    parameters.newton.linear.method = method;
    Engine engine(mesh, without_tension(material::HolzapfelOgden{}), parameters);
    int solves = 0, sum = 0;
    const auto count = [&](const implicit::Step& step) {
      solves += step.newton.linear_solves;
      sum += step.newton.linear_iterations;
    };
    volume = engine.go_to({8.0 * units::mmHg, 0.0}, count).value();
    iterations = static_cast<double>(sum) / solves;
  }
};

}  // namespace

void iterative_solver(Findings& found) {
  using enum implicit::LinearMethod;
  const auto compare = [&](const mesh::Mesh& mesh, const std::string& elements) {
    const Filled with_direct(mesh, direct);
    const Filled with_iterative(mesh, iterative);
    found.add_within("cavity volume, " + elements, 1e-3 * with_iterative.volume,
                     1e-3 * with_direct.volume, 1e-5, "ml");
    return with_iterative.iterations;
  };
  const auto hexahedra = [](double edge) {
    return ideal_mesh({.edge_length = 0.5 * edge, .order = 2});
  };
  const double coarse = compare(hexahedra(18.0), "quadratic hexahedra of 18 mm");
  const double fine = compare(hexahedra(13.0), "quadratic hexahedra of 13 mm");
  found.add_error("iterations per solve of 13 mm over those of 18 mm", fine / coarse, 1.5);
  compare(mesh::refine(mesh::split_into_tetrahedra(ideal_mesh({.edge_length = 18.0}))),
          "quadratic tetrahedra of 18 mm");
}

}  // namespace lv::verify
