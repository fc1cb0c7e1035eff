#include "lv/analysis/regional.hpp"

#include "mesh_io/mesh_files.hpp"
#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include <cmath>
#include <map>
#include <numeric>

namespace {

using namespace lv;
using analysis::CellFields;
using analysis::Region;

std::vector<CellFields> cells_of_volumes(const std::vector<double>& volumes) {
  std::vector<CellFields> cells(volumes.size());
  for (std::size_t c = 0; c < cells.size(); ++c)
    cells[c].volume = volumes[c];
  return cells;
}

/// Cells of different volumes on a ring about (3, -2), radius 25, 30 degrees short of closing.
std::vector<CellFields> ring() {
  std::vector<CellFields> cells(12);
  for (int c = 0; c < 12; ++c) {
    const double angle = 0.48 * c;
    cells[c].volume = 1.0 + 0.1 * c;
    cells[c].position = Vec3(3 + 25 * std::cos(angle), -2 + 25 * std::sin(angle), -30.0);
  }
  return cells;
}

std::vector<CellFields> moved(std::vector<CellFields> cells, const Mat3& A, const Vec3& b) {
  for (CellFields& cell : cells)
    cell.position = A * cell.position + b;
  return cells;
}

/// Right-handed about z: anticlockwise seen from the base.
Mat3 turn(double angle) {
  return Eigen::AngleAxisd(angle, Vec3::UnitZ()).toRotationMatrix();
}

std::vector<int> all_of(const std::vector<CellFields>& cells) {
  std::vector<int> members(cells.size());
  std::iota(members.begin(), members.end(), 0);
  return members;
}

struct Ventricle {
  mesh::Mesh mesh = test::ellipsoid_mesh({}, 5.0, 2);
  mesh::Regions regions = mesh::divide(mesh, {});
  std::vector<CellFields> cells = std::vector<CellFields>(mesh.cell_count());
};

}  // namespace

TEST_CASE("means and deviations are weighted by volume", "[unit][analysis]") {
  const auto cells = cells_of_volumes({1, 2, 5, 100});
  const auto s = analysis::statistics({4.0, 1.0, 2.0, 1e6}, cells, {0, 1, 2});
  CHECK(s.mean == Approx(2.0));  // (4 + 2 + 10) / 8
  CHECK(s.sd == Approx(std::sqrt((4.0 + 2.0) / 8.0)));
}

TEST_CASE("a cell counts as much as the parts it could be cut in", "[unit][analysis]") {
  const auto whole = analysis::statistics({5, 7, 9}, cells_of_volumes({1, 3, 2}), {0, 1, 2});
  const auto parts = analysis::statistics({7, 9, 5, 7, 9, 7}, cells_of_volumes({1, 1, 1, 1, 1, 1}),
                                          {0, 1, 2, 3, 4, 5});
  CHECK(whole.mean == Approx(parts.mean));
  CHECK(whole.sd == Approx(parts.sd));
  CHECK(whole.p1 == parts.p1);
  CHECK(whole.p50 == parts.p50);
  CHECK(whole.p99 == parts.p99);
}

TEST_CASE("percentiles are where that share of the volume lies below", "[unit][analysis]") {
  std::vector<double> values(1000);
  for (int i = 0; i < 1000; ++i)
    values[i] = (i * 7) % 1000;  // all numbers below 1000, out of order
  const auto cells = cells_of_volumes(std::vector<double>(1000, 0.3));
  const auto s = analysis::statistics(values, cells, all_of(cells));
  CHECK(s.p1 == Approx(10.0).margin(1.0));  // one cell more or less
  CHECK(s.p50 == Approx(500.0).margin(1.0));
  CHECK(s.p99 == Approx(990.0).margin(1.0));
}

TEST_CASE("a region without cells has no statistics and no rotation", "[unit][analysis]") {
  const auto s = analysis::statistics({1.0}, cells_of_volumes({1.0}), {});
  for (const double value : {s.mean, s.sd, s.p1, s.p50, s.p99})
    CHECK(std::isnan(value));
  CHECK(std::isnan(analysis::rotation(ring(), ring(), {})));
}

TEST_CASE("rotation is positive anticlockwise seen from the apex", "[unit][analysis]") {
  // seen from the apex, the right-handed sense about z is clockwise
  for (const double angle : {0.2, -0.3, 3.0})
    CHECK(analysis::rotation(moved(ring(), turn(-angle), {0, 0, 0}), ring(), all_of(ring())) ==
          Approx(angle));
}

TEST_CASE("rotation is about the region's own centre", "[unit][analysis]") {
  const Mat3 widen_and_turn = 1.3 * turn(-0.2);
  CHECK(analysis::rotation(moved(ring(), widen_and_turn, {20, -10, 5}), ring(), all_of(ring())) ==
        Approx(0.2));
  CHECK(std::abs(analysis::rotation(moved(ring(), Mat3::Identity(), {20, -10, 5}), ring(),
                                    all_of(ring()))) < 1e-14);
}

TEST_CASE("only a region's members tell its rotation", "[unit][analysis]") {
  auto now = moved(ring(), turn(-0.2), {0, 0, 0});
  now[5].position = {1000, 1000, 0};
  CHECK(analysis::rotation(now, ring(), {0, 2, 4, 7, 9}) == Approx(0.2));
}

TEST_CASE("each scheme of regions divides the wall without gap or overlap", "[unit][analysis]") {
  const Ventricle lv;
  std::map<std::string, std::vector<int>> count;  // how often each cell occurs in a scheme
  std::map<std::string, int> regions;
  for (const Region& region : analysis::region_list(lv.regions, lv.cells)) {
    ++regions[region.scheme];
    auto& occurrences = count[region.scheme];
    occurrences.resize(lv.cells.size(), 0);
    for (const int c : region.cells)
      ++occurrences[c];
  }
  const std::map<std::string, int> expected{
      {"whole", 1}, {"third", 3}, {"slice", 7}, {"sector", 38}, {"aha17", 17}};
  CHECK(regions == expected);
  for (const auto& [scheme, occurrences] : count)
    CHECK(occurrences == std::vector<int>(lv.cells.size(), 1));
}

TEST_CASE("thirds are the slices 1-2, 3-5 and 6-7", "[unit][analysis]") {
  const Ventricle lv;
  for (const Region& region : analysis::region_list(lv.regions, lv.cells))
    if (region.scheme == "third")
      for (const int c : region.cells) {
        const int slice = lv.regions.slice[c];
        CHECK(region.name == (slice <= 2 ? "basal" : slice <= 5 ? "middle" : "apical"));
      }
}

TEST_CASE("zones appear with an infarct and divide the wall by its extent", "[unit][analysis]") {
  Ventricle lv;
  for (std::size_t c = 0; c < lv.cells.size(); ++c)
    lv.cells[c].infarct = c < 10 ? 1.0 : c < 30 ? 0.4 : 0.0;
  std::map<std::string, std::size_t> sizes;
  for (const Region& region : analysis::region_list(lv.regions, lv.cells))
    if (region.scheme == "zone")
      sizes[region.name] = region.cells.size();
  const std::map<std::string, std::size_t> expected{
      {"infarct", 10}, {"border", 20}, {"remote", lv.cells.size() - 30}};
  CHECK(sizes == expected);
}

TEST_CASE("quantities without an earlier state are from the undeformed wall", "[unit][analysis]") {
  auto now = cells_of_volumes({1.0});
  now[0].F = Vec3(1.2, 0.9, 1.0).asDiagonal();
  now[0].axes = mesh::wall_axes(Vec3::UnitX());
  now[0].pressure = 2.5;
  const auto value = [&](const std::vector<CellFields>& then, const std::string& name) {
    for (const auto& q : analysis::cell_quantities(now, then))
      if (q.quantity->name == name)
        return q.values.at(0);
    FAIL("no quantity " << name);
    return 0.0;
  };
  CHECK(value({}, "radial_strain") == Approx(0.22));
  CHECK(value({}, "circumferential_strain") == Approx(-0.095));
  CHECK(value({}, "thickening") == Approx(0.2));
  CHECK(value({}, "pressure") == 2.5);
  CHECK(value(now, "radial_strain") == Approx(0.0).margin(1e-15));
  CHECK(value(now, "J") == 1.0);
}
