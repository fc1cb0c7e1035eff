#include "lv/analysis/results.hpp"

#include "mesh_io/mesh_files.hpp"
#include "support/block_mesh.hpp"
#include <Eigen/Geometry>
#include <catch2/catch.hpp>

namespace {

using namespace lv;

/// A beat that fills by `filling` and then contracts by `contraction`.
struct PrescribedBeat {
  PrescribedBeat(const Mat3& filling, const Mat3& contraction) {
    const analysis::FieldAnalysis analysis(mesh, {.base = {.stiffness = 0.0}});
    beat.moments = {
        {heartbeat::end_diastole, "filling", true, snapshot(0.6, 1.07, filling)},
        {heartbeat::end_systole, "contraction", true, snapshot(0.9, 20.0, contraction * filling)}};
    analysis::BeatFields fields{analysis.at_rest(), {}};
    for (const heartbeat::NamedMoment& m : beat.moments)
      fields.moments.push_back({m.name, analysis.fields(m.wall)});
    results = analysis::results(mesh, mesh::divide(mesh, {}), beat, fields);
  }

  [[nodiscard]] heartbeat::Snapshot snapshot(double time, double pressure, const Mat3& F) const {
    heartbeat::Snapshot s;
    s.time = time;
    s.pressure = pressure;
    s.positions = test::moved(mesh.nodes, F);
    s.tension.assign(mesh.nodes.size(), 0.0);
    return s;
  }

  mesh::Mesh mesh = test::coarse_mesh(mesh::CellKind::hexahedron);
  heartbeat::Beat beat;
  analysis::Results results;
};

}  // namespace

TEST_CASE("volumes, lengths and times of a beat are those of its states", "[unit][analysis]") {
  const Mat3 filling = Vec3(1.2, 1.2, 1.1).asDiagonal();
  const Mat3 contraction = Vec3(0.8, 0.8, 0.9).asDiagonal();
  const PrescribedBeat lv(filling, contraction);
  const analysis::Results& r = lv.results;
  const double V = r.early_diastole.cavity_volume;
  CHECK(r.at(heartbeat::end_diastole).cavity_volume == Approx(1.2 * 1.2 * 1.1 * V));
  CHECK(r.at(heartbeat::end_systole).cavity_volume ==
        Approx(0.8 * 0.8 * 0.9 * 1.2 * 1.2 * 1.1 * V));
  CHECK(r.ejection_fraction() == Approx(1.0 - 0.8 * 0.8 * 0.9));
  CHECK(r.at(heartbeat::end_diastole).wall_volume ==
        Approx(1.2 * 1.2 * 1.1 * r.early_diastole.wall_volume));
  CHECK(r.early_diastole.wall_volume == Approx(test::volume(lv.mesh)));
  CHECK(r.early_diastole.apex_endo_z == Approx(-80.0).epsilon(1e-3));  // 60 + 20 mm
  CHECK(r.early_diastole.long_axis == Approx(80.0).epsilon(1e-3));
  CHECK(r.at(heartbeat::end_systole).long_axis == Approx(0.99 * r.early_diastole.long_axis));
  CHECK(r.at(heartbeat::end_diastole).apex_epi_z == Approx(1.1 * r.early_diastole.apex_epi_z));
  CHECK(r.at(heartbeat::end_systole).base_endo_radius ==
        Approx(0.96 * r.early_diastole.base_endo_radius));
  CHECK(r.at(heartbeat::end_systole).base_axial_shift == Approx(0.0).margin(1e-12));
  CHECK(r.at(heartbeat::end_diastole).time == 0.6);
  CHECK(r.at(heartbeat::end_systole).pressure == 20.0);
  CHECK(r.whole(heartbeat::end_diastole, "J").mean == Approx(1.2 * 1.2 * 1.1));
  CHECK(r.whole(heartbeat::end_systole, "J").sd == Approx(0.0).margin(1e-7));
}

TEST_CASE("shortening and thickening are from end-diastole", "[unit][analysis]") {
  const Mat3 filling = Vec3(1.2, 1.2, 1.1).asDiagonal();
  const PrescribedBeat lv(filling, 0.9 * Mat3::Identity());
  CHECK(lv.results.fibre_shortening == Approx(0.1));
  CHECK(lv.results.thickening == Approx(-0.1));
  CHECK(lv.results.whole("end_systole", "fibre_strain").mean == Approx(0.5 * (0.81 - 1.0)));
}

TEST_CASE("every slice of a wall that turns as a whole turns by that angle", "[unit][analysis]") {
  // in the right-handed sense about z: clockwise seen from the apex
  const Mat3 filling = Eigen::AngleAxisd(0.05, Vec3::UnitZ()).toRotationMatrix();
  const Mat3 contraction = Eigen::AngleAxisd(-0.25, Vec3::UnitZ()).toRotationMatrix();
  const PrescribedBeat lv(filling, contraction);
  REQUIRE(lv.results.rotation.size() == 7);
  for (int s = 0; s < 7; ++s) {
    const analysis::SliceRotation& slice = lv.results.rotation[s];
    CHECK(slice.slice == s + 1);
    CHECK(slice.filling == Approx(-0.05));
    CHECK(slice.from_end_diastole == Approx(0.25));
    CHECK(slice.from_early_diastole == Approx(0.20));
  }
}
