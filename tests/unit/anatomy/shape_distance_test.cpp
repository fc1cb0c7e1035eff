#include "lv/anatomy/shape_distance.hpp"

#include "lv/base/units.hpp"
#include "lv/calibrate/fit.hpp"
#include "lv/mesh/surface.hpp"
#include "lv/verify/small_ventricle.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace {

using namespace lv;
using geometry::Contour;
using geometry::Side;
using units::mmHg;

/// Where a plane across the long axis cuts a surface, in order about the axis.
Contour cut(const mesh::Surface& surface, const std::vector<Vec3>& nodes, double z, Side side) {
  Contour loop;
  loop.side = side;
  const auto cross = [&](int a, int b) {
    const double s = (z - nodes[a].z()) / (nodes[b].z() - nodes[a].z());
    if (nodes[a].z() < nodes[b].z() && s >= 0.0 && s < 1.0)  // each edge in one of its directions
      loop.points.emplace_back((1.0 - s) * nodes[a] + s * nodes[b]);
  };
  for (int f = 0; f < surface.size(); ++f)
    mesh::for_triangles(surface.face(f), [&](int a, int b, int c) {
      for (const auto& [i, j] : {std::array{a, b}, std::array{b, c}, std::array{c, a}}) {
        cross(i, j);
        cross(j, i);
      }
    });
  std::sort(loop.points.begin(), loop.points.end(), [](const Vec3& a, const Vec3& b) {
    return std::atan2(a.y(), a.x()) < std::atan2(b.y(), b.x());
  });
  return loop;
}

/// Both borders on slices 8 mm apart, in images that lie `moved` from the model.
std::vector<Contour> loops_of(const mesh::Mesh& mesh, const std::vector<Vec3>& nodes,
                              const Vec3& moved) {
  std::vector<Contour> loops;
  for (int slice = 1; slice <= 5; ++slice)
    for (const Side side : {Side::endo, Side::epi}) {
      const mesh::Surface& surface = side == Side::endo ? mesh.endo : mesh.epi;
      loops.push_back(cut(surface, nodes, -8.0 * slice, side));
      loops.back().slice = slice;
      for (Vec3& x : loops.back().points)
        x += moved;
    }
  return loops;
}

mesh::Mesh coarse_ventricle() {
  return verify::ideal_mesh({.edge_length = 14.0, .layers = 1, .order = 2});
}

/// Wider by a factor, as high.
std::vector<Vec3> widened(std::vector<Vec3> nodes, double factor) {
  for (Vec3& x : nodes)
    x = Vec3(factor * x.x(), factor * x.y(), x.z());
  return nodes;
}

}  // namespace

TEST_CASE("the drawn surfaces themselves are found at no distance, wherever they lie on the axis",
          "[unit][anatomy]") {
  const mesh::Mesh mesh = coarse_ventricle();
  const auto parts = anatomy::drawn_parts({}, loops_of(mesh, mesh.nodes, {0.0, 0.0, -6.0}), 0.0);
  REQUIRE(parts.size() == 60);
  CHECK(parts[0].name == "1 endo ant");
  CHECK(parts[0].points[0].y() > 0.0);  // a quarter turn beyond the septum, which lies along x
  for (const double d : anatomy::mean_distances(mesh, mesh.nodes, parts))
    CHECK(d == Approx(0.0).margin(2e-3));
}

TEST_CASE("a part that is drawn too far out lies alone inside of the model's surface, or outside",
          "[unit][anatomy]") {
  const mesh::Mesh mesh = coarse_ventricle();
  auto parts = anatomy::drawn_parts({}, loops_of(mesh, mesh.nodes, Vec3::Zero()), 0.0);
  for (const std::size_t n : {24U, 30U})  // anterior, of the third slice: endocardium, epicardium
    for (Vec3& x : parts[n].points)
      x += Vec3(x.x(), x.y(), 0.0).normalized();
  const auto d = anatomy::mean_distances(mesh, mesh.nodes, parts);
  for (std::size_t n = 0; n < d.size(); ++n)
    CHECK(d[n] == Approx(n == 24 || n == 30 ? -1.0 : 0.0).margin(0.1));
}

TEST_CASE("distances do not leap as a wall grows narrower than loops near its base",
          "[unit][anatomy]") {
  const mesh::Mesh mesh = coarse_ventricle();
  const auto parts = anatomy::drawn_parts({}, loops_of(mesh, mesh.nodes, {0.0, 0.0, 6.0}), 0.0);
  std::vector<double> before;
  for (int step = 0; step <= 30; ++step) {
    const std::vector<Vec3> nodes = widened(mesh.nodes, 1.0 - 0.002 * step);
    const std::vector<double> now = anatomy::mean_distances(mesh, nodes, parts);
    for (std::size_t n = 0; n < before.size(); ++n)  // 0.06 mm of the epicardium's radius
      CHECK(now[n] == Approx(before[n]).margin(0.1));
    before = now;
  }
  CHECK(*std::min_element(before.begin(), before.end()) < -0.5);
}

TEST_CASE("the end-systolic surfaces of a twin give its contractility back, whatever its volume",
          "[calibrate]") {
  using calibrate::FitParameters;
  const mesh::Mesh mesh = coarse_ventricle();
  calibrate::Ventricle ventricle(
      mesh,
      [](const FitParameters& p) {
        solid::CardiacModel heart{.base = {.stiffness = implicit::rigid_base}};
        heart.myocardium.active = material::NiedererHunterSmith{.T_scale = p.T_scale};
        return implicit::StaticModel(heart);
      },
      {});
  calibrate::Plan plan;
  plan.active = true;
  plan.ed_pressure = 8.0 * mmHg;
  plan.es_pressure = 120.0 * mmHg;
  plan.T_scale = {0.1, 20.0};
  plan.errors = {.volume = 10.0, .shape = 0.5};  // the volume is not believed
  plan.parameters_alone = true;
  const FitParameters truth{.T_scale = 3.6};
  const solid::Loads es{plan.es_pressure, 1.0};
  const auto parts = anatomy::drawn_parts(
      {}, loops_of(mesh, ventricle.positions(truth, es).value(), {0.0, 0.0, -7.0}), 0.0);
  for (const anatomy::DrawnPart& part : parts)
    plan.drawn.push_back(part.name);
  plan.esv.volume = 1.1 * ventricle.volume(truth, es).value();
  const calibrate::Model model{
      [&](const FitParameters& p, const solid::Loads& loads) { return ventricle.volume(p, loads); },
      [&](const FitParameters& p) { return ventricle.unloaded_volume(p); },
      {},
      [&](const FitParameters& p, const solid::Loads& loads) {
        return Outcome<std::vector<double>>(
            anatomy::mean_distances(mesh, ventricle.positions(p, loads).value(), parts));
      }};
  const calibrate::Fit fit = calibrate::fit(model, {.T_scale = 3.0}, plan);
  CHECK(fit.parameters.T_scale == Approx(truth.T_scale).epsilon(0.01));
  REQUIRE(fit.regional_fit);
  const calibrate::ShapeFit& shape = fit.regional_fit->shape.value();
  CHECK(shape.before.bias > 0.3);  // fitted to a volume too large
  CHECK(shape.after.rms < 0.03);
  plan.drawn.clear();
  CHECK(calibrate::fit(model, {.T_scale = 3.0}, plan).parameters.T_scale < 0.85 * truth.T_scale);
}
