// Strain and stress of AHA segments over a beat, from its frames on disk.
#include "lv/page/wall_series.hpp"
#include "lv/report/fields_vtk.hpp"
#include "lv/report/tables_csv.hpp"

#include "mesh_io/mesh_files.hpp"
#include "support/temporary_folder.hpp"
#include <catch2/catch.hpp>

#include <cmath>
#include <map>

namespace {

using namespace lv;
using analysis::CellFields;

/// A coarse ventricle whose elements differ in volume, shape and stress, more so later.
struct Beating {
  mesh::Mesh mesh = test::ellipsoid_mesh({}, 12.0, 2);
  mesh::Regions regions = mesh::divide(mesh, {});

  [[nodiscard]] std::vector<CellFields> cells(double t) const {
    std::vector<CellFields> all(mesh.cell_count());
    for (std::size_t c = 0; c < all.size(); ++c) {
      const double a = std::sin(0.7 * static_cast<double>(c));
      all[c].volume = 20.0 + 3.0 * a;
      all[c].F << 1 + t * a, 0.1 * t, 0, t * t * a, 1 - 0.3 * t, 0.05 * a, 0, 0.1 * t, 1 + 0.2 * t;
      all[c].tension = 30 * t + a;
      all[c].fibre_stress_passive = 5 * t * t - a;
      all[c].fibre_stress_active = 30 * t + a;
      all[c].pressure = 4 + t * a;
      all[c].axes = mesh::wall_axes(Vec3(std::cos(0.3 * a), std::sin(0.3 * a), 0.1 * a));
    }
    return all;
  }
  [[nodiscard]] heartbeat::Snapshot snapshot(double t) const {
    heartbeat::Snapshot s;
    s.time = t;
    s.positions = mesh.nodes;
    return s;
  }
};

}  // namespace

TEST_CASE("at their moments the courses of segments are the means of regions.csv", "[unit][page]") {
  const Beating wall;
  const test::TemporaryFolder folder;
  constexpr double end_diastole = 0.25;
  constexpr double end_systole = 0.5;
  std::vector<page::TimedFrame> frames;
  for (const double t : {0.125, end_diastole, 0.375, end_systole}) {
    frames.push_back({t, folder / (std::to_string(frames.size()) + ".vtu")});
    report::write_wall(frames.back().file, wall.mesh, wall.regions, wall.snapshot(t), wall.cells(t),
                       t < end_diastole ? std::vector<CellFields>{} : wall.cells(end_diastole));
  }
  const Table courses = page::segments_over_time(frames, end_diastole);
  REQUIRE(courses.rows().size() == frames.size() * mesh::aha_count);
  CHECK(courses.columns() ==
        std::vector<std::string>{"time_s", "segment", "name", "active_tension_kPa",
                                 "fibre_stress_kPa", "fibre_stress_passive_kPa", "fibre_strain",
                                 "circumferential_strain", "radial_strain", "longitudinal_strain"});

  heartbeat::Beat beat;
  for (const auto& [name, t] : {std::pair{heartbeat::end_diastole, end_diastole},
                                std::pair{heartbeat::end_systole, end_systole}})
    beat.moments.push_back({name, "", true, wall.snapshot(t)});
  const analysis::Results results =
      analysis::results(wall.mesh, wall.regions, beat,
                        {wall.cells(0.0),
                         {{heartbeat::end_diastole, wall.cells(end_diastole)},
                          {heartbeat::end_systole, wall.cells(end_systole)}}});
  const std::map<std::string, std::size_t> first_row{{heartbeat::end_diastole, 1 * mesh::aha_count},
                                                     {heartbeat::end_systole, 3 * mesh::aha_count}};
  int compared = 0;
  for (const analysis::RegionalValue& r : results.regional) {
    const std::string column = r.unit == "1" ? r.quantity : r.quantity + "_" + r.unit;
    const std::vector<double> course = courses.numbers(column);
    if (r.scheme != "aha17" || std::isnan(course.front()))
      continue;
    const std::size_t segment = std::stoul(r.region);
    INFO(r.state << ", " << r.region << ", " << r.quantity);
    CHECK(course[first_row.at(r.state) + segment - 1] ==
          Approx(r.statistics.mean).epsilon(6e-6).margin(1e-7));
    ++compared;
  }
  CHECK(compared == 2 * mesh::aha_count * 7);
}
