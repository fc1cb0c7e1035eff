#include "lv/activation/front.hpp"

#include "lv/base/check.hpp"
#include "lv/mesh/refine.hpp"

#include "support/block_mesh.hpp"
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

namespace {

using namespace lv;
using activation::Speeds;
using mesh::CellKind;

std::vector<Mat3> even(const mesh::Mesh& mesh, const Mat3& metric) {
  return std::vector<Mat3>(mesh.cell_count(), metric);
}

double longest(const std::vector<double>& times) {
  return *std::max_element(times.begin(), times.end());
}

}  // namespace

TEST_CASE("the travel metric gives each direction its speed", "[unit][activation]") {
  Mat3 frame;
  frame << 0, 1, 0, 0, 0, 1, 1, 0, 0;  // f0 = z, s0 = x, n0 = y
  const Mat3 G = activation::travel_metric(frame, {600.0, 300.0, 150.0, 0.0});
  CHECK(std::sqrt(G(2, 2)) == Approx(1.0 / 600.0));
  CHECK(std::sqrt(G(0, 0)) == Approx(1.0 / 300.0));
  CHECK(std::sqrt(G(1, 1)) == Approx(1.0 / 150.0));
}

TEST_CASE("a front along the edges of cells arrives with its speed", "[unit][activation]") {
  for (const CellKind kind : {CellKind::hexahedron, CellKind::tetrahedron}) {
    const mesh::Mesh m = test::cubes(kind, 3);
    const Mat3 G = activation::travel_metric(Mat3::Identity(), {600.0, 300.0, 150.0, 0.0});
    std::vector<activation::Start> starts;
    double top = 0.0;
    for (std::size_t a = 0; a < m.nodes.size(); ++a) {
      if (m.nodes[a].z() == 0.0)
        starts.push_back({static_cast<int>(a), 0.01});
      top = std::max(top, m.nodes[a].z());
    }
    const auto times = activation::arrival_times(m, even(m, G), {.endocardium = 0.0}, starts);
    for (std::size_t a = 0; a < m.nodes.size(); ++a)
      CHECK(times[a] == Approx(0.01 + m.nodes[a].z() / 150.0));
    CHECK(longest(times) == Approx(0.01 + top / 150.0));
  }
}

TEST_CASE("the endocardium carries a front ahead of the muscle", "[unit][activation]") {
  mesh::Mesh m = mesh::refine(test::block_mesh(CellKind::hexahedron, 2));
  REQUIRE(m.endo.size() > 0);
  const Mat3 G = Mat3::Identity() / (100.0 * 100.0);
  const std::vector<activation::Start> start{{m.endo.nodes.front(), 0.0}};
  const auto slow = activation::arrival_times(m, even(m, G), {.endocardium = 0.0}, start);
  const auto fast = activation::arrival_times(m, even(m, G), {.endocardium = 1000.0}, start);
  for (std::size_t a = 0; a < m.nodes.size(); ++a)
    CHECK(fast[a] <= slow[a]);
  const Vec3 from = m.nodes[start.front().node];
  for (const int node : m.endo.nodes)
    CHECK(fast[node] >= (m.nodes[node] - from).norm() / 1000.0 * (1.0 - 1e-9));
  CHECK(longest(fast) < 0.8 * longest(slow));
}

TEST_CASE("muscle that no front reaches is refused", "[unit][activation]") {
  const mesh::Mesh m = test::cubes(CellKind::hexahedron, 1);
  CHECK_THROWS_AS(activation::arrival_times(m, even(m, Mat3::Identity()), {}, {}), InputError);
}
